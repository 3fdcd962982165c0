#ifndef itkPositionArithmetic_h
#define itkPositionArithmetic_h

#include "itkTriangleSurface.h"

#include <cmath>

namespace itk
{

/** A position, or a difference of two, in double precision. */
using PositionType = std::array<double, 3>;

/** The positions of a triangle's corners. */
using CornersType = std::array<PositionType, 3>;

inline PositionType
ToPosition(const TriangleSurface::PointType & point)
{
  return { point[0], point[1], point[2] };
}

inline CornersType
CornersOf(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  const auto & points = surface.GetPoints();
  return { ToPosition(points[triangle[0]]), ToPosition(points[triangle[1]]), ToPosition(points[triangle[2]]) };
}

inline bool
IsFinite(const TriangleSurface::PointType & point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

inline PositionType
Add(const PositionType & a, const PositionType & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline PositionType
Subtract(const PositionType & a, const PositionType & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline double
Dot(const PositionType & a, const PositionType & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline PositionType
Cross(const PositionType & a, const PositionType & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double
Length(const PositionType & a)
{
  return std::sqrt(Dot(a, a));
}

inline double
SquaredDistance(const PositionType & a, const PositionType & b)
{
  const PositionType difference = Subtract(a, b);
  return Dot(difference, difference);
}

inline double
Distance(const PositionType & a, const PositionType & b)
{
  return std::sqrt(SquaredDistance(a, b));
}

/** The triangle's normal, as long as twice its area. */
inline PositionType
AreaVector(const CornersType & corners)
{
  return Cross(Subtract(corners[1], corners[0]), Subtract(corners[2], corners[0]));
}

} // namespace itk

#endif
