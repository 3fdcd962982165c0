#ifndef itkPositionArithmetic_h
#define itkPositionArithmetic_h

#include "itkTriangleSurface.h"
#include "rhombicVector3.h"

#include <algorithm>

namespace itk
{

using rhombic::Add;
using rhombic::Along;
using rhombic::Cross;
using rhombic::Distance;
using rhombic::Dot;
using rhombic::Length;
using rhombic::Mix;
using rhombic::Scaled;
using rhombic::SquaredDistance;
using rhombic::Subtract;

/** A position, or a difference of two, in double precision. */
using PositionType = rhombic::Vector3;

/** The positions of a triangle's corners. */
using CornersType = std::array<PositionType, 3>;

inline PositionType
ToPosition(const TriangleSurface::PointType & point)
{
  return { point[0], point[1], point[2] };
}

inline TriangleSurface::PointType
ToPoint(const PositionType & position)
{
  return { static_cast<float>(position[0]), static_cast<float>(position[1]), static_cast<float>(position[2]) };
}

inline CornersType
CornersOf(const TriangleSurface::PointsContainer & points, const TriangleSurface::TriangleType & triangle)
{
  return { ToPosition(points[triangle[0]]), ToPosition(points[triangle[1]]), ToPosition(points[triangle[2]]) };
}

inline CornersType
CornersOf(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  return CornersOf(surface.GetPoints(), triangle);
}

inline bool
IsFinite(const TriangleSurface::PointType & point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

/** The triangle's normal, as long as twice its area. */
inline PositionType
AreaVector(const CornersType & corners)
{
  return Cross(Subtract(corners[1], corners[0]), Subtract(corners[2], corners[0]));
}

/** The mean length of the triangles' sides in mm; 0 without triangles. */
inline double
MeanSideOf(const TriangleSurface & surface)
{
  double sum = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const CornersType corners = CornersOf(surface, triangle);
    sum += Distance(corners[0], corners[1]) + Distance(corners[1], corners[2]) + Distance(corners[2], corners[0]);
  }
  return sum / std::max(1.0, 3.0 * static_cast<double>(surface.GetNumberOfTriangles()));
}

/** The side of the plane through \a a, \a b and \a c on which \a d lies: 1 in front of the triangle's counter-clockwise
 * side, -1 behind it, 0 in the plane. Exact for finite points. */
int
OrientationInSpace(const TriangleSurface::PointType & a,
                   const TriangleSurface::PointType & b,
                   const TriangleSurface::PointType & c,
                   const TriangleSurface::PointType & d);

/** The turn from \a a over \a b to \a c seen against \a axis (0, 1 or 2): 1 counter-clockwise, -1 clockwise, 0
 * straight. It is the sign of the triangle normal's component along that axis. Exact for finite points. */
int
OrientationAlongAxis(const TriangleSurface::PointType & a,
                     const TriangleSurface::PointType & b,
                     const TriangleSurface::PointType & c,
                     unsigned int axis);

/** Whether three points are not on one line. Exact for finite points. */
bool
HasArea(const TriangleSurface::PointType & a,
        const TriangleSurface::PointType & b,
        const TriangleSurface::PointType & c);

} // namespace itk

#endif
