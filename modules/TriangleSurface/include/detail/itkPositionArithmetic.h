#ifndef itkPositionArithmetic_h
#define itkPositionArithmetic_h

#include "itkTriangleSurface.h"

namespace itk
{

/** A position, or a difference of two, in double precision. */
using PositionType = std::array<double, 3>;

inline PositionType
ToPosition(const TriangleSurface::PointType & point)
{
  return { point[0], point[1], point[2] };
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

} // namespace itk

#endif
