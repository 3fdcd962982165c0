#include "itkTriangleSurfaceTopology.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <ostream>

namespace itk
{
namespace
{

using PointId = std::uint32_t;

constexpr std::size_t BlockOfPoints = 1 << 14;

/** Sets of the items from 0 to size - 1, which are in no set until they are added. Thread safety: any number of threads
 * may add and join at once; an item's parent never has a higher number, so that the sets do not depend on their order.
 */
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : m_Parent(size)
  {
    rhombic::ForEachInBlocks(size, BlockOfPoints, [&](std::size_t item) { m_Parent[item] = 0; });
  }

  /** Puts an item that is in no set into one of its own. */
  void
  Add(std::uint32_t item)
  {
    if (!this->Has(item))
    {
      std::uint32_t none = 0;
      m_Parent[item].compare_exchange_strong(none, item + 1, std::memory_order_relaxed);
    }
  }

  bool
  Has(std::uint32_t item) const
  {
    return m_Parent[item].load(std::memory_order_relaxed) != 0;
  }

  /** The smallest item of the set, once no thread joins sets any more. */
  std::uint32_t
  Find(std::uint32_t item)
  {
    for (std::uint32_t parent = this->ParentOf(item); parent != item; parent = this->ParentOf(item))
    {
      const std::uint32_t next = this->ParentOf(parent);
      m_Parent[item].store(next + 1, std::memory_order_relaxed); // an item above, whatever others store there
      item = next;
    }
    return item;
  }

  void
  Join(std::uint32_t a, std::uint32_t b)
  {
    for (bool isJoined = false; !isJoined;)
    {
      const auto [low, high] = std::minmax({ this->Find(a), this->Find(b) });
      std::uint32_t first = high + 1;
      isJoined = low == high || m_Parent[high].compare_exchange_strong(first, low + 1, std::memory_order_relaxed);
    }
  }

private:
  std::uint32_t
  ParentOf(std::uint32_t item) const
  {
    return m_Parent[item].load(std::memory_order_relaxed) - 1;
  }

  BulkVector<std::atomic<std::uint32_t>> m_Parent; ///< the parent's number and 1, itself for the first; 0: in no set
};

/** Sorts by operator< on several threads: sorts blocks, then merges them in pairs. Items that compare equal must be
 * indistinguishable. Takes the items' memory once more. */
template <typename TContainer>
void
ParallelSort(TContainer & items)
{
  constexpr std::size_t block = 1 << 16;
  const std::size_t size = items.size();
  const auto at = [size](TContainer & container, std::size_t index) {
    return container.begin() + static_cast<std::ptrdiff_t>(std::min(index, size));
  };
  rhombic::ForEachBlock(
    size, block, [&](std::size_t begin, std::size_t end) { std::sort(at(items, begin), at(items, end)); });
  TContainer merged(size > block ? size : 0);
  for (std::size_t sorted = block; sorted < size; sorted *= 2)
  {
    rhombic::ForEachBlock(size, 2 * sorted, [&](std::size_t begin, std::size_t end) {
      const auto middle = at(items, begin + sorted);
      std::merge(at(items, begin), middle, middle, at(items, end), at(merged, begin));
    });
    items.swap(merged);
  }
}

/** The link of a point in a triangle: the opposite side, in the triangle's direction. */
struct Link
{
  PointId from;
  PointId to;

  bool
  operator<(const Link & other) const
  {
    return from != other.from ? from < other.from : to < other.to;
  }
};

/** The links of all points, one point after the other. */
struct PointLinks
{
  BulkVector<std::uint64_t> begin; ///< index of each point's first link, and the end of the last
  BulkVector<Link> links;
};

PointLinks
CollectLinks(const TriangleSurface & surface)
{
  PointLinks all;
  all.begin.assign(surface.GetNumberOfPoints() + 1, 0);
  for (const auto & triangle : surface.GetTriangles())
  {
    for (const PointId point : triangle)
    {
      ++all.begin[point];
    }
  }
  // The sums are where each point's links end; filling them in moves them to where they begin.
  std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
  all.links.resize(3 * surface.GetNumberOfTriangles());
  for (const auto & triangle : surface.GetTriangles())
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      all.links[--all.begin[triangle[corner]]] = { triangle[(corner + 1) % 3], triangle[(corner + 2) % 3] };
    }
  }
  return all;
}

/** The triangles around one point. */
class Fan
{
public:
  /** Copies the links of \a point. */
  template <typename TIterator>
  void
  Assign(PointId point, TIterator begin, TIterator end)
  {
    m_Point = point;
    m_Links.assign(begin, end);
    m_Ends.clear();
    for (std::uint32_t link = 0; link < m_Links.size(); ++link)
    {
      m_Ends.push_back({ m_Links[link].from, link, true });
      m_Ends.push_back({ m_Links[link].to, link, false });
    }
    std::sort(m_Ends.begin(), m_Ends.end());
  }

  /** Adds the flaws of the edges to points of higher number to \a topology; returns the number of these edges. */
  SizeValueType
  CountEdges(TriangleSurfaceTopology & topology) const
  {
    SizeValueType distinct = 0;
    for (std::size_t begin = 0, end = 0; begin < m_Ends.size(); begin = end)
    {
      end = this->EndOfNeighbour(begin);
      if (m_Ends[begin].neighbour <= m_Point)
      {
        continue;
      }
      ++distinct;
      topology.boundaryEdges += end - begin == 1 ? 1 : 0;
      topology.misorientedEdges += end - begin == 2 && m_Ends[begin].isFrom == m_Ends[begin + 1].isFrom ? 1 : 0;
      topology.nonManifoldEdges += end - begin > 2 ? 1 : 0;
    }
    return distinct;
  }

  /** Whether the links form a single cycle, or a single path at a boundary. */
  bool
  IsSingle() const
  {
    std::size_t start = 0;
    for (std::size_t begin = 0, end = 0; begin < m_Ends.size(); begin = end)
    {
      end = this->EndOfNeighbour(begin);
      if (end - begin > 2)
      {
        return false;
      }
      start = end - begin == 1 ? begin : start; // an end of a path
    }
    std::size_t visited = 0;
    std::size_t current = start;
    do
    {
      ++visited;
      current = this->FindOtherUse(this->FindOtherEnd(current));
    } while (current != start && current != NoEnd);
    return visited == m_Links.size();
  }

  /** Adds the duplicates among the triangles that have no point of lower number to \a topology, so that each is counted
   * at one point. Returns the number of these triangles that have three different points. Destroys the links. */
  SizeValueType
  CountTriangles(TriangleSurfaceTopology & topology)
  {
    std::size_t kept = 0;
    for (const Link & link : m_Links)
    {
      const auto [low, high] = std::minmax(link.from, link.to);
      if (m_Point < low && low < high)
      {
        m_Links[kept++] = { low, high };
      }
    }
    m_Links.resize(kept);
    std::sort(m_Links.begin(), m_Links.end());
    for (std::size_t n = 1; n < kept; ++n)
    {
      topology.duplicateTriangles += m_Links[n - 1] < m_Links[n] ? 0 : 1;
    }
    return kept;
  }

private:
  /** One end of a link. */
  struct End
  {
    PointId neighbour;
    std::uint32_t link;
    bool isFrom;

    bool
    operator<(const End & other) const
    {
      return neighbour != other.neighbour ? neighbour < other.neighbour
             : link != other.link         ? link < other.link
                                          : isFrom < other.isFrom;
    }
  };

  static constexpr std::size_t NoEnd = static_cast<std::size_t>(-1);

  std::size_t
  EndOfNeighbour(std::size_t end) const
  {
    const PointId neighbour = m_Ends[end].neighbour;
    while (end < m_Ends.size() && m_Ends[end].neighbour == neighbour)
    {
      ++end;
    }
    return end;
  }

  std::size_t
  FindOtherEnd(std::size_t end) const
  {
    const End & known = m_Ends[end];
    const Link & link = m_Links[known.link];
    const End other{ known.isFrom ? link.to : link.from, known.link, !known.isFrom };
    return static_cast<std::size_t>(std::lower_bound(m_Ends.begin(), m_Ends.end(), other) - m_Ends.begin());
  }

  /** The end of the only other link at the same neighbour, or NoEnd. */
  std::size_t
  FindOtherUse(std::size_t end) const
  {
    const PointId neighbour = m_Ends[end].neighbour;
    if (end > 0 && m_Ends[end - 1].neighbour == neighbour)
    {
      return end - 1;
    }
    return end + 1 < m_Ends.size() && m_Ends[end + 1].neighbour == neighbour ? end + 1 : NoEnd;
  }

  PointId m_Point = 0;
  std::vector<Link> m_Links;
  std::vector<End> m_Ends;
};

/** Counts over some points of a component. */
struct ComponentShape
{
  std::uint32_t component;
  OffsetValueType eulerCharacteristic = 0;
  SizeValueType flaws = 0; ///< boundary, non-manifold and misoriented edges and non-manifold points
};

SizeValueType
CountFlaws(const TriangleSurfaceTopology & topology)
{
  return topology.boundaryEdges + topology.nonManifoldEdges + topology.misorientedEdges + topology.nonManifoldPoints;
}

/** Adds the flaws at the points [begin, end) to \a topology. Returns one shape for each run of points of the same
 * component. */
std::vector<ComponentShape>
CountFans(const PointLinks & all,
          const TriangleSurfaceComponents & components,
          std::size_t begin,
          std::size_t end,
          TriangleSurfaceTopology & topology)
{
  std::vector<ComponentShape> shapes;
  Fan fan;
  for (std::size_t point = begin; point < end; ++point)
  {
    const auto first = all.links.begin() + static_cast<std::ptrdiff_t>(all.begin[point]);
    const auto last = all.links.begin() + static_cast<std::ptrdiff_t>(all.begin[point + 1]);
    if (first == last)
    {
      ++topology.unusedPoints;
      continue;
    }
    if (shapes.empty() || shapes.back().component != components.ofPoint[point])
    {
      shapes.push_back({ components.ofPoint[point] });
    }
    const SizeValueType flaws = CountFlaws(topology);
    fan.Assign(static_cast<PointId>(point), first, last);
    const auto edges = static_cast<OffsetValueType>(fan.CountEdges(topology));
    topology.nonManifoldPoints += fan.IsSingle() ? 0 : 1;
    const auto triangles = static_cast<OffsetValueType>(fan.CountTriangles(topology));
    shapes.back().eulerCharacteristic += 1 - edges + triangles;
    shapes.back().flaws += CountFlaws(topology) - flaws;
  }
  return shapes;
}

/** Counts everything that depends on the connectivity. */
void
CountConnections(const TriangleSurface & surface, TriangleSurfaceTopology & topology)
{
  const TriangleSurfaceComponents components = FindTriangleSurfaceComponents(surface);
  const PointLinks all = CollectLinks(surface);
  std::vector<ComponentShape> shapes(components.count);
  std::mutex mutex;
  rhombic::ForEachBlock(surface.GetNumberOfPoints(), BlockOfPoints, [&](std::size_t begin, std::size_t end) {
    TriangleSurfaceTopology ofBlock;
    const std::vector<ComponentShape> shapesOfBlock = CountFans(all, components, begin, end, ofBlock);
    const std::lock_guard<std::mutex> lock(mutex);
    topology.boundaryEdges += ofBlock.boundaryEdges;
    topology.nonManifoldEdges += ofBlock.nonManifoldEdges;
    topology.misorientedEdges += ofBlock.misorientedEdges;
    topology.nonManifoldPoints += ofBlock.nonManifoldPoints;
    topology.unusedPoints += ofBlock.unusedPoints;
    topology.duplicateTriangles += ofBlock.duplicateTriangles;
    for (const ComponentShape & shape : shapesOfBlock)
    {
      shapes[shape.component].eulerCharacteristic += shape.eulerCharacteristic;
      shapes[shape.component].flaws += shape.flaws;
    }
  });
  topology.components = components.count;
  for (const ComponentShape & shape : shapes)
  {
    topology.eulerCharacteristic += shape.eulerCharacteristic;
    topology.genus += shape.flaws == 0 ? static_cast<SizeValueType>(1 - shape.eulerCharacteristic / 2) : 0;
  }
}

bool
IsDegenerate(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  const auto & a = surface.GetPoints()[triangle[0]];
  const auto & b = surface.GetPoints()[triangle[1]];
  const auto & c = surface.GetPoints()[triangle[2]];
  return !IsFinite(a) || !IsFinite(b) || !IsFinite(c) ||
         !HasArea(a, b, c); // a triangle with a repeated point has no area
}

SizeValueType
CountDegenerateTriangles(const TriangleSurface & surface)
{
  const auto & triangles = surface.GetTriangles();
  std::atomic<SizeValueType> count{ 0 };
  rhombic::ForEachBlock(triangles.size(), BlockOfPoints, [&](std::size_t begin, std::size_t end) {
    const auto at = [&triangles](std::size_t n) { return triangles.begin() + static_cast<std::ptrdiff_t>(n); };
    count += static_cast<SizeValueType>(
      std::count_if(at(begin), at(end), [&surface](const auto & triangle) { return IsDegenerate(surface, triangle); }));
  });
  return count;
}

/** Counts repeated positions and positions that are not finite. */
void
CountPositions(const TriangleSurface & surface, TriangleSurfaceTopology & topology)
{
  std::vector<bool> isUsed(surface.GetNumberOfPoints(), false);
  for (const auto & triangle : surface.GetTriangles())
  {
    for (const PointId point : triangle)
    {
      isUsed[point] = true;
    }
  }
  TriangleSurface::PointsContainer positions;
  positions.reserve(surface.GetNumberOfPoints());
  for (std::size_t point = 0; point < isUsed.size(); ++point)
  {
    const auto & position = surface.GetPoints()[point];
    if (!isUsed[point])
    {
      continue;
    }
    if (!IsFinite(position))
    {
      ++topology.nonFinitePoints;
    }
    else
    {
      positions.push_back({ position[0] + 0.0f, position[1] + 0.0f, position[2] + 0.0f }); // turns -0 into 0
    }
  }
  ParallelSort(positions);
  const auto distinct = std::unique(positions.begin(), positions.end());
  topology.repeatedPositions = static_cast<SizeValueType>(positions.end() - distinct);
}

} // namespace

TriangleSurfaceComponents
FindTriangleSurfaceComponents(const TriangleSurface & surface)
{
  const auto & triangles = surface.GetTriangles();
  DisjointSets sets(surface.GetNumberOfPoints());
  rhombic::ForEachInBlocks(triangles.size(), BlockOfPoints, [&](std::size_t n) {
    for (const PointId point : triangles[n])
    {
      sets.Add(point);
    }
    sets.Join(triangles[n][0], triangles[n][1]);
    sets.Join(triangles[n][1], triangles[n][2]);
  });
  TriangleSurfaceComponents components;
  components.ofPoint.assign(surface.GetNumberOfPoints(), TriangleSurfaceComponents::None);
  for (PointId point = 0; point < components.ofPoint.size(); ++point)
  {
    if (sets.Has(point))
    {
      const PointId first = sets.Find(point);
      components.ofPoint[point] = first == point ? components.count++ : components.ofPoint[first];
    }
  }
  return components;
}

std::vector<std::uint32_t>
FindTriangleSurfaceFirstPoints(const TriangleSurfaceComponents & components)
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

void
KeepTriangleSurfaceComponents(TriangleSurface & surface,
                              const TriangleSurfaceComponents & components,
                              const std::vector<bool> & keep)
{
  auto & triangles = surface.GetTriangles();
  triangles.erase(std::remove_if(triangles.begin(),
                                 triangles.end(),
                                 [&](const auto & triangle) { return !keep[components.ofPoint[triangle[0]]]; }),
                  triangles.end());
  surface.RemoveUnusedPoints();
}

TriangleSurfaceTopology
ComputeTriangleSurfaceTopology(const TriangleSurface & surface)
{
  TriangleSurfaceTopology topology;
  topology.degenerateTriangles = CountDegenerateTriangles(surface);
  CountPositions(surface, topology);
  CountConnections(surface, topology);
  return topology;
}

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceTopology & topology)
{
  return os << topology.components << " components, Euler characteristic " << topology.eulerCharacteristic << ", genus "
            << topology.genus << ", " << topology.boundaryEdges << " boundary edges, " << topology.nonManifoldEdges
            << " non-manifold edges, " << topology.misorientedEdges << " misoriented edges, "
            << topology.nonManifoldPoints << " non-manifold points, " << topology.unusedPoints << " unused points, "
            << topology.repeatedPositions << " repeated positions, " << topology.nonFinitePoints
            << " non-finite points, " << topology.degenerateTriangles << " degenerate triangles, "
            << topology.duplicateTriangles << " duplicate triangles";
}

} // namespace itk
