#include "itkTriangleDistanceProof.h"

#include "itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr unsigned int MostCuts = 10;
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

} // namespace

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
  return this->IsPartWithin(corners, witnesses, MostCuts);
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
