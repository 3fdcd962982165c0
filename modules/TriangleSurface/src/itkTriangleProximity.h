#ifndef itkTriangleProximity_h
#define itkTriangleProximity_h

#include "itkPositionArithmetic.h"
#include "itkTriangleTree.h"

namespace itk
{

/** Whether no place of a triangle is further than a distance from a surface.
 *
 * The triangle is cut into pieces. A piece is near if all its corners are near one triangle of the surface, the one
 * nearest to its centre: then so is all between them, as the places so near a triangle are a convex set. It is also
 * near if its centre is a little nearer than it must be and it is small.
 *
 * Yes is proven, but for rounding. No means that there are places further than 0.9 times the distance, or that the
 * triangle is more than a thousand times as large as the distance. Thread safe.
 *
 * \param corners in mm
 * \param surface the tree of its triangles
 * \param distance in mm, above 0 */
bool
IsWithinDistance(const std::array<PositionType, 3> & corners, const TriangleTree & surface, double distance);

} // namespace itk

#endif
