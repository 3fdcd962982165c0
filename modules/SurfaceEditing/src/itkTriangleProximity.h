#ifndef itkTriangleProximity_h
#define itkTriangleProximity_h

#include "detail/itkPositionArithmetic.h"
#include "itkTriangleTree.h"

namespace itk
{

/** Whether no place of a triangle is further than a distance from a surface.
 *
 * The triangle is cut into pieces. A piece is near if all its corners are near one triangle of the surface, the one
 * nearest to its centre: then so is all between them, as the places so near a triangle are a convex set. It is also
 * near if its centre is nearer by the distance to its furthest corner. Pieces of less than a quarter of the longest
 * side of the triangle, and of the surface's triangle nearest to them, are not cut any more: of these, the corners
 * must be near, and the centre within 0.9 times the distance. So the answer yes is proven but for what is between these
 * places, at most 0.1 of that side from one of them.
 *
 * Thread safe.
 *
 * \param corners in mm
 * \param surface the tree of its triangles
 * \param distance in mm, above 0
 * \param likely triangles of the surface, which are tried first: the nearer they are, the faster is the answer */
bool
IsWithinDistance(const std::array<PositionType, 3> & corners,
                 const TriangleTree & surface,
                 double distance,
                 const std::array<std::uint32_t, 3> & likely);

} // namespace itk

#endif
