#include "itkTriangleSurfaceSolids.h"

#include "rhombicForEachBlock.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

using ComponentId = std::uint32_t;
using PointId = std::uint32_t;

constexpr std::size_t BlockOfComponents = 64;

/** Calls \a visit(component, turns) for the crossings of the ray along +z from a point with other components than its
 * own, see TriangleTree::VisitCrossings(). */
template <typename TVisitor>
void
VisitOtherComponents(const TriangleTree & tree,
                     const TriangleSurfaceComponents & components,
                     PointId point,
                     const TVisitor & visit)
{
  const TriangleSurface & surface = tree.GetSurface();
  tree.VisitCrossings(surface.GetPoints()[point], [&](std::uint32_t triangle, int turns) {
    const ComponentId crossed = components.ofPoint[surface.GetTriangles()[triangle][0]];
    if (crossed != components.ofPoint[point])
    {
      visit(crossed, turns);
    }
  });
}

/** The components, other than its own, that wind around a point, in ascending order. */
std::vector<ComponentId>
FindEnclosing(const TriangleTree & tree, const TriangleSurfaceComponents & components, PointId point)
{
  std::vector<std::pair<ComponentId, int>> crossings;
  VisitOtherComponents(
    tree, components, point, [&](ComponentId component, int turns) { crossings.emplace_back(component, turns); });
  std::sort(crossings.begin(), crossings.end());
  std::vector<ComponentId> enclosing;
  for (std::size_t begin = 0, end = 0; begin < crossings.size(); begin = end)
  {
    int windings = 0;
    for (; end < crossings.size() && crossings[end].first == crossings[begin].first; ++end)
    {
      windings += crossings[end].second;
    }
    if (windings != 0)
    {
      enclosing.push_back(crossings[begin].first);
    }
  }
  return enclosing;
}

/** How often all components but its own wind around a point. */
int
CountWindings(const TriangleTree & tree, const TriangleSurfaceComponents & components, PointId point)
{
  int windings = 0;
  VisitOtherComponents(tree, components, point, [&windings](ComponentId, int turns) { windings += turns; });
  return windings;
}

/** For each component, the outer shell of its solid. */
std::vector<ComponentId>
FindOuterShells(const TriangleSurface & surface,
                const TriangleSurfaceComponents & components,
                const std::vector<double> & volumes)
{
  const TriangleTree tree(surface);
  const std::vector<PointId> points = FindTriangleSurfaceFirstPoints(components);
  std::vector<ComponentId> shells(components.count);
  rhombic::ForEachInBlocks(components.count, BlockOfComponents, [&](std::size_t id) {
    const auto component = static_cast<ComponentId>(id);
    ComponentId & shell = shells[component];
    shell = component;
    if (volumes[component] >= 0.0)
    {
      return;
    }
    for (const ComponentId enclosing : FindEnclosing(tree, components, points[component]))
    {
      if (volumes[enclosing] > 0.0 && (shell == component || volumes[enclosing] < volumes[shell]))
      {
        shell = enclosing;
      }
    }
  });
  return shells;
}

/** The points of a component with the least and the greatest x. */
struct Ends
{
  PointId least;
  PointId greatest;
};

std::vector<Ends>
FindEnds(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  const auto & points = surface.GetPoints();
  std::vector<Ends> ends(components.count);
  const std::vector<PointId> first = FindTriangleSurfaceFirstPoints(components);
  std::transform(first.begin(), first.end(), ends.begin(), [](PointId point) { return Ends{ point, point }; });
  for (PointId point = 0; point < points.size(); ++point)
  {
    if (components.ofPoint[point] != TriangleSurfaceComponents::None)
    {
      Ends & found = ends[components.ofPoint[point]];
      found.least = points[point][0] < points[found.least][0] ? point : found.least;
      found.greatest = points[point][0] > points[found.greatest][0] ? point : found.greatest;
    }
  }
  return ends;
}

/** For each component, 1 if it is misfacing, see CountTriangleSurfaceShells(), else 0. */
std::vector<std::uint8_t>
FindMisfacing(const TriangleTree & tree,
              const TriangleSurfaceComponents & components,
              const std::vector<double> & volumes)
{
  const std::vector<Ends> ends = FindEnds(tree.GetSurface(), components);
  std::vector<std::uint8_t> misfacing(components.count);
  rhombic::ForEachInBlocks(components.count, BlockOfComponents, [&](std::size_t component) {
    const int expected = volumes[component] < 0.0 ? 1 : 0;
    misfacing[component] = CountWindings(tree, components, ends[component].least) != expected &&
                           CountWindings(tree, components, ends[component].greatest) != expected;
  });
  return misfacing;
}

/** For each component, 1 if no other encloses it, else 0; bytes, because threads must not write bits side by side. */
std::vector<std::uint8_t>
FindOutermost(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  const TriangleTree tree(surface);
  const std::vector<PointId> points = FindTriangleSurfaceFirstPoints(components);
  std::vector<std::uint8_t> isOutermost(components.count);
  rhombic::ForEachInBlocks(components.count, BlockOfComponents, [&](std::size_t component) {
    isOutermost[component] = FindEnclosing(tree, components, points[component]).empty();
  });
  return isOutermost;
}

/** Removes the components that \a keep leaves out. They count as cavities if \a isCavity(component), else as solids. */
template <typename TPredicate>
RemovedShells
Keep(TriangleSurface & surface,
     const TriangleSurfaceComponents & components,
     const std::vector<bool> & keep,
     const TPredicate & isCavity)
{
  const double volumeBefore = ComputeTriangleSurfaceVolume(surface);
  RemovedShells removed;
  for (ComponentId component = 0; component < components.count; ++component)
  {
    if (!keep[component])
    {
      ++(isCavity(component) ? removed.cavities : removed.solids);
    }
  }
  if (removed.solids + removed.cavities > 0)
  {
    KeepTriangleSurfaceComponents(surface, components, keep);
    removed.volume = volumeBefore - ComputeTriangleSurfaceVolume(surface);
  }
  return removed;
}

/** Keeps the solids for whose outer shell \a isKept(shell) is true. */
template <typename TPredicate>
RemovedShells
KeepSolids(TriangleSurface & surface,
           const TriangleSurfaceComponents & components,
           const std::vector<ComponentId> & shells,
           const TPredicate & isKept)
{
  std::vector<bool> keep(components.count);
  for (ComponentId component = 0; component < components.count; ++component)
  {
    keep[component] = isKept(shells[component]);
  }
  return Keep(surface, components, keep, [&shells](ComponentId component) { return shells[component] != component; });
}

} // namespace

RemovedShells
KeepLargestTriangleSurfaceSolid(TriangleSurface & surface)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<double> volumes = ComputeTriangleSurfaceComponentVolumes(surface, components);
  const std::vector<ComponentId> shells = FindOuterShells(surface, components, volumes);
  ComponentId largest = shells.empty() ? 0 : shells.front();
  for (const ComponentId shell : shells)
  {
    largest = std::abs(volumes[shell]) > std::abs(volumes[largest]) ? shell : largest;
  }
  return KeepSolids(surface, components, shells, [&](ComponentId shell) { return shell == largest; });
}

RemovedShells
RemoveSmallTriangleSurfaceSolids(TriangleSurface & surface, double minimumVolume)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<double> volumes = ComputeTriangleSurfaceComponentVolumes(surface, components);
  const std::vector<ComponentId> shells = FindOuterShells(surface, components, volumes);
  return KeepSolids(
    surface, components, shells, [&](ComponentId shell) { return std::abs(volumes[shell]) >= minimumVolume; });
}

RemovedShells
FillTriangleSurfaceCavities(TriangleSurface & surface)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<std::uint8_t> isOutermost = FindOutermost(surface, components);
  const std::vector<double> volumes = ComputeTriangleSurfaceComponentVolumes(surface, components);
  return Keep(surface, components, { isOutermost.begin(), isOutermost.end() }, [&volumes](ComponentId component) {
    return volumes[component] < 0.0;
  });
}

ShellCounts
CountTriangleSurfaceShells(const TriangleTree & surface)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface.GetSurface());
  const std::vector<double> volumes = ComputeTriangleSurfaceComponentVolumes(surface.GetSurface(), components);
  const std::vector<std::uint8_t> misfacing = FindMisfacing(surface, components, volumes);
  ShellCounts counts;
  for (ComponentId component = 0; component < components.count; ++component)
  {
    counts.misfacing += misfacing[component];
    ++(volumes[component] < 0.0 && misfacing[component] == 0 ? counts.cavities : counts.solids);
  }
  return counts;
}

SizeValueType
TurnMisfacingTriangleSurfaceShells(TriangleSurface & surface)
{
  return TurnMisfacingTriangleSurfaceShells(surface, TriangleTree(surface));
}

SizeValueType
TurnMisfacingTriangleSurfaceShells(TriangleSurface & surface, const TriangleTree & tree)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<std::uint8_t> misfacing =
    FindMisfacing(tree, components, ComputeTriangleSurfaceComponentVolumes(surface, components));
  for (auto & triangle : surface.GetTriangles())
  {
    if (misfacing[components.ofPoint[triangle[0]]])
    {
      std::swap(triangle[1], triangle[2]);
    }
  }
  for (std::size_t point = 0; point < surface.GetNormals().size(); ++point)
  {
    const ComponentId component = components.ofPoint[point];
    if (component != TriangleSurfaceComponents::None && misfacing[component])
    {
      auto & normal = surface.GetNormals()[point];
      normal = { -normal[0], -normal[1], -normal[2] };
    }
  }
  const auto count = static_cast<SizeValueType>(std::count(misfacing.begin(), misfacing.end(), 1));
  if (count > 0)
  {
    surface.Modified();
  }
  return count;
}

} // namespace itk
