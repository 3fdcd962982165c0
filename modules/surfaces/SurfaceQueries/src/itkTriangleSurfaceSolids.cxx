#include "itkTriangleSurfaceSolids.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace itk
{
namespace
{

using ComponentId = std::uint32_t;
using PointId = std::uint32_t;

constexpr std::size_t BlockOfComponents = 64;
constexpr std::size_t TrianglesOfRayBlock = 16384;

/** The components, other than its own, that wind around a point, in ascending order. */
std::vector<ComponentId>
FindEnclosing(const TriangleTree & tree, const TriangleSurfaceComponents & components, PointId point)
{
  const TriangleSurface & surface = tree.GetSurface();
  std::vector<std::pair<ComponentId, int>> crossings;
  tree.VisitCrossings(surface.GetPoints()[point], [&](std::uint32_t triangle, int turns) {
    const ComponentId crossed = components.ofPoint[surface.GetTriangles()[triangle][0]];
    if (crossed != components.ofPoint[point])
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

/** \class PointColumns
 * \brief Some points of a surface, in the cells of a grid across z: those below or in the box of a triangle are found
 * without a look at the others. */
class PointColumns
{
public:
  PointColumns(const TriangleSurface & surface, const std::vector<PointId> & points)
    : m_Size(std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(8.0 * points.size())), 256, MostCells))
    , m_Ends(m_Size * m_Size)
    , m_Places(points.size())
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::array<float, 2> highest{ -infinity, -infinity };
    m_Lowest = { infinity, infinity };
    for (const PointId point : points)
    {
      for (unsigned int axis = 0; axis < 2; ++axis)
      {
        m_Lowest[axis] = std::min(m_Lowest[axis], surface.GetPoints()[point][axis]);
        highest[axis] = std::max(highest[axis], surface.GetPoints()[point][axis]);
      }
    }
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const float length = highest[axis] - m_Lowest[axis];
      m_CellsPerMillimetre[axis] = length > 0.0f ? static_cast<float>(m_Size) / length : 0.0f;
    }
    const auto cellOf = [&](PointId point) {
      const auto & position = surface.GetPoints()[point];
      return this->CellOf(position[1], 1) * m_Size + this->CellOf(position[0], 0);
    };
    for (const PointId point : points)
    {
      ++m_Ends[cellOf(point)];
    }
    std::partial_sum(m_Ends.begin(), m_Ends.end(), m_Ends.begin());
    // Filled in from the last one on, the sums move to where each cell begins; its end is where the next one begins.
    for (std::size_t n = points.size(); n-- > 0;)
    {
      m_Places[--m_Ends[cellOf(points[n])]] = { surface.GetPoints()[points[n]], static_cast<std::uint32_t>(n) };
    }
    m_Ends.push_back(static_cast<std::uint32_t>(points.size()));
  }

  /** Calls \a visit(n) for each point, number n, from which a ray along +z meets the box. */
  template <typename TVisitor>
  void
  VisitBelow(const TriangleTree::Box & box, const TVisitor & visit) const
  {
    const std::size_t left = this->CellOf(box.lowest[0], 0), right = this->CellOf(box.highest[0], 0);
    const std::size_t last = this->CellOf(box.highest[1], 1);
    for (std::size_t row = this->CellOf(box.lowest[1], 1); row <= last; ++row)
    {
      for (std::size_t n = m_Ends[row * m_Size + left]; n < m_Ends[row * m_Size + right + 1]; ++n)
      {
        const auto & [x, y, z] = m_Places[n].position;
        if (x >= box.lowest[0] && x <= box.highest[0] && y >= box.lowest[1] && y <= box.highest[1] &&
            z <= box.highest[2])
        {
          visit(m_Places[n].number);
        }
      }
    }
  }

private:
  static constexpr std::size_t MostCells = 4096; ///< along an axis

  struct Place
  {
    TriangleTree::PointType position;
    std::uint32_t number;
  };

  std::size_t
  CellOf(float coordinate, unsigned int axis) const
  {
    const float cell = (coordinate - m_Lowest[axis]) * m_CellsPerMillimetre[axis];
    return static_cast<std::uint32_t>(static_cast<int>(std::min(static_cast<float>(m_Size - 1), std::max(0.0f, cell))));
  }

  std::size_t m_Size; ///< number of cells along each axis
  std::array<float, 2> m_Lowest;
  std::array<float, 2> m_CellsPerMillimetre;
  std::vector<std::uint32_t> m_Ends; ///< where the places of each cell begin, and the end of the last
  std::vector<Place> m_Places;       ///< cell by cell
};

/** For each of some points, how often all components but its own wind around it. */
std::vector<int>
CountWindings(const TriangleSurface & surface,
              const TriangleSurfaceComponents & components,
              const std::vector<PointId> & points)
{
  std::vector<std::atomic<int>> windings(points.size());
  if (components.count > 1)
  {
    const PointColumns columns(surface, points);
    rhombic::ForEachInBlocks(surface.GetNumberOfTriangles(), TrianglesOfRayBlock, [&](std::size_t id) {
      const auto & corners = surface.GetTriangles()[id];
      columns.VisitBelow(TriangleTree::BoxOf(surface.GetPoints(), corners), [&](std::size_t n) {
        const auto isPlaced = [&](PointId corner) { return IsFinite(surface.GetPoints()[corner]); };
        if (components.ofPoint[corners[0]] != components.ofPoint[points[n]] &&
            std::all_of(corners.begin(), corners.end(), isPlaced))
        {
          const auto triangle = static_cast<std::uint32_t>(id);
          windings[n] += TriangleTree::CountTurns(surface, surface.GetPoints()[points[n]], triangle);
        }
      });
    });
  }
  return { windings.begin(), windings.end() };
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

/** For each component, the point with the least x; behind these, for each component, the one with the greatest. */
std::vector<PointId>
FindEnds(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  const auto & points = surface.GetPoints();
  const std::vector<PointId> first = FindTriangleSurfaceFirstPoints(components);
  std::vector<PointId> ends = first;
  ends.insert(ends.end(), first.begin(), first.end());
  for (PointId point = 0; point < points.size(); ++point)
  {
    if (const ComponentId component = components.ofPoint[point]; component != TriangleSurfaceComponents::None)
    {
      PointId & least = ends[component];
      PointId & greatest = ends[components.count + component];
      least = points[point][0] < points[least][0] ? point : least;
      greatest = points[point][0] > points[greatest][0] ? point : greatest;
    }
  }
  return ends;
}

/** For each component, 1 if it is misfacing, see CountTriangleSurfaceShells(), else 0. */
std::vector<std::uint8_t>
FindMisfacing(const TriangleSurface & surface,
              const TriangleSurfaceComponents & components,
              const std::vector<double> & volumes)
{
  const std::vector<int> windings = CountWindings(surface, components, FindEnds(surface, components));
  std::vector<std::uint8_t> misfacing(components.count);
  for (ComponentId component = 0; component < components.count; ++component)
  {
    const int expected = volumes[component] < 0.0 ? 1 : 0;
    misfacing[component] = windings[component] != expected && windings[components.count + component] != expected;
  }
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
CountTriangleSurfaceShells(const TriangleSurface & surface)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<double> volumes = ComputeTriangleSurfaceComponentVolumes(surface, components);
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
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const std::vector<std::uint8_t> misfacing =
    FindMisfacing(surface, components, ComputeTriangleSurfaceComponentVolumes(surface, components));
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
