#include "itkTriangleTree.h"

#include "detail/itkClosestOnTriangle.h"
#include "detail/itkExactOrientation.h"
#include "itkForEachBlock.h"

#include <algorithm>

namespace itk
{
namespace
{

using Box = TriangleTree::Box;
using PointType = TriangleTree::PointType;

constexpr unsigned int ParallelDepth = 6; // levels of the tree, counted from the root, that threads share

constexpr Box EmptyBox = { { std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity() },
                           { -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity() } };

PointType
CentreOf(const Box & box)
{
  PointType centre;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    centre[axis] = 0.5f * box.lowest[axis] + 0.5f * box.highest[axis];
  }
  return centre;
}

float
SideOf(const Box & box, unsigned int axis)
{
  return box.highest[axis] - box.lowest[axis];
}

double
SquaredDistance(const PositionType & position, const Box & box)
{
  double squared = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double outside =
      std::max({ double(box.lowest[axis]) - position[axis], 0.0, position[axis] - double(box.highest[axis]) });
    squared += outside * outside;
  }
  return squared;
}

/** The turn from \a from over \a to to \a point seen from +z, with the point shifted by an infinitesimal amount along x
 * and a smaller one along y. The area of (from, to, point) grows with the point's x by from.y - to.y and with its y by
 * to.x - from.x. */
int
TurnAroundShifted(const PointType & from, const PointType & to, const PointType & point)
{
  if (const int turn = OrientationAlongAxis(from, to, point, 2))
  {
    return turn;
  }
  if (from[1] != to[1])
  {
    return from[1] > to[1] ? 1 : -1;
  }
  return (to[0] > from[0]) - (to[0] < from[0]);
}

/** The side of a triangle on which the shifted point lies, see TriangleTree::VisitCrossings(). */
int
SideOfShifted(const PointType & a, const PointType & b, const PointType & c, const PointType & point)
{
  int side = OrientationInSpace(a, b, c, point);
  for (unsigned int axis = 0; axis < 3 && side == 0; ++axis)
  {
    side = OrientationAlongAxis(a, b, c, axis);
  }
  return side;
}

} // namespace

TriangleTree::TriangleTree(const TriangleSurface & surface)
  : m_Surface(&surface)
{
  this->SortTriangles();
  this->BuildBoxes();
}

void
TriangleTree::SortTriangles()
{
  const auto & points = m_Surface->GetPoints();
  const auto & triangles = m_Surface->GetTriangles();
  CentredTriangles centred;
  centred.reserve(triangles.size());
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle)
  {
    const auto & corners = triangles[triangle];
    if (IsFinite(points[corners[0]]) && IsFinite(points[corners[1]]) && IsFinite(points[corners[2]]))
    {
      centred.push_back({ CentreOf(this->GetTriangleBox(triangle)), triangle });
    }
  }
  m_Order.resize(centred.size());
  if (centred.empty())
  {
    return;
  }
  std::vector<Node> nodes;
  for (unsigned int depth = 0; depth < ParallelDepth; ++depth)
  {
    nodes.clear();
    this->CollectNodes(this->Root(), depth, nodes);
    ForEachInBlocks(nodes.size(), 1, [&](std::size_t n) { Halve(centred, nodes[n]); });
  }
  nodes.clear();
  this->CollectNodes(this->Root(), ParallelDepth, nodes);
  ForEachInBlocks(nodes.size(), 1, [&](std::size_t n) { HalveAllBelow(centred, nodes[n]); });
  std::transform(
    centred.begin(), centred.end(), m_Order.begin(), [](const CentredTriangle & item) { return item.triangle; });
}

/** Halves a node's triangles across the longest side of the box around their centres. */
void
TriangleTree::Halve(CentredTriangles & centred, const Node & node)
{
  if (node.IsLeaf())
  {
    return;
  }
  const auto begin = centred.begin() + static_cast<std::ptrdiff_t>(node.begin * LeafSize);
  const auto middle = centred.begin() + static_cast<std::ptrdiff_t>(node.Right().begin * LeafSize);
  const auto end = centred.begin() + static_cast<std::ptrdiff_t>(std::min(node.end * LeafSize, centred.size()));
  Box box = EmptyBox;
  std::for_each(begin, end, [&box](const CentredTriangle & item) {
    box = Union(box, Box{ item.centre, item.centre });
  });
  unsigned int longest = 0;
  for (unsigned int axis = 1; axis < 3; ++axis)
  {
    longest = SideOf(box, axis) > SideOf(box, longest) ? axis : longest;
  }
  std::nth_element(begin, middle, end, [longest](const CentredTriangle & a, const CentredTriangle & b) {
    return a.centre[longest] != b.centre[longest] ? a.centre[longest] < b.centre[longest] : a.triangle < b.triangle;
  });
}

void
TriangleTree::HalveAllBelow(CentredTriangles & centred, const Node & node)
{
  if (!node.IsLeaf())
  {
    Halve(centred, node);
    HalveAllBelow(centred, node.Left());
    HalveAllBelow(centred, node.Right());
  }
}

void
TriangleTree::BuildBoxes()
{
  if (m_Order.empty())
  {
    return;
  }
  const Node root = this->Root();
  m_Boxes.resize(2 * root.end - 1);
  std::vector<Node> subtrees;
  this->CollectNodes(root, ParallelDepth, subtrees);
  ForEachBlock(subtrees.size(), 1, [&](std::size_t n, std::size_t) {
    this->BuildBoxesBelow(subtrees[n], std::numeric_limits<unsigned int>::max());
  });
  this->BuildBoxesBelow(root, ParallelDepth);
}

void
TriangleTree::CollectNodes(const Node & node, unsigned int depth, std::vector<Node> & nodes) const
{
  if (depth == 0 || node.IsLeaf())
  {
    nodes.push_back(node);
    return;
  }
  this->CollectNodes(node.Left(), depth - 1, nodes);
  this->CollectNodes(node.Right(), depth - 1, nodes);
}

/** Computes the boxes of a node and of \a depth - 1 levels below it; deeper boxes are there already. */
Box
TriangleTree::BuildBoxesBelow(const Node & node, unsigned int depth)
{
  if (depth > 0)
  {
    m_Boxes[node.id] = node.IsLeaf() ? this->ComputeLeafBox(node.begin)
                                     : Union(this->BuildBoxesBelow(node.Left(), depth - 1),
                                             this->BuildBoxesBelow(node.Right(), depth - 1));
  }
  return m_Boxes[node.id];
}

Box
TriangleTree::ComputeLeafBox(std::size_t leaf) const
{
  Box box = EmptyBox;
  for (const std::uint32_t triangle : this->GetLeaf(leaf))
  {
    box = Union(box, this->GetTriangleBox(triangle));
  }
  return box;
}

TriangleTree::ClosestPoint
TriangleTree::FindClosestPoint(const PositionType & position,
                               double maximumSquaredDistance,
                               double enoughSquaredDistance) const
{
  ClosestPoint closest;
  closest.squaredDistance = maximumSquaredDistance;
  if (m_Boxes.empty())
  {
    return closest;
  }
  struct DistantNode
  {
    Node node;
    double squaredDistance;
  };
  const auto measure = [&](const Node & node) {
    return DistantNode{ node, SquaredDistance(position, m_Boxes[node.id]) };
  };
  std::array<DistantNode, MostNodes> stack; // the nearest on top
  std::size_t size = 0;
  stack[size++] = measure(this->Root());
  while (size > 0)
  {
    const DistantNode top = stack[--size];
    if (top.squaredDistance > closest.squaredDistance)
    {
      continue;
    }
    if (top.node.IsLeaf())
    {
      for (const std::uint32_t triangle : this->GetLeaf(top.node.begin))
      {
        if (SquaredDistance(position, this->GetTriangleBox(triangle)) <= closest.squaredDistance)
        {
          this->ImproveClosestPoint(position, triangle, closest);
        }
      }
      if (closest.triangle != None && closest.squaredDistance <= enoughSquaredDistance)
      {
        return closest;
      }
      continue;
    }
    const DistantNode left = measure(top.node.Left());
    const DistantNode right = measure(top.node.Right());
    const bool isLeftNearer = left.squaredDistance <= right.squaredDistance;
    for (const DistantNode & child : { isLeftNearer ? right : left, isLeftNearer ? left : right })
    {
      if (child.squaredDistance <= closest.squaredDistance)
      {
        stack[size++] = child;
      }
    }
  }
  return closest;
}

TriangleTree::PositionType
TriangleTree::FindClosestPointOfTriangle(const PositionType & position, std::uint32_t triangle) const
{
  return ClosestOnTriangle(position, CornersOf(*m_Surface, m_Surface->GetTriangles()[triangle]));
}

void
TriangleTree::ImproveClosestPoint(const PositionType & position, std::uint32_t triangle, ClosestPoint & closest) const
{
  const PositionType candidate = this->FindClosestPointOfTriangle(position, triangle);
  const double squared = SquaredDistance(candidate, position);
  if (squared < closest.squaredDistance || (squared == closest.squaredDistance && triangle < closest.triangle))
  {
    closest = { candidate, squared, triangle };
  }
}

/** The ray crosses the triangle if the shifted point is inside the triangle as seen along z, and is behind a triangle
 * that faces up or in front of one that faces down. */
int
TriangleTree::CountTurns(const PointType & point, std::uint32_t triangle) const
{
  const auto & corners = m_Surface->GetTriangles()[triangle];
  const auto & points = m_Surface->GetPoints();
  const auto & a = points[corners[0]];
  const auto & b = points[corners[1]];
  const auto & c = points[corners[2]];
  const int turn = TurnAroundShifted(a, b, point);
  if (turn == 0 || TurnAroundShifted(b, c, point) != turn || TurnAroundShifted(c, a, point) != turn)
  {
    return 0;
  }
  return SideOfShifted(a, b, c, point) == -turn ? turn : 0;
}

int
TriangleTree::ComputeWindingNumber(const PointType & point) const
{
  int windings = 0;
  this->VisitCrossings(point, [&windings](std::uint32_t, int turns) { windings += turns; });
  return windings;
}

} // namespace itk
