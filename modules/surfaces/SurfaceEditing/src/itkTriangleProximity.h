#ifndef itkTriangleProximity_h
#define itkTriangleProximity_h

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleTree.h"

namespace itk
{

/** Whether all of a triangle is within \a distance (in mm, above 0) of a surface. The three triangles \a likely of the
 * surface are tried first; the nearer they are, the faster is the answer.
 *
 * The triangle is cut into pieces. A piece is near if all its corners are near one triangle of the surface, because the
 * points within a distance of a triangle are a convex set. A piece is also near if its centre is nearer than the
 * distance by at least the distance from the centre to the farthest corner. Pieces are no longer cut when their longest
 * side is below a quarter of that of the triangle and of the nearest triangle of the surface: then the corners must be
 * near and the centre within 0.9 times the distance. So the answer yes is proven except between these points, no
 * farther than 0.1 of that side from one of them. */
bool
IsWithinDistance(const CornersType & corners,
                 const TriangleTree & surface,
                 double distance,
                 const std::array<std::uint32_t, 3> & likely);

/** Whether all of a triangle is within \a distance of one of three triangles of a surface. */
bool
IsNearOneTriangle(const CornersType & corners,
                  const TriangleTree & surface,
                  double distance,
                  const std::array<std::uint32_t, 3> & triangles);

} // namespace itk

#endif
