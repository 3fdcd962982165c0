#ifndef itkFCCGaussianImageFilter_hxx
#define itkFCCGaussianImageFilter_hxx

#include "itkFCCMirror.h"
#include "itkFCCResamplingChecks.h"
#include "itkHugePages.h"
#include "itkInputSamples.h"
#include "itkMultiThreaderBase.h"
#include "itkRowArithmetic.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Sigma: " << m_Sigma << std::endl;
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!(m_Sigma >= 0.0) || !std::isfinite(m_Sigma))
  {
    itkExceptionMacro("Sigma must be a number of mm from 0 on, not " << m_Sigma << "; try 1.");
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::VerifyInputInformation() ITKv5_CONST
{
  Superclass::VerifyInputInformation();
  if (!AreAxesPerpendicular(this->GetInput()->GetDirection()))
  {
    itkExceptionMacro("The lattice's axes are not perpendicular, so that no Gaussian on it is isotropic; resample the "
                      "scan with CartesianToFCCImageFilter, whose lattices are.");
  }
  const auto variances = this->GetVariances();
  const double reach = 4.0 * std::sqrt(*std::max_element(variances.begin(), variances.end()));
  if (!(reach <= FCCGaussianTaps::MaximumReach))
  {
    itkExceptionMacro("A Sigma of " << m_Sigma << " mm is out of proportion to the lattice's spacing of "
                                    << this->GetInput()->GetSpacing() << " mm; use at most "
                                    << m_Sigma * FCCGaussianTaps::MaximumReach / reach << '.');
  }
}

template <typename TInputImage, typename TOutputImage>
std::array<double, 3>
FCCGaussianImageFilter<TInputImage, TOutputImage>::GetVariances() const
{
  const TInputImage * const input = this->GetInput();
  std::array<double, 3> variances{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // Rows hold samples of one parity; other axes need two planes for that.
    if (axis == 0 || input->GetLargestPossibleRegion().GetSize(axis) > 1)
    {
      const double unit = input->GetSpacing()[axis] * input->GetDirection().GetVnlMatrix().get_column(axis).magnitude();
      variances[axis] = m_Sigma * m_Sigma / (unit * unit);
    }
  }
  return variances;
}

template <typename TInputImage, typename TOutputImage>
auto
FCCGaussianImageFilter<TInputImage, TOutputImage>::AddReach(const RegionType & region,
                                                            const FCCGaussianTaps & taps) const -> RegionType
{
  RegionType wider = region;
  wider.PadByRadius({ { static_cast<SizeValueType>(taps.GetReach(0) / 2 + 1),
                        static_cast<SizeValueType>(taps.GetReach(1)),
                        static_cast<SizeValueType>(taps.GetReach(2)) } });
  wider.Crop(this->GetInput()->GetLargestPossibleRegion());
  return wider;
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  if (m_Sigma > 0.0)
  {
    const FCCGaussianTaps taps(this->GetVariances());
    const_cast<TInputImage *>(this->GetInput())
      ->SetRequestedRegion(this->AddReach(this->GetOutput()->GetRequestedRegion(), taps));
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::GenerateData()
{
  VerifyInputSamples(*this, *this->GetInput());
  this->AllocateOutputs();
  TOutputImage * const output = this->GetOutput();
  AdviseHugePages(output->GetBufferPointer(),
                  output->GetBufferedRegion().GetNumberOfPixels() * sizeof(OutputPixelType));

  WorkProgress progress(*this, output->GetRequestedRegion().GetNumberOfPixels());
  const FCCGaussianTaps taps(this->GetVariances());
  constexpr unsigned int undivided = 2;
  ThreadFailure failure;
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->template ParallelizeImageRegionRestrictDirection<3>(
    undivided,
    output->GetRequestedRegion(),
    [&](const RegionType & region) {
      failure.Capture([&] { m_Sigma > 0.0 ? this->Smooth(region, taps, progress) : this->Copy(region, progress); });
    },
    nullptr);
  failure.Rethrow();
  progress.Finish();
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::Copy(const RegionType & region, WorkProgress & whole)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  WorkProgress::Share progress(whole);
  const auto end = region.GetIndex() + region.GetSize();
  auto index = region.GetIndex();
  for (; index[2] < end[2]; ++index[2])
  {
    for (index[1] = region.GetIndex(1); index[1] < end[1]; ++index[1])
    {
      const InputPixelType * const row = input->GetBufferPointer() + input->ComputeOffset(index);
      std::transform(row,
                     row + region.GetSize(0),
                     output->GetBufferPointer() + output->ComputeOffset(index),
                     [](auto value) { return static_cast<OutputPixelType>(value); });
      progress.Completed(region.GetSize(0));
    }
  }
}

template <typename TInputImage, typename TOutputImage>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::Smooth(const RegionType & region,
                                                          const FCCGaussianTaps & taps,
                                                          WorkProgress & whole)
{
  const TInputImage * const input = this->GetInput();
  TOutputImage * const output = this->GetOutput();
  WorkProgress::Share progress(whole);
  const auto inputRow = [&](IndexValueType i, IndexValueType j, IndexValueType k) {
    return input->GetBufferPointer() + input->ComputeOffset({ { i, j, k } });
  };
  const auto outputRow = [&](const typename TOutputImage::IndexType & index) {
    return output->GetBufferPointer() + output->ComputeOffset(index);
  };
  const IndexValueType first = this->AddReach(region, taps).GetIndex(0);

  bool isAllFinite = true;
  this->BlendRows(
    region,
    taps,
    [&](IndexValueType j, IndexValueType k, SizeValueType length, float * row) {
      progress.CheckAbort();
      RowArithmetic::ConvertFrom(inputRow(first, j, k), length, row);
      if constexpr (std::is_floating_point<InputPixelType>::value)
      {
        for (SizeValueType n = 0; n < length; ++n)
        {
          const bool isFinite = std::isfinite(row[n]);
          isAllFinite = isAllFinite && isFinite;
          row[n] = isFinite ? row[n] : 0.0f;
        }
      }
    },
    [&](const auto & index, const float * values) {
      RowArithmetic::RoundTo(values, region.GetSize(0), outputRow(index));
      progress.Completed(region.GetSize(0));
    });

  if constexpr (std::is_floating_point<InputPixelType>::value)
  {
    if (isAllFinite)
    {
      return;
    }
    // The weights of the finite samples alone, with which what was blended of them becomes an average. Where all are
    // finite, that is a division by exactly 1.
    float allWeights = 0.0f;
    this->BlendRows(
      { region.GetIndex(), { { 1, 1, 1 } } },
      taps,
      [](IndexValueType, IndexValueType, SizeValueType length, float * row) { std::fill_n(row, length, 1.0f); },
      [&](const auto &, const float * values) { allWeights = values[0]; });
    this->BlendRows(
      region,
      taps,
      [&](IndexValueType j, IndexValueType k, SizeValueType length, float * row) {
        progress.CheckAbort();
        std::transform(inputRow(first, j, k), inputRow(first, j, k) + length, row, [](auto value) {
          return std::isfinite(value) ? 1.0f : 0.0f;
        });
      },
      [&](const auto & index, const float * values) {
        const InputPixelType * const own = inputRow(index[0], index[1], index[2]);
        OutputPixelType * const row = outputRow(index);
        for (SizeValueType n = 0; n < region.GetSize(0); ++n)
        {
          row[n] = static_cast<OutputPixelType>(std::isfinite(own[n]) ? row[n] / (values[n] / allWeights) : own[n]);
        }
      });
  }
}

template <typename TInputImage, typename TOutputImage>
template <typename TLoadRow, typename TStoreRow>
void
FCCGaussianImageFilter<TInputImage, TOutputImage>::BlendRows(const RegionType & region,
                                                             const FCCGaussianTaps & taps,
                                                             const TLoadRow & loadRow,
                                                             const TStoreRow & storeRow) const
{
  const RegionType whole = this->GetInput()->GetLargestPossibleRegion();
  const RegionType wider = this->AddReach(region, taps);
  const SizeValueType length = wider.GetSize(0);
  const SizeValueType stride = RowArithmetic::PaddedLength(length);

  // The planes and rows within reach, in rings: their place is their index modulo the ring's length.
  const auto rowCount = std::min<SizeValueType>(2 * taps.GetReach(1) + 1, whole.GetSize(1));
  const auto planeCount = std::min<SizeValueType>(2 * taps.GetReach(2) + 1, whole.GetSize(2));
  const auto placeOfRow = [&](IndexValueType j) {
    return static_cast<SizeValueType>(j - whole.GetIndex(1)) % rowCount;
  };
  const auto placeOfPlane = [&](IndexValueType k) {
    return static_cast<SizeValueType>(k - whole.GetIndex(2)) % planeCount;
  };

  // Blocks of rows such that their blends in all planes within reach stay in the second-level cache.
  constexpr SizeValueType cachedSamples = 256 * 1024;
  const SizeValueType blockSize = std::clamp<SizeValueType>(
    cachedSamples / (2 * planeCount * stride), 8, std::max<SizeValueType>(8, region.GetSize(1)));

  // Of a row, its sums along y over the even and the odd steps, which lie at points of both parities of x; of those,
  // the sums along z: at the sites of the row, and at the points between them.
  std::vector<float> rowRing(rowCount * stride);
  std::vector<float> slabRing[2];
  for (auto & ring : slabRing)
  {
    ring.resize(planeCount * blockSize * stride);
  }
  const auto margin = static_cast<SizeValueType>(taps.GetReach(0) / 2 + 1);
  std::vector<float> line[2];
  for (auto & points : line)
  {
    points.resize(RowArithmetic::PaddedLength(length + 2 * margin));
  }
  std::vector<float> values(RowArithmetic::PaddedLength(region.GetSize(0)));
  std::vector<const float *> terms;
  std::vector<float> weights;
  const auto blend = [&](SizeValueType count, float * sum) {
    RowArithmetic::Blend(terms.data(), weights.data(), terms.size(), count, sum);
    terms.clear();
    weights.clear();
  };
  const auto addTerms = [&](const FCCGaussianTaps::Factor & factor, const auto & rowAt) {
    for (std::size_t n = 0; n < factor.steps.size(); ++n)
    {
      terms.push_back(rowAt(factor.steps[n]));
      weights.push_back(factor.weights[n]);
    }
  };

  const auto regionEnd = region.GetIndex() + region.GetSize();
  const auto widerEnd = wider.GetIndex() + wider.GetSize();
  const auto whereLast = whole.GetUpperIndex();
  for (IndexValueType blockBegin = region.GetIndex(1); blockBegin < regionEnd[1];
       blockBegin += static_cast<IndexValueType>(blockSize))
  {
    const IndexValueType blockEnd = std::min(blockBegin + static_cast<IndexValueType>(blockSize), regionEnd[1]);
    const auto slabRow = [&](unsigned int parity, IndexValueType j, IndexValueType k) {
      return slabRing[parity].data() +
             (placeOfPlane(k) * blockSize + static_cast<SizeValueType>(j - blockBegin)) * stride;
    };

    const auto makeSlab = [&](IndexValueType k) {
      IndexValueType nextRow = wider.GetIndex(1);
      for (IndexValueType j = blockBegin; j < blockEnd; ++j)
      {
        nextRow = std::max(nextRow, j - taps.GetReach(1));
        for (; nextRow < std::min(j + taps.GetReach(1) + 1, widerEnd[1]); ++nextRow)
        {
          loadRow(nextRow, k, length, rowRing.data() + placeOfRow(nextRow) * stride);
        }
        for (unsigned int parity = 0; parity < 2; ++parity)
        {
          addTerms(taps.GetFactor(1, parity), [&](OffsetValueType step) {
            return rowRing.data() + placeOfRow(MirrorIntoRange(j + step, whole.GetIndex(1), whereLast[1])) * stride;
          });
          blend(length, slabRow(parity, j, k));
        }
      }
    };

    IndexValueType nextPlane = wider.GetIndex(2);
    for (IndexValueType k = region.GetIndex(2); k < regionEnd[2]; ++k)
    {
      nextPlane = std::max(nextPlane, k - taps.GetReach(2));
      for (; nextPlane < std::min(k + taps.GetReach(2) + 1, widerEnd[2]); ++nextPlane)
      {
        makeSlab(nextPlane);
      }
      for (IndexValueType j = blockBegin; j < blockEnd; ++j)
      {
        const IndexValueType parity = FCCLattice::Parity(j, k);
        for (unsigned int between = 0; between < 2; ++between)
        {
          for (unsigned int zParity = 0; zParity < 2; ++zParity)
          {
            addTerms(taps.GetFactor(2, zParity), [&](OffsetValueType step) {
              return slabRow(zParity ^ between, j, MirrorIntoRange(k + step, whole.GetIndex(2), whereLast[2]));
            });
          }
          std::vector<float> & points = line[between];
          blend(length, points.data() + margin);

          const IndexValueType ownParity = parity ^ static_cast<IndexValueType>(between);
          const auto mirror = [&](IndexValueType i) {
            const IndexValueType x = MirrorIntoRange(2 * i + ownParity, 2 * whole.GetIndex(0), 2 * whereLast[0] + 1);
            return static_cast<SizeValueType>((x - ownParity) / 2 - wider.GetIndex(0)) + margin;
          };
          for (SizeValueType n = 0; n < margin; ++n)
          {
            const auto step = static_cast<IndexValueType>(n);
            if (wider.GetIndex(0) == whole.GetIndex(0))
            {
              points[margin - 1 - n] = points[mirror(wider.GetIndex(0) - 1 - step)];
            }
            if (widerEnd[0] == whereLast[0] + 1)
            {
              points[margin + length + n] = points[mirror(widerEnd[0] + step)];
            }
          }
        }

        for (unsigned int between = 0; between < 2; ++between)
        {
          const IndexValueType ownParity = parity ^ static_cast<IndexValueType>(between);
          const float * const points = line[between].data() + margin + (region.GetIndex(0) - wider.GetIndex(0));
          addTerms(taps.GetFactor(0, between),
                   [&](OffsetValueType step) { return points + (step + parity - ownParity) / 2; });
        }
        blend(region.GetSize(0), values.data());
        storeRow(typename TOutputImage::IndexType{ { region.GetIndex(0), j, k } }, values.data());
      }
    }
  }
}

} // namespace itk

#endif
