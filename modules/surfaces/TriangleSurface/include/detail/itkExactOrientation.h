#ifndef itkExactOrientation_h
#define itkExactOrientation_h

#include "itkTriangleSurface.h"

namespace itk
{

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
