#ifndef itkTriangleTree_h
#define itkTriangleTree_h

#include "itkPointBox.h"
#include "itkTriangleSurface.h"

#include <algorithm>
#include <limits>

namespace itk
{

/** \class TriangleTree
 * \brief A binary tree of boxes around the triangles of a surface: nearest points, ray crossings, overlapping boxes.
 *
 * The triangles are sorted along a curve through the cells of a fine grid. Each node divides its
 * part of the curve where that passes into the other half of a box, down to leaves of at most four triangles. Built in
 * nearly linear time on several threads, the same for any number of them; memory about 25 bytes per triangle, 50 while
 * it is built.
 *
 * Triangles with a position that is not finite are left out. The tree keeps the surface alive; changing the surface
 * invalidates the tree.
 *
 * \ingroup SurfaceQueries
 */
class TriangleTree
{
public:
  using PointType = TriangleSurface::PointType;
  using PositionType = std::array<double, 3>;
  using Box = PointBox;

  /** The smallest box around a triangle. */
  static Box
  BoxOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle)
  {
    Box box{ points[triangle[0]], points[triangle[0]] };
    box.Add(points[triangle[1]]);
    box.Add(points[triangle[2]]);
    return box;
  }

  /** The point of the surface nearest to a position. */
  struct ClosestPoint
  {
    PositionType point{};          ///< in mm
    double squaredDistance;        ///< in mm^2
    std::uint32_t triangle = None; ///< None if nothing is near enough
  };

  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  explicit TriangleTree(const TriangleSurface & surface);

  /** A tree of some of the surface's triangles. */
  TriangleTree(const TriangleSurface & surface, BulkVector<std::uint32_t> triangles);

  /** Must be called when points of a triangle have moved, with its boxes before and after that: enlarges the boxes of
   * the tree that held the triangle, and a few around it. Queries are fast as long as the points are about where they
   * were. */
  void
  Enlarge(const Box & before, const Box & after);

  /** Finds all boxes anew, after many points have moved: takes about a tenth of the time of a new tree. Queries are
   * fast as long as triangles that were neighbours still are. */
  void
  Refit();

  const TriangleSurface &
  GetSurface() const
  {
    return *m_Surface;
  }

  /** Finds the point of the surface nearest to \a position; if there are several, the point of the triangle with the
   * lowest id. If no point is within \a maximumSquaredDistance (in mm^2), the result has that squaredDistance and the
   * triangle None. The search may end early with any point within \a enoughSquaredDistance (in mm^2). */
  ClosestPoint
  FindClosestPoint(const PositionType & position,
                   double maximumSquaredDistance = std::numeric_limits<double>::infinity(),
                   double enoughSquaredDistance = -1.0) const;

  /** The distance in mm, above \a least, at which a ray from \a position first leaves the surface: through the
   * clockwise side of a triangle; infinite if it leaves no triangle. \param direction of length 1 */
  double
  FindExit(const PositionType & position, const PositionType & direction, double least) const;

  /** The point of one triangle nearest to \a position. */
  PositionType
  FindClosestPointOfTriangle(const PositionType & position, std::uint32_t triangle) const;

  /** Calls \a visit(triangle) for every triangle whose box has a point in common with \a box, in the tree's order. */
  template <typename TVisitor>
  void
  VisitTriangles(const Box & box, TVisitor && visit) const
  {
    this->VisitLeaves(box, 0, [&](std::size_t leaf) {
      for (const std::uint32_t triangle : this->GetLeaf(leaf))
      {
        if (this->GetTriangleBox(triangle).Overlaps(box))
        {
          visit(triangle);
        }
      }
    });
  }

  /** Calls \a visit(triangle, turns) for every triangle that the ray from \a point along +z crosses: turns is 1 if the
   * ray leaves through the triangle's counter-clockwise side, -1 if it enters there. Exact. The point is taken to be
   * shifted by infinitesimal amounts, along x, less along y and still less along z, so that no ray meets an edge and
   * every point on the surface is on one side of it. */
  template <typename TVisitor>
  void
  VisitCrossings(const PointType & point, TVisitor && visit) const
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    this->VisitTriangles({ point, { point[0], point[1], infinity } }, [&](std::uint32_t triangle) {
      if (const int turns = CountTurns(*m_Surface, point, triangle))
      {
        visit(triangle, turns);
      }
    });
  }

  /** How VisitCrossings() counts the crossing of the ray from \a point with one triangle; 0 if it does not cross. */
  static int
  CountTurns(const TriangleSurface & surface, const PointType & point, std::uint32_t triangle);

  Box
  GetTriangleBox(std::uint32_t triangle) const
  {
    return BoxOf(m_Surface->GetPoints(), m_Surface->GetTriangles()[triangle]);
  }

  /** The number of triangles in the tree: those with finite positions. */
  SizeValueType
  GetNumberOfPlacedTriangles() const
  {
    return m_Order.size();
  }

  /** The ids of the triangles of one leaf, at most LeafSize. */
  struct Leaf
  {
    const std::uint32_t * first;
    const std::uint32_t * last;

    const std::uint32_t *
    begin() const
    {
      return first;
    }
    const std::uint32_t *
    end() const
    {
      return last;
    }
    std::size_t
    size() const
    {
      return static_cast<std::size_t>(last - first);
    }
  };

  static constexpr std::size_t LeafSize = 4;

  /** Leaves with successive numbers are mostly neighbours in space. */
  std::size_t
  GetNumberOfLeaves() const
  {
    return m_LeafEnds.size();
  }

  Leaf
  GetLeaf(std::size_t leaf) const
  {
    return { m_Order.data() + (leaf > 0 ? m_LeafEnds[leaf - 1] : 0), m_Order.data() + m_LeafEnds[leaf] };
  }

  /** Cuts the tree into subtrees of at most \a mostTriangles, a leaf's or more: the first leaf of each, ascending, and
   * the number of leaves. */
  std::vector<std::size_t>
  FindSubtrees(std::size_t mostTriangles) const;

  /** Calls \a visit(leaf) in ascending order for every leaf from \a from on whose box has a point in common with \a
   * box.
   */
  template <typename TVisitor>
  void
  VisitLeaves(const Box & box, std::size_t from, TVisitor && visit) const
  {
    this->VisitNodes([&](const Node & node) {
      const bool isVisited = node.end > from && m_Nodes[node.id].box.Overlaps(box);
      if (isVisited && node.IsLeaf())
      {
        visit(node.begin);
      }
      return isVisited;
    });
  }

  /** Bytes, without the surface. */
  SizeValueType
  GetMemorySize() const
  {
    return (m_Order.size() + m_LeafEnds.size()) * sizeof(std::uint32_t) + m_Nodes.size() * sizeof(StoredNode);
  }

private:
  /** Nodes are stored in depth-first order: a node with L leaves and all nodes below it are 2 L - 1 successive nodes.
   */
  struct StoredNode
  {
    Box box;
    std::uint32_t leavesOfLeft; ///< number of leaves of the left child
  };

  /** A node's number and the leaves [begin, end) below it. */
  struct Node
  {
    std::size_t id;
    std::size_t begin;
    std::size_t end;

    bool
    IsLeaf() const
    {
      return end - begin == 1;
    }
  };

  Node
  LeftOf(const Node & node) const
  {
    return { node.id + 1, node.begin, node.begin + m_Nodes[node.id].leavesOfLeft };
  }
  Node
  RightOf(const Node & node) const
  {
    const std::size_t leavesOfLeft = m_Nodes[node.id].leavesOfLeft;
    return { node.id + 2 * leavesOfLeft, node.begin + leavesOfLeft, node.end };
  }

  /** Capacity of a stack of nodes: more than the depth, as no cell's number has more bits than 63 and no cell more
   * triangles than 2^32. */
  static constexpr std::size_t MostNodes = 128;

  Node
  Root() const
  {
    return { 0, 0, this->GetNumberOfLeaves() };
  }

  /** Calls \a visit(node) depth first, left children before right children, for the root and the children of all nodes
   * for which it returns true. */
  template <typename TVisitor>
  void
  VisitNodes(const TVisitor & visit) const
  {
    std::array<Node, MostNodes> stack;
    std::size_t size = 0;
    if (!m_Nodes.empty())
    {
      stack[size++] = this->Root();
    }
    while (size > 0)
    {
      const Node node = stack[--size];
      if (visit(node) && !node.IsLeaf())
      {
        stack[size++] = this->RightOf(node);
        stack[size++] = this->LeftOf(node);
      }
    }
  }

  class Builder;

  /** Puts the box around those of its children in a node that is no leaf. */
  void
  JoinBoxes(std::size_t id)
  {
    m_Nodes[id].box = m_Nodes[id + 1].box;
    m_Nodes[id].box.Add(m_Nodes[id + 2 * std::size_t{ m_Nodes[id].leavesOfLeft }].box);
  }

  void
  RefitSubtree(const Node & top);

  void
  Build(BulkVector<std::uint32_t> triangles);

  void
  ImproveClosestPoint(const PositionType & position, std::uint32_t triangle, ClosestPoint & closest) const;

  TriangleSurface::ConstPointer m_Surface;
  BulkVector<std::uint32_t> m_Order;    ///< ids of the triangles, leaf by leaf
  BulkVector<std::uint32_t> m_LeafEnds; ///< for each leaf, how many triangles are in it and those before
  BulkVector<StoredNode> m_Nodes;
};

} // namespace itk

#endif
