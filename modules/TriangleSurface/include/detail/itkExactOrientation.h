#ifndef itkExactOrientation_h
#define itkExactOrientation_h

#include "itkTriangleSurface.h"

namespace itk
{

/** On which side of the plane through \a a, \a b and \a c the point \a d lies: 1 where the triangle's counter-clockwise
 * side faces, -1 behind it, 0 in the plane. Never wrong for finite points. Thread safe. */
int
OrientationInSpace(const TriangleSurface::PointType & a,
                   const TriangleSurface::PointType & b,
                   const TriangleSurface::PointType & c,
                   const TriangleSurface::PointType & d);

/** The turn from \a a over \a b to \a c seen against \a axis (0, 1 or 2): 1 counter-clockwise, -1 clockwise, 0
 * straight. It is the sign of the triangle normal's component along that axis. Never wrong for finite points. Thread
 * safe. */
int
OrientationAlongAxis(const TriangleSurface::PointType & a,
                     const TriangleSurface::PointType & b,
                     const TriangleSurface::PointType & c,
                     unsigned int axis);

/** Whether three points are not on one line. Never wrong for finite points. Thread safe. */
bool
HasArea(const TriangleSurface::PointType & a,
        const TriangleSurface::PointType & b,
        const TriangleSurface::PointType & c);

} // namespace itk

#endif
