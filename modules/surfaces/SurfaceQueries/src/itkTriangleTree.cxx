#include "itkTriangleTree.h"

#include "detail/itkClosestOnTriangle.h"
#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace itk
{
namespace
{

using Box = TriangleTree::Box;
using PointType = TriangleTree::PointType;

/** A triangle, and the number along a curve through space of the grid cell with the centre of its box. */
struct CurvePlace
{
  std::uint64_t cell;
  std::uint32_t triangle;

  bool
  operator<(const CurvePlace & other) const
  {
    return cell != other.cell ? cell < other.cell : triangle < other.triangle;
  }
};
using CurvePlaces = BulkVector<CurvePlace>;

constexpr unsigned int BitsOfAxis = 21; // of a cell's number along one axis
constexpr unsigned int BitsOfBucket = 15;
constexpr std::size_t NumberOfBuckets = std::size_t{ 1 } << BitsOfBucket;
constexpr std::size_t FewestForBuckets = 50000;
constexpr std::size_t TrianglesOfBlock = 65536;

/** Moves each bit of a number below 2^21 to three times its place. */
std::uint64_t
SpreadBits(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x001f00000000ffffU;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

/** The centre of a triangle's box. */
TriangleSurface::PointType
CentreOf(const TriangleSurface & surface, std::uint32_t triangle)
{
  const Box box = TriangleTree::BoxOf(surface.GetPoints(), surface.GetTriangles()[triangle]);
  return { 0.5f * box.lowest[0] + 0.5f * box.highest[0],
           0.5f * box.lowest[1] + 0.5f * box.highest[1],
           0.5f * box.lowest[2] + 0.5f * box.highest[2] };
}

/** The box around the centres of triangles. */
Box
FindBox(const TriangleSurface & surface, const BulkVector<std::uint32_t> & triangles)
{
  std::vector<Box> ofBlocks((triangles.size() + TrianglesOfBlock - 1) / TrianglesOfBlock);
  rhombic::ForEachBlock(triangles.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    const auto first = CentreOf(surface, triangles[begin]);
    Box box{ first, first };
    for (std::size_t n = begin + 1; n < end; ++n)
    {
      box.Add(CentreOf(surface, triangles[n]));
    }
    ofBlocks[begin / TrianglesOfBlock] = box;
  });
  Box box = ofBlocks.front();
  for (const Box & other : ofBlocks)
  {
    box.Add(other);
  }
  return box;
}

CurvePlaces
FindPlaces(const TriangleSurface & surface, const BulkVector<std::uint32_t> & triangles)
{
  const Box box = FindBox(surface, triangles);
  double longest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, double(box.highest[axis]) - box.lowest[axis]);
  }
  constexpr double last = (1U << BitsOfAxis) - 1;
  const double cellsPerMillimetre = longest > 0.0 ? last / longest : 0.0;
  CurvePlaces places(triangles.size());
  rhombic::ForEachInBlocks(triangles.size(), TrianglesOfBlock, [&](std::size_t n) {
    const auto centre = CentreOf(surface, triangles[n]);
    std::uint64_t cell = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double number = std::min(last, (double(centre[axis]) - box.lowest[axis]) * cellsPerMillimetre);
      cell |= SpreadBits(static_cast<std::uint64_t>(number)) << axis;
    }
    places[n] = { cell, triangles[n] };
  });
  return places;
}

std::size_t
BucketOf(const CurvePlace & place)
{
  return place.cell >> (3 * BitsOfAxis - BitsOfBucket);
}

/** Moves places into buckets by the highest bits of their cells, and sorts each bucket. */
void
SortByBuckets(CurvePlaces & places)
{
  const std::size_t blocks = (places.size() + TrianglesOfBlock - 1) / TrianglesOfBlock;
  using Counts = std::array<std::uint32_t, NumberOfBuckets>;
  BulkVector<Counts> next(blocks, Counts()); // counts, then the place of the next triangle
  rhombic::ForEachBlock(places.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    auto & counts = next[begin / TrianglesOfBlock];
    for (std::size_t n = begin; n < end; ++n)
    {
      ++counts[BucketOf(places[n])];
    }
  });
  std::vector<std::size_t> ends(NumberOfBuckets);
  std::uint32_t sum = 0;
  for (std::size_t bucket = 0; bucket < NumberOfBuckets; ++bucket)
  {
    for (auto & ofBlock : next)
    {
      sum += std::exchange(ofBlock[bucket], sum);
    }
    ends[bucket] = sum;
  }
  CurvePlaces sorted(places.size());
  rhombic::ForEachBlock(places.size(), TrianglesOfBlock, [&](std::size_t begin, std::size_t end) {
    auto & ofBlock = next[begin / TrianglesOfBlock];
    for (std::size_t n = begin; n < end; ++n)
    {
      sorted[ofBlock[BucketOf(places[n])]++] = places[n];
    }
  });
  places.swap(sorted);
  constexpr std::size_t bucketsOfBlock = 256;
  rhombic::ForEachInBlocks(NumberOfBuckets, bucketsOfBlock, [&](std::size_t bucket) {
    const std::size_t begin = bucket > 0 ? ends[bucket - 1] : 0;
    std::sort(places.data() + begin, places.data() + ends[bucket]);
  });
}

/** Sorts triangles along a Z-order curve (G. Morton, 1966) through the cells of a grid, 2^21 along the longest side of
 * the box around the triangles: two triangles whose cells have their highest n bits in common lie in one of 2^n boxes
 * of about the same size. Positions must be finite.
 *
 * Nearly linear time, on several threads with the same result for any number of them; memory 16 bytes per triangle more
 * than the result. */
CurvePlaces
SortAlongCurve(const TriangleSurface & surface, const BulkVector<std::uint32_t> & triangles)
{
  if (triangles.empty())
  {
    return {};
  }
  CurvePlaces places = FindPlaces(surface, triangles);
  if (places.size() < FewestForBuckets)
  {
    std::sort(places.begin(), places.end());
  }
  else
  {
    SortByBuckets(places);
  }
  return places;
}

double
SquaredDistance(const PositionType & position, const Box & box)
{
  double squared = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double below = double(box.lowest[axis]) - position[axis];
    const double above = position[axis] - double(box.highest[axis]);
    const double outside = std::max(std::max(below, above), 0.0);
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

BulkVector<std::uint32_t>
AllTriangles(const TriangleSurface & surface)
{
  BulkVector<std::uint32_t> triangles(surface.GetNumberOfTriangles());
  std::iota(triangles.begin(), triangles.end(), 0);
  return triangles;
}

/** Whether a ray meets a box within \a most mm. */
bool
IsOnRay(const TriangleTree::Box & box, const PositionType & position, const PositionType & direction, double most)
{
  double begin = 0.0;
  double end = most;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double low = box.lowest[axis] - position[axis];
    const double high = box.highest[axis] - position[axis];
    if (direction[axis] == 0.0)
    {
      if (low > 0.0 || high < 0.0)
      {
        return false;
      }
      continue;
    }
    const double first = low / direction[axis];
    const double second = high / direction[axis];
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  }
  constexpr double rounding = 1e-9; // of the divisions
  return begin <= end + rounding * (1.0 + std::abs(end));
}

/** The distance at which a ray leaves through a triangle's clockwise side, its edges included; infinite if it does not.
 * Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. */
double
FindExitThrough(const CornersType & corners, const PositionType & position, const PositionType & direction)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  const PositionType first = Subtract(corners[1], corners[0]);
  const PositionType second = Subtract(corners[2], corners[0]);
  const PositionType across = Cross(direction, second);
  const double determinant = Dot(first, across); // above 0 where the ray meets the counter-clockwise side
  if (!(determinant < 0.0))
  {
    return none;
  }
  const PositionType toRay = Subtract(position, corners[0]);
  const double u = Dot(toRay, across) / determinant;
  const PositionType turned = Cross(toRay, first);
  const double v = Dot(direction, turned) / determinant;
  constexpr double rounding = 1e-9; // so that no ray passes between two triangles
  return u < -rounding || v < -rounding || u + v > 1.0 + rounding ? none : Dot(second, turned) / determinant;
}

} // namespace

/** \class TriangleTree::Builder
 * \brief Builds the nodes of a tree from triangles along a curve: counts leaves, so that all nodes have their places,
 * then fills parts of the curve that are whole subtrees on several threads, and the nodes above them. */
class TriangleTree::Builder
{
public:
  Builder(TriangleTree & tree, CurvePlaces places)
    : m_Tree(tree)
    , m_Places(std::move(places))
  {}

  void
  Build()
  {
    this->Cut(0, m_Places.size());
    rhombic::ForEachInBlocks(m_Parts.size(), 1, [this](std::size_t n) {
      m_Parts[n].leaves = this->CountLeaves(m_Parts[n].begin, m_Parts[n].end);
    });
    Place place;
    this->PlaceParts(place);
    m_Tree.m_LeafEnds.resize(place.leaf);
    m_Tree.m_Nodes.resize(place.node);
    rhombic::ForEachInBlocks(m_Parts.size(), 1, [this](std::size_t n) {
      Place next = m_Parts[n].place;
      this->FillNodes(m_Parts[n].begin, m_Parts[n].end, next);
    });
    for (auto above = m_Above.rbegin(); above != m_Above.rend(); ++above) // children before their parents
    {
      this->JoinChildren(above->node, above->leavesOfLeft);
    }
  }

private:
  static constexpr std::size_t MostOfPart = 8192;

  /** Where nodes are put. */
  struct Place
  {
    std::size_t node = 0;
    std::size_t leaf = 0;
  };

  struct Part
  {
    std::size_t begin; ///< triangles along the curve
    std::size_t end;
    std::uint32_t leaves = 0;
    Place place{};
  };

  /** A node above parts. */
  struct NodeAbove
  {
    std::size_t node;
    std::uint32_t leavesOfLeft;
  };

  /** Where the highest bit changes in which the cells of places [begin, end) differ. */
  std::size_t
  FindMiddle(std::size_t begin, std::size_t end) const
  {
    const std::uint64_t first = m_Places[begin].cell;
    const std::uint64_t last = m_Places[end - 1].cell;
    if (first == last)
    {
      return begin + (end - begin) / 2;
    }
    const int highest = 63 - __builtin_clzll(first ^ last);
    const CurvePlace middle{ last >> highest << highest, 0 };
    return static_cast<std::size_t>(std::lower_bound(m_Places.data() + begin, m_Places.data() + end, middle) -
                                    m_Places.data());
  }

  void
  Cut(std::size_t begin, std::size_t end)
  {
    m_AreParts.push_back(end - begin <= MostOfPart);
    if (m_AreParts.back())
    {
      m_Parts.push_back({ begin, end });
      return;
    }
    const std::size_t middle = this->FindMiddle(begin, end);
    this->Cut(begin, middle);
    this->Cut(middle, end);
  }

  std::uint32_t
  CountLeaves(std::size_t begin, std::size_t end) const
  {
    if (end - begin <= LeafSize)
    {
      return 1;
    }
    const std::size_t middle = this->FindMiddle(begin, end);
    return this->CountLeaves(begin, middle) + this->CountLeaves(middle, end);
  }

  /** Puts the next node and all below it at \a place, which moves behind them. Returns its number of leaves. */
  std::uint32_t
  PlaceParts(Place & place)
  {
    if (m_AreParts[m_NextNode++])
    {
      Part & part = m_Parts[m_NextPart++];
      part.place = place;
      place.node += 2 * std::size_t{ part.leaves } - 1;
      place.leaf += part.leaves;
      return part.leaves;
    }
    const std::size_t above = m_Above.size();
    m_Above.push_back({ place.node++, 0 });
    const std::uint32_t left = this->PlaceParts(place);
    m_Above[above].leavesOfLeft = left;
    return left + this->PlaceParts(place);
  }

  /** Fills the node of places [begin, end) and all below it. Returns its number of leaves. */
  std::uint32_t
  FillNodes(std::size_t begin, std::size_t end, Place & place) const
  {
    const std::size_t id = place.node++;
    if (end - begin <= LeafSize)
    {
      Box box = m_Tree.GetTriangleBox(m_Places[begin].triangle);
      for (std::size_t n = begin + 1; n < end; ++n)
      {
        box.Add(m_Tree.GetTriangleBox(m_Places[n].triangle));
      }
      m_Tree.m_Nodes[id] = { box, 0 };
      m_Tree.m_LeafEnds[place.leaf++] = static_cast<std::uint32_t>(end);
      return 1;
    }
    const std::size_t middle = this->FindMiddle(begin, end);
    const std::uint32_t left = this->FillNodes(begin, middle, place);
    const std::uint32_t right = this->FillNodes(middle, end, place);
    this->JoinChildren(id, left);
    return left + right;
  }

  void
  JoinChildren(std::size_t id, std::uint32_t leavesOfLeft) const
  {
    auto & nodes = m_Tree.m_Nodes;
    nodes[id] = { nodes[id + 1].box, leavesOfLeft };
    nodes[id].box.Add(nodes[id + 2 * std::size_t{ leavesOfLeft }].box);
  }

  TriangleTree & m_Tree;
  CurvePlaces m_Places;
  std::vector<Part> m_Parts;
  std::vector<bool> m_AreParts; ///< whether nodes are parts: the parts and all nodes above them, in the tree's order
  std::vector<NodeAbove> m_Above;
  std::size_t m_NextNode = 0;
  std::size_t m_NextPart = 0;
};

TriangleTree::TriangleTree(const TriangleSurface & surface)
  : m_Surface(&surface)
{
  this->Build(AllTriangles(surface));
}

TriangleTree::TriangleTree(const TriangleSurface & surface, BulkVector<std::uint32_t> triangles)
  : m_Surface(&surface)
{
  this->Build(std::move(triangles));
}

void
TriangleTree::Build(BulkVector<std::uint32_t> triangles)
{
  const TriangleSurface & surface = *m_Surface;
  m_Order = std::move(triangles);
  const auto isPlaced = [&](std::uint32_t triangle) {
    const auto & [a, b, c] = surface.GetTriangles()[triangle];
    return IsFinite(surface.GetPoints()[a]) && IsFinite(surface.GetPoints()[b]) && IsFinite(surface.GetPoints()[c]);
  };
  m_Order.erase(std::remove_if(m_Order.begin(), m_Order.end(), std::not_fn(isPlaced)), m_Order.end());
  CurvePlaces places = SortAlongCurve(surface, m_Order);
  std::transform(
    places.begin(), places.end(), m_Order.begin(), [](const CurvePlace & place) { return place.triangle; });
  if (!places.empty())
  {
    Builder(*this, std::move(places)).Build();
  }
}

void
TriangleTree::Enlarge(const Box & before, const Box & after)
{
  this->VisitNodes([&](const Node & node) {
    Box & box = m_Nodes[node.id].box;
    const bool mayHoldTriangle = box.Holds(before);
    if (mayHoldTriangle)
    {
      box.Add(after);
    }
    return mayHoldTriangle;
  });
}

void
TriangleTree::RefitSubtree(const Node & top)
{
  std::size_t leaf = top.end;
  for (std::size_t id = top.id + 2 * (top.end - top.begin) - 1; id-- > top.id;) // children before their parents
  {
    StoredNode & node = m_Nodes[id];
    if (node.leavesOfLeft > 0)
    {
      this->JoinBoxes(id);
      continue;
    }
    const Leaf triangles = this->GetLeaf(--leaf);
    node.box = this->GetTriangleBox(*triangles.begin());
    for (const std::uint32_t triangle : triangles)
    {
      node.box.Add(this->GetTriangleBox(triangle));
    }
  }
}

void
TriangleTree::Refit()
{
  constexpr std::size_t leavesOfSubtree = 256;
  std::vector<Node> subtrees;
  std::vector<std::size_t> above;
  this->VisitNodes([&](const Node & node) {
    const bool isAbove = node.end - node.begin > leavesOfSubtree;
    isAbove ? above.push_back(node.id) : subtrees.push_back(node);
    return isAbove;
  });
  rhombic::ForEachInBlocks(subtrees.size(), 1, [&](std::size_t n) { this->RefitSubtree(subtrees[n]); });
  std::for_each(above.rbegin(), above.rend(), [this](std::size_t id) { this->JoinBoxes(id); });
}

std::vector<std::size_t>
TriangleTree::FindSubtrees(std::size_t mostTriangles) const
{
  std::vector<std::size_t> begins;
  this->VisitNodes([&](const Node & node) {
    const auto triangles =
      static_cast<std::size_t>(this->GetLeaf(node.end - 1).end() - this->GetLeaf(node.begin).begin());
    const bool isCut = !node.IsLeaf() && triangles > mostTriangles;
    if (!isCut)
    {
      begins.push_back(node.begin);
    }
    return isCut;
  });
  begins.push_back(this->GetNumberOfLeaves());
  return begins;
}

TriangleTree::ClosestPoint
TriangleTree::FindClosestPoint(const PositionType & position,
                               double maximumSquaredDistance,
                               double enoughSquaredDistance) const
{
  ClosestPoint closest;
  closest.squaredDistance = maximumSquaredDistance;
  if (m_Nodes.empty())
  {
    return closest;
  }
  struct DistantNode
  {
    Node node;
    double squaredDistance;
  };
  std::array<DistantNode, MostNodes> farther; // the nearest on top
  std::size_t size = 0;
  Node node = this->Root();
  double squaredDistance = SquaredDistance(position, m_Nodes[node.id].box);
  for (;;)
  {
    if (squaredDistance <= closest.squaredDistance)
    {
      if (!node.IsLeaf())
      {
        const Node left = this->LeftOf(node);
        const Node right = this->RightOf(node);
        const double toLeft = SquaredDistance(position, m_Nodes[left.id].box);
        const double toRight = SquaredDistance(position, m_Nodes[right.id].box);
        const bool isLeftNearer = toLeft <= toRight;
        if (const double toFarther = isLeftNearer ? toRight : toLeft; toFarther <= closest.squaredDistance)
        {
          farther[size++] = { isLeftNearer ? right : left, toFarther };
        }
        node = isLeftNearer ? left : right;
        squaredDistance = isLeftNearer ? toLeft : toRight;
        continue;
      }
      for (const std::uint32_t triangle : this->GetLeaf(node.begin))
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
    }
    if (size == 0)
    {
      return closest;
    }
    node = farther[--size].node;
    squaredDistance = farther[size].squaredDistance;
  }
}

double
TriangleTree::FindExit(const PositionType & position, const PositionType & direction, double least) const
{
  double nearest = std::numeric_limits<double>::infinity();
  this->VisitNodes([&](const Node & node) {
    if (!IsOnRay(m_Nodes[node.id].box, position, direction, nearest))
    {
      return false;
    }
    if (node.IsLeaf())
    {
      for (const std::uint32_t triangle : this->GetLeaf(node.begin))
      {
        const double exit =
          FindExitThrough(CornersOf(*m_Surface, m_Surface->GetTriangles()[triangle]), position, direction);
        nearest = exit > least ? std::min(nearest, exit) : nearest;
      }
    }
    return true;
  });
  return nearest;
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
 * that faces up or in front of a triangle that faces down. */
int
TriangleTree::CountTurns(const TriangleSurface & surface, const PointType & point, std::uint32_t triangle)
{
  const auto & corners = surface.GetTriangles()[triangle];
  const auto & points = surface.GetPoints();
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

} // namespace itk
