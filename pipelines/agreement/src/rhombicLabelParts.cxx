#include "rhombicLabelParts.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSceneRules.h"
#include "rhombicWording.h"

#include "itkCastImageFilter.h"
#include "itkConnectedComponentImageFilter.h"
#include "itkImageRegionConstIterator.h"
#include "itkImageRegionIterator.h"

#include <algorithm>
#include <map>
#include <set>
#include <type_traits>
#include <utility>

namespace rhombic
{
namespace
{

using PartImage = CartesianImage<std::int32_t>;

constexpr std::size_t MostParts = 1000; // of a label

/** A part of a label in one of the maps. */
struct Part
{
  std::size_t pair = 0; ///< of the label
  std::size_t group = 0;
  bool isOfFirst = true;
  double volume = 0.0; ///< in mm^3
};

/** The parts of both maps, by the values that their voxels have. Values of one map are not used in the other. */
using Parts = std::map<std::int32_t, Part>;

PartImage::Pointer
CastToParts(const ScanImage & layer)
{
  return std::visit(
    [](const auto & image) {
      const auto cast = itk::CastImageFilter<std::decay_t<decltype(*image)>, PartImage>::New();
      cast->SetInput(image);
      cast->InPlaceOff(); // the layer may be shared
      cast->Update();
      return PartImage::Pointer(cast->GetOutput());
    },
    layer);
}

std::uintmax_t
MemoryOfParts(const Scan & map)
{
  return (1 + map.furtherLayers.size()) * sizeof(std::int32_t) *
         GeometryOf(map.image).GetLargestPossibleRegion().GetNumberOfPixels();
}

/** Copies the layers of a map to images of int32, which hold any number of parts. */
std::vector<PartImage *>
WidenLayers(Scan & map)
{
  std::vector<PartImage *> layers;
  const auto widen = [&layers](ScanImage & layer) {
    const PartImage::Pointer wide = CastToParts(layer);
    layers.push_back(wide);
    layer = wide;
  };
  widen(map.image);
  std::for_each(map.furtherLayers.begin(), map.furtherLayers.end(), widen);
  return layers;
}

/** Gives the voxels of each part of a label a value of its own, from \a next on. */
void
MarkParts(const ComparedLabel & label,
          const itk::ImageRegion<3> & region,
          const std::vector<PartImage *> & layers,
          const Part & part,
          std::int32_t & next,
          Parts & parts)
{
  const std::int32_t before = next;
  for (PartImage * const layer : layers) // one of which has the label
  {
    const auto mask = CartesianImage<std::uint8_t>::New();
    mask->SetRegions(region);
    mask->Allocate();
    itk::ImageRegionIterator<PartImage> voxel(layer, region);
    itk::ImageRegionIterator<CartesianImage<std::uint8_t>> inMask(mask, region);
    for (; !voxel.IsAtEnd(); ++voxel, ++inMask)
    {
      inMask.Set(voxel.Get() == label.value ? 1 : 0);
    }
    const auto components = itk::ConnectedComponentImageFilter<CartesianImage<std::uint8_t>, PartImage>::New();
    components->SetInput(mask);
    components->SetFullyConnected(true);
    components->Update();
    const auto count = static_cast<std::size_t>(components->GetObjectCount());
    if (count > MostParts)
    {
      throw Failure(FailureKind::Usage,
                    label.name + " has " + std::to_string(count) + " parts in " + (part.isOfFirst ? "A" : "B") +
                      ", and at most " + std::to_string(MostParts) +
                      " are followed; remove its specks first, or compare it as a whole.");
    }
    itk::ImageRegionConstIterator<PartImage> component(components->GetOutput(), region);
    for (voxel.GoToBegin(); !voxel.IsAtEnd(); ++voxel, ++component)
    {
      if (component.Get() != 0)
      {
        voxel.Set(next + component.Get() - 1);
      }
    }
    next += static_cast<std::int32_t>(count);
  }
  for (std::int32_t value = before; value < next; ++value)
  {
    parts[value] = part;
    parts[value].group = static_cast<std::size_t>(value);
  }
}

/** Parts of the same label that overlap get one group. */
void
GroupParts(const LabelOverlap & overlap, Parts & parts)
{
  for (const auto & [values, volume] : overlap.common)
  {
    const auto one = parts.find(values.first);
    const auto other = parts.find(values.second);
    if (one == parts.end() || other == parts.end() || one->second.pair != other->second.pair)
    {
      continue;
    }
    const std::size_t from = other->second.group;
    const std::size_t to = one->second.group;
    for (auto & [value, part] : parts)
    {
      part.group = part.group == from ? to : part.group;
    }
  }
}

/** The parts of a pair that belong together, as their values. */
struct PartGroup
{
  std::size_t pair = 0;
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> second;
  double volumeOfFirst = 0.0;
  double volumeOfSecond = 0.0;
};

/** The groups in the order of the pairs, and in each those of A first, the largest first. */
std::vector<PartGroup>
ListGroups(const Parts & parts)
{
  std::map<std::size_t, PartGroup> byGroup;
  for (const auto & [value, part] : parts)
  {
    PartGroup & group = byGroup[part.group];
    group.pair = part.pair;
    (part.isOfFirst ? group.first : group.second).push_back(value);
    (part.isOfFirst ? group.volumeOfFirst : group.volumeOfSecond) += part.volume;
  }
  std::vector<PartGroup> groups;
  for (auto & [number, group] : byGroup)
  {
    groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(), [](const PartGroup & one, const PartGroup & other) {
    if (one.pair != other.pair)
    {
      return one.pair < other.pair;
    }
    return std::pair(one.volumeOfFirst, one.volumeOfSecond) > std::pair(other.volumeOfFirst, other.volumeOfSecond);
  });
  return groups;
}

/** Replaces values of voxels. */
void
Replace(const std::map<std::int32_t, std::int32_t> & values, const std::vector<PartImage *> & layers)
{
  for (PartImage * const layer : layers)
  {
    std::int32_t * const begin = layer->GetBufferPointer();
    std::transform(begin, begin + layer->GetBufferedRegion().GetNumberOfPixels(), begin, [&values](std::int32_t value) {
      const auto found = value != 0 ? values.find(value) : values.end();
      return found != values.end() ? found->second : value;
    });
  }
}

/** The highest value of a label of either map. */
std::int32_t
HighestOf(const ComparedSide & first, const ComparedSide & second)
{
  std::int32_t highest = 0;
  for (const ComparedSide * const side : { &first, &second })
  {
    for (const ComparedLabel & label : side->labels)
    {
      highest = std::max(highest, label.value);
    }
  }
  return highest;
}

/** Throws Failure(Usage) for a pattern that fits no pair. */
std::set<std::size_t>
FindDivided(const std::vector<std::string> & patterns, const std::vector<LabelPair> & pairs)
{
  std::set<std::size_t> divided;
  for (const std::string & pattern : patterns)
  {
    bool fits = false;
    std::vector<std::string> names;
    for (std::size_t n = 0; n < pairs.size(); ++n)
    {
      names.push_back(pairs[n].name);
      if (FitsPattern(pattern, pairs[n].name))
      {
        divided.insert(n);
        fits = true;
      }
    }
    if (!fits && !pairs.empty())
    {
      throw Failure(FailureKind::Usage, DescribeUnknown("label", pattern, names, "use " + Enumerate(names)));
    }
  }
  return divided;
}

/** A label of a group, which is added to a side that has parts of the group. */
std::optional<std::size_t>
AddLabel(const ComparedLabel & whole,
         const std::string & name,
         std::int32_t value,
         const std::vector<std::int32_t> & parts,
         std::map<std::int32_t, std::int32_t> & values,
         ComparedSide & side)
{
  if (parts.empty())
  {
    return std::nullopt;
  }
  for (const std::int32_t part : parts)
  {
    values[part] = value;
  }
  side.labels.push_back({ name, value, true, whole.colour });
  return side.labels.size() - 1;
}

} // namespace

void
DivideIntoParts(const std::vector<std::string> & patterns,
                const AffineMap * toSecond,
                std::uintmax_t maximumMemory,
                ComparedSide & first,
                ComparedSide & second,
                std::vector<LabelPair> & pairs)
{
  const std::set<std::size_t> divided = FindDivided(patterns, pairs);
  if (divided.empty())
  {
    return;
  }
  RequireMemory(MemoryOfParts(first.map->scan) + MemoryOfParts(second.map->scan),
                maximumMemory,
                "The parts of labels",
                "crop the label maps");
  const std::vector<PartImage *> layersOfFirst = WidenLayers(first.map->scan);
  const std::vector<PartImage *> layersOfSecond = WidenLayers(second.map->scan);
  std::int32_t next = HighestOf(first, second) + 1;
  Parts parts;
  const auto mark = [&](const ComparedSide & side, const auto & number, const auto & layers, const Part & part) {
    if (number)
    {
      const ComparedLabel & label = side.labels[*number];
      MarkParts(label, side.moments.at(label.value).region, layers, part, next, parts);
    }
  };
  for (const std::size_t pair : divided)
  {
    mark(first, pairs[pair].first, layersOfFirst, { pair, 0, true });
    mark(second, pairs[pair].second, layersOfSecond, { pair, 0, false });
  }
  for (ComparedSide * const side : { &first, &second })
  {
    for (const auto & [value, moments] : ComputeLabelMoments(side->map->scan))
    {
      if (const auto part = parts.find(value); part != parts.end())
      {
        part->second.volume = moments.volume;
      }
    }
  }
  GroupParts(ComputeLabelOverlap(first.map->scan, second.map->scan, toSecond), parts);

  std::map<std::int32_t, std::int32_t> values;
  std::map<std::size_t, std::vector<LabelPair>> pairsOfParts;
  for (const PartGroup & group : ListGroups(parts))
  {
    const LabelPair & whole = pairs[group.pair];
    std::vector<LabelPair> & made = pairsOfParts[group.pair];
    LabelPair & pair = made.emplace_back();
    pair.name = whole.name + " " + std::to_string(made.size());
    pair.whole = whole.name;
    pair.change = { group.first.size(), group.second.size() };
    const ComparedLabel label = whole.first ? first.labels[*whole.first] : second.labels[*whole.second];
    pair.first = AddLabel(label, pair.name, next, group.first, values, first);
    pair.second = AddLabel(label, pair.name, next, group.second, values, second);
    ++next;
  }
  Replace(values, layersOfFirst);
  Replace(values, layersOfSecond);
  std::vector<LabelPair> all;
  for (std::size_t n = 0; n < pairs.size(); ++n)
  {
    const auto made = pairsOfParts.find(n);
    if (made == pairsOfParts.end())
    {
      all.push_back(pairs[n]);
    }
    else
    {
      all.insert(all.end(), made->second.begin(), made->second.end());
    }
  }
  pairs = std::move(all);
  for (ComparedSide * const side : { &first, &second })
  {
    side->moments = ComputeLabelMoments(side->map->scan);
    side->map->labels = SummarizeLabels(side->map->scan, {});
  }
}

} // namespace rhombic
