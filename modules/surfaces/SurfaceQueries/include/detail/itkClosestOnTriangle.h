#ifndef itkClosestOnTriangle_h
#define itkClosestOnTriangle_h

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <limits>

namespace itk
{

inline PositionType
ClosestOnSegment(const PositionType & position, const PositionType & a, const PositionType & b)
{
  const PositionType way = Subtract(b, a);
  const double squaredLength = Dot(way, way);
  const double share = squaredLength > 0.0 ? Dot(Subtract(position, a), way) / squaredLength : 0.0;
  return Along(a, way, std::clamp(share, 0.0, 1.0));
}

/** The closest point on the sides of a triangle. */
inline PositionType
ClosestOnSides(const PositionType & position, const CornersType & corners)
{
  PositionType closest{};
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int n = 0; n < 3; ++n)
  {
    const PositionType candidate = ClosestOnSegment(position, corners[n], corners[(n + 1) % 3]);
    if (const double squared = SquaredDistance(candidate, position); squared < least)
    {
      least = squared;
      closest = candidate;
    }
  }
  return closest;
}

/** The closest point of a triangle, by the region into which the position projects: beyond a corner, beyond a side, or
 * inside the triangle. See Ericson, Real-Time Collision Detection (2005), section 5.1.5. */
inline PositionType
ClosestOnTriangle(const PositionType & position, const CornersType & corners)
{
  constexpr double leastArea = 1e-12; // squared, relative to the sides
  const auto & [a, b, c] = corners;
  const PositionType ab = Subtract(b, a);
  const PositionType ac = Subtract(c, a);
  const double abab = Dot(ab, ab), abac = Dot(ab, ac), acac = Dot(ac, ac);
  if (!(abab * acac - abac * abac > leastArea * abab * acac))
  {
    return ClosestOnSides(position, corners);
  }
  const PositionType fromA = Subtract(position, a);
  const double abA = Dot(ab, fromA), acA = Dot(ac, fromA); // projections on the sides, seen from a, b and c
  const double abB = abA - abab, acB = acA - abac;
  const double abC = abA - abac, acC = acA - acac;
  if (abA <= 0.0 && acA <= 0.0)
  {
    return a;
  }
  if (abB >= 0.0 && acB <= abB)
  {
    return b;
  }
  if (acC >= 0.0 && abC <= acC)
  {
    return c;
  }
  const double weightOfC = abA * acB - abB * acA; // barycentric weights, times twice the area squared
  if (weightOfC <= 0.0 && abA >= 0.0 && abB <= 0.0)
  {
    return Along(a, ab, abA / abab);
  }
  const double weightOfB = abC * acA - abA * acC;
  if (weightOfB <= 0.0 && acA >= 0.0 && acC <= 0.0)
  {
    return Along(a, ac, acA / acac);
  }
  const double weightOfA = abB * acC - abC * acB;
  if (weightOfA <= 0.0)
  {
    return ClosestOnSegment(position, b, c);
  }
  const double sum = weightOfA + weightOfB + weightOfC;
  return Along(Along(a, ab, weightOfB / sum), ac, weightOfC / sum);
}

} // namespace itk

#endif
