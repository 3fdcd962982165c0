#include "rhombicLabelMap.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rhombic
{
namespace
{

constexpr std::size_t MostLabels = 4096;

[[noreturn]] void
RefuseLabelMap(const std::string & why)
{
  throw Failure(FailureKind::Unreadable,
                "This is not a label map: " + why + "; name a segmentation instead of a scan.");
}

/** Number and volume of the voxels of one value. */
struct LabelCount
{
  std::size_t numberOfVoxels = 0;
  double volume = 0; ///< cubic mm
};

/** Whether a value is an integer of 32 bits. */
template <typename TPixel>
bool
IsLabelValue(TPixel value)
{
  if constexpr (std::is_floating_point_v<TPixel>)
  {
    constexpr TPixel limit = 2147483648.0F; // the smallest float beyond int32
    return value >= -limit && value < limit && std::trunc(value) == value;
  }
  return true;
}

template <typename TPixel>
void
CountLabels(const itk::Image<TPixel, 3> & image,
            const std::vector<double> & voxelVolumes,
            std::map<std::int32_t, LabelCount> & counts)
{
  const auto size = image.GetLargestPossibleRegion().GetSize();
  const TPixel * pixel = image.GetBufferPointer();
  for (const double voxelVolume : voxelVolumes)
  {
    const TPixel * const end = pixel + size[0] * size[1];
    while (pixel != end)
    {
      const TPixel value = *pixel;
      const TPixel * const next = std::find_if(pixel, end, [value](TPixel other) { return other != value; });
      if (!IsLabelValue(value))
      {
        RefuseLabelMap("it holds " + std::to_string(value) + ", which is no whole number");
      }
      LabelCount & count = counts[static_cast<std::int32_t>(value)];
      if (counts.size() > MostLabels)
      {
        RefuseLabelMap("it holds more than 4096 different values");
      }
      const auto length = static_cast<std::size_t>(next - pixel);
      count.numberOfVoxels += length;
      count.volume += static_cast<double>(length) * voxelVolume;
      pixel = next;
    }
  }
}

/** Whether at least half of all adjacent voxels along x that are both not 0 are equal. */
template <typename TPixel>
bool
HoldsPieces(const itk::Image<TPixel, 3> & image)
{
  const std::size_t lineLength = image.GetLargestPossibleRegion().GetSize()[0];
  const TPixel * const begin = image.GetBufferPointer();
  const TPixel * const end = begin + image.GetLargestPossibleRegion().GetNumberOfPixels();
  std::size_t pairs = 0;
  std::size_t equalPairs = 0;
  for (const TPixel * line = begin; line != end; line += lineLength)
  {
    for (std::size_t x = 1; x < lineLength; ++x)
    {
      pairs += line[x] != 0 && line[x - 1] != 0 ? 1 : 0;
      equalPairs += line[x] != 0 && line[x - 1] == line[x] ? 1 : 0;
    }
  }
  return 2 * equalPairs >= pairs;
}

/** Whether all values are whole numbers, none negative, and at most MostLabels different ones. */
template <typename TPixel>
bool
HoldsLabelValues(const itk::Image<TPixel, 3> & image)
{
  const TPixel * const begin = image.GetBufferPointer();
  const TPixel * const end = begin + image.GetLargestPossibleRegion().GetNumberOfPixels();
  std::set<std::int32_t> values;
  for (const TPixel * pixel = begin; pixel != end; ++pixel)
  {
    if (pixel == begin || *pixel != pixel[-1])
    {
      if (!IsLabelValue(*pixel) || *pixel < 0 || values.size() > MostLabels)
      {
        return false;
      }
      values.insert(static_cast<std::int32_t>(*pixel));
    }
  }
  return values.size() <= MostLabels;
}

const Label *
FindLabel(const LabelTable & table, std::int32_t value)
{
  const auto found = std::lower_bound(
    table.begin(), table.end(), value, [](const Label & label, std::int32_t wanted) { return label.value < wanted; });
  return found != table.end() && found->value == value ? &*found : nullptr;
}

/** The first voxels that are not 0, and those behind the last, along each axis. */
struct LabelBox
{
  itk::Size<3> begin;
  itk::Size<3> end{ { 0, 0, 0 } };
};

template <typename TPixel>
void
Extend(LabelBox & box, const itk::Image<TPixel, 3> & image)
{
  const auto size = image.GetLargestPossibleRegion().GetSize();
  auto & [begin, end] = box;
  const TPixel * line = image.GetBufferPointer();
  for (std::size_t z = 0; z < size[2]; ++z)
  {
    for (std::size_t y = 0; y < size[1]; ++y, line += size[0])
    {
      const auto isLabel = [](TPixel value) { return value != 0; };
      const TPixel * const lineEnd = line + size[0];
      const TPixel * const first = std::find_if(line, lineEnd, isLabel);
      if (first != lineEnd)
      {
        const auto last = std::find_if(std::make_reverse_iterator(lineEnd), std::make_reverse_iterator(first), isLabel);
        begin = { { std::min<std::size_t>(begin[0], static_cast<std::size_t>(first - line)),
                    std::min<std::size_t>(begin[1], y),
                    std::min<std::size_t>(begin[2], z) } };
        end = { { std::max<std::size_t>(end[0], static_cast<std::size_t>(last.base() - line)),
                  std::max<std::size_t>(end[1], y + 1),
                  z + 1 } };
      }
    }
  }
}

/** The fraction of a region of \a inner that is in \a outer, in world space. Both extend to the outer faces of their
 * voxels. */
double
OverlapOfRegion(const itk::ImageBase<3> & inner, const itk::ImageRegion<3> & region, const itk::ImageBase<3> & outer)
{
  constexpr int points = 32; // along each axis, in the middle of equal parts of the region
  std::size_t inside = 0;
  for (int n = 0; n < points * points * points; ++n)
  {
    const int cell[3] = { n % points, n / points % points, n / points / points };
    itk::ContinuousIndex<double, 3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      index[axis] = static_cast<double>(region.GetIndex(axis)) - 0.5 +
                    (cell[axis] + 0.5) / points * static_cast<double>(region.GetSize(axis));
    }
    const auto point = inner.TransformContinuousIndexToPhysicalPoint<double>(index);
    const auto outerIndex = outer.TransformPhysicalPointToContinuousIndex<double>(point);
    inside += outer.GetLargestPossibleRegion().IsInside(outerIndex) ? 1 : 0;
  }
  return static_cast<double>(inside) / (points * points * points);
}

} // namespace

bool
LooksLikeLabelMap(const Scan & scan)
{
  return std::visit([](const auto & image) { return HoldsPieces(*image) && HoldsLabelValues(*image); }, scan.image);
}

bool
IsMask(const std::vector<LabelSummary> & labels)
{
  return labels.size() == 1 && (labels.front().label.value == 1 || labels.front().label.value == 255);
}

std::vector<LabelSummary>
SummarizeLabels(const Scan & scan, const LabelTable & table)
{
  const std::vector<double> voxelVolumes = VoxelVolumes(scan);
  std::map<std::int32_t, LabelCount> counts;
  for (const ScanImage & layer : LayersOf(scan))
  {
    std::visit([&](const auto & image) { CountLabels(*image, voxelVolumes, counts); }, layer);
  }

  std::vector<LabelSummary> summaries;
  for (const auto & [value, count] : counts)
  {
    if (value != 0)
    {
      const Label * const label = FindLabel(table, value);
      summaries.push_back({ label != nullptr ? *label : NamedLabel(value, ""),
                            count.numberOfVoxels,
                            count.volume / CubicMillimetresPerMl });
    }
  }
  return summaries;
}

itk::ImageRegion<3>
RegionOfLabels(const std::vector<ScanImage> & layers)
{
  const itk::ImageRegion<3> whole = GeometryOf(layers.front()).GetLargestPossibleRegion();
  LabelBox box{ whole.GetSize() };
  for (const ScanImage & layer : layers)
  {
    std::visit([&box](const auto & image) { Extend(box, *image); }, layer);
  }
  if (box.end[2] == 0)
  {
    return whole;
  }
  itk::ImageRegion<3> region = whole;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    region.SetIndex(axis, whole.GetIndex(axis) + static_cast<itk::IndexValueType>(box.begin[axis]));
    region.SetSize(axis, box.end[axis] - box.begin[axis]);
  }
  return region;
}

std::string
RequireOverlap(const Scan & scan,
               const Scan & labels,
               const std::filesystem::path & scanPath,
               const std::filesystem::path & labelsPath)
{
  const double overlap =
    OverlapOfRegion(GeometryOf(labels.image), RegionOfLabels(LayersOf(labels)), GeometryOf(scan.image));
  FailIf(overlap == 0,
         FailureKind::Geometry,
         "The labels of " + labelsPath.string() + " lie nowhere in " + scanPath.string() +
           "; check that both are of the same patient and examination.");
  constexpr double enough = 0.99;
  if (overlap >= enough)
  {
    return "";
  }
  return "Only " + std::to_string(static_cast<int>(std::floor(100 * overlap))) + " % of the box around the labels of " +
         labelsPath.string() + " lie in " + scanPath.string() + ".";
}

} // namespace rhombic
