#ifndef itkUnfoldedPoints_h
#define itkUnfoldedPoints_h

#include "detail/itkTrianglesOfPoints.h"

namespace itk
{

/** For each point, 1 if it is certain that no two triangles at it meet elsewhere than at corners and sides they share,
 * else 0.
 *
 * It is certain if the triangles at the point form one closed fan, and there is a direction from which all of them are
 * seen from the same side, and go round the point once: then each is seen in a sector of its own. The direction is that
 * of the triangles' mean normal; a bound on rounding errors makes it a proof. */
std::vector<std::uint8_t>
FindUnfoldedPoints(const TriangleSurface & surface, const TrianglesOfPoints & triangles);

} // namespace itk

#endif
