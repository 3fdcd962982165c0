#include "rhombicLabelMap.h"

#include "rhombicAnatomicalColours.h"
#include "rhombicFailure.h"
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

Label
UnnamedLabel(std::int32_t value)
{
  Label label;
  label.value = value;
  label.name = SanitizeLabelName("", value);
  label.colour = AnatomicalColour("", value);
  return label;
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
      summaries.push_back({ label != nullptr ? *label : UnnamedLabel(value),
                            count.numberOfVoxels,
                            count.volume / CubicMillimetresPerMl });
    }
  }
  return summaries;
}

} // namespace rhombic
