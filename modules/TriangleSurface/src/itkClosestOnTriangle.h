#ifndef itkClosestOnTriangle_h
#define itkClosestOnTriangle_h

#include "itkPositionArithmetic.h"

#include <algorithm>
#include <limits>

namespace itk
{

inline PositionType
ClosestOnSegment(const PositionType & position, const PositionType & a, const PositionType & b)
{
  const PositionType along = Subtract(b, a);
  const double length = Dot(along, along);
  const double part = length > 0.0 ? std::clamp(Dot(Subtract(position, a), along) / length, 0.0, 1.0) : 0.0;
  return { a[0] + part * along[0], a[1] + part * along[1], a[2] + part * along[2] };
}

/** The position's foot on the triangle's plane if that lies inside all three sides, else the best point of the sides
 * that it lies beyond, or of all sides if the triangle has next to no area. With sides u and v from the first corner,
 * the foot is corner + (s u + t v) / area. */
inline PositionType
ClosestOnTriangle(const PositionType & position, const std::array<PositionType, 3> & corners)
{
  constexpr double leastArea = 1e-12;
  const PositionType u = Subtract(corners[1], corners[0]);
  const PositionType v = Subtract(corners[2], corners[0]);
  const PositionType away = Subtract(position, corners[0]);
  const double uu = Dot(u, u), uv = Dot(u, v), vv = Dot(v, v), ua = Dot(u, away), va = Dot(v, away);
  const double area = uu * vv - uv * uv;
  const double s = vv * ua - uv * va;
  const double t = uu * va - uv * ua;
  const bool hasArea = area > leastArea * uu * vv;
  const bool isBeyond[3] = { t<0.0, s + t> area, s < 0.0 }; // the side from each corner to the next
  if (hasArea && !isBeyond[0] && !isBeyond[1] && !isBeyond[2])
  {
    const double ofU = s / area;
    const double ofV = t / area;
    return { corners[0][0] + ofU * u[0] + ofV * v[0],
             corners[0][1] + ofU * u[1] + ofV * v[1],
             corners[0][2] + ofU * u[2] + ofV * v[2] };
  }
  PositionType closest{};
  double closestDistance = std::numeric_limits<double>::infinity();
  for (unsigned int n = 0; n < 3; ++n)
  {
    if (hasArea && !isBeyond[n])
    {
      continue;
    }
    const PositionType candidate = ClosestOnSegment(position, corners[n], corners[(n + 1) % 3]);
    const PositionType way = Subtract(candidate, position);
    const double distance = Dot(way, way);
    if (distance < closestDistance)
    {
      closestDistance = distance;
      closest = candidate;
    }
  }
  return closest;
}

} // namespace itk

#endif
