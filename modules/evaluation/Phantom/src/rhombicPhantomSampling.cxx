#include "rhombicPhantom.h"

#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicPhantomAnatomy.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

// The images are made in slabs: all samples with one x, y fastest. A part is added to a slab line by line, along its
// own axis, y or z.

namespace rhombic
{
namespace
{

constexpr PhantomPoint FieldLow{ -216.0, -144.0, -12.0 };
constexpr PhantomPoint FieldHigh{ 216.0, 136.0, 712.0 };

/** Indices first .. last - 1. */
struct Range
{
  long first;
  long last;
};

/** The grid of samples: as many as fit the field, in its middle. */
struct Grid
{
  double spacing;
  double aperture; ///< side of the cube that each sample is the average of, in spacings
  std::array<long, 3> size;
  PhantomPoint origin;

  double
  PointOf(unsigned axis, double index) const
  {
    return origin[axis] + spacing * index;
  }
  double
  IndexOf(unsigned axis, double point) const
  {
    return (point - origin[axis]) / spacing;
  }
  /** The samples along an axis whose apertures may touch an interval. */
  Range
  RangeOf(unsigned axis, double low, double high) const
  {
    const double reach = 0.5 * aperture;
    return { std::clamp(std::lround(std::floor(IndexOf(axis, low) - reach)), 0L, size[axis]),
             std::clamp(std::lround(std::ceil(IndexOf(axis, high) + reach)) + 1, 0L, size[axis]) };
  }
  Range
  RangeOf(unsigned axis, const PhantomBounds & bounds) const
  {
    return RangeOf(axis, bounds.low[axis], bounds.high[axis]);
  }
  /** The offset in a slab of the sample with index \a along on \a axis (1 or 2), and \a across on the other axis. */
  std::size_t
  PlaceInSlab(unsigned axis, long along, long across) const
  {
    return static_cast<std::size_t>(axis == 1 ? across * size[1] + along : along * size[1] + across);
  }
};

Grid
MakeGrid(const PhantomSettings & settings)
{
  constexpr double least = 0.5;
  constexpr double most = 10.0;
  if (!(settings.spacing >= least && settings.spacing <= most))
  {
    throw Failure(FailureKind::Usage,
                  "The phantom can't be sampled every " + FormatNumber(settings.spacing) + " mm; give a spacing from " +
                    FormatNumber(least) + " to " + FormatNumber(most) + " mm.");
  }
  // An average over two spacings makes linear interpolation between samples exact for planes; beyond 4 mm it would lose
  // the ribs.
  constexpr double widestBlur = 4.0;
  const double aperture = std::max(1.0, std::min(2.0, widestBlur / settings.spacing));
  Grid grid{ settings.spacing, aperture, {}, {} };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    grid.size[axis] = std::lround(std::ceil((FieldHigh[axis] - FieldLow[axis]) / settings.spacing));
    grid.origin[axis] =
      0.5 * (FieldLow[axis] + FieldHigh[axis]) - 0.5 * settings.spacing * static_cast<double>(grid.size[axis] - 1);
  }
  return grid;
}

/** Points spread evenly over the unit square about 0, no two of them in the same row or column: a Fibonacci lattice. */
const std::vector<std::array<double, 2>> &
SubSamples()
{
  static const auto samples = [] {
    constexpr int count = 55; // this Fibonacci number, and the number before it
    constexpr int step = 34;
    std::vector<std::array<double, 2>> points;
    for (int i = 0; i < count; ++i)
    {
      points.push_back({ (i + 0.5) / count - 0.5, (i * step % count + 0.5) / count - 0.5 });
    }
    return points;
  }();
  return samples;
}

/** Adds, to the first differences of a row of sums, the share of each sample's aperture that lies beyond \a begin. */
void
AddFrom(double begin, float sign, double aperture, Range range, std::vector<float> & differences)
{
  float before = 0.0f;
  const long first = std::max(range.first, std::lround(std::ceil(begin - 0.5 * aperture)));
  for (long index = first; before != 1.0f && index < range.last; ++index)
  {
    const double share = (static_cast<double>(index) - begin) / aperture + 0.5;
    const float covered = static_cast<float>(std::clamp(share, 0.0, 1.0));
    differences[static_cast<std::size_t>(index - range.first)] += sign * (covered - before);
    before = covered;
  }
}

/** Adds \a contrast times the share of each aperture that the solid covers. */
void
AddSolid(const Grid & grid, long x, const PhantomSolid & solid, double contrast, std::vector<float> & slab)
{
  const unsigned axis = solid.axis;
  const unsigned other = 3 - axis;
  const Range lines = grid.RangeOf(other, solid.bounds);
  const Range row = grid.RangeOf(axis, solid.bounds);
  const auto & samples = SubSamples();
  const float weight = static_cast<float>(contrast) / static_cast<float>(samples.size());
  std::vector<float> differences(static_cast<std::size_t>(row.last - row.first));
  for (long line = lines.first; line < lines.last; ++line)
  {
    std::fill(differences.begin(), differences.end(), 0.0f);
    for (const auto & sample : samples)
    {
      PhantomPoint point{};
      point[0] = grid.PointOf(0, static_cast<double>(x) + grid.aperture * sample[0]);
      point[other] = grid.PointOf(other, static_cast<double>(line) + grid.aperture * sample[1]);
      const PhantomSpan span = solid.spanAt(point);
      if (span.first < span.last)
      {
        AddFrom(grid.IndexOf(axis, span.first), 1.0f, grid.aperture, row, differences);
        AddFrom(grid.IndexOf(axis, span.last), -1.0f, grid.aperture, row, differences);
      }
    }
    float sum = 0.0f;
    for (long index = row.first; index < row.last; ++index)
    {
      sum += differences[static_cast<std::size_t>(index - row.first)];
      slab[grid.PlaceInSlab(axis, index, line)] += weight * sum;
    }
  }
}

/** Sets the label of the samples that the solid contains. */
void
LabelSolid(const Grid & grid, long x, const PhantomSolid & solid, int label, std::vector<std::uint8_t> & slab)
{
  const unsigned axis = solid.axis;
  const unsigned other = 3 - axis;
  const Range lines = grid.RangeOf(other, solid.bounds);
  for (long line = lines.first; line < lines.last; ++line)
  {
    PhantomPoint point{};
    point[0] = grid.PointOf(0, static_cast<double>(x));
    point[other] = grid.PointOf(other, static_cast<double>(line));
    const PhantomSpan span = solid.spanAt(point);
    const Range row = grid.RangeOf(axis, span.first, span.last);
    for (long index = row.first; index < row.last; ++index)
    {
      const double position = grid.PointOf(axis, static_cast<double>(index));
      if (span.first <= position && position <= span.last)
      {
        slab[grid.PlaceInSlab(axis, index, line)] = static_cast<std::uint8_t>(label);
      }
    }
  }
}

/** The value of a part minus the value of the part around it. */
double
ContrastOf(const PhantomPart & part)
{
  const bool isInAir = part.parent == PhantomPart::None;
  const int around = isInAir ? PhantomAir : PhantomParts()[static_cast<std::size_t>(part.parent)].label;
  return HounsfieldOf(part.label) - HounsfieldOf(around);
}

template <typename TImage>
typename TImage::Pointer
AllocateOn(const Grid & grid)
{
  auto image = TImage::New();
  typename TImage::SizeType size;
  std::copy(grid.size.begin(), grid.size.end(), size.begin());
  image->SetRegions(size);
  image->SetSpacing(typename TImage::SpacingType(grid.spacing));
  image->SetOrigin(grid.origin.data());
  try
  {
    image->Allocate();
  }
  catch (const itk::MemoryAllocationError &)
  {
    throw Failure(FailureKind::Memory,
                  "There is not enough memory for a phantom of " +
                    std::to_string(image->GetLargestPossibleRegion().GetNumberOfPixels()) +
                    " voxels; give a larger spacing.");
  }
  return image;
}

/** An image made of slabs: samples of \a air, changed by addPart(grid, x, part, slab) for each part, then rounded. */
template <typename TImage, typename TValue, typename TAddPart>
typename TImage::Pointer
MakeImage(const PhantomSettings & settings, TValue air, const TAddPart & addPart)
{
  const Grid grid = MakeGrid(settings);
  const auto image = AllocateOn<TImage>(grid);
  const auto width = static_cast<std::size_t>(grid.size[0]);
  ForEachInBlocks(width, 1, [&](std::size_t i) {
    const auto x = static_cast<long>(i);
    std::vector<TValue> slab(static_cast<std::size_t>(grid.size[1] * grid.size[2]), air);
    for (const auto & part : PhantomParts())
    {
      const Range range = grid.RangeOf(0, part.solid.bounds);
      if (range.first <= x && x < range.last)
      {
        addPart(grid, x, part, slab);
      }
    }
    auto * voxel = image->GetBufferPointer() + i;
    for (const TValue value : slab)
    {
      *voxel = static_cast<typename TImage::PixelType>(std::lround(value));
      voxel += width;
    }
  });
  return image;
}

} // namespace

PhantomScan::Pointer
MakePhantomScan(const PhantomSettings & settings)
{
  // Where parts are nested, the value is the sum of their contrasts; the average of a sum is the sum of the averages.
  const auto add = [](const Grid & grid, long x, const PhantomPart & part, std::vector<float> & slab) {
    AddSolid(grid, x, part.solid, ContrastOf(part), slab);
  };
  return MakeImage<PhantomScan>(settings, static_cast<float>(HounsfieldOf(PhantomAir)), add);
}

PhantomLabels::Pointer
MakePhantomLabels(const PhantomSettings & settings)
{
  const auto add = [](const Grid & grid, long x, const PhantomPart & part, std::vector<std::uint8_t> & slab) {
    LabelSolid(grid, x, part.solid, part.label, slab);
  };
  return MakeImage<PhantomLabels>(settings, std::uint8_t{ PhantomAir }, add);
}

} // namespace rhombic
