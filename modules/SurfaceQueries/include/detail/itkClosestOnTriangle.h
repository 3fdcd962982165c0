#ifndef itkClosestOnTriangle_h
#define itkClosestOnTriangle_h

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <limits>

namespace itk
{

inline PositionType
Along(const PositionType & from, const PositionType & way, double share)
{
  return { from[0] + share * way[0], from[1] + share * way[1], from[2] + share * way[2] };
}

inline PositionType
ClosestOnSegment(const PositionType & position, const PositionType & a, const PositionType & b)
{
  const PositionType way = Subtract(b, a);
  const double length = Dot(way, way);
  return Along(a, way, length > 0.0 ? std::clamp(Dot(Subtract(position, a), way) / length, 0.0, 1.0) : 0.0);
}

/** The best place on the sides of a triangle that has next to no area. */
inline PositionType
ClosestOnSides(const PositionType & position, const std::array<PositionType, 3> & corners)
{
  PositionType closest{};
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int n = 0; n < 3; ++n)
  {
    const PositionType candidate = ClosestOnSegment(position, corners[n], corners[(n + 1) % 3]);
    const PositionType away = Subtract(candidate, position);
    if (Dot(away, away) < least)
    {
      least = Dot(away, away);
      closest = candidate;
    }
  }
  return closest;
}

/** By the region of the plane that the position's foot lies in, see Ericson, Real-Time Collision Detection (2005),
 * 5.1.5: beyond a corner, beyond a side, or inside. */
inline PositionType
ClosestOnTriangle(const PositionType & position, const std::array<PositionType, 3> & corners)
{
  constexpr double leastArea = 1e-12;
  const auto & [a, b, c] = corners;
  const PositionType ab = Subtract(b, a);
  const PositionType ac = Subtract(c, a);
  const double abab = Dot(ab, ab), abac = Dot(ab, ac), acac = Dot(ac, ac);
  if (!(abab * acac - abac * abac > leastArea * abab * acac))
  {
    return ClosestOnSides(position, corners);
  }
  const PositionType fromA = Subtract(position, a);
  const double abA = Dot(ab, fromA), acA = Dot(ac, fromA); // how far along the sides, seen from a, b and c
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
  const double weightOfC = abA * acB - abB * acA; // times twice the area squared, as are the others
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
