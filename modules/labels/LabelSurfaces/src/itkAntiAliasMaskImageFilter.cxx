#include "itkAntiAliasMaskImageFilter.h"

#include "detail/itkRowArithmetic.h"
#include "itkInputSamples.h"
#include "itkMath.h"
#include "itkMultiThreaderBase.h"
#include "itkVoxelBand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace itk
{
namespace
{

/** A Gaussian of sigma voxels, and how the local volumes in it are matched. */
struct Scale
{
  double sigma;
  unsigned int corrections;
  float gain; // below 1 for thin parts, where Newton's step overshoots
};
constexpr Scale Wide{ 2.5, 2, 1.0f };
constexpr Scale Medium{ 1.2, 4, 0.6f };
constexpr Scale Fine{ 1.0, 10, 0.5f };
constexpr double WideningByPeriod = 0.3;
constexpr unsigned int CorrectionsBetweenSlices = 6;
constexpr double BandWidth = 2.0;  // of the wide Gaussian, in sigma: depths there reach 3 voxels
constexpr float Narrow = 0.2f;     // voxels: depth on the wrong side; times the widening
constexpr float VeryNarrow = 0.3f; // voxels: the same, after the medium Gaussian
constexpr float Lost = 0.03f;      // voxels: depth on the wrong side
constexpr float TubeRadius = 0.6f; // voxels
constexpr SizeValueType LargestSpur = 2;
constexpr SizeValueType SmallestSheet = 16;
constexpr unsigned int Passes = Wide.corrections + Medium.corrections + Fine.corrections + 5;

/** Weights of a Gaussian at -r, ..., r voxels, r being three sigma, rounded up. */
std::vector<float>
GaussianWeights(double sigma)
{
  const auto reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<double> weights;
  double sum = 0.0;
  for (int n = -reach; n <= reach; ++n)
  {
    weights.push_back(std::exp(-0.5 * n * n / (sigma * sigma)));
    sum += weights.back();
  }
  std::vector<float> normalized;
  for (const double weight : weights)
  {
    normalized.push_back(static_cast<float>(weight / sum));
  }
  return normalized;
}

/** The inverse of the slope of a step smoothed with a Gaussian. */
double
InverseSlope(double sigma)
{
  return sigma * std::sqrt(2.0 * Math::pi);
}

/** The sample of an axis at \a sample - \a reach, or the nearest one. */
SizeValueType
ClampedSample(SizeValueType sample, SizeValueType reach, SizeValueType length)
{
  return sample < reach ? 0 : std::min(sample - reach, length - 1);
}

/** The 26 neighbours of voxels, which are given by their offset in the buffer. */
struct VoxelGrid
{
  using Coordinates = std::array<OffsetValueType, 3>;

  std::array<SizeValueType, 3> size;

  Coordinates
  CoordinatesOf(SizeValueType voxel) const
  {
    const SizeValueType row = voxel / size[0];
    return { static_cast<OffsetValueType>(voxel % size[0]),
             static_cast<OffsetValueType>(row % size[1]),
             static_cast<OffsetValueType>(row / size[1]) };
  }

  SizeValueType
  OffsetOf(const Coordinates & voxel) const
  {
    return (static_cast<SizeValueType>(voxel[2]) * size[1] + static_cast<SizeValueType>(voxel[1])) * size[0] +
           static_cast<SizeValueType>(voxel[0]);
  }

  bool
  Holds(const Coordinates & voxel) const
  {
    bool isIn = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isIn = isIn && voxel[axis] >= 0 && voxel[axis] < static_cast<OffsetValueType>(size[axis]);
    }
    return isIn;
  }

  template <typename TVisit>
  void
  ForEachNeighbor(SizeValueType voxel, const TVisit & visit) const
  {
    const Coordinates center = this->CoordinatesOf(voxel);
    for (const OffsetValueType dz : { -1, 0, 1 })
    {
      for (const OffsetValueType dy : { -1, 0, 1 })
      {
        for (const OffsetValueType dx : { -1, 0, 1 })
        {
          const Coordinates neighbor{ center[0] + dx, center[1] + dy, center[2] + dz };
          if ((dx != 0 || dy != 0 || dz != 0) && this->Holds(neighbor))
          {
            visit(this->OffsetOf(neighbor));
          }
        }
      }
    }
  }

  /** Whether a few voxels, at least one, are one connected piece. */
  bool
  AreConnected(std::vector<SizeValueType> voxels) const
  {
    if (voxels.empty())
    {
      return false;
    }
    auto reached = voxels.begin() + 1; // end of the voxels connected with the first
    for (auto from = voxels.begin(); from != reached; ++from)
    {
      const Coordinates here = this->CoordinatesOf(*from);
      reached = std::partition(reached, voxels.end(), [&](SizeValueType voxel) {
        const Coordinates there = this->CoordinatesOf(voxel);
        return std::abs(here[0] - there[0]) <= 1 && std::abs(here[1] - there[1]) <= 1 &&
               std::abs(here[2] - there[2]) <= 1;
      });
    }
    return reached == voxels.end();
  }
};

constexpr float
SideOf(std::uint8_t mask)
{
  return mask != 0 ? 1.0f : -1.0f;
}

} // namespace

void
AntiAliasMaskImageFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ProtectSpecksOnly: " << (m_ProtectSpecksOnly ? "On" : "Off") << std::endl;
  os << indent << "SamplePeriod: " << m_SamplePeriod[0] << ' ' << m_SamplePeriod[1] << ' ' << m_SamplePeriod[2]
     << std::endl;
  os << indent << "ThinVoxels: " << m_ThinVoxels.size() << std::endl;
  os << indent << "ProtectedVoxels: " << m_ProtectedVoxels.size() << std::endl;
}

void
AntiAliasMaskImageFilter::SetSamplePeriod(const PeriodType & period)
{
  if (period != m_SamplePeriod)
  {
    if (*std::min_element(period.begin(), period.end()) == 0)
    {
      itkExceptionMacro("The SamplePeriod must be at least 1 along each axis.");
    }
    m_SamplePeriod = period;
    this->Modified();
  }
}

void
AntiAliasMaskImageFilter::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  const_cast<InputImageType *>(this->GetInput())->SetRequestedRegionToLargestPossibleRegion();
}

void
AntiAliasMaskImageFilter::EnlargeOutputRequestedRegion(DataObject * output)
{
  output->SetRequestedRegionToLargestPossibleRegion();
}

void
AntiAliasMaskImageFilter::GenerateData()
{
  VerifyInputSamples(*this, *this->GetInput());
  this->AllocateOutputs();
  const auto & size = this->GetOutput()->GetBufferedRegion().GetSize();
  m_Size = { size[0], size[1], size[2] };
  m_Mask = this->GetInput()->GetBufferPointer();
  m_Field = this->GetOutput()->GetBufferPointer();
  m_ThinVoxels.clear();
  m_ProtectedVoxels.clear();
  const std::unique_ptr<float[]> smoothed(new float[size[0] * size[1] * size[2]]);
  m_Smoothed = smoothed.get();
  WorkProgress progress(*this, Passes * (size[1] + size[2]));
  m_WorkProgress = &progress;

  const auto longestPeriod = *std::max_element(m_SamplePeriod.begin(), m_SamplePeriod.end());
  m_Widening = std::max(1.0, WideningByPeriod * static_cast<double>(longestPeriod));
  const VoxelBand border = this->FindBorder();
  const auto reach = static_cast<SizeValueType>(std::ceil(BandWidth * m_Widening * Wide.sigma));
  const VoxelBand band = border.Widened({ reach, reach, reach });
  const auto far = static_cast<float>(0.5 * InverseSlope(m_Widening * Wide.sigma));
  this->ForEach(size[2], [&](SizeValueType z) {
    for (SizeValueType voxel = z * size[0] * size[1]; voxel < (z + 1) * size[0] * size[1]; ++voxel)
    {
      m_Field[voxel] = m_Mask[voxel] != 0 ? far : -far;
    }
  });
  this->MatchLocalVolumes(
    Wide.sigma, longestPeriod > 1 ? CorrectionsBetweenSlices : Wide.corrections, Wide.gain, band, m_Field);
  std::vector<std::uint8_t> thin(size[0] * size[1] * size[2]);
  std::vector<std::uint8_t> isMarked(thin.size());
  if (this->FindNarrow(thin, band, Narrow * static_cast<float>(m_Widening), isMarked))
  {
    this->Refine(Medium.sigma, Medium.corrections, Medium.gain, isMarked);
  }
  this->FindThin(border.Widened({ 2, 2, 2 }), thin);
  for (SizeValueType voxel = 0; voxel < thin.size(); ++voxel)
  {
    if (thin[voxel] != 0 && m_Mask[voxel] != 0)
    {
      m_ThinVoxels.push_back(voxel);
    }
  }
  if (this->FindNarrow(thin, band, VeryNarrow, isMarked))
  {
    this->Refine(Fine.sigma, Fine.corrections, Fine.gain, isMarked);
    this->KeepLost(thin, isMarked);
    this->DropSpurs(isMarked);
    this->Protect(isMarked, false);
    this->Protect(isMarked, true);
  }
  progress.Finish();
}

void
AntiAliasMaskImageFilter::ForEach(SizeValueType count, const std::function<void(SizeValueType)> & work)
{
  ThreadFailure failure;
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->ParallelizeArray(
    0,
    count,
    [&](SizeValueType n) {
      failure.Capture([&] {
        m_WorkProgress->CheckAbort();
        work(n);
      });
    },
    nullptr);
  failure.Rethrow();
}

void
AntiAliasMaskImageFilter::CheckAbortAt(SizeValueType n) const
{
  constexpr SizeValueType period = 4096;
  if (n % period == 0)
  {
    m_WorkProgress->CheckAbort();
  }
}

VoxelBand
AntiAliasMaskImageFilter::FindBorder()
{
  const SizeValueType length = m_Size[0];
  const SizeValueType height = m_Size[1];
  VoxelBand border(m_Size);
  this->ForEach(m_Size[2], [&](SizeValueType z) {
    for (SizeValueType row = z * height; row < (z + 1) * height; ++row)
    {
      const std::uint8_t * const voxels = m_Mask + row * length;
      const SizeValueType y = row - z * height;
      const std::uint8_t * const others[] = { y > 0 ? voxels - length : voxels,
                                              y + 1 < height ? voxels + length : voxels,
                                              z > 0 ? voxels - height * length : voxels,
                                              z + 1 < m_Size[2] ? voxels + height * length : voxels };
      for (SizeValueType begin = 0; begin < length; begin += border.GetTileLength())
      {
        const SizeValueType end = std::min(begin + border.GetTileLength(), length);
        bool isBorder = false;
        for (SizeValueType x = begin; x < end; ++x)
        {
          isBorder |= (voxels[x] != 0) != (voxels[std::min(x + 1, length - 1)] != 0);
        }
        for (const std::uint8_t * const other : others)
        {
          for (SizeValueType x = begin; x < end; ++x)
          {
            isBorder |= (voxels[x] != 0) != (other[x] != 0);
          }
        }
        if (isBorder)
        {
          border.Mark(row, begin);
        }
      }
    }
  });
  return border;
}

void
AntiAliasMaskImageFilter::Smooth(double sigma, const VoxelBand & band, const RowReader & read, const RowWriter & write)
{
  const std::vector<float> weights = GaussianWeights(sigma);
  const SizeValueType taps = weights.size();
  const SizeValueType reach = taps / 2;
  const SizeValueType width = m_Size[0];
  const SizeValueType height = m_Size[1];
  const SizeValueType depth = m_Size[2];
  const SizeValueType stride = RowArithmetic::PaddedLength(width);
  const VoxelBand smoothedInPlane = band.Widened({ 0, 0, reach });
  const VoxelBand smoothedInRow = smoothedInPlane.Widened({ 0, reach, 0 });

  // Along x and y, plane by plane.
  this->ForEach(depth, [&](SizeValueType z) {
    std::vector<float> extended(stride + 2 * reach);
    std::vector<float> plane(height * stride);
    std::vector<float> blend(stride);
    std::vector<const float *> terms(taps);
    const auto blendRun = [&](const auto & rowOfTap, SizeValueType begin, SizeValueType end, float * result) {
      for (SizeValueType tap = 0; tap < taps; ++tap)
      {
        terms[tap] = rowOfTap(tap) + begin;
      }
      RowArithmetic::Blend(terms.data(), weights.data(), taps, end - begin, result + begin);
    };
    for (SizeValueType y = 0; y < height; ++y)
    {
      if (smoothedInRow.HasRow(y + z * height))
      {
        read(y + z * height, extended.data() + reach);
        std::fill_n(extended.begin(), reach, extended[reach]);
        std::fill_n(extended.begin() + static_cast<std::ptrdiff_t>(reach + width), reach, extended[reach + width - 1]);
        smoothedInRow.ForEachRun(y + z * height, [&](SizeValueType begin, SizeValueType end) {
          blendRun([&](SizeValueType tap) { return extended.data() + tap; }, begin, end, plane.data() + y * stride);
        });
      }
    }
    for (SizeValueType y = 0; y < height; ++y)
    {
      smoothedInPlane.ForEachRun(y + z * height, [&](SizeValueType begin, SizeValueType end) {
        const auto rowOfTap = [&](SizeValueType tap) {
          return plane.data() + ClampedSample(y + tap, reach, height) * stride;
        };
        blendRun(rowOfTap, begin, end, blend.data());
        std::copy(blend.data() + begin, blend.data() + end, m_Smoothed + (y + z * height) * width + begin);
      });
    }
    m_WorkProgress->Completed(1);
  });

  // Along z, for each y.
  this->ForEach(height, [&](SizeValueType y) {
    std::vector<float> rows(depth * stride);
    std::vector<float> blend(stride);
    std::vector<const float *> terms(taps);
    for (SizeValueType z = 0; z < depth; ++z)
    {
      smoothedInPlane.ForEachRun(y + z * height, [&](SizeValueType begin, SizeValueType end) {
        const float * const smoothed = m_Smoothed + (y + z * height) * width;
        std::copy(smoothed + begin, smoothed + end, rows.data() + z * stride + begin);
      });
    }
    for (SizeValueType z = 0; z < depth; ++z)
    {
      band.ForEachRun(y + z * height, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType tap = 0; tap < taps; ++tap)
        {
          terms[tap] = rows.data() + ClampedSample(z + tap, reach, depth) * stride + begin;
        }
        RowArithmetic::Blend(terms.data(), weights.data(), taps, end - begin, blend.data() + begin);
        write(y + z * height, begin, end, blend.data());
      });
    }
    m_WorkProgress->Completed(1);
  });
}

bool
AntiAliasMaskImageFilter::IsSample(SizeValueType voxel) const
{
  const auto coordinates = VoxelGrid{ m_Size }.CoordinatesOf(voxel);
  const auto & first = this->GetOutput()->GetBufferedRegion().GetIndex();
  bool isSample = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    isSample = isSample && (first[axis] + coordinates[axis]) % static_cast<IndexValueType>(m_SamplePeriod[axis]) == 0;
  }
  return isSample;
}

AntiAliasMaskImageFilter::SampleComb
AntiAliasMaskImageFilter::MakeComb(unsigned int axis, double sigma) const
{
  const std::vector<float> weights = GaussianWeights(sigma);
  const SizeValueType length = m_Size[axis];
  const auto period = static_cast<IndexValueType>(m_SamplePeriod[axis]);
  const IndexValueType first = this->GetOutput()->GetBufferedRegion().GetIndex(axis);
  SampleComb comb{ std::vector<float>(length), std::vector<float>(length) };
  for (SizeValueType n = 0; n < length; ++n)
  {
    comb.samples[n] = (first + static_cast<IndexValueType>(n)) % period == 0 ? 1.0f : 0.0f;
  }
  for (SizeValueType n = 0; n < length; ++n)
  {
    constexpr float least = 1e-6f; // far from all samples
    for (SizeValueType tap = 0; tap < weights.size(); ++tap)
    {
      comb.share[n] += weights[tap] * comb.samples[ClampedSample(n + tap, weights.size() / 2, length)];
    }
    comb.share[n] = period == 1 ? 1.0f : std::max(least, comb.share[n]);
  }
  return comb;
}

void
AntiAliasMaskImageFilter::MatchLocalVolumes(double narrowSigma,
                                            unsigned int corrections,
                                            float gain,
                                            const VoxelBand & band,
                                            float * field)
{
  const SizeValueType width = m_Size[0];
  const double sigma = m_Widening * narrowSigma;
  const auto slope = static_cast<float>(InverseSlope(sigma));
  const SampleComb combs[3] = { this->MakeComb(0, sigma), this->MakeComb(1, sigma), this->MakeComb(2, sigma) };
  const float * const samples = combs[0].samples.data();
  const auto isSampleRow = [&](SizeValueType row) {
    return combs[1].samples[row % m_Size[1]] * combs[2].samples[row / m_Size[1]] > 0.0f;
  };
  const auto shareOf = [&](SizeValueType row) {
    return combs[1].share[row % m_Size[1]] * combs[2].share[row / m_Size[1]];
  };
  this->Smooth(
    sigma,
    band,
    [&](SizeValueType row, float * values) {
      const std::uint8_t * const mask = m_Mask + row * width;
      const float half = isSampleRow(row) ? 0.5f : 0.0f;
      for (SizeValueType x = 0; x < width; ++x)
      {
        values[x] = samples[x] * (mask[x] != 0 ? half : -half);
      }
    },
    [&](SizeValueType row, SizeValueType begin, SizeValueType end, const float * values) {
      const float share = shareOf(row);
      for (SizeValueType x = begin; x < end; ++x)
      {
        field[row * width + x] = slope * (values[x] / (share * combs[0].share[x]));
      }
    });
  for (unsigned int n = 0; n < corrections; ++n)
  {
    this->Smooth(
      sigma,
      band,
      [&](SizeValueType row, float * values) {
        std::fill_n(values, width, 0.0f);
        const std::uint8_t * const mask = m_Mask + row * width;
        const float * const depths = field + row * width;
        if (isSampleRow(row))
        {
          band.ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
            for (SizeValueType x = begin; x < end; ++x)
            {
              const float coverage = std::min(1.0f, std::max(0.0f, depths[x] + 0.5f));
              values[x] = samples[x] * ((mask[x] != 0 ? 1.0f : 0.0f) - coverage);
            }
          });
        }
      },
      [&](SizeValueType row, SizeValueType begin, SizeValueType end, const float * values) {
        const float share = shareOf(row);
        for (SizeValueType x = begin; x < end; ++x)
        {
          field[row * width + x] += gain * slope * (values[x] / (share * combs[0].share[x]));
        }
      });
  }
}

void
AntiAliasMaskImageFilter::FindThin(const VoxelBand & band, std::vector<std::uint8_t> & thin)
{
  const SizeValueType width = m_Size[0];
  const SizeValueType height = m_Size[1];
  const SizeValueType depth = m_Size[2];
  const auto sample = [](SizeValueType first, SizeValueType step, SizeValueType length) {
    return ClampedSample(first + step, 1, length);
  };
  // Whether one of the eight 2 x 2 x 2 blocks around a voxel is all of its class.
  const auto isInBlock = [&](SizeValueType x, SizeValueType y, SizeValueType z) {
    const bool isInside = m_Mask[(z * height + y) * width + x] != 0;
    for (unsigned int block = 0; block < 8; ++block)
    {
      bool isWhole = true;
      for (unsigned int corner = 0; corner < 8 && isWhole; ++corner)
      {
        const SizeValueType blockX = sample(x, (block & 1) + (corner & 1), width);
        const SizeValueType blockY = sample(y, (block >> 1 & 1) + (corner >> 1 & 1), height);
        const SizeValueType blockZ = sample(z, (block >> 2) + (corner >> 2), depth);
        isWhole = (m_Mask[(blockZ * height + blockY) * width + blockX] != 0) == isInside;
      }
      if (isWhole)
      {
        return true;
      }
    }
    return false;
  };
  this->ForEach(depth, [&](SizeValueType z) {
    for (SizeValueType y = 0; y < height; ++y)
    {
      band.ForEachRun(z * height + y, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType x = begin; x < end; ++x)
        {
          thin[(z * height + y) * width + x] = isInBlock(x, y, z) ? 0 : 1;
        }
      });
    }
  });
  std::vector<std::uint8_t> isSeen(thin.size());
  for (SizeValueType voxel = 0; voxel < thin.size(); ++voxel)
  {
    this->CheckAbortAt(voxel);
    if (thin[voxel] != 0 && isSeen[voxel] == 0)
    {
      const std::vector<SizeValueType> part = this->CollectPart(voxel, thin, isSeen);
      const std::uint8_t kind = part.size() >= SmallestSheet ? 3 : this->IsSpur(part, thin) ? 1 : 2;
      for (const SizeValueType member : part)
      {
        thin[member] = kind;
      }
    }
  }
}

std::vector<SizeValueType>
AntiAliasMaskImageFilter::CollectPart(SizeValueType first,
                                      const std::vector<std::uint8_t> & marked,
                                      std::vector<std::uint8_t> & isSeen) const
{
  const VoxelGrid grid{ m_Size };
  std::vector<SizeValueType> part{ first };
  isSeen[first] = 1;
  for (SizeValueType n = 0; n < part.size(); ++n)
  {
    this->CheckAbortAt(n);
    grid.ForEachNeighbor(part[n], [&](SizeValueType neighbor) {
      if (marked[neighbor] != 0 && isSeen[neighbor] == 0 && (m_Mask[first] != 0) == (m_Mask[neighbor] != 0))
      {
        isSeen[neighbor] = 1;
        part.push_back(neighbor);
      }
    });
  }
  return part;
}

bool
AntiAliasMaskImageFilter::IsSpur(const std::vector<SizeValueType> & part,
                                 const std::vector<std::uint8_t> & marked) const
{
  const VoxelGrid grid{ m_Size };
  std::vector<SizeValueType> base; // voxels that the part sticks out of
  for (const SizeValueType voxel : part)
  {
    grid.ForEachNeighbor(voxel, [&](SizeValueType neighbor) {
      if (marked[neighbor] == 0 && (m_Mask[voxel] != 0) == (m_Mask[neighbor] != 0))
      {
        base.push_back(neighbor);
      }
    });
  }
  return grid.AreConnected(base);
}

bool
AntiAliasMaskImageFilter::FindNarrow(const std::vector<std::uint8_t> & thin,
                                     const VoxelBand & band,
                                     float least,
                                     std::vector<std::uint8_t> & isNarrow)
{
  const SizeValueType width = m_Size[0];
  const SizeValueType height = m_Size[1];
  std::vector<std::uint8_t> found(m_Size[2]);
  this->ForEach(m_Size[2], [&](SizeValueType z) {
    for (SizeValueType row = z * height; row < (z + 1) * height; ++row)
    {
      band.ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType voxel = row * width + begin; voxel < row * width + end; ++voxel)
        {
          const float depth = SideOf(m_Mask[voxel]) * m_Field[voxel];
          const bool isThin = thin[voxel] >= 2 && depth < 0.0f;
          isNarrow[voxel] = isThin || (depth < -least && this->IsSample(voxel)) ? 1 : 0;
          found[z] |= isNarrow[voxel];
        }
      });
    }
  });
  return std::find(found.begin(), found.end(), 1) != found.end();
}

void
AntiAliasMaskImageFilter::Refine(double sigma,
                                 unsigned int corrections,
                                 float gain,
                                 const std::vector<std::uint8_t> & isNarrow)
{
  constexpr double blendingSigma = 1.0;
  const SizeValueType width = m_Size[0];
  VoxelBand narrow(m_Size);
  this->ForEach(m_Size[2], [&](SizeValueType z) {
    for (SizeValueType row = z * m_Size[1]; row < (z + 1) * m_Size[1]; ++row)
    {
      for (SizeValueType x = 0; x < width; ++x)
      {
        if (isNarrow[row * width + x] != 0)
        {
          narrow.Mark(row, x);
        }
      }
    }
  });
  const SizeValueType blended = GaussianWeights(blendingSigma).size() / 2;
  const SizeValueType reach = blended + GaussianWeights(m_Widening * sigma).size(); // of two corrections
  const std::unique_ptr<float[]> fine(new float[isNarrow.size()]);
  this->MatchLocalVolumes(sigma, corrections, gain, narrow.Widened({ reach, reach, reach }), fine.get());
  this->Smooth(
    blendingSigma,
    narrow.Widened({ blended, blended, blended }),
    [&](SizeValueType row, float * values) { std::copy_n(isNarrow.data() + row * width, width, values); },
    [&](SizeValueType row, SizeValueType begin, SizeValueType end, const float * values) {
      for (SizeValueType x = begin; x < end; ++x)
      {
        constexpr float steepness = 100.0f; // around a single voxel: 1 up to a distance of 2, 0 from 4 on
        const SizeValueType voxel = row * width + x;
        m_Field[voxel] += std::min(1.0f, steepness * values[x]) * (fine[voxel] - m_Field[voxel]);
      }
    });
}

void
AntiAliasMaskImageFilter::KeepLost(const std::vector<std::uint8_t> & thin, std::vector<std::uint8_t> & isMarked)
{
  const SizeValueType voxelsPerPlane = m_Size[0] * m_Size[1];
  this->ForEach(m_Size[2], [&](SizeValueType z) {
    for (SizeValueType voxel = z * voxelsPerPlane; voxel < (z + 1) * voxelsPerPlane; ++voxel)
    {
      const bool isLost = SideOf(m_Mask[voxel]) * m_Field[voxel] < -Lost;
      const bool isLeft = thin[voxel] == 0 || (thin[voxel] == 3 && m_ProtectSpecksOnly);
      isMarked[voxel] &= isLost && !isLeft ? 1 : 0;
    }
  });
}

void
AntiAliasMaskImageFilter::DropSpurs(std::vector<std::uint8_t> & isMarked)
{
  std::vector<std::uint8_t> isSeen(isMarked.size());
  for (SizeValueType first = 0; first < isMarked.size(); ++first)
  {
    this->CheckAbortAt(first);
    if (isMarked[first] == 0 || isSeen[first] != 0)
    {
      continue;
    }
    const std::vector<SizeValueType> part = this->CollectPart(first, isMarked, isSeen);
    if (part.size() <= LargestSpur && this->IsSpur(part, isMarked))
    {
      for (const SizeValueType voxel : part)
      {
        isMarked[voxel] = 0;
      }
    }
  }
}

void
AntiAliasMaskImageFilter::Protect(const std::vector<std::uint8_t> & isProtected, bool isInside)
{
  using Voxel = VoxelGrid::Coordinates;
  const VoxelGrid grid{ m_Size };
  const float side = isInside ? 1.0f : -1.0f;
  const auto raise = [&](const Voxel & voxel, float depth) {
    constexpr float barely = 0.02f; // no voxel changes sides
    if (grid.Holds(voxel))
    {
      const SizeValueType offset = grid.OffsetOf(voxel);
      const bool isOwn = (m_Mask[offset] != 0) == isInside;
      m_Field[offset] = side * std::max(side * m_Field[offset], isOwn ? depth : std::min(depth, -barely));
    }
  };
  const auto protect = [&](const Voxel & voxel) {
    for (const OffsetValueType dz : { -1, 0, 1 })
    {
      for (const OffsetValueType dy : { -1, 0, 1 })
      {
        for (const OffsetValueType dx : { -1, 0, 1 })
        {
          const Voxel neighbor{ voxel[0] + dx, voxel[1] + dy, voxel[2] + dz };
          const auto steps = static_cast<float>(std::abs(dx) + std::abs(dy) + std::abs(dz));
          raise(neighbor, TubeRadius - std::sqrt(steps));
          if (steps < 2.0f || !grid.Holds(neighbor) || (m_Mask[grid.OffsetOf(neighbor)] != 0) != isInside)
          {
            continue;
          }
          // The distance of the diagonal between the two from the other corners of its square or cube.
          const float distance = steps == 2.0f ? std::sqrt(1.0f / 2.0f) : std::sqrt(2.0f / 3.0f);
          for (unsigned int corner = 0; corner < 8; ++corner)
          {
            raise({ voxel[0] + ((corner & 1) != 0 ? dx : 0),
                    voxel[1] + ((corner & 2) != 0 ? dy : 0),
                    voxel[2] + ((corner & 4) != 0 ? dz : 0) },
                  TubeRadius - distance);
          }
        }
      }
    }
  };
  for (SizeValueType offset = 0; offset < isProtected.size(); ++offset)
  {
    this->CheckAbortAt(offset);
    if (isProtected[offset] != 0 && (m_Mask[offset] != 0) == isInside)
    {
      protect(grid.CoordinatesOf(offset));
      if (isInside)
      {
        m_ProtectedVoxels.push_back(offset);
      }
    }
  }
}

} // namespace itk
