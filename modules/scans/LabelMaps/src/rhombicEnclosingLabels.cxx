#include "rhombicEnclosingLabels.h"

#include "rhombicWording.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

constexpr std::size_t RaysAlongSide = 128; // at most, across each side of the map
constexpr double HiddenShare = 0.95;       // of the rays through a label

/** How many rays meet each label, and how many meet another one before it. */
struct Encounters
{
  std::map<std::int32_t, std::size_t> rays;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> before; ///< by the label in front and the one behind
};

/** Voxels [begin, end) of a ray that have one label. */
struct Run
{
  std::size_t begin;
  std::size_t end;
  std::int32_t label;
};

/** Adds the runs of the labels that are shown.
 * \param first and \param step the offset of the ray's first voxel, and the distance of its voxels */
template <typename TImage>
void
AddRuns(const TImage & image,
        std::size_t first,
        std::size_t step,
        std::size_t length,
        const std::set<std::int32_t> & shown,
        std::vector<Run> & runs)
{
  const auto * voxel = image.GetBufferPointer() + first;
  std::int32_t last = 0;
  bool isShown = false;
  for (std::size_t n = 0; n < length; ++n, voxel += step)
  {
    const auto value = static_cast<std::int32_t>(*voxel);
    if (value != last)
    {
      isShown = value != 0 && shown.count(value) != 0;
      if (isShown)
      {
        runs.push_back({ n, n, value });
      }
      last = value;
    }
    if (isShown)
    {
      runs.back().end = n + 1;
    }
  }
}

/** Counts a ray that meets runs in their order. */
void
AddRay(const std::vector<Run> & runs, Encounters & encounters)
{
  std::vector<std::int32_t> labels; // in the order in which the ray meets them first
  for (const Run & run : runs)
  {
    if (std::find(labels.begin(), labels.end(), run.label) == labels.end())
    {
      ++encounters.rays[run.label];
      for (const std::int32_t front : labels)
      {
        ++encounters.before[{ front, run.label }];
      }
      labels.push_back(run.label);
    }
  }
}

/** Follows rays along an axis, in both directions. Where labels of several layers begin at one voxel, the first layer
 * is in front. */
void
FollowRays(const std::vector<ScanImage> & layers,
           std::size_t axis,
           const std::set<std::int32_t> & shown,
           Encounters & encounters)
{
  const auto & size = GeometryOf(layers.front()).GetLargestPossibleRegion().GetSize();
  const std::size_t steps[3] = { 1, size[0], size[0] * size[1] };
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const auto strideOf = [&size](std::size_t side) { return (size[side] + RaysAlongSide - 1) / RaysAlongSide; };
  std::vector<Run> runs;
  for (std::size_t j = 0; j < size[v]; j += strideOf(v))
  {
    for (std::size_t i = 0; i < size[u]; i += strideOf(u))
    {
      runs.clear();
      for (const ScanImage & layer : layers)
      {
        std::visit(
          [&](const auto & image) {
            AddRuns(*image, i * steps[u] + j * steps[v], steps[axis], size[axis], shown, runs);
          },
          layer);
      }
      std::stable_sort(runs.begin(), runs.end(), [](const Run & a, const Run & b) { return a.begin < b.begin; });
      AddRay(runs, encounters);
      std::stable_sort(runs.begin(), runs.end(), [](const Run & a, const Run & b) { return a.end > b.end; });
      AddRay(runs, encounters);
    }
  }
}

bool
IsNameOfCover(const std::string & name)
{
  static const std::vector<std::string> patterns{ "skin*",   "*fat",     "*fat_*", "*subcutaneous*", "muscle",
                                                  "muscles", "*_muscle", "body",   "body_*",         "torso*" };
  return std::any_of(
    patterns.begin(), patterns.end(), [&name](const std::string & pattern) { return MatchesPattern(pattern, name); });
}

} // namespace

std::set<std::int32_t>
FindEnclosingLabels(const LabelMap & map)
{
  std::set<std::int32_t> shown;
  std::set<std::int32_t> enclosing;
  for (const LabelSummary & summary : map.labels)
  {
    if (!summary.label.isVisible)
    {
      continue;
    }
    shown.insert(summary.label.value);
    if (IsNameOfCover(summary.label.name))
    {
      enclosing.insert(summary.label.value);
    }
  }
  if (shown.size() < 2)
  {
    return {};
  }
  const std::vector<ScanImage> layers = LayersOf(map.scan);
  Encounters encounters;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    FollowRays(layers, axis, shown, encounters);
  }
  for (const auto & [labels, rays] : encounters.before)
  {
    if (static_cast<double>(rays) >= HiddenShare * static_cast<double>(encounters.rays[labels.second]))
    {
      enclosing.insert(labels.first);
    }
  }
  return enclosing;
}

} // namespace rhombic
