#include "itkTriangleSurfaceIntersections.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTriangleGrid.h"
#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleNeighborhood.h"
#include "itkUnfoldedPoints.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace itk
{
namespace
{

using Contact = TriangleContact;
using Box = TriangleTree::Box;
using TriangleType = TriangleSurface::TriangleType;
using Flags = BulkVector<std::uint8_t>; ///< of points

constexpr std::size_t TrianglesOfPart = 64;
constexpr std::size_t TrianglesOfSample = 32; // parts where not all are tested
constexpr std::size_t PartsOfBlock = 16;
constexpr std::size_t BlockOfPoints = 16384;

bool
AreDuplicates(TriangleType a, TriangleType b)
{
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/** \class ContactSearch
 * \brief Finds how the triangles of a surface meet elsewhere than at corners and sides they share.
 *
 * Triangles are tested in parts, which are small subtrees: those of a part are compared with each other and with all
 * those around the part. Pairs with a common point at which the surface is not folded need no test. */
class ContactSearch
{
public:
  /** \param areUnfolded see FindUnfoldedPoints()
   *  \param sizeOfPart triangles at most */
  ContactSearch(const TriangleTree & tree, Flags areUnfolded, std::size_t sizeOfPart)
    : m_Tree(tree)
    , m_Parts(tree.FindSubtrees(sizeOfPart))
    , m_AreUnfolded(std::move(areUnfolded))
  {}

  std::size_t
  GetNumberOfParts() const
  {
    return m_Parts.size() - 1;
  }

  /** Calls \a visit(a, b, contact) for pairs with a triangle in a part, without those that an earlier part has
   * visited. Every \a stride-th part is tested. Returns how many triangles the part has. \a near is for working. */
  template <typename TVisitor>
  std::size_t
  TestPart(std::size_t part, std::size_t stride, TriangleNeighborhood & near, const TVisitor & visit) const
  {
    const std::size_t begin = m_Parts[part];
    const std::size_t end = m_Parts[part + 1];
    const TriangleTree::Leaf ofPart = this->TrianglesOf(part);
    const Steps around(this->BoxAround(ofPart));
    near.Clear();
    this->AddTriangles(ofPart, around, near);
    m_Tree.VisitLeaves(around.box, stride == 1 ? end : 0, [&](std::size_t leaf) {
      const bool isInPart = leaf >= begin && leaf < end;
      if (!isInPart && (leaf >= end || this->PartOf(leaf) % stride != 0))
      {
        this->AddTriangles(m_Tree.GetLeaf(leaf), around, near);
      }
    });
    this->VisitContacts(near, ofPart.size(), visit);
    return ofPart.size();
  }

  /** Calls \a visit(a, b, contact) for pairs of a triangle in a part and another of the part, or of another tree of the
   * same surface, which may hold the part's triangles, too: such pairs may come twice. */
  template <typename TVisitor>
  void
  TestPartAgainst(const TriangleTree & others,
                  std::size_t part,
                  TriangleNeighborhood & near,
                  const TVisitor & visit) const
  {
    const TriangleTree::Leaf ofPart = this->TrianglesOf(part);
    const Steps around(this->BoxAround(ofPart));
    near.Clear();
    this->AddTriangles(ofPart, around, near);
    others.VisitLeaves(
      around.box, 0, [&](std::size_t leaf) { this->AddTriangles(others.GetLeaf(leaf), around, near); });
    this->VisitContacts(near, ofPart.size(), visit);
  }

private:
  /** Steps of a box around the triangles of a part. */
  struct Steps
  {
    explicit Steps(const Box & around)
      : box(around)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const float length = box.highest[axis] - box.lowest[axis];
        perMillimetre[axis] = length > 2.0f * most / std::numeric_limits<float>::max() ? most / length : 0.0f;
      }
    }

    TriangleNeighborhood::StepBox
    Of(const Box & other) const
    {
      TriangleNeighborhood::StepBox steps;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto stepOf = [&](float coordinate) {
          const float step = (coordinate - box.lowest[axis]) * perMillimetre[axis];
          return static_cast<std::int16_t>(std::min(most, std::max(0.0f, step)));
        };
        steps[axis] = stepOf(other.lowest[axis]);
        steps[axis + 3] = stepOf(other.highest[axis]);
      }
      return steps;
    }

    static constexpr float most = 32000.0f;

    Box box;
    std::array<float, 3> perMillimetre;
  };

  TriangleTree::Leaf
  TrianglesOf(std::size_t part) const
  {
    return { m_Tree.GetLeaf(m_Parts[part]).begin(), m_Tree.GetLeaf(m_Parts[part + 1] - 1).end() };
  }

  Box
  BoxAround(const TriangleTree::Leaf & triangles) const
  {
    Box around = m_Tree.GetTriangleBox(*triangles.begin());
    for (const std::uint32_t triangle : triangles)
    {
      around.Add(m_Tree.GetTriangleBox(triangle));
    }
    return around;
  }

  /** Tests the pairs of a neighbourhood whose first is among the first \a count members. */
  template <typename TVisitor>
  void
  VisitContacts(TriangleNeighborhood & near, std::size_t count, const TVisitor & visit) const
  {
    const auto & triangles = m_Tree.GetSurface().GetTriangles();
    near.VisitPairs(count, [&](std::uint32_t a, std::uint32_t b) {
      visit(a, b, FindContact(m_Tree.GetSurface().GetPoints(), triangles[a], triangles[b]));
    });
  }

  void
  AddTriangles(const TriangleTree::Leaf & triangles, const Steps & around, TriangleNeighborhood & near) const
  {
    for (const std::uint32_t triangle : triangles)
    {
      const Box box = m_Tree.GetTriangleBox(triangle);
      if (box.Overlaps(around.box))
      {
        TriangleType corners = m_Tree.GetSurface().GetTriangles()[triangle];
        for (std::uint32_t & corner : corners)
        {
          corner = m_AreUnfolded[corner] ? corner : TriangleTree::None;
        }
        near.Add(triangle, around.Of(box), corners);
      }
    }
  }

  std::size_t
  PartOf(std::size_t leaf) const
  {
    return static_cast<std::size_t>(std::upper_bound(m_Parts.begin(), m_Parts.end(), leaf) - m_Parts.begin()) - 1;
  }

  const TriangleTree & m_Tree;
  std::vector<std::size_t> m_Parts; ///< the first leaf of each, and the end of the last
  Flags m_AreUnfolded;
};

/** Clears the flags of points at which the surface is folded. */
void
KeepUnfolded(const TriangleSurface & surface, const TrianglesOfPoints & fans, Flags & areUnfolded)
{
  rhombic::ForEachInBlocks(areUnfolded.size(), BlockOfPoints, [&](std::size_t point) {
    areUnfolded[point] = areUnfolded[point] != 0 && IsUnfoldedPoint(surface, fans, static_cast<std::uint32_t>(point));
  });
}

/** \class UnfoldedCorners
 * \brief Flags of the points at which the surface is not folded, of corners of added triangles only. */
class UnfoldedCorners
{
public:
  explicit UnfoldedCorners(const TriangleSurface & surface)
    : m_Surface(surface)
    , m_AreUnfolded(surface.GetNumberOfPoints(), 0)
  {}

  void
  Add(std::uint32_t triangle)
  {
    for (const std::uint32_t corner : m_Surface.GetTriangles()[triangle])
    {
      if (std::exchange(m_AreUnfolded[corner], std::uint8_t{ 1 }) == 0)
      {
        m_Corners.push_back(corner);
      }
    }
  }

  Flags
  Find(const TrianglesOfPoints & fans) &&
  {
    rhombic::ForEachInBlocks(m_Corners.size(), BlockOfPoints, [&](std::size_t n) {
      m_AreUnfolded[m_Corners[n]] = IsUnfoldedPoint(m_Surface, fans, m_Corners[n]);
    });
    return std::move(m_AreUnfolded);
  }

private:
  const TriangleSurface & m_Surface;
  Flags m_AreUnfolded;
  BulkVector<std::uint32_t> m_Corners;
};

/** The triangles of a tree that cross others of it, or are in another contact of at least that kind, ascending. */
BulkVector<std::uint32_t>
FindAllCrossing(const TriangleTree & tree,
                Flags areUnfolded,
                Contact least,
                rhombic::StagedProgress & progress,
                double stageEnd)
{
  const ContactSearch search(tree, std::move(areUnfolded), TrianglesOfPart);
  progress.Begin(stageEnd, search.GetNumberOfParts());
  return CollectIds(search.GetNumberOfParts(), PartsOfBlock, [&](std::size_t begin, std::size_t end, auto & found) {
    TriangleNeighborhood near(tree.GetSurface());
    for (std::size_t part = begin; part < end; ++part)
    {
      search.TestPart(part, 1, near, [&](std::uint32_t a, std::uint32_t b, Contact contact) {
        if (contact >= least)
        {
          found.insert(found.end(), { a, b });
        }
      });
    }
    progress.Completed(end - begin);
  });
}

/** The triangles that cross others with which they have a point in common, or that lie at the other end of an edge of
 * at most \a longest mm. */
BulkVector<std::uint32_t>
FindCrossingAtEdges(const TriangleSurface & surface,
                    const TrianglesOfPoints & fans,
                    const Flags & areUnfolded,
                    double longest)
{
  const auto & points = surface.GetPoints();
  const auto & triangles = surface.GetTriangles();
  const auto test = [&](std::uint32_t a, std::uint32_t b, BulkVector<std::uint32_t> & found) {
    const auto isCorner = [&](std::uint32_t point) {
      return areUnfolded[point] != 0 && std::count(triangles[b].begin(), triangles[b].end(), point) > 0;
    };
    if (!std::any_of(triangles[a].begin(), triangles[a].end(), isCorner) &&
        TriangleTree::BoxOf(points, triangles[a]).Overlaps(TriangleTree::BoxOf(points, triangles[b])) &&
        FindContact(points, triangles[a], triangles[b]) == Contact::Crossing)
    {
      found.insert(found.end(), { a, b });
    }
  };
  const auto testAround = [&](std::size_t point, BulkVector<std::uint32_t> & found) {
    fans.VisitTriangles(point, [&](std::uint32_t a) {
      if (areUnfolded[point] == 0)
      {
        fans.VisitTriangles(point, [&](std::uint32_t b) { a < b ? test(a, b, found) : void(); });
      }
    });
    fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t) {
      if (Distance(ToPosition(points[point]), ToPosition(points[next])) <= longest)
      {
        fans.VisitTriangles(point, [&](std::uint32_t a) {
          fans.VisitTriangles(next, [&](std::uint32_t b) { a != b ? test(a, b, found) : void(); });
        });
      }
    });
  };
  return CollectIds(points.size(), BlockOfPoints, [&](std::size_t begin, std::size_t end, auto & found) {
    for (std::size_t point = begin; point < end; ++point)
    {
      testAround(point, found);
    }
  });
}

} // namespace

Flags
FindUnfoldedPoints(const TriangleSurface & surface, const TrianglesOfPoints & fans)
{
  Flags areUnfolded(surface.GetNumberOfPoints(), 1);
  KeepUnfolded(surface, fans, areUnfolded);
  return areUnfolded;
}

TriangleSurfaceIntersections
FindTriangleSurfaceSelfIntersections(const TriangleTree & tree, SizeValueType maximumTestedTriangles)
{
  const SizeValueType placed = tree.GetNumberOfPlacedTriangles();
  const SizeValueType most = std::max<SizeValueType>(TriangleTree::LeafSize, maximumTestedTriangles);
  const std::size_t stride = std::max<std::size_t>(1, (placed + most - 1) / most);

  const TriangleSurface & surface = tree.GetSurface();
  const ContactSearch search(
    tree, FindUnfoldedPoints(surface, TrianglesOfPoints(surface)), stride > 1 ? TrianglesOfSample : TrianglesOfPart);
  TriangleSurfaceIntersections found;
  found.testedTriangles = tree.GetSurface().GetNumberOfTriangles() - placed;
  found.isSampled = stride > 1;
  std::mutex mutex;
  rhombic::ForEachBlock(search.GetNumberOfParts(), PartsOfBlock, [&](std::size_t begin, std::size_t end) {
    TriangleSurfaceIntersections ofBlock;
    const auto count = [&](std::uint32_t a, std::uint32_t b, Contact contact) {
      const auto & triangles = tree.GetSurface().GetTriangles();
      ofBlock.touchingPairs += contact == Contact::Touching ? 1 : 0;
      ofBlock.crossingPairs += contact == Contact::Crossing && !AreDuplicates(triangles[a], triangles[b]) ? 1 : 0;
    };
    TriangleNeighborhood near(tree.GetSurface());
    for (std::size_t part = (begin + stride - 1) / stride * stride; part < end; part += stride)
    {
      ofBlock.testedTriangles += search.TestPart(part, stride, near, count);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.crossingPairs += ofBlock.crossingPairs;
    found.touchingPairs += ofBlock.touchingPairs;
    found.testedTriangles += ofBlock.testedTriangles;
  });
  return found;
}

BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree,
                      const TrianglesOfPoints & fans,
                      Contact least,
                      rhombic::StagedProgress * progress,
                      double stageEnd)
{
  const TriangleSurface & surface = tree.GetSurface();
  Flags areUnfolded(surface.GetNumberOfPoints(), 0);
  for (std::size_t leaf = 0; leaf < tree.GetNumberOfLeaves(); ++leaf)
  {
    for (const std::uint32_t triangle : tree.GetLeaf(leaf))
    {
      for (const std::uint32_t corner : surface.GetTriangles()[triangle])
      {
        areUnfolded[corner] = 1;
      }
    }
  }
  KeepUnfolded(surface, fans, areUnfolded);
  rhombic::StagedProgress silent({});
  return FindAllCrossing(tree, std::move(areUnfolded), least, progress == nullptr ? silent : *progress, stageEnd);
}

BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree,
                      const TrianglesOfPoints & fans,
                      const BulkVector<std::uint32_t> & candidates,
                      Contact least)
{
  const TriangleSurface & surface = tree.GetSurface();
  UnfoldedCorners corners(surface);
  for (const std::uint32_t candidate : candidates)
  {
    corners.Add(candidate);
  }
  const TriangleTree ofCandidates(surface, candidates);
  const ContactSearch search(ofCandidates, std::move(corners).Find(fans), TrianglesOfSample);
  return CollectIds(search.GetNumberOfParts(), PartsOfBlock, [&](std::size_t begin, std::size_t end, auto & found) {
    TriangleNeighborhood near(tree.GetSurface());
    for (std::size_t part = begin; part < end; ++part)
    {
      search.TestPartAgainst(tree, part, near, [&](std::uint32_t a, std::uint32_t b, Contact contact) {
        if (contact >= least)
        {
          found.insert(found.end(), { a, b });
        }
      });
    }
  });
}

BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleGrid & grid, rhombic::StagedProgress & progress, double stageEnd)
{
  constexpr std::size_t blocksTogether = 4;
  const TriangleSurface & surface = grid.GetSurface();
  progress.Begin(stageEnd, grid.GetNumberOfBlocks());
  return CollectIds(grid.GetNumberOfBlocks(), blocksTogether, [&](std::size_t first, std::size_t last, auto & found) {
    TriangleGrid::Block block(grid);
    TriangleNeighborhood near(surface);
    TriangleNeighborhood::StepBox around; // the cell's triangles
    std::size_t ofCell = 0;
    const auto begin = [&](const TriangleGrid::Entry * entry, const TriangleGrid::Entry * end) {
      near.Clear();
      around = entry->box;
      for (; entry != end; ++entry)
      {
        near.Add(entry->triangle, entry->box, entry->unfoldedCorners);
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          around[axis] = std::min(around[axis], entry->box[axis]);
          around[axis + 3] = std::max(around[axis + 3], entry->box[axis + 3]);
        }
      }
      ofCell = near.GetSize();
    };
    const auto add = [&](const TriangleGrid::Entry * entry, const TriangleGrid::Entry * end) {
      for (; entry != end; ++entry)
      {
        const auto & box = entry->box;
        if ((box[0] <= around[3]) & (box[1] <= around[4]) & (box[2] <= around[5]) & (around[0] <= box[3]) &
            (around[1] <= box[4]) & (around[2] <= box[5]))
        {
          near.Add(entry->triangle, box, entry->unfoldedCorners);
        }
      }
    };
    const auto test = [&] {
      near.VisitPairs(ofCell, [&](std::uint32_t a, std::uint32_t b) {
        if (FindContact(surface.GetPoints(), surface.GetTriangles()[a], surface.GetTriangles()[b]) == Contact::Crossing)
        {
          found.insert(found.end(), { a, b });
        }
      });
    };
    for (std::size_t n = first; n < last; ++n)
    {
      block.Load(n);
      block.VisitCells(begin, add, test);
    }
    progress.Completed(last - first);
  });
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

BulkVector<std::uint32_t>
FindCrossingTriangles(const TriangleSurface & surface,
                      const TrianglesOfPoints & fans,
                      const CrossingCandidates & candidates)
{
  Flags areUnfolded = FindUnfoldedPoints(surface, fans);
  BulkVector<std::uint32_t> found = FindCrossingAtEdges(surface, fans, areUnfolded, candidates.longestEdge);
  rhombic::StagedProgress silent({});
  const auto listed =
    FindAllCrossing(TriangleTree(surface, { candidates.triangles.begin(), candidates.triangles.end() }),
                    std::move(areUnfolded),
                    Contact::Crossing,
                    silent,
                    1.0);
  found.insert(found.end(), listed.begin(), listed.end());
  SortUnique(found);
  return found;
}

} // namespace itk
