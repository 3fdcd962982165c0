#ifndef itkBruteForceDistance_h
#define itkBruteForceDistance_h

#include "itkTriangleSurface.h"

#include <algorithm>
#include <cmath>
#include <limits>

/** Distances found by looking at everything, for tests of what finds them cleverly. */
namespace bruteforce
{

using Vector = std::array<double, 3>;
using Corners = std::array<Vector, 3>;

inline Vector
Mix(const Corners & corners, double a, double b, double c)
{
  Vector mixed;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    mixed[axis] = a * corners[0][axis] + b * corners[1][axis] + c * corners[2][axis];
  }
  return mixed;
}

inline double
Length(const Vector & a, const Vector & b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

inline double
DistanceToSegment(const Vector & point, const Vector & a, const Vector & b)
{
  double along = 0.0;
  double squared = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    along += (point[axis] - a[axis]) * (b[axis] - a[axis]);
    squared += (b[axis] - a[axis]) * (b[axis] - a[axis]);
  }
  const double share = std::clamp(along / squared, 0.0, 1.0);
  return Length(point, Mix({ a, b, a }, 1.0 - share, share, 0.0));
}

/** The foot's barycentric coordinates are ratios of volumes by Cramer's rule. */
inline double
DistanceToTriangle(const Vector & point, const Corners & t)
{
  const auto difference = [](const Vector & a, const Vector & b) {
    return Vector{ a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  };
  const auto cross = [](const Vector & a, const Vector & b) {
    return Vector{ a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
  };
  const auto dot = [](const Vector & a, const Vector & b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Vector u = difference(t[1], t[0]);
  const Vector v = difference(t[2], t[0]);
  const Vector w = difference(point, t[0]);
  const Vector normal = cross(u, v);
  const double c = dot(cross(u, w), normal) / dot(normal, normal);
  const double b = dot(cross(w, v), normal) / dot(normal, normal);
  if (b >= 0.0 && c >= 0.0 && b + c <= 1.0)
  {
    return std::abs(dot(w, normal)) / std::sqrt(dot(normal, normal));
  }
  return std::min({ DistanceToSegment(point, t[0], t[1]),
                    DistanceToSegment(point, t[1], t[2]),
                    DistanceToSegment(point, t[2], t[0]) });
}

inline Corners
CornersOf(const itk::TriangleSurface & surface, const itk::TriangleSurface::TriangleType & triangle)
{
  Corners corners;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    const auto & point = surface.GetPoints()[triangle[corner]];
    corners[corner] = { point[0], point[1], point[2] };
  }
  return corners;
}

inline double
DistanceToSurface(const Vector & point, const itk::TriangleSurface & surface)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto & triangle : surface.GetTriangles())
  {
    const auto & corner = surface.GetPoints()[triangle[0]];
    double reach = 0.0; // of the triangle from its first corner
    const Corners corners = CornersOf(surface, triangle);
    reach = std::max(Length(corners[0], corners[1]), Length(corners[0], corners[2]));
    if (Length(point, { corner[0], corner[1], corner[2] }) - reach < nearest)
    {
      nearest = std::min(nearest, DistanceToTriangle(point, corners));
    }
  }
  return nearest;
}

/** The largest distance to \a other over a grid of \a steps + 1 places along the sides of each triangle. */
inline double
FurthestDistance(const itk::TriangleSurface & surface, const itk::TriangleSurface & other, unsigned int steps)
{
  double furthest = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const Corners corners = CornersOf(surface, triangle);
    for (unsigned int i = 0; i <= steps; ++i)
    {
      for (unsigned int j = 0; i + j <= steps; ++j)
      {
        const double a = static_cast<double>(i) / steps;
        const double b = static_cast<double>(j) / steps;
        furthest = std::max(furthest, DistanceToSurface(Mix(corners, a, b, 1.0 - a - b), other));
      }
    }
  }
  return furthest;
}

} // namespace bruteforce

#endif
