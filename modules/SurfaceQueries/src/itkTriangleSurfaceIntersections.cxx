#include "itkTriangleSurfaceIntersections.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTriangleContact.h"
#include "itkForEachBlock.h"
#include "itkUnfoldedPoints.h"

#include <algorithm>
#include <cstring>
#include <mutex>

namespace itk
{
namespace
{

using Contact = TriangleContact;
using Box = TriangleTree::Box;
using TriangleType = TriangleSurface::TriangleType;

constexpr std::size_t TrianglesOfGroup = 32;
constexpr std::size_t GroupsOfBlock = 128;

bool
AreDuplicates(TriangleType a, TriangleType b)
{
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

void
SortUnique(std::vector<std::uint32_t> & ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/** \class BoxList
 * \brief Triangles and their boxes, coordinate by coordinate, so that many are compared with one at once. */
class BoxList
{
public:
  void
  Clear()
  {
    m_Triangles.clear();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Lowest[axis].clear();
      m_Highest[axis].clear();
    }
  }

  void
  Add(std::uint32_t triangle, const Box & box)
  {
    m_Triangles.push_back(triangle);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Lowest[axis].push_back(box.lowest[axis]);
      m_Highest[axis].push_back(box.highest[axis]);
    }
  }

  std::size_t
  GetSize() const
  {
    return m_Triangles.size();
  }

  std::uint32_t
  GetTriangle(std::size_t n) const
  {
    return m_Triangles[n];
  }

  /** Calls \a visit(triangle) for those behind the \a n-th whose boxes overlap its box. */
  template <typename TVisitor>
  void
  VisitOverlapping(std::size_t n, const TVisitor & visit)
  {
    const std::size_t size = m_Triangles.size();
    m_Overlap.resize(size + sizeof(std::uint64_t));
    const float *x0 = m_Lowest[0].data(), *y0 = m_Lowest[1].data(), *z0 = m_Lowest[2].data();
    const float *x1 = m_Highest[0].data(), *y1 = m_Highest[1].data(), *z1 = m_Highest[2].data();
    const Box box{ { x0[n], y0[n], z0[n] }, { x1[n], y1[n], z1[n] } };
    std::uint8_t * const overlap = m_Overlap.data();
    for (std::size_t other = n + 1; other < size; ++other)
    {
      overlap[other] = (x0[other] <= box.highest[0]) & (box.lowest[0] <= x1[other]) & (y0[other] <= box.highest[1]) &
                       (box.lowest[1] <= y1[other]) & (z0[other] <= box.highest[2]) & (box.lowest[2] <= z1[other]);
    }
    std::fill_n(overlap + size, sizeof(std::uint64_t), 0);
    for (std::size_t other = n + 1; other < size; other += sizeof(std::uint64_t))
    {
      std::uint64_t next;
      std::memcpy(&next, overlap + other, sizeof(next));
      for (; next != 0; next &= next - 1)
      {
        visit(m_Triangles[other + static_cast<std::size_t>(__builtin_ctzll(next)) / 8]);
      }
    }
  }

private:
  std::vector<std::uint32_t> m_Triangles;
  std::array<std::vector<float>, 3> m_Lowest;
  std::array<std::vector<float>, 3> m_Highest;
  std::vector<std::uint8_t> m_Overlap;
};

/** \class ContactSearch
 * \brief Finds how the triangles of a surface meet elsewhere than at corners and sides they share.
 *
 * Triangles are tested in groups, which are small subtrees: those of a group are compared with each other and with all
 * those around the group. Pairs with a common point at which the surface is not folded need no test. */
class ContactSearch
{
public:
  explicit ContactSearch(const TriangleTree & tree)
    : m_Tree(tree)
    , m_Groups(tree.FindSubtrees(TrianglesOfGroup))
    , m_AreUnfolded(FindUnfoldedPoints(tree.GetSurface(), TrianglesOfPoints(tree.GetSurface())))
  {}

  std::size_t
  GetNumberOfGroups() const
  {
    return m_Groups.size() - 1;
  }

  /** Calls \a visit(a, b, contact) for pairs with a triangle in a group, without those that an earlier group has
   * visited. Every \a stride-th group is tested. Returns how many triangles the group has. \a near is for working. */
  template <typename TVisitor>
  std::size_t
  TestGroup(std::size_t group, std::size_t stride, BoxList & near, const TVisitor & visit) const
  {
    const std::size_t begin = m_Groups[group];
    const std::size_t end = m_Groups[group + 1];
    Box around = m_Tree.GetTriangleBox(*m_Tree.GetLeaf(begin).begin());
    near.Clear();
    for (std::size_t leaf = begin; leaf < end; ++leaf)
    {
      for (const std::uint32_t triangle : m_Tree.GetLeaf(leaf))
      {
        const Box box = m_Tree.GetTriangleBox(triangle);
        near.Add(triangle, box);
        around = TriangleTree::Union(around, box);
      }
    }
    const std::size_t ofGroup = near.GetSize();
    m_Tree.VisitLeaves(around, stride == 1 ? end : 0, [&](std::size_t leaf) {
      const bool isInGroup = leaf >= begin && leaf < end;
      if (!isInGroup && (leaf >= end || this->GroupOf(leaf) % stride != 0))
      {
        this->AddLeaf(leaf, around, near);
      }
    });
    const auto & triangles = m_Tree.GetSurface().GetTriangles();
    for (std::size_t n = 0; n < ofGroup; ++n)
    {
      const std::uint32_t a = near.GetTriangle(n);
      near.VisitOverlapping(n, [&](std::uint32_t b) {
        if (!this->AreApart(triangles[a], triangles[b]))
        {
          visit(a, b, FindContact(m_Tree.GetSurface().GetPoints(), triangles[a], triangles[b]));
        }
      });
    }
    return ofGroup;
  }

private:
  void
  AddLeaf(std::size_t leaf, const Box & around, BoxList & near) const
  {
    for (const std::uint32_t triangle : m_Tree.GetLeaf(leaf))
    {
      const Box box = m_Tree.GetTriangleBox(triangle);
      if (box.Overlaps(around))
      {
        near.Add(triangle, box);
      }
    }
  }

  std::size_t
  GroupOf(std::size_t leaf) const
  {
    return static_cast<std::size_t>(std::upper_bound(m_Groups.begin(), m_Groups.end(), leaf) - m_Groups.begin()) - 1;
  }

  /** Whether two triangles are certain to meet only where they share a corner or a side. */
  bool
  AreApart(const TriangleType & a, const TriangleType & b) const
  {
    bool areApart = false;
    for (const std::uint32_t point : a)
    {
      const bool isShared = (point == b[0]) | (point == b[1]) | (point == b[2]);
      areApart |= isShared & (m_AreUnfolded[point] != 0);
    }
    return areApart;
  }

  const TriangleTree & m_Tree;
  std::vector<std::size_t> m_Groups; ///< the first leaf of each, and the end of the last
  std::vector<std::uint8_t> m_AreUnfolded;
};

/** The triangles that cross others with which they have a point in common, or that lie at the other end of an edge of
 * at most \a longest mm; each perhaps several times. */
std::vector<std::uint32_t>
FindCrossingAtEdges(const TriangleSurface & surface, double longest)
{
  const TrianglesOfPoints fans(surface);
  const std::vector<std::uint8_t> areUnfolded = FindUnfoldedPoints(surface, fans);
  const auto & points = surface.GetPoints();
  const auto & triangles = surface.GetTriangles();
  std::vector<std::uint32_t> found;
  std::mutex mutex;
  const auto test = [&](std::uint32_t a, std::uint32_t b) {
    const auto isCorner = [&](std::uint32_t point) {
      return areUnfolded[point] != 0 && std::count(triangles[b].begin(), triangles[b].end(), point) > 0;
    };
    if (!std::any_of(triangles[a].begin(), triangles[a].end(), isCorner) &&
        TriangleTree::BoxOf(points, triangles[a]).Overlaps(TriangleTree::BoxOf(points, triangles[b])) &&
        FindContact(points, triangles[a], triangles[b]) == Contact::Crossing)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      found.insert(found.end(), { a, b });
    }
  };
  constexpr std::size_t pointsOfBlock = 16384;
  ForEachInBlocks(points.size(), pointsOfBlock, [&](std::size_t point) {
    fans.VisitTriangles(point, [&](std::uint32_t a) {
      if (areUnfolded[point] == 0)
      {
        fans.VisitTriangles(point, [&](std::uint32_t b) { a < b ? test(a, b) : void(); });
      }
    });
    fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t) {
      if (Distance(ToPosition(points[point]), ToPosition(points[next])) <= longest)
      {
        fans.VisitTriangles(point, [&](std::uint32_t a) {
          fans.VisitTriangles(next, [&](std::uint32_t b) { a != b ? test(a, b) : void(); });
        });
      }
    });
  });
  return found;
}

} // namespace

TriangleSurfaceIntersections
FindSelfIntersections(const TriangleTree & tree, SizeValueType maximumTestedTriangles)
{
  const SizeValueType placed = tree.GetNumberOfPlacedTriangles();
  const SizeValueType most = std::max<SizeValueType>(TriangleTree::LeafSize, maximumTestedTriangles);
  const std::size_t stride = std::max<std::size_t>(1, (placed + most - 1) / most);

  const ContactSearch search(tree);
  TriangleSurfaceIntersections found;
  found.testedTriangles = tree.GetSurface().GetNumberOfTriangles() - placed;
  found.isSampled = stride > 1;
  std::mutex mutex;
  ForEachBlock(search.GetNumberOfGroups(), GroupsOfBlock, [&](std::size_t begin, std::size_t end) {
    TriangleSurfaceIntersections ofBlock;
    const auto count = [&](std::uint32_t a, std::uint32_t b, Contact contact) {
      const auto & triangles = tree.GetSurface().GetTriangles();
      ofBlock.touchingPairs += contact == Contact::Touching ? 1 : 0;
      ofBlock.crossingPairs += contact == Contact::Crossing && !AreDuplicates(triangles[a], triangles[b]) ? 1 : 0;
    };
    BoxList near;
    for (std::size_t group = (begin + stride - 1) / stride * stride; group < end; group += stride)
    {
      ofBlock.testedTriangles += search.TestGroup(group, stride, near, count);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.crossingPairs += ofBlock.crossingPairs;
    found.touchingPairs += ofBlock.touchingPairs;
    found.testedTriangles += ofBlock.testedTriangles;
  });
  return found;
}

std::vector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree)
{
  const ContactSearch search(tree);
  std::vector<std::uint32_t> found;
  std::mutex mutex;
  ForEachBlock(search.GetNumberOfGroups(), GroupsOfBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> ofBlock;
    BoxList near;
    for (std::size_t group = begin; group < end; ++group)
    {
      search.TestGroup(group, 1, near, [&](std::uint32_t a, std::uint32_t b, Contact contact) {
        if (contact == Contact::Crossing)
        {
          ofBlock.insert(ofBlock.end(), { a, b });
        }
      });
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.insert(found.end(), ofBlock.begin(), ofBlock.end());
  });
  SortUnique(found);
  return found;
}

double
FindLongestRoundedEdge(const TriangleSurface & surface, double smallestSpacing, double largestSpacing)
{
  double farthest = 0.0;
  for (const double bound : surface.GetBounds())
  {
    farthest = std::max(farthest, std::abs(bound));
  }
  const double step = farthest * static_cast<double>(std::numeric_limits<float>::epsilon()) / smallestSpacing;
  const double rounding = std::sqrt(0.75) * step;
  const double gap = std::max(std::sqrt(2.0) / 1024.0, 8.0 * step);
  return 4.0 * rounding / (0.7 * gap - 2.0 * rounding) * largestSpacing;
}

std::vector<std::uint32_t>
FindCrossingTriangles(const TriangleSurface & surface, const CrossingCandidates & candidates)
{
  std::vector<std::uint32_t> found = FindCrossingAtEdges(surface, candidates.longestEdge);
  const std::vector<std::uint32_t> listed = FindCrossingTriangles(TriangleTree(surface, candidates.triangles));
  found.insert(found.end(), listed.begin(), listed.end());
  SortUnique(found);
  return found;
}

} // namespace itk
