#ifndef itkTriangleTree_h
#define itkTriangleTree_h

#include "itkTriangleSurface.h"

#include <algorithm>
#include <limits>

namespace itk
{

/** \class TriangleTree
 * \brief A tree of boxes around the triangles of a surface, for questions about places.
 *
 * Triangles are halved across the longest side of the box around their centres, again and again until there are four at
 * most; every node halves its range of leaves, so nodes need no links. Built in O(n log n) with several threads; holds
 * 16 bytes a triangle (16 more while it is built). The same for any number of threads.
 *
 * Triangles with a position that is not finite are left out. The tree keeps the surface alive; a change of the
 * surface invalidates the tree.
 *
 * Thread safety: all questions may be asked by several threads at once.
 *
 * \ingroup SurfaceQueries
 */
class TriangleTree
{
public:
  using PointType = TriangleSurface::PointType;
  using PositionType = std::array<double, 3>;

  /** Corners with the least and the greatest coordinates in mm; both belong to the box. */
  struct Box
  {
    PointType lowest;
    PointType highest;

    /** Whether they have a point in common, be it of their faces. */
    bool
    Overlaps(const Box & other) const
    {
      return lowest[0] <= other.highest[0] && other.lowest[0] <= highest[0] && lowest[1] <= other.highest[1] &&
             other.lowest[1] <= highest[1] && lowest[2] <= other.highest[2] && other.lowest[2] <= highest[2];
    }
  };

  /** The smallest box around two. */
  static Box
  Union(const Box & a, const Box & b)
  {
    Box both;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      both.lowest[axis] = std::min(a.lowest[axis], b.lowest[axis]);
      both.highest[axis] = std::max(a.highest[axis], b.highest[axis]);
    }
    return both;
  }

  /** The place of the surface that is nearest to a position. */
  struct ClosestPoint
  {
    PositionType point{};          ///< in mm
    double squaredDistance;        ///< in mm^2
    std::uint32_t triangle = None; ///< None where nothing is near enough
  };

  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  explicit TriangleTree(const TriangleSurface & surface);

  const TriangleSurface &
  GetSurface() const
  {
    return *m_Surface;
  }

  /** The point of the surface nearest to \a position, the one of the triangle with the lowest number if there are
   * several. Only what is at most \a maximumSquaredDistance (in mm^2) away is
   * looked for; squaredDistance is that maximum and triangle None where there is nothing. Where the question is only
   * whether something is near, the search may end with any point at most \a enoughSquaredDistance (in mm^2) away. */
  ClosestPoint
  FindClosestPoint(const PositionType & position,
                   double maximumSquaredDistance = std::numeric_limits<double>::infinity(),
                   double enoughSquaredDistance = -1.0) const;

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

  /** Calls \a visit(triangle, turns) for every triangle that the ray from \a point along +z crosses: turns is 1 where
   * it comes out of the triangle's counter-clockwise side, -1 where it enters there. Exact, with \a point understood as
   * moved by infinitely little along x, less along y and still less along z, so that no ray meets an edge, and points
   * on the surface are on one definite side of it. */
  template <typename TVisitor>
  void
  VisitCrossings(const PointType & point, TVisitor && visit) const
  {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    this->VisitTriangles({ point, { point[0], point[1], infinity } }, [&](std::uint32_t triangle) {
      if (const int turns = this->CountTurns(point, triangle))
      {
        visit(triangle, turns);
      }
    });
  }

  /** How often the surface, which must be closed, winds around a point: 1 inside an outward-facing surface, 0 outside,
   * 0 in its cavities. Exact; points on the surface count as VisitCrossings() says. */
  int
  ComputeWindingNumber(const PointType & point) const;

  /** The box around one triangle. */
  Box
  GetTriangleBox(std::uint32_t triangle) const;

  /** All but those with a position that is not finite. */
  SizeValueType
  GetNumberOfPlacedTriangles() const
  {
    return m_Order.size();
  }

  /** The triangles of one leaf, up to LeafSize. */
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

  /** Neighbours in number are mostly neighbours in space. */
  std::size_t
  GetNumberOfLeaves() const
  {
    return (m_Order.size() + LeafSize - 1) / LeafSize;
  }

  /** Number \a leaf, below GetNumberOfLeaves(). */
  Leaf
  GetLeaf(std::size_t leaf) const
  {
    return { m_Order.data() + leaf * LeafSize, m_Order.data() + std::min(m_Order.size(), (leaf + 1) * LeafSize) };
  }

  /** Calls \a visit(leaf) in order for every leaf from number \a from on whose box has a point in common with \a box.
   */
  template <typename TVisitor>
  void
  VisitLeaves(const Box & box, std::size_t from, TVisitor && visit) const
  {
    NodeStack stack;
    if (!m_Boxes.empty())
    {
      stack.Push(this->Root());
    }
    while (!stack.IsEmpty())
    {
      const Node node = stack.Pop();
      if (node.end <= from || !m_Boxes[node.id].Overlaps(box))
      {
        continue;
      }
      if (node.IsLeaf())
      {
        visit(node.begin);
        continue;
      }
      stack.Push(node.Right());
      stack.Push(node.Left());
    }
  }

  /** Bytes held. */
  SizeValueType
  GetMemorySize() const
  {
    return m_Order.size() * sizeof(std::uint32_t) + m_Boxes.size() * sizeof(Box);
  }

private:
  /** A node and the leaves [begin, end) below it. Nodes are stored parents first, left before right: a node with L
   * leaves has 2 L - 1 nodes from itself on. */
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
    Node
    Left() const
    {
      return { id + 1, begin, begin + (end - begin) / 2 };
    }
    Node
    Right() const
    {
      const std::size_t middle = begin + (end - begin) / 2;
      return { id + 2 * (middle - begin), middle, end };
    }
  };

  /** Of nodes still to be visited: their number of leaves halves with each, and there are less than 2^32. */
  static constexpr std::size_t MostNodes = 64;

  class NodeStack
  {
  public:
    bool
    IsEmpty() const
    {
      return m_Size == 0;
    }
    void
    Push(const Node & node)
    {
      m_Nodes[m_Size++] = node;
    }
    Node
    Pop()
    {
      return m_Nodes[--m_Size];
    }

  private:
    std::array<Node, MostNodes> m_Nodes;
    std::size_t m_Size = 0;
  };

  Node
  Root() const
  {
    return { 0, 0, this->GetNumberOfLeaves() };
  }

  struct CentredTriangle
  {
    PointType centre;
    std::uint32_t triangle;
  };
  using CentredTriangles = std::vector<CentredTriangle, BulkAllocator<CentredTriangle>>;

  void
  SortTriangles();
  static void
  Halve(CentredTriangles & centred, const Node & node);
  static void
  HalveAllBelow(CentredTriangles & centred, const Node & node);
  void
  BuildBoxes();
  void
  CollectNodes(const Node & node, unsigned int depth, std::vector<Node> & nodes) const;
  Box
  BuildBoxesBelow(const Node & node, unsigned int depth);
  Box
  ComputeLeafBox(std::size_t leaf) const;

  void
  ImproveClosestPoint(const PositionType & position, std::uint32_t triangle, ClosestPoint & closest) const;

  int
  CountTurns(const PointType & point, std::uint32_t triangle) const;

  TriangleSurface::ConstPointer m_Surface;
  std::vector<std::uint32_t, BulkAllocator<std::uint32_t>> m_Order; ///< triangles, leaf by leaf
  std::vector<Box, BulkAllocator<Box>> m_Boxes;                     ///< of the nodes
};

} // namespace itk

#endif
