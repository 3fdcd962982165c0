#include "itkTriangleDistanceProof.h"

#include "itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace itk
{
namespace
{

constexpr unsigned int MostCuts = 6;
constexpr double Rounding = 1e-9;     // of the limit and of lengths, on the safe side
constexpr double SmallestPart = 0.25; // its longest side over the limit

double
Distance(const PositionType & a, const PositionType & b)
{
  const PositionType way = Subtract(a, b);
  return std::sqrt(Dot(way, way));
}

PositionType
Middle(const PositionType & a, const PositionType & b)
{
  return { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
}

/** Across and along a triangle's plane, and above it. */
struct Frame
{
  PositionType origin;
  std::array<PositionType, 3> axes;

  explicit Frame(const std::array<PositionType, 3> & corners)
    : origin(corners[0])
  {
    const PositionType normal = Cross(Subtract(corners[1], origin), Subtract(corners[2], origin));
    axes[0] = Unit(Subtract(corners[1], origin));
    axes[2] = Unit(normal);
    axes[1] = Cross(axes[2], axes[0]);
  }

  PositionType
  ToFrame(const PositionType & position) const
  {
    const PositionType way = Subtract(position, origin);
    return { Dot(way, axes[0]), Dot(way, axes[1]), Dot(way, axes[2]) };
  }

  static PositionType
  Unit(const PositionType & vector)
  {
    const double length = std::sqrt(Dot(vector, vector));
    return { vector[0] / length, vector[1] / length, vector[2] / length };
  }
};

/** Twice the area of a triangle seen from above, positive if it is counter-clockwise. */
double
AreaFromAbove(const PositionType & a, const PositionType & b, const PositionType & c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** A counter-clockwise triangle at height 0. */
class FlatTriangle
{
public:
  explicit FlatTriangle(const std::array<PositionType, 3> & corners)
    : m_Corners(corners)
    , m_Tolerance(Rounding * AreaFromAbove(corners[0], corners[1], corners[2]))
  {}

  /** Whether a segment, seen from above, may have places in common with it. */
  bool
  MayMeet(const PositionType & from, const PositionType & to) const
  {
    bool isLeft = true;
    bool isRight = true;
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const PositionType & next = m_Corners[(corner + 1) % 3];
      if (AreaFromAbove(m_Corners[corner], next, from) < -m_Tolerance &&
          AreaFromAbove(m_Corners[corner], next, to) < -m_Tolerance)
      {
        return false;
      }
      const double side = AreaFromAbove(from, to, m_Corners[corner]);
      isLeft = isLeft && side > m_Tolerance;
      isRight = isRight && side < -m_Tolerance;
    }
    return !isLeft && !isRight;
  }

  /** How far from height 0 the part of another triangle above or below it is; 0 if there is none. */
  double
  GreatestHeight(const std::array<PositionType, 3> & triangle) const
  {
    std::array<PositionType, 9> polygon{ triangle[0], triangle[1], triangle[2] };
    std::size_t size = 3;
    for (unsigned int corner = 0; corner < 3 && size > 0; ++corner)
    {
      size = this->Clip(polygon, size, m_Corners[corner], m_Corners[(corner + 1) % 3]);
    }
    double greatest = 0.0;
    for (std::size_t n = 0; n < size; ++n)
    {
      greatest = std::max(greatest, std::abs(polygon[n][2]));
    }
    return greatest;
  }

private:
  /** Cuts away what is on the right of a line through two points; returns how many corners the rest has. */
  std::size_t
  Clip(std::array<PositionType, 9> & polygon,
       std::size_t size,
       const PositionType & from,
       const PositionType & to) const
  {
    std::array<PositionType, 9> rest;
    std::size_t sizeOfRest = 0;
    for (std::size_t n = 0; n < size; ++n)
    {
      const PositionType & a = polygon[n];
      const PositionType & b = polygon[(n + 1) % size];
      const double sideOfA = AreaFromAbove(from, to, a) + m_Tolerance;
      const double sideOfB = AreaFromAbove(from, to, b) + m_Tolerance;
      if (sideOfA >= 0.0)
      {
        rest[sizeOfRest++] = a;
      }
      if ((sideOfA < 0.0) != (sideOfB < 0.0))
      {
        const double share = sideOfA / (sideOfA - sideOfB);
        rest[sizeOfRest++] = { a[0] + share * (b[0] - a[0]),
                               a[1] + share * (b[1] - a[1]),
                               a[2] + share * (b[2] - a[2]) };
      }
    }
    polygon = rest;
    return sizeOfRest;
  }

  const std::array<PositionType, 3> m_Corners;
  const double m_Tolerance;
};

/** A side of a triangle of the sheet: its points' ids, the lower one first, and their positions. */
struct SheetEdge
{
  std::array<std::uint32_t, 2> ids;
  int direction; // 1 from the lower to the higher id
  PositionType low;
  PositionType high;
};

TriangleTree::Box
BoxAround(const std::array<PositionType, 3> & corners, double distance)
{
  TriangleTree::Box box;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto [lowest, highest] = std::minmax({ corners[0][axis], corners[1][axis], corners[2][axis] });
    box.lowest[axis] = std::nextafter(static_cast<float>(lowest - distance), -std::numeric_limits<float>::infinity());
    box.highest[axis] = std::nextafter(static_cast<float>(highest + distance), std::numeric_limits<float>::infinity());
  }
  return box;
}

} // namespace

/** The sheet is made of the surface's triangles around whose parts above and below are within the limit. Seen from
 * above its winding number is the same at all places of the triangle if none of its border edges is seen there; where
 * it is not 0, the sheet covers the place. */
bool
TriangleDistanceProof::IsBetweenSheets(const Corners & corners) const
{
  const Frame frame(corners);
  const Corners flat{ frame.ToFrame(corners[0]), frame.ToFrame(corners[1]), frame.ToFrame(corners[2]) };
  const FlatTriangle triangle(flat);
  PositionType place;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    place[axis] = 0.31 * flat[0][axis] + 0.33 * flat[1][axis] + 0.36 * flat[2][axis];
  }
  const double limit = (1.0 - Rounding) * m_Limit;
  int winding = 0;
  bool isOnEdge = false;
  std::vector<SheetEdge> edges;
  const auto & points = m_Surface.GetSurface().GetPoints();
  m_Surface.VisitTriangles(BoxAround(corners, m_Limit), [&](std::uint32_t id) {
    const auto & ids = m_Surface.GetSurface().GetTriangles()[id];
    const Corners sheet{ frame.ToFrame(ToPosition(points[ids[0]])),
                         frame.ToFrame(ToPosition(points[ids[1]])),
                         frame.ToFrame(ToPosition(points[ids[2]])) };
    if (!(triangle.GreatestHeight(sheet) <= limit))
    {
      return;
    }
    int turns = 0;
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const unsigned int next = (corner + 1) % 3;
      const bool isUpwards = ids[corner] < ids[next];
      const SheetEdge edge{ { std::min(ids[corner], ids[next]), std::max(ids[corner], ids[next]) },
                            isUpwards ? 1 : -1,
                            sheet[isUpwards ? corner : next],
                            sheet[isUpwards ? next : corner] };
      edges.push_back(edge);
      const double side = AreaFromAbove(edge.low, edge.high, place);
      isOnEdge = isOnEdge || side == 0.0;
      turns += side > 0.0 ? edge.direction : -edge.direction;
    }
    winding += turns / 3; // 1 or -1 where all sides have the place on the same side
  });
  if (winding == 0 || isOnEdge)
  {
    return false;
  }
  std::sort(edges.begin(), edges.end(), [](const SheetEdge & a, const SheetEdge & b) { return a.ids < b.ids; });
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
  {
    int balance = 0;
    for (end = begin; end < edges.size() && edges[end].ids == edges[begin].ids; ++end)
    {
      balance += edges[end].direction;
    }
    if (balance != 0 && triangle.MayMeet(edges[begin].low, edges[begin].high))
    {
      return false;
    }
  }
  return true;
}

bool
TriangleDistanceProof::IsWithin(const Triangle & triangle, const Near & near) const
{
  Corners corners;
  Witnesses witnesses;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    if (near[corner] == TriangleTree::None)
    {
      return false;
    }
    corners[corner] = ToPosition(triangle[corner]);
    witnesses[corner] = { near[corner], this->DistanceTo(corners[corner], near[corner]) };
  }
  return this->IsPartWithin(corners, witnesses, 0) || this->IsBetweenSheets(corners) ||
         this->IsPartWithin(corners, witnesses, MostCuts);
}

bool
TriangleDistanceProof::IsCentreWithin(const Triangle & triangle, const Near & near) const
{
  PositionType centre;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    centre[axis] = (double{ triangle[0][axis] } + triangle[1][axis] + triangle[2][axis]) / 3.0;
  }
  return std::any_of(
           near.begin(),
           near.end(),
           [&](std::uint32_t id) { return id != TriangleTree::None && this->DistanceTo(centre, id) <= m_Limit; }) ||
         m_Surface.FindClosestPoint(centre, m_Limit * m_Limit).triangle != TriangleTree::None;
}

bool
TriangleDistanceProof::IsPartWithin(const Corners & corners, const Witnesses & witnesses, unsigned int cutsLeft) const
{
  const double furthest = std::max({ witnesses[0].distance, witnesses[1].distance, witnesses[2].distance });
  if (!(furthest <= m_Limit))
  {
    return false;
  }
  const double longest =
    std::max({ Distance(corners[0], corners[1]), Distance(corners[1], corners[2]), Distance(corners[2], corners[0]) });
  // no place of a triangle is further than the longest side / sqrt(3) from its nearest corner
  if (furthest + longest / std::sqrt(3.0) <= m_Limit || this->IsOneTriangleNear(corners, witnesses))
  {
    return true;
  }
  if (cutsLeft == 0 || longest < SmallestPart * m_Limit)
  {
    return false;
  }
  Corners middles; // of the sides opposite to the corners
  Witnesses nearMiddles;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    const unsigned int next = (corner + 1) % 3;
    const unsigned int last = (corner + 2) % 3;
    middles[corner] = Middle(corners[next], corners[last]);
    nearMiddles[corner] = this->FindWitness(middles[corner], witnesses[next], witnesses[last]);
    if (!(nearMiddles[corner].distance <= m_Limit))
    {
      return false;
    }
  }
  const auto isWithin = [&](const Corners & part, const Witnesses & nearPart) {
    return this->IsPartWithin(part, nearPart, cutsLeft - 1);
  };
  return isWithin(middles, nearMiddles) &&
         isWithin({ corners[0], middles[2], middles[1] }, { witnesses[0], nearMiddles[2], nearMiddles[1] }) &&
         isWithin({ middles[2], corners[1], middles[0] }, { nearMiddles[2], witnesses[1], nearMiddles[0] }) &&
         isWithin({ middles[1], middles[0], corners[2] }, { nearMiddles[1], nearMiddles[0], witnesses[2] });
}

/** Whether no corner is further than the limit from one of the triangles: then no place between them is, as the places
 * so near a triangle are a convex set. */
bool
TriangleDistanceProof::IsOneTriangleNear(const Corners & corners, const Witnesses & witnesses) const
{
  return std::any_of(witnesses.begin(), witnesses.end(), [&](const Witness & witness) {
    return std::all_of(corners.begin(), corners.end(), [&](const PositionType & corner) {
      return this->DistanceTo(corner, witness.triangle) <= m_Limit;
    });
  });
}

/** One of two triangles, or where neither is well within the limit, the nearest one of all. */
TriangleDistanceProof::Witness
TriangleDistanceProof::FindWitness(const PositionType & position, const Witness & first, const Witness & second) const
{
  Witness best{ first.triangle, this->DistanceTo(position, first.triangle) };
  if (second.triangle != first.triangle)
  {
    const double distance = this->DistanceTo(position, second.triangle);
    best = distance < best.distance ? Witness{ second.triangle, distance } : best;
  }
  if (best.distance > 0.5 * m_Limit)
  {
    const double bound = std::min(best.distance, m_Limit);
    const auto closest = m_Surface.FindClosestPoint(position, bound * bound);
    if (closest.triangle != TriangleTree::None)
    {
      best = { closest.triangle, std::sqrt(closest.squaredDistance) };
    }
  }
  return best;
}

double
TriangleDistanceProof::DistanceTo(const PositionType & position, std::uint32_t triangle) const
{
  return Distance(position, m_Surface.FindClosestPointOfTriangle(position, triangle));
}

} // namespace itk
