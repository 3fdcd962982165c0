#include "rhombicPhantom.h"

#include "rhombicFailure.h"
#include "rhombicPhantomAnatomy.h"

#include "itkForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace rhombic
{
namespace
{

constexpr double AirHounsfield = -1000.0;

constexpr PhantomPoint FieldLow{ -216.0, -144.0, -12.0 };
constexpr PhantomPoint FieldHigh{ 216.0, 136.0, 712.0 };

std::vector<PhantomOrgan>
MakeOrgans()
{
  std::vector<PhantomOrgan> organs{
    { "skin", PhantomSkin, 30, 0, { 0.89f, 0.71f, 0.59f } },
    { "fat", PhantomFat, -100, 0, { 0.94f, 0.85f, 0.52f } },
    { "muscle", PhantomMuscle, 50, 0, { 0.69f, 0.30f, 0.26f } },
    { "skull", PhantomSkull, 900, 0, { 0.95f, 0.90f, 0.76f } },
    { "teeth", PhantomTeeth, 1600, 0, { 1.00f, 0.98f, 0.92f } },
    { "spine", PhantomSpine, 600, 0, { 0.93f, 0.85f, 0.65f } },
    { "ribs", PhantomRibs, 700, 0, { 0.95f, 0.84f, 0.57f } },
    { "shoulders", PhantomShoulders, 750, 0, { 0.91f, 0.80f, 0.60f } },
    { "pelvis", PhantomPelvis, 700, 0, { 0.90f, 0.78f, 0.55f } },
    { "brain", PhantomBrain, 35, 0, { 0.86f, 0.66f, 0.64f } },
    { "eyes", PhantomEyes, 10, 0, { 0.80f, 0.87f, 0.92f } },
    { "airway", PhantomAirway, -1000, 0, { 0.55f, 0.80f, 0.92f } },
    { "right lung", PhantomRightLung, -850, 0, { 0.80f, 0.55f, 0.58f } },
    { "left lung", PhantomLeftLung, -850, 0, { 0.84f, 0.61f, 0.64f } },
    { "heart", PhantomHeart, 45, 0, { 0.79f, 0.20f, 0.20f } },
    { "aorta", PhantomAorta, 42, 0, { 0.88f, 0.13f, 0.13f } },
    { "liver", PhantomLiver, 60, 0, { 0.60f, 0.28f, 0.21f } },
    { "spleen", PhantomSpleen, 52, 0, { 0.52f, 0.25f, 0.42f } },
    { "stomach", PhantomStomach, 20, 0, { 0.87f, 0.58f, 0.46f } },
    { "right kidney", PhantomRightKidney, 32, 0, { 0.73f, 0.40f, 0.18f } },
    { "left kidney", PhantomLeftKidney, 32, 0, { 0.78f, 0.46f, 0.23f } },
    { "bowel", PhantomBowel, 15, 0, { 0.82f, 0.68f, 0.50f } },
    { "marker", PhantomMarker, 2000, 0, { 0.30f, 0.62f, 0.35f } },
  };
  const auto volumeOf = [&organs](int label) -> double & { return organs[static_cast<std::size_t>(label) - 1].volume; };
  const auto & parts = PhantomParts();
  for (const auto & part : parts)
  {
    const double volume = part.solid->GetVolume();
    volumeOf(part.label) += volume;
    if (part.parent != PhantomPart::None)
    {
      volumeOf(parts[static_cast<std::size_t>(part.parent)].label) -= volume;
    }
  }
  return organs;
}

double
HounsfieldOf(int label)
{
  return label == PhantomAir ? AirHounsfield : PhantomOrgans()[static_cast<std::size_t>(label) - 1].hounsfield;
}

/** How much a part changes the value of the one around it. */
double
ContrastOf(const PhantomPart & part)
{
  const int around =
    part.parent == PhantomPart::None ? PhantomAir : PhantomParts()[static_cast<std::size_t>(part.parent)].label;
  return HounsfieldOf(part.label) - HounsfieldOf(around);
}

/** The grid of samples: as many as fit the field, in its middle. */
struct Grid
{
  double spacing;
  double aperture; ///< side of the cube that each sample is the average of, in spacings
  std::array<long, 3> size;
  PhantomPoint origin;

  double
  At(unsigned axis, double index) const
  {
    return origin[axis] + spacing * index;
  }
  double
  IndexOf(unsigned axis, double place) const
  {
    return (place - origin[axis]) / spacing;
  }
};

Grid
MakeGrid(const PhantomSettings & settings)
{
  constexpr double least = 0.5;
  constexpr double most = 10.0;
  if (!(settings.spacing >= least && settings.spacing <= most))
  {
    std::ostringstream text;
    text << "The phantom can't be sampled every " << settings.spacing << " mm; give a spacing from " << least << " to "
         << most << " mm.";
    throw Failure(FailureKind::Usage, text.str());
  }
  // A ramp of two spacings makes linear interpolation between samples exact for planes; beyond 4 mm it would lose the
  // ribs.
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

template <typename TImage>
typename TImage::Pointer
AllocateOn(const Grid & grid)
{
  auto image = TImage::New();
  typename TImage::RegionType region;
  typename TImage::SpacingType spacing(grid.spacing);
  typename TImage::PointType origin;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    region.SetSize(axis, static_cast<itk::SizeValueType>(grid.size[axis]));
    origin[axis] = grid.origin[axis];
  }
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  try
  {
    image->Allocate();
  }
  catch (const itk::MemoryAllocationError &)
  {
    throw Failure(FailureKind::Memory,
                  "There is not enough memory for a phantom of " + std::to_string(region.GetNumberOfPixels()) +
                    " voxels; give a larger spacing.");
  }
  return image;
}

/** Indices first .. last - 1. */
struct Range
{
  long first;
  long last;
};

/** The samples along one axis that a solid may touch. */
Range
RangeOf(const Grid & grid, double low, double high, unsigned axis)
{
  const double reach = 0.5 * grid.aperture;
  return { std::clamp(std::lround(std::floor(grid.IndexOf(axis, low) - reach)), 0L, grid.size[axis]),
           std::clamp(std::lround(std::ceil(grid.IndexOf(axis, high) + reach)) + 1, 0L, grid.size[axis]) };
}

Range
RangeOf(const Grid & grid, const PhantomBounds & bounds, unsigned axis)
{
  return RangeOf(grid, bounds.low[axis], bounds.high[axis], axis);
}

/** Places in the unit square about 0, no two of them in one row or column: Hammersley's. */
const std::vector<std::array<double, 2>> &
SubSamples()
{
  static const auto samples = [] {
    constexpr unsigned bits = 6;
    constexpr unsigned count = 1u << bits;
    std::vector<std::array<double, 2>> places;
    for (unsigned i = 0; i < count; ++i)
    {
      unsigned mirrored = 0;
      for (unsigned bit = 0; bit < bits; ++bit)
      {
        mirrored |= ((i >> bit) & 1u) << (bits - 1 - bit);
      }
      places.push_back({ (i + 0.5) / count - 0.5, (mirrored + 0.5) / count - 0.5 });
    }
    return places;
  }();
  return samples;
}

/** Sums, along a row of samples, the share of each one's aperture that spans cover. */
class RowCoverage
{
public:
  RowCoverage(long size, double aperture)
    : m_Steps(static_cast<std::size_t>(size) + 1, 0.0f)
    , m_Aperture(aperture)
  {}

  /** Adds a span in indices. */
  void
  Add(double first, double last)
  {
    AddRamp(first, 1.0f);
    AddRamp(last, -1.0f);
  }

  /** Calls \a function(i, sum) for each sample that something may cover, and forgets the sums. */
  template <typename TFunction>
  void
  Take(const TFunction & function)
  {
    float sum = 0.0f;
    for (std::size_t i = 0; i + 1 < m_Steps.size(); ++i)
    {
      sum += m_Steps[i];
      if (sum != 0.0f)
      {
        function(static_cast<long>(i), sum);
      }
    }
    std::fill(m_Steps.begin(), m_Steps.end(), 0.0f);
  }

private:
  /** Covers all from \a place on: a share of the apertures that it cuts, then all of them. */
  void
  AddRamp(double place, float sign)
  {
    const auto end = static_cast<long>(m_Steps.size()) - 1;
    float before = 0.0f;
    for (long i = std::clamp(std::lround(std::ceil(place - 0.5 * m_Aperture)), 0L, end); before != 1.0f && i <= end;
         ++i)
    {
      const double share = (static_cast<double>(i) - place) / m_Aperture + 0.5;
      const float covered = static_cast<float>(std::clamp(share, 0.0, 1.0));
      m_Steps[static_cast<std::size_t>(i)] += sign * (covered - before);
      before = covered;
    }
  }

  std::vector<float> m_Steps;
  double m_Aperture;
};

/** Adds \a contrast times the part of each aperture of slice \a k that lies in a solid with lines in the slice. */
void
AddLinesInSlice(const Grid & grid, const PhantomSolid & solid, long k, float contrast, std::vector<float> & slice)
{
  const auto along = solid.GetAxis();
  const unsigned across = 1 - along;
  const Range range = RangeOf(grid, solid.GetBounds(), across);
  const auto & samples = SubSamples();
  const float weight = contrast / static_cast<float>(samples.size());
  RowCoverage row(grid.size[along], grid.aperture);
  for (long i = range.first; i < range.last; ++i)
  {
    for (const auto & sample : samples)
    {
      PhantomPoint point{};
      point[across] = grid.At(across, static_cast<double>(i) + grid.aperture * sample[0]);
      point[2] = grid.At(2, static_cast<double>(k) + grid.aperture * sample[1]);
      const PhantomSpan span = solid.GetSpan(point);
      if (span.first < span.last)
      {
        row.Add(grid.IndexOf(along, span.first), grid.IndexOf(along, span.last));
      }
    }
    row.Take([&](long j, float sum) {
      const long x = along == 0 ? j : i;
      const long y = along == 0 ? i : j;
      slice[static_cast<std::size_t>(y * grid.size[0] + x)] += weight * sum;
    });
  }
}

/** The same for a solid with lines along z. */
void
AddLinesThroughSlice(const Grid & grid, const PhantomSolid & solid, long k, float contrast, std::vector<float> & slice)
{
  const Range columns = RangeOf(grid, solid.GetBounds(), 0);
  const Range rows = RangeOf(grid, solid.GetBounds(), 1);
  const auto & samples = SubSamples();
  const double weight = contrast / (grid.aperture * grid.spacing * static_cast<double>(samples.size()));
  const double low = grid.At(2, static_cast<double>(k) - 0.5 * grid.aperture);
  const double high = grid.At(2, static_cast<double>(k) + 0.5 * grid.aperture);
  for (long j = rows.first; j < rows.last; ++j)
  {
    for (long i = columns.first; i < columns.last; ++i)
    {
      double length = 0.0;
      for (const auto & sample : samples)
      {
        const PhantomSpan span = solid.GetSpan({ grid.At(0, static_cast<double>(i) + grid.aperture * sample[0]),
                                                 grid.At(1, static_cast<double>(j) + grid.aperture * sample[1]),
                                                 0.0 });
        length += std::max(0.0, std::min(high, span.last) - std::max(low, span.first));
      }
      slice[static_cast<std::size_t>(j * grid.size[0] + i)] += static_cast<float>(weight * length);
    }
  }
}

/** The averages over the apertures of slice \a k. The indicator of a tree of nested parts is a sum over its parts, and
 * so is the average: each part adds its own. */
std::vector<float>
ScanSlice(const Grid & grid, long k)
{
  std::vector<float> slice(static_cast<std::size_t>(grid.size[0] * grid.size[1]), static_cast<float>(AirHounsfield));
  for (const auto & part : PhantomParts())
  {
    const Range range = RangeOf(grid, part.solid->GetBounds(), 2);
    if (range.first <= k && k < range.last)
    {
      const auto add = part.solid->GetAxis() == 2 ? AddLinesThroughSlice : AddLinesInSlice;
      add(grid, *part.solid, k, static_cast<float>(ContrastOf(part)), slice);
    }
  }
  return slice;
}

/** Writes a part's label at the samples of slice \a k that it contains. */
void
LabelPart(const Grid & grid, const PhantomPart & part, long k, std::vector<std::uint8_t> & slice)
{
  // Lines along z are asked voxel by voxel: along y, each a line of its own.
  const PhantomBounds bounds = part.solid->GetBounds();
  const auto axis = part.solid->GetAxis();
  const unsigned along = axis == 2 ? 1 : axis;
  const unsigned across = 1 - along;
  const Range lines = RangeOf(grid, bounds, across);
  for (long i = lines.first; i < lines.last; ++i)
  {
    PhantomPoint point{};
    point[across] = grid.At(across, static_cast<double>(i));
    point[2] = grid.At(2, static_cast<double>(k));
    const PhantomSpan span =
      axis == 2 ? PhantomSpan{ bounds.low[along], bounds.high[along] } : part.solid->GetSpan(point);
    const Range range = span.first <= span.last ? RangeOf(grid, span.first, span.last, along) : Range{ 0, 0 };
    for (long j = range.first; j < range.last; ++j)
    {
      point[along] = grid.At(along, static_cast<double>(j));
      const bool inside =
        axis == 2 ? part.solid->Contains(point) : span.first <= point[along] && point[along] <= span.last;
      if (inside)
      {
        const long x = along == 0 ? j : i;
        const long y = along == 0 ? i : j;
        slice[static_cast<std::size_t>(y * grid.size[0] + x)] = static_cast<std::uint8_t>(part.label);
      }
    }
  }
}

/** The labels at the samples of slice \a k: parts cover those that hold them. */
std::vector<std::uint8_t>
LabelSlice(const Grid & grid, long k)
{
  std::vector<std::uint8_t> slice(static_cast<std::size_t>(grid.size[0] * grid.size[1]), PhantomAir);
  for (const auto & part : PhantomParts())
  {
    const Range range = RangeOf(grid, part.solid->GetBounds(), 2);
    if (range.first <= k && k < range.last)
    {
      LabelPart(grid, part, k, slice);
    }
  }
  return slice;
}

/** An image whose slice k is \a makeSlice(grid, k), converted by \a convert. */
template <typename TImage, typename TMakeSlice, typename TConvert>
typename TImage::Pointer
MakeImage(const PhantomSettings & settings, const TMakeSlice & makeSlice, const TConvert & convert)
{
  const Grid grid = MakeGrid(settings);
  const auto image = AllocateOn<TImage>(grid);
  auto * voxels = image->GetBufferPointer();
  itk::ForEachInBlocks(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t k) {
    const auto slice = makeSlice(grid, static_cast<long>(k));
    std::transform(slice.begin(), slice.end(), voxels + k * slice.size(), convert);
  });
  return image;
}

} // namespace

const std::vector<PhantomOrgan> &
PhantomOrgans()
{
  static const std::vector<PhantomOrgan> organs = MakeOrgans();
  return organs;
}

int
PhantomLabelAt(const PhantomPoint & point)
{
  const auto & parts = PhantomParts();
  const auto part =
    std::find_if(parts.rbegin(), parts.rend(), [&point](const auto & p) { return p.solid->Contains(point); });
  return part == parts.rend() ? PhantomAir : part->label;
}

double
PhantomHounsfieldAt(const PhantomPoint & point)
{
  return HounsfieldOf(PhantomLabelAt(point));
}

PhantomEnclosure
PhantomEnclosedBy(double threshold)
{
  if (!(threshold > AirHounsfield))
  {
    throw Failure(FailureKind::Usage,
                  "A threshold of " + std::to_string(threshold) +
                    " HU encloses the endless air around the phantom; give one above -1000 HU.");
  }
  PhantomEnclosure enclosure{ {}, 0.0 };
  for (const auto & organ : PhantomOrgans())
  {
    if (organ.hounsfield >= threshold)
    {
      enclosure.labels.push_back(organ.label);
      enclosure.volume += organ.volume;
    }
  }
  return enclosure;
}

PhantomScan::Pointer
MakePhantomScan(const PhantomSettings & settings)
{
  return MakeImage<PhantomScan>(
    settings, ScanSlice, [](float value) { return static_cast<std::int16_t>(std::lround(value)); });
}

PhantomLabels::Pointer
MakePhantomLabels(const PhantomSettings & settings)
{
  return MakeImage<PhantomLabels>(settings, LabelSlice, [](std::uint8_t label) { return label; });
}

} // namespace rhombic
