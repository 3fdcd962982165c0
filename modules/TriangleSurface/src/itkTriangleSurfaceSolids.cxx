#include "itkTriangleSurfaceSolids.h"

#include "itkForEachBlock.h"
#include "itkTriangleSurfaceComponents.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleTree.h"

#include <cmath>

namespace itk
{
namespace
{

using ComponentId = std::uint32_t;

constexpr std::size_t BlockOfComponents = 64;

std::vector<std::uint32_t>
FindFirstPoints(const TriangleSurfaceComponents & components)
{
  std::vector<std::uint32_t> first;
  first.reserve(components.count);
  for (std::uint32_t point = 0; point < components.ofPoint.size(); ++point)
  {
    if (components.ofPoint[point] == first.size())
    {
      first.push_back(point);
    }
  }
  return first;
}

/** The components, other than its own, that wind around a point. */
class Enclosures
{
public:
  Enclosures(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
    : m_Components(components)
    , m_FirstPoints(FindFirstPoints(components))
    , m_Tree(surface)
  {}

  /** In increasing order. */
  std::vector<ComponentId>
  Find(ComponentId component) const
  {
    const TriangleSurface & surface = m_Tree.GetSurface();
    std::vector<std::pair<ComponentId, int>> crossings;
    m_Tree.VisitCrossings(surface.GetPoints()[m_FirstPoints[component]], [&](std::uint32_t triangle, int turns) {
      const ComponentId crossed = m_Components.ofPoint[surface.GetTriangles()[triangle][0]];
      if (crossed != component)
      {
        crossings.emplace_back(crossed, turns);
      }
    });
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

private:
  const TriangleSurfaceComponents & m_Components;
  const std::vector<std::uint32_t> m_FirstPoints;
  const TriangleTree m_Tree;
};

/** The outer shell of the solid that each component is a part of. */
std::vector<ComponentId>
FindOuterShells(const TriangleSurface & surface,
                const TriangleSurfaceComponents & components,
                const std::vector<double> & volumes)
{
  const Enclosures enclosures(surface, components);
  std::vector<ComponentId> shells(components.count);
  ForEachBlock(components.count, BlockOfComponents, [&](std::size_t begin, std::size_t end) {
    for (auto component = static_cast<ComponentId>(begin); component < end; ++component)
    {
      ComponentId & shell = shells[component];
      shell = component;
      if (volumes[component] >= 0.0)
      {
        continue;
      }
      for (const ComponentId enclosing : enclosures.Find(component))
      {
        if (volumes[enclosing] > 0.0 && (shell == component || volumes[enclosing] < volumes[shell]))
        {
          shell = enclosing;
        }
      }
    }
  });
  return shells;
}

SizeValueType
Keep(TriangleSurface & surface, const TriangleSurfaceComponents & components, const std::vector<bool> & keep)
{
  const auto removed = std::count(keep.begin(), keep.end(), false);
  if (removed > 0)
  {
    KeepComponents(surface, components, keep);
  }
  return static_cast<SizeValueType>(removed);
}

/** Keeps the components whose solid's outer shell \a isKept(shell) approves. */
template <typename TPredicate>
SizeValueType
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
  return Keep(surface, components, keep);
}

} // namespace

SizeValueType
KeepLargestSolid(TriangleSurface & surface)
{
  const TriangleSurfaceComponents components = FindComponents(surface);
  const std::vector<double> volumes = ComputeComponentVolumes(surface, components);
  const std::vector<ComponentId> shells = FindOuterShells(surface, components, volumes);
  ComponentId largest = shells.empty() ? 0 : shells.front();
  for (const ComponentId shell : shells)
  {
    largest = std::abs(volumes[shell]) > std::abs(volumes[largest]) ? shell : largest;
  }
  return KeepSolids(surface, components, shells, [&](ComponentId shell) { return shell == largest; });
}

SizeValueType
RemoveSmallSolids(TriangleSurface & surface, double minimumVolume)
{
  const TriangleSurfaceComponents components = FindComponents(surface);
  const std::vector<double> volumes = ComputeComponentVolumes(surface, components);
  const std::vector<ComponentId> shells = FindOuterShells(surface, components, volumes);
  return KeepSolids(
    surface, components, shells, [&](ComponentId shell) { return std::abs(volumes[shell]) >= minimumVolume; });
}

SizeValueType
FillCavities(TriangleSurface & surface)
{
  const TriangleSurfaceComponents components = FindComponents(surface);
  std::vector<std::uint8_t> isOutermost(components.count); // bytes, which threads may write side by side
  {
    const Enclosures enclosures(surface, components);
    ForEachBlock(components.count, BlockOfComponents, [&](std::size_t begin, std::size_t end) {
      for (auto component = static_cast<ComponentId>(begin); component < end; ++component)
      {
        isOutermost[component] = enclosures.Find(component).empty();
      }
    });
  }
  return Keep(surface, components, { isOutermost.begin(), isOutermost.end() });
}

} // namespace itk
