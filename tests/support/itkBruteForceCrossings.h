#ifndef itkBruteForceCrossings_h
#define itkBruteForceCrossings_h

#include "itkTriangleSurface.h"

#include <algorithm>

/** Crossings found by looking at everything, for tests of what finds or avoids them cleverly. */
namespace bruteforce
{

using Place = itk::TriangleSurface::PointType;
using CornerIds = itk::TriangleSurface::TriangleType;

/** Six times the volume of a tetrahedron, by the side of (a, b, c) on which d lies. */
inline long double
SignedVolume(const Place & a, const Place & b, const Place & c, const Place & d)
{
  const auto from = [&a](const Place & to, unsigned int axis) {
    return static_cast<long double>(to[axis]) - static_cast<long double>(a[axis]);
  };
  return from(b, 0) * (from(c, 1) * from(d, 2) - from(c, 2) * from(d, 1)) -
         from(b, 1) * (from(c, 0) * from(d, 2) - from(c, 2) * from(d, 0)) +
         from(b, 2) * (from(c, 0) * from(d, 1) - from(c, 1) * from(d, 0));
}

/** Whether the segment from \a p to \a q passes through the inside of a triangle. */
inline bool
PassesThrough(const Place & p, const Place & q, const Place & a, const Place & b, const Place & c)
{
  const auto haveSameSign = [](long double u, long double v) { return (u > 0 && v > 0) || (u < 0 && v < 0); };
  const long double ab = SignedVolume(p, q, a, b);
  return haveSameSign(SignedVolume(a, b, c, p), -SignedVolume(a, b, c, q)) &&
         haveSameSign(ab, SignedVolume(p, q, b, c)) && haveSameSign(ab, SignedVolume(p, q, c, a));
}

/** The number of pairs of triangles of which a side of one passes through the inside of the other. Sides at a common
 * corner do not count. */
inline std::size_t
CountCrossings(const itk::TriangleSurface & surface)
{
  const auto & points = surface.GetPoints();
  const auto & triangles = surface.GetTriangles();
  const auto isBelow = [&](const CornerIds & first, const CornerIds & second, unsigned int axis) {
    return std::max({ points[first[0]][axis], points[first[1]][axis], points[first[2]][axis] }) <
           std::min({ points[second[0]][axis], points[second[1]][axis], points[second[2]][axis] });
  };
  const auto areBoxesApart = [&](const CornerIds & first, const CornerIds & second) {
    bool areApart = false;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      areApart = areApart || isBelow(first, second, axis) || isBelow(second, first, axis);
    }
    return areApart;
  };
  const auto hasPassingSide = [&](const CornerIds & first, const CornerIds & second) {
    const auto isShared = [&second](std::uint32_t point) {
      return std::find(second.begin(), second.end(), point) != second.end();
    };
    bool isPassing = false;
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const std::uint32_t p = first[corner], q = first[(corner + 1) % 3];
      isPassing =
        isPassing || (!isShared(p) && !isShared(q) &&
                      PassesThrough(points[p], points[q], points[second[0]], points[second[1]], points[second[2]]));
    }
    return isPassing;
  };
  std::size_t crossings = 0;
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    for (std::size_t m = n + 1; m < triangles.size(); ++m)
    {
      crossings += !areBoxesApart(triangles[n], triangles[m]) &&
                       (hasPassingSide(triangles[n], triangles[m]) || hasPassingSide(triangles[m], triangles[n]))
                     ? 1
                     : 0;
    }
  }
  return crossings;
}

} // namespace bruteforce

#endif
