#ifndef itkUnfoldedPoints_h
#define itkUnfoldedPoints_h

#include "itkTriangleSurface.h"

namespace itk
{

class TrianglesOfPoints;

/** Whether it is certain that no two triangles at a point meet elsewhere than at corners and sides they share.
 *
 * It is certain if the triangles at the point form one closed fan, and there is a direction from which all of them are
 * seen from the same side, and go round the point once: then each is seen in a sector of its own. The direction is that
 * of the triangles' mean normal; a bound on rounding errors makes it a proof. */
bool
IsUnfoldedPoint(const TriangleSurface & surface, const TrianglesOfPoints & fans, std::uint32_t point);

} // namespace itk

#endif
