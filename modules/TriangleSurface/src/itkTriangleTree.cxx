#include "itkTriangleTree.h"

#include "itkExactOrientation.h"
#include "itkParallelSort.h"
#include "itkClosestOnTriangle.h"

#include <cmath>

namespace itk
{
namespace
{

using Box = TriangleTree::Box;
using PointType = TriangleTree::PointType;

constexpr std::uint32_t BitsAlongAxis = 21;
constexpr std::size_t BlockOfTriangles = 1 << 16;
constexpr unsigned int ParallelDepth = 6;

/** A triangle and where its centre lies on the Morton curve. */
struct Placed
{
  std::uint64_t code;
  std::uint32_t triangle;

  bool
  operator<(const Placed & other) const
  {
    return code != other.code ? code < other.code : triangle < other.triangle;
  }
};

using PlacedContainer = std::vector<Placed, BulkAllocator<Placed>>;

constexpr Box EmptyBox = { { std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity() },
                           { -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity() } };

bool
IsFinite(const PointType & point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

/** The 21 low bits of \a value moved to every third place. */
std::uint64_t
SpreadBits(std::uint64_t value)
{
  value = (value | (value << 32)) & 0x001f00000000ffff;
  value = (value | (value << 16)) & 0x001f0000ff0000ff;
  value = (value | (value << 8)) & 0x100f00f00f00f00f;
  value = (value | (value << 4)) & 0x10c30c30c30c30c3;
  return (value | (value << 2)) & 0x1249249249249249;
}

std::uint64_t
ComputeMortonCode(const Box & box, const Box & all, double cellsPerMillimetre)
{
  std::uint64_t code = 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double centre = 0.5 * (double(box.lowest[axis]) + double(box.highest[axis]));
    code |= SpreadBits(static_cast<std::uint64_t>((centre - double(all.lowest[axis])) * cellsPerMillimetre)) << axis;
  }
  return code;
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

/** Which way the sides of a triangle turn around \a point, moved by infinitely little along x and less along y, when
 * all are seen from +z. The area of (from, to, point) grows with the point's x by from.y - to.y and with its y by
 * to.x - from.x. */
int
TurnAround(const PointType & from, const PointType & to, const PointType & point)
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

/** On which side of a triangle the point lies, moved by infinitely little along x, less along y, still less along z. */
int
SideOfMoved(const PointType & a, const PointType & b, const PointType & c, const PointType & point)
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

Box
TriangleTree::GetTriangleBox(std::uint32_t triangle) const
{
  const auto & corners = m_Surface->GetTriangles()[triangle];
  const auto & points = m_Surface->GetPoints();
  const Box first = { points[corners[0]], points[corners[0]] };
  const Box second = { points[corners[1]], points[corners[1]] };
  const Box third = { points[corners[2]], points[corners[2]] };
  return Union(first, Union(second, third));
}

void
TriangleTree::SortTriangles()
{
  const auto & points = m_Surface->GetPoints();
  const auto & triangles = m_Surface->GetTriangles();
  Box all = EmptyBox;
  for (const PointType & point : points)
  {
    if (IsFinite(point))
    {
      all = Union(all, { point, point });
    }
  }
  double extent = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    extent = std::max(extent, double(all.highest[axis]) - double(all.lowest[axis]));
  }
  const double cellsPerMillimetre = extent > 0.0 ? ((1u << BitsAlongAxis) - 1) / extent : 0.0;

  PlacedContainer placed;
  placed.reserve(triangles.size());
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle)
  {
    const auto & corners = triangles[triangle];
    if (IsFinite(points[corners[0]]) && IsFinite(points[corners[1]]) && IsFinite(points[corners[2]]))
    {
      placed.push_back({ ComputeMortonCode(this->GetTriangleBox(triangle), all, cellsPerMillimetre), triangle });
    }
  }
  ParallelSort(placed);
  m_Order.resize(placed.size());
  std::transform(placed.begin(), placed.end(), m_Order.begin(), [](const Placed & item) { return item.triangle; });
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

/** Fills in the boxes of a node and \a depth - 1 levels below, from those that are there already deeper down. */
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
TriangleTree::FindClosestPoint(const PositionType & position, double maximumSquaredDistance) const
{
  ClosestPoint closest;
  closest.squaredDistance = maximumSquaredDistance;
  NodeStack stack;
  if (!m_Boxes.empty())
  {
    stack.Push(this->Root());
  }
  while (!stack.IsEmpty())
  {
    const Node node = stack.Pop();
    if (SquaredDistance(position, m_Boxes[node.id]) > closest.squaredDistance)
    {
      continue;
    }
    if (node.IsLeaf())
    {
      for (const std::uint32_t triangle : this->GetLeaf(node.begin))
      {
        this->ImproveClosestPoint(position, triangle, closest);
      }
      continue;
    }
    const Node left = node.Left();
    const Node right = node.Right();
    const bool isLeftNearer =
      SquaredDistance(position, m_Boxes[left.id]) <= SquaredDistance(position, m_Boxes[right.id]);
    stack.Push(isLeftNearer ? right : left);
    stack.Push(isLeftNearer ? left : right);
  }
  return closest;
}

TriangleTree::PositionType
TriangleTree::FindClosestPointOfTriangle(const PositionType & position, std::uint32_t triangle) const
{
  const auto & corners = m_Surface->GetTriangles()[triangle];
  const auto & points = m_Surface->GetPoints();
  return ClosestOnTriangle(
    position, { ToPosition(points[corners[0]]), ToPosition(points[corners[1]]), ToPosition(points[corners[2]]) });
}

void
TriangleTree::ImproveClosestPoint(const PositionType & position, std::uint32_t triangle, ClosestPoint & closest) const
{
  const PositionType candidate = this->FindClosestPointOfTriangle(position, triangle);
  const PositionType away = Subtract(candidate, position);
  const double distance = Dot(away, away);
  if (distance < closest.squaredDistance || (distance == closest.squaredDistance && triangle < closest.triangle))
  {
    closest = { candidate, distance, triangle };
  }
}

/** Where the moved point lies inside the triangle as seen along z, the ray crosses the plane there; it does so above
 * the point if the point is behind a triangle that faces up or before one that faces down. */
int
TriangleTree::CountTurns(const PointType & point, std::uint32_t triangle) const
{
  const auto & corners = m_Surface->GetTriangles()[triangle];
  const auto & points = m_Surface->GetPoints();
  const auto & a = points[corners[0]];
  const auto & b = points[corners[1]];
  const auto & c = points[corners[2]];
  const int turn = TurnAround(a, b, point);
  if (turn == 0 || TurnAround(b, c, point) != turn || TurnAround(c, a, point) != turn)
  {
    return 0;
  }
  return SideOfMoved(a, b, c, point) == -turn ? turn : 0;
}

int
TriangleTree::ComputeWindingNumber(const PointType & point) const
{
  int turns = 0;
  this->VisitCrossings(point, [&turns](std::uint32_t, int one) { turns += one; });
  return turns;
}

} // namespace itk
