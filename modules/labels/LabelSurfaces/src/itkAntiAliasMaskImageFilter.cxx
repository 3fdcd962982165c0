#include "itkAntiAliasMaskImageFilter.h"

#include "detail/itkRowArithmetic.h"
#include "itkBulkImage.h"
#include "itkInputSamples.h"
#include "itkMath.h"
#include "itkVoxelBand.h"
#include "itkWorkProgress.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

/** \file
 * Words. A voxel's *class* is inside or outside. Its *depth* is the field on its own side of the border: below 0 the
 * field puts the voxel on the wrong side. A *thin* voxel is in no 2 x 2 x 2 block of its class; connected thin voxels
 * of one class are a *part*. The *band* is the voxels near the border, for which the field is made. A voxel is known by
 * its offset in the buffer, a row of voxels along x by its number y + z height. */

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
constexpr Scale WideBetweenSlices{ 2.5, 6, 1.0f };
constexpr Scale Medium{ 1.2, 4, 0.6f };
constexpr Scale Fine{ 1.0, 10, 0.5f };
constexpr double WideningByPeriod = 0.3;
constexpr double BandWidth = 2.0;  // of the wide Gaussian, in sigma: depths there reach 3 voxels
constexpr float Narrow = 0.2f;     // voxels: depth on the wrong side; times the widening
constexpr float VeryNarrow = 0.3f; // voxels: the same, after the medium Gaussian
constexpr float Lost = 0.03f;      // voxels: depth on the wrong side
constexpr float TubeRadius = 0.6f; // voxels
constexpr SizeValueType LargestSpur = 2;
constexpr SizeValueType SmallestSheet = 16;
constexpr SizeValueType PlanesTogether = 32; // that Gaussians go through
constexpr unsigned int Passes = Wide.corrections + Medium.corrections + Fine.corrections + 5;

/** The form of the part of its class that a voxel belongs to. */
enum class VoxelForm : std::uint8_t
{
  Thick = 0, ///< in a 2 x 2 x 2 block of its class
  Thin,      ///< in none, and not yet known to be one of the others
  Spur,      ///< in a part of fewer than SmallestSheet thin voxels that connects nothing
  SmallPart, ///< in another part of fewer than SmallestSheet thin voxels
  Sheet      ///< in a larger part: a sheet or vessel
};

/** For each voxel, 1 if it belongs to the set and 0 if not. */
using VoxelSet = VoxelArray<std::uint8_t>;

using VoxelForms = VoxelArray<VoxelForm>;

/** The index along an axis that is \a reach before \a index, or the nearest in an image of \a length voxels. */
SizeValueType
ClampedIndex(SizeValueType index, SizeValueType reach, SizeValueType length)
{
  return index < reach ? 0 : std::min(index - reach, length - 1);
}

/** The mask and its field, and the threads of the filter: what all passes work with. */
struct MaskWork
{
  AntiAliasMaskImageFilter & filter;
  WorkProgress & progress;
  const AntiAliasMaskImageFilter::OutputImageType & image; ///< of the field
  std::array<SizeValueType, 3> size;
  const std::uint8_t * mask;
  float * field;
  float * scratch; ///< for the voxels of the planes that Smooth() keeps, rows having RowArithmetic::PaddedLength()
  double widening; ///< of all Gaussians

  SizeValueType
  GetNumberOfVoxels() const
  {
    return size[0] * size[1] * size[2];
  }

  bool
  IsInside(SizeValueType voxel) const
  {
    return mask[voxel] != 0;
  }

  float
  GetDepth(SizeValueType voxel) const
  {
    return this->IsInside(voxel) ? field[voxel] : -field[voxel];
  }

  Index<3>
  IndexOf(SizeValueType voxel) const
  {
    return image.ComputeIndex(static_cast<OffsetValueType>(voxel));
  }

  SizeValueType
  OffsetOf(const Index<3> & index) const
  {
    return static_cast<SizeValueType>(image.ComputeOffset(index));
  }

  /** Calls use(index) for each neighbour of a voxel through faces, edges and corners, in the image. */
  template <typename TUse>
  void
  ForEachNeighbor(const Index<3> & voxel, const TUse & use) const
  {
    for (OffsetValueType n = 0; n < 27; ++n)
    {
      const Index<3> neighbor = voxel + Offset<3>{ { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 } };
      if (neighbor != voxel && image.GetBufferedRegion().IsInside(neighbor))
      {
        use(neighbor);
      }
    }
  }

  /** Whether a voxel is a sample of the shape along one axis. */
  bool
  IsSample(unsigned int axis, IndexValueType index) const
  {
    return index % static_cast<IndexValueType>(filter.GetSamplePeriod()[axis]) == 0;
  }

  bool
  IsSample(SizeValueType voxel) const
  {
    const Index<3> index = this->IndexOf(voxel);
    return this->IsSample(0, index[0]) && this->IsSample(1, index[1]) && this->IsSample(2, index[2]);
  }

  /** Calls use(row) for each row, plane by plane on the filter's threads. */
  template <typename TUse>
  void
  ForEachRow(const TUse & use) const
  {
    progress.ForEach(size[2], [&](SizeValueType z) {
      for (SizeValueType row = z * size[1]; row < (z + 1) * size[1]; ++row)
      {
        use(row);
      }
    });
  }

  /** Calls use(voxel) for the voxels of a band, row by row. */
  template <typename TUse>
  void
  ForEachVoxel(const VoxelBand & band, const TUse & use) const
  {
    this->ForEachRow([&](SizeValueType row) {
      band.ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType voxel = row * size[0] + begin; voxel < row * size[0] + end; ++voxel)
        {
          use(voxel);
        }
      });
    });
  }

  /** The same one by one, in the order of the voxels. */
  template <typename TUse>
  void
  ForEachVoxelInOrder(const VoxelBand & band, const TUse & use) const
  {
    for (SizeValueType row = 0; row < size[1] * size[2]; ++row)
    {
      this->CheckAbortAt(row);
      band.ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType voxel = row * size[0] + begin; voxel < row * size[0] + end; ++voxel)
        {
          use(voxel);
        }
      });
    }
  }

  /** Checks for an abort at some of the steps of a serial loop. */
  void
  CheckAbortAt(SizeValueType n) const
  {
    constexpr SizeValueType period = 4096;
    if (n % period == 0)
    {
      progress.CheckAbort();
    }
  }
};

// ---- Gaussians of rows

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

/** Writes the values of a part of a row to be smoothed, values[x] being that of voxel x, or returns false if all of the
 * row are 0. */
using RowReader = std::function<bool(SizeValueType row, SizeValueType begin, SizeValueType end, float * values)>;

/** Takes the smoothed values of a part of a row; values[x] is the value of voxel x. */
using RowWriter = std::function<void(SizeValueType row, SizeValueType begin, SizeValueType end, const float * values)>;

/** Rows in a line along y or z: their values, or null where all are 0. */
using LineOfRows = std::vector<const float *>;

/** Smooths across a line of rows at the voxels of a band, from one row of the line to before another.
 * \param first, step the numbers of the rows are first, first + step, ...
 * \param target gives the place for the smoothed values of a row */
template <typename TTarget>
void
SmoothAcrossRows(const std::vector<float> & weights,
                 const LineOfRows & rows,
                 SizeValueType first,
                 SizeValueType step,
                 SizeValueType beginRow,
                 SizeValueType endRow,
                 const VoxelBand & band,
                 const TTarget & target,
                 const RowWriter & write)
{
  LineOfRows terms(weights.size());
  LineOfRows termsOfRun(weights.size());
  std::vector<float> weightsOfTerms(weights.size());
  for (SizeValueType n = beginRow; n < endRow; ++n)
  {
    SizeValueType count = 0;
    for (SizeValueType tap = 0; tap < weights.size() && band.HasRow(first + n * step); ++tap)
    {
      terms[count] = rows[ClampedIndex(n + tap, weights.size() / 2, rows.size())];
      weightsOfTerms[count] = weights[tap];
      count += terms[count] != nullptr ? 1 : 0;
    }
    band.ForEachRun(first + n * step, [&](SizeValueType begin, SizeValueType end) {
      float * const smoothed = target(n);
      const auto isAtBegin = [begin](const float * row) { return row + begin; };
      std::transform(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count), termsOfRun.begin(), isAtBegin);
      if (count > 0)
      {
        RowArithmetic::Blend(termsOfRun.data(), weightsOfTerms.data(), count, end - begin, smoothed + begin);
      }
      else
      {
        std::fill(smoothed + begin, smoothed + end, 0.0f);
      }
      if (write)
      {
        write(first + n * step, begin, end, smoothed);
      }
    });
  }
}

/** A Gaussian with the band of its results, and the bands in which it is applied along axes before. */
struct GaussianInBand
{
  GaussianInBand(double sigma, const VoxelBand & ofResults)
    : weights(GaussianWeights(sigma))
    , band(ofResults)
    , smoothedInPlane(band.Widened({ 0, 0, weights.size() / 2 }))
    , smoothedInRow(smoothedInPlane.Widened({ 0, weights.size() / 2, 0 }))
  {}

  std::vector<float> weights;
  VoxelBand band;
  VoxelBand smoothedInPlane; ///< along x and y
  VoxelBand smoothedInRow;   ///< along x
};

/** Smooths the rows of a plane along x and y into \a planeOfScratch. Returns whether any of them has values. */
bool
SmoothPlane(const MaskWork & work,
            const GaussianInBand & gaussian,
            const RowReader & read,
            SizeValueType z,
            float * planeOfScratch)
{
  const std::vector<float> & weights = gaussian.weights;
  const SizeValueType reach = weights.size() / 2;
  const SizeValueType width = work.size[0];
  const SizeValueType height = work.size[1];
  const SizeValueType stride = RowArithmetic::PaddedLength(width);
  std::vector<float> extended(stride + 2 * reach);
  std::unique_ptr<float[]> plane; // not initialised: what a run reads is made for it
  LineOfRows rows(height);
  std::vector<const float *> terms(weights.size());
  for (SizeValueType y = 0; y < height; ++y)
  {
    const SizeValueType number = y + z * height;
    const auto [first, last] = gaussian.smoothedInRow.FindRange(number);
    const SizeValueType begin = ClampedIndex(first, reach, width);
    const SizeValueType end = std::min(last + reach, width);
    if (!gaussian.smoothedInRow.HasRow(number) || !read(number, begin, end, extended.data() + reach))
    {
      continue;
    }
    if (!plane)
    {
      plane.reset(new float[height * stride]);
    }
    float * const row = plane.get() + y * stride;
    std::fill(row + width, row + stride, 0.0f);
    rows[y] = row;
    std::fill_n(extended.begin(), reach, extended[reach]);
    std::fill_n(extended.begin() + static_cast<std::ptrdiff_t>(reach + width), reach, extended[reach + width - 1]);
    gaussian.smoothedInRow.ForEachRun(number, [&](SizeValueType beginRun, SizeValueType endRun) {
      std::iota(terms.begin(), terms.end(), extended.data() + beginRun);
      RowArithmetic::Blend(terms.data(), weights.data(), terms.size(), endRun - beginRun, row + beginRun);
    });
  }
  if (plane)
  {
    const auto inScratch = [&](SizeValueType y) { return planeOfScratch + y * stride; };
    SmoothAcrossRows(weights, rows, z * height, 1, 0, height, gaussian.smoothedInPlane, inScratch, nullptr);
  }
  return plane != nullptr;
}

/** Smooths the rows of \a read with a Gaussian and passes their parts in its band to \a write. Rows and planes of zeros
 * take no time: in thick slices most are.
 *
 * Some planes at a time, so that the scratch memory is that of these and of those around them, and each plane is read
 * before any plane in its reach is written: once, in order, as it may be in a temporary file. */
void
Smooth(const MaskWork & work, const GaussianInBand & gaussian, const RowReader & read, const RowWriter & write)
{
  constexpr SizeValueType planes = PlanesTogether;
  const std::vector<float> & weights = gaussian.weights;
  const SizeValueType reach = weights.size() / 2;
  const SizeValueType height = work.size[1];
  const SizeValueType depth = work.size[2];
  const SizeValueType stride = RowArithmetic::PaddedLength(work.size[0]);
  const SizeValueType kept = planes + 2 * reach;
  const auto scratchOf = [&](SizeValueType z) { return work.scratch + z % kept * height * stride; };
  std::vector<std::uint8_t> hasValues(depth); // by plane
  SizeValueType next = 0;                     // plane to be smoothed along x and y
  for (SizeValueType begin = 0; begin < depth; begin += planes)
  {
    const SizeValueType end = std::min(begin + planes, depth);
    const SizeValueType last = std::min(end + reach, depth);
    work.progress.ForEach(last - next, [&](SizeValueType n) {
      hasValues[next + n] = SmoothPlane(work, gaussian, read, next + n, scratchOf(next + n)) ? 1 : 0;
      work.progress.Completed(1);
    });
    next = last;
    work.progress.ForEach(height, [&](SizeValueType y) {
      std::vector<float> smoothed(stride);
      LineOfRows rows(depth);
      for (SizeValueType z = ClampedIndex(begin, reach, depth); z < last; ++z)
      {
        rows[z] = hasValues[z] != 0 ? scratchOf(z) + y * stride : nullptr;
      }
      SmoothAcrossRows(
        weights, rows, y, height, begin, end, gaussian.band, [&](SizeValueType) { return smoothed.data(); }, write);
      work.progress.Completed(end == depth ? 1 : 0);
    });
  }
}

// ---- Passes, in the order of their use

/** Finds the voxels at the border, on one side of it at least. */
VoxelBand
FindBorder(const MaskWork & work)
{
  const SizeValueType length = work.size[0];
  const SizeValueType height = work.size[1];
  VoxelBand border(work.size);
  work.ForEachRow([&](SizeValueType row) {
    const std::uint8_t * const voxels = work.mask + row * length;
    const SizeValueType y = row % height;
    const SizeValueType z = row / height;
    const std::uint8_t * const others[] = { y > 0 ? voxels - length : voxels,
                                            y + 1 < height ? voxels + length : voxels,
                                            z > 0 ? voxels - height * length : voxels,
                                            z + 1 < work.size[2] ? voxels + height * length : voxels };
    const auto isSameRow = [&](const std::uint8_t * other) { return std::memcmp(voxels, other, length) == 0; };
    if (std::memcmp(voxels, voxels + 1, length - 1) == 0 &&
        std::all_of(std::begin(others), std::end(others), isSameRow)) // quicker than tile by tile, and mostly so
    {
      return;
    }
    for (SizeValueType begin = 0; begin < length; begin += border.GetTileLength())
    {
      const SizeValueType end = std::min(begin + border.GetTileLength(), length);
      bool isBorder = false;
      for (SizeValueType x = begin; x < std::min(end, length - 1); ++x)
      {
        isBorder |= (voxels[x] != 0) != (voxels[x + 1] != 0);
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
  });
  return border;
}

/** By voxel of an axis: 1 for a sample of the shape and 0 for others, and the share of samples in a Gaussian's reach.
 */
struct AxisSamples
{
  std::vector<float> isSample;
  std::vector<float> share;
};

AxisSamples
FindSamples(const MaskWork & work, unsigned int axis, double sigma)
{
  const std::vector<float> weights = GaussianWeights(sigma);
  const SizeValueType length = work.size[axis];
  AxisSamples samples{ std::vector<float>(length), std::vector<float>(length) };
  const IndexValueType first = work.image.GetBufferedRegion().GetIndex(axis);
  for (SizeValueType n = 0; n < length; ++n)
  {
    samples.isSample[n] = work.IsSample(axis, first + static_cast<IndexValueType>(n)) ? 1.0f : 0.0f;
  }
  for (SizeValueType n = 0; n < length; ++n)
  {
    constexpr float least = 1e-6f; // far from all samples
    for (SizeValueType tap = 0; tap < weights.size(); ++tap)
    {
      samples.share[n] += weights[tap] * samples.isSample[ClampedIndex(n + tap, weights.size() / 2, length)];
    }
    samples.share[n] = work.filter.GetSamplePeriod()[axis] == 1 ? 1.0f : std::max(least, samples.share[n]);
  }
  return samples;
}

/** The rows of a band that hold samples, or the others. */
VoxelBand
RowsOf(const VoxelBand & band, const BulkVector<std::uint8_t> & hasSamples, bool withSamples)
{
  return band.Selected([&](SizeValueType row) { return (hasSamples[row] != 0) == withSamples; });
}

/** Makes the field in a band so that its coverage of the samples, smoothed, is the smoothed mask.
 *
 * The field is the sum of the smoothed lacks of all rounds, which depend on rows with samples alone: the other rows
 * follow from the sum of the lacks at the end. */
void
MatchLocalVolumes(const MaskWork & work, const Scale & scale, const VoxelBand & band, float * field)
{
  const SizeValueType width = work.size[0];
  const SizeValueType height = work.size[1];
  const double sigma = work.widening * scale.sigma;
  const auto slope = static_cast<float>(InverseSlope(sigma));
  const AxisSamples alongX = FindSamples(work, 0, sigma);
  const AxisSamples alongY = FindSamples(work, 1, sigma);
  const AxisSamples alongZ = FindSamples(work, 2, sigma);
  BulkVector<std::uint8_t> hasSamples(height * work.size[2]); // by row
  BulkVector<SizeValueType> placeOfRow(hasSamples.size());    // in the sums
  SizeValueType placed = 0;
  for (SizeValueType row = 0; row < hasSamples.size(); ++row)
  {
    hasSamples[row] = alongY.isSample[row % height] * alongZ.isSample[row / height] > 0.0f ? 1 : 0;
    placeOfRow[row] = placed;
    placed += hasSamples[row] != 0 && band.HasRow(row) ? width : 0;
  }
  const bool areAllSamples = std::find(hasSamples.begin(), hasSamples.end(), 0) == hasSamples.end();
  BulkVector<float> sums(areAllSamples ? 0 : placed, 0.0f); // of the lacks after the first, times the gain
  const VoxelBand matched = areAllSamples ? band : RowsOf(band, hasSamples, true);
  const auto readMask = [&](SizeValueType row, SizeValueType first, SizeValueType last, float * values) {
    const std::uint8_t * const mask = work.mask + row * width;
    for (SizeValueType x = first; x < last && hasSamples[row] != 0; ++x)
    {
      values[x] = alongX.isSample[x] * ((mask[x] != 0 ? 1.0f : 0.0f) - 0.5f); // the field is 0, its coverage 1/2
    }
    return hasSamples[row] != 0;
  };
  const auto readLack = [&](SizeValueType row, SizeValueType first, SizeValueType last, float * values) {
    if (!matched.HasRow(row))
    {
      return false;
    }
    std::fill(values + first, values + last, 0.0f);
    matched.ForEachRun(row, [&, mask = work.mask + row * width](SizeValueType begin, SizeValueType end) {
      for (SizeValueType x = begin; x < end; ++x)
      {
        const float coverage = std::min(1.0f, std::max(0.0f, field[row * width + x] + 0.5f));
        values[x] = scale.gain * alongX.isSample[x] * ((mask[x] != 0 ? 1.0f : 0.0f) - coverage);
      }
      for (SizeValueType x = begin; x < end && !areAllSamples; ++x)
      {
        sums[placeOfRow[row] + x] += values[x];
      }
    });
    return true;
  };
  const auto readAll = [&](SizeValueType row, SizeValueType first, SizeValueType last, float * values) {
    const bool isRead = readMask(row, first, last, values);
    for (SizeValueType x = first; x < last && isRead && band.HasRow(row); ++x)
    {
      values[x] += sums[placeOfRow[row] + x];
    }
    return isRead;
  };
  const auto add = [&](bool isFirst) {
    return [&, isFirst](SizeValueType row, SizeValueType begin, SizeValueType end, const float * values) {
      const float share = alongY.share[row % height] * alongZ.share[row / height];
      for (SizeValueType x = begin; x < end; ++x)
      {
        const float correction = slope * (values[x] / (share * alongX.share[x]));
        field[row * width + x] = isFirst ? correction : field[row * width + x] + correction;
      }
    };
  };
  const GaussianInBand gaussian(sigma, matched);
  Smooth(work, gaussian, readMask, add(true));
  for (unsigned int n = 0; n < scale.corrections; ++n)
  {
    Smooth(work, gaussian, readLack, add(false));
  }
  if (!areAllSamples)
  {
    Smooth(work, GaussianInBand(sigma, RowsOf(band, hasSamples, false)), readAll, add(true));
  }
}

/** Finds the narrow voxels: samples more than \a least on the wrong side, and voxels of small parts and sheets that are
 * on it at all. Returns whether there are any. */
bool
FindNarrow(const MaskWork & work, const VoxelForms & forms, const VoxelBand & band, float least, VoxelSet & isNarrow)
{
  std::atomic<bool> isAny{ false };
  work.ForEachVoxel(band, [&](SizeValueType voxel) {
    const float depth = work.GetDepth(voxel);
    const bool isThinPart = forms[voxel] == VoxelForm::SmallPart || forms[voxel] == VoxelForm::Sheet;
    isNarrow[voxel] = (isThinPart && depth < 0.0f) || (depth < -least && work.IsSample(voxel)) ? 1 : 0;
    if (isNarrow[voxel] != 0)
    {
      isAny = true;
    }
  });
  return isAny;
}

/** Replaces the field around the narrow voxels of a band by that for a smaller Gaussian. Beyond the band the mask lacks
 * nothing, as it is wider than the Gaussian. */
void
Refine(const MaskWork & work, const Scale & scale, const VoxelBand & band, const VoxelSet & isNarrow)
{
  constexpr double blendingSigma = 1.0;
  const SizeValueType width = work.size[0];
  VoxelBand narrow(work.size);
  work.ForEachVoxel(band, [&](SizeValueType voxel) {
    if (isNarrow[voxel] != 0)
    {
      narrow.Mark(voxel / width, voxel % width);
    }
  });
  const SizeValueType blended = GaussianWeights(blendingSigma).size() / 2;
  const SizeValueType reach = blended + GaussianWeights(work.widening * scale.sigma).size(); // of two corrections
  const VoxelArray<float> fine = MakeVoxelArray<float>(work.GetNumberOfVoxels(), false);
  MatchLocalVolumes(work, scale, narrow.Widened({ reach, reach, reach }).Common(band), fine.get());
  Smooth(
    work,
    GaussianInBand(blendingSigma, narrow.Widened({ blended, blended, blended }).Common(band)),
    [&](SizeValueType row, SizeValueType first, SizeValueType last, float * values) {
      std::copy(&isNarrow[row * width + first], &isNarrow[row * width + last], values + first);
      return narrow.HasRow(row);
    },
    [&](SizeValueType row, SizeValueType begin, SizeValueType end, const float * values) {
      for (SizeValueType x = begin; x < end; ++x)
      {
        constexpr float steepness = 100.0f; // around a single voxel: 1 up to a distance of 2, 0 from 4 on
        const SizeValueType voxel = row * width + x;
        work.field[voxel] += std::min(1.0f, steepness * values[x]) * (fine[voxel] - work.field[voxel]);
      }
    });
}

/** Marks the voxels of a run of which one of the eight 2 x 2 x 2 blocks around them is all of their class.
 * \param isThick of the voxels of the row, 0 or 1 */
void
FindThick(const MaskWork & work,
          SizeValueType row,
          SizeValueType begin,
          SizeValueType end,
          std::vector<std::uint8_t> & isThick)
{
  const auto & size = work.size;
  const SizeValueType first = ClampedIndex(begin, 1, size[0]);
  const SizeValueType last = std::min(end, size[0] - 1);
  std::fill(
    isThick.begin() + static_cast<std::ptrdiff_t>(begin), isThick.begin() + static_cast<std::ptrdiff_t>(end), 0);
  std::vector<std::uint8_t> columns(last - first +
                                    3); // 4 rows across: 1 all outside, 2 all inside, 0 else; one more at either end
  for (unsigned int block = 0; block < 4; ++block)
  {
    const std::uint8_t * rows[4];
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      const SizeValueType y = ClampedIndex(row % size[1] + (block & 1) + (corner & 1), 1, size[1]);
      const SizeValueType z = ClampedIndex(row / size[1] + (block >> 1) + (corner >> 1), 1, size[2]);
      rows[corner] = work.mask + (z * size[1] + y) * size[0];
    }
    const auto [a, b, c, d] = rows;
    std::uint8_t * const columnOf = columns.data() + 1;
    for (SizeValueType x = first; x <= last; ++x)
    {
      const int inside = (a[x] != 0) + (b[x] != 0) + (c[x] != 0) + (d[x] != 0);
      columnOf[x - first] = static_cast<std::uint8_t>((inside == 0 ? 1 : 0) + (inside == 4 ? 2 : 0));
    }
    columns.front() = columns[1];
    columns.back() = columns[columns.size() - 2];
    for (SizeValueType x = begin; x < end; ++x)
    {
      const std::uint8_t * const here = columnOf + (x - first);
      isThick[x] |= static_cast<std::uint8_t>((here[0] != 0) & ((here[0] == here[-1]) | (here[0] == here[1])));
    }
  }
}

/** Calls use(part) for the connected members of one class, part by part, in the order of their first voxels. Members
 * are in the band. */
template <typename TTest, typename TUse>
void
ForEachPart(const MaskWork & work, const VoxelBand & band, const TTest & isMember, const TUse & use)
{
  VoxelSet isSeen = MakeVoxelArray<std::uint8_t>(work.GetNumberOfVoxels(), true);
  work.ForEachVoxelInOrder(band, [&](SizeValueType first) {
    if (!isMember(first) || isSeen[first] != 0)
    {
      return;
    }
    BulkVector<SizeValueType> part{ first };
    isSeen[first] = 1;
    for (SizeValueType n = 0; n < part.size(); ++n)
    {
      work.CheckAbortAt(n);
      work.ForEachNeighbor(work.IndexOf(part[n]), [&](const Index<3> & index) {
        const SizeValueType neighbor = work.OffsetOf(index);
        if (isMember(neighbor) && isSeen[neighbor] == 0 && work.IsInside(first) == work.IsInside(neighbor))
        {
          isSeen[neighbor] = 1;
          part.push_back(neighbor);
        }
      });
    }
    use(part);
  });
}

/** Whether a few voxels are one piece, connected through faces, edges and corners. */
bool
AreConnected(std::vector<Index<3>> voxels)
{
  auto reached = voxels.begin() + 1; // end of the voxels connected with the first
  for (auto from = voxels.begin(); from != reached; ++from)
  {
    reached = std::partition(reached, voxels.end(), [here = *from](const Index<3> & there) {
      const Offset<3> way = there - here;
      return std::abs(way[0]) <= 1 && std::abs(way[1]) <= 1 && std::abs(way[2]) <= 1;
    });
  }
  return reached == voxels.end();
}

/** Whether a part sticks out of other voxels of its class, and connects them with nothing. */
template <typename TTest>
bool
IsSpur(const MaskWork & work, const BulkVector<SizeValueType> & part, const TTest & isMember)
{
  std::vector<Index<3>> base; // voxels that the part sticks out of
  for (const SizeValueType voxel : part)
  {
    work.ForEachNeighbor(work.IndexOf(voxel), [&](const Index<3> & index) {
      const SizeValueType neighbor = work.OffsetOf(index);
      if (!isMember(neighbor) && work.IsInside(voxel) == work.IsInside(neighbor))
      {
        base.push_back(index);
      }
    });
  }
  return !base.empty() && AreConnected(base);
}

/** Finds the forms of the voxels in a band; all others are thick. */
void
FindForms(const MaskWork & work, const VoxelBand & band, VoxelForms & forms)
{
  work.ForEachRow([&](SizeValueType row) {
    std::vector<std::uint8_t> isThick(work.size[0]);
    band.ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
      FindThick(work, row, begin, end, isThick);
      for (SizeValueType x = begin; x < end; ++x)
      {
        forms[row * work.size[0] + x] = isThick[x] != 0 ? VoxelForm::Thick : VoxelForm::Thin;
      }
    });
  });
  const auto isThin = [&forms](SizeValueType voxel) { return forms[voxel] != VoxelForm::Thick; };
  ForEachPart(work, band, isThin, [&](const BulkVector<SizeValueType> & part) {
    const VoxelForm form = part.size() >= SmallestSheet ? VoxelForm::Sheet
                           : IsSpur(work, part, isThin) ? VoxelForm::Spur
                                                        : VoxelForm::SmallPart;
    for (const SizeValueType voxel : part)
    {
      forms[voxel] = form;
    }
  });
}

/** Leaves the protected voxels of the narrow ones, all of which are in the band: thin voxels that are still on the
 * wrong side, without spurs. */
void
KeepProtected(const MaskWork & work, const VoxelForms & forms, const VoxelBand & band, VoxelSet & isNarrow)
{
  work.ForEachVoxel(band, [&](SizeValueType voxel) {
    const bool isUnprotectedForm =
      forms[voxel] == VoxelForm::Thick || (forms[voxel] == VoxelForm::Sheet && work.filter.GetProtectSpecksOnly());
    isNarrow[voxel] &= work.GetDepth(voxel) < -Lost && !isUnprotectedForm ? 1 : 0;
  });
  const auto isMember = [&isNarrow](SizeValueType voxel) { return isNarrow[voxel] != 0; };
  ForEachPart(work, band, isMember, [&](const BulkVector<SizeValueType> & part) {
    if (part.size() <= LargestSpur && IsSpur(work, part, isMember))
    {
      for (const SizeValueType voxel : part)
      {
        isNarrow[voxel] = 0;
      }
    }
  });
}

/** Puts tubes around the protected voxels of one class in a band. */
void
PutTubes(const MaskWork & work, const VoxelBand & band, const VoxelSet & isProtected, bool isInside)
{
  const float side = isInside ? 1.0f : -1.0f;
  const auto raise = [&](const Index<3> & index, float depth) {
    constexpr float barely = 0.02f; // no voxel changes sides
    const SizeValueType voxel = work.OffsetOf(index);
    const bool isOwn = work.IsInside(voxel) == isInside;
    work.field[voxel] = side * std::max(side * work.field[voxel], isOwn ? depth : std::min(depth, -barely));
  };
  work.ForEachVoxelInOrder(band, [&](SizeValueType n) {
    if (isProtected[n] == 0 || work.IsInside(n) != isInside)
    {
      return;
    }
    const Index<3> voxel = work.IndexOf(n);
    raise(voxel, TubeRadius);
    work.ForEachNeighbor(voxel, [&](const Index<3> & neighbor) {
      float steps = 0.0f;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        steps += neighbor[axis] != voxel[axis] ? 1.0f : 0.0f;
      }
      raise(neighbor, TubeRadius - std::sqrt(steps));
      if (steps < 2.0f || work.IsInside(work.OffsetOf(neighbor)) != isInside)
      {
        return;
      }
      // The distance of the diagonal between the two from the other corners of its square or cube.
      const float distance = steps == 2.0f ? std::sqrt(1.0f / 2.0f) : std::sqrt(2.0f / 3.0f);
      for (unsigned int corner = 0; corner < 8; ++corner)
      {
        raise({ { ((corner & 1) != 0 ? neighbor : voxel)[0],
                  ((corner & 2) != 0 ? neighbor : voxel)[1],
                  ((corner & 4) != 0 ? neighbor : voxel)[2] } },
              TubeRadius - distance);
      }
    });
  });
}

/** The voxels of one class in a band that pass a test, ascending. */
template <typename TTest>
BulkVector<SizeValueType>
ListClass(const MaskWork & work, const VoxelBand & band, bool isInside, const TTest & test)
{
  BulkVector<SizeValueType> voxels;
  work.ForEachVoxelInOrder(band, [&](SizeValueType voxel) {
    if (test(voxel) && work.IsInside(voxel) == isInside)
    {
      voxels.push_back(voxel);
    }
  });
  return voxels;
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
  os << indent << "ProtectedOutsideVoxels: " << m_ProtectedOutsideVoxels.size() << std::endl;
  os << indent << "Needed: " << (m_IsNeeded ? "where a function tells" : "everywhere") << std::endl;
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

double
AntiAliasMaskImageFilter::FindWidening(const PeriodType & period)
{
  return std::max(1.0, WideningByPeriod * static_cast<double>(*std::max_element(period.begin(), period.end())));
}

void
AntiAliasMaskImageFilter::SetNeeded(NeededType isNeeded)
{
  m_IsNeeded = std::move(isNeeded);
  this->Modified();
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
  this->GetOutput()->SetBufferedRegion(this->GetOutput()->GetRequestedRegion());
  AllocateInBulk(*this->GetOutput());
  const auto & size = this->GetOutput()->GetBufferedRegion().GetSize();
  const double widening = FindWidening(m_SamplePeriod);
  const SizeValueType widestReach = GaussianWeights(widening * Wide.sigma).size() / 2;
  const SizeValueType scratchPlanes = std::min(size[2], PlanesTogether + 2 * widestReach);
  const VoxelArray<float> scratch =
    MakeVoxelArray<float>(RowArithmetic::PaddedLength(size[0]) * size[1] * scratchPlanes, false);
  const auto longestPeriod = *std::max_element(m_SamplePeriod.begin(), m_SamplePeriod.end());
  WorkProgress progress(*this, Passes * (size[1] + size[2]));
  const MaskWork work{ *this,
                       progress,
                       *this->GetOutput(),
                       { size[0], size[1], size[2] },
                       this->GetInput()->GetBufferPointer(),
                       this->GetOutput()->GetBufferPointer(),
                       scratch.get(),
                       widening };

  const VoxelBand border = FindBorder(work);
  const auto reach = static_cast<SizeValueType>(std::ceil(BandWidth * work.widening * Wide.sigma));
  VoxelBand band = border.Widened({ reach, reach, reach });
  if (m_IsNeeded)
  {
    band = band.SelectedTiles([&](SizeValueType row, SizeValueType begin, SizeValueType end) {
      return m_IsNeeded(work.IndexOf(row * size[0] + begin), end - begin);
    });
  }
  const auto far = static_cast<float>(0.5 * InverseSlope(work.widening * Wide.sigma));
  work.ForEachRow([&](SizeValueType row) {
    for (SizeValueType voxel = row * size[0]; voxel < (row + 1) * size[0]; ++voxel)
    {
      work.field[voxel] = work.IsInside(voxel) ? far : -far;
    }
  });
  MatchLocalVolumes(work, longestPeriod > 1 ? WideBetweenSlices : Wide, band, work.field);

  VoxelForms forms = MakeVoxelArray<VoxelForm>(work.GetNumberOfVoxels(), true);
  VoxelSet isNarrow = MakeVoxelArray<std::uint8_t>(work.GetNumberOfVoxels(), true);
  if (FindNarrow(work, forms, band, Narrow * static_cast<float>(work.widening), isNarrow))
  {
    Refine(work, Medium, band, isNarrow);
  }
  const VoxelBand formed = border.Widened({ 2, 2, 2 });
  FindForms(work, formed, forms);
  m_ThinVoxels = ListClass(work, formed, true, [&](SizeValueType voxel) { return forms[voxel] != VoxelForm::Thick; });
  m_ProtectedVoxels.clear();
  m_ProtectedOutsideVoxels.clear();
  if (FindNarrow(work, forms, band, VeryNarrow, isNarrow))
  {
    Refine(work, Fine, band, isNarrow);
    KeepProtected(work, forms, band, isNarrow);
    PutTubes(work, band, isNarrow, false);
    PutTubes(work, band, isNarrow, true);
    const auto isProtected = [&](SizeValueType voxel) { return isNarrow[voxel] != 0; };
    m_ProtectedVoxels = ListClass(work, band, true, isProtected);
    m_ProtectedOutsideVoxels = ListClass(work, band, false, isProtected);
  }
  progress.Finish();
}

} // namespace itk
