#ifndef itkTriangleContact_h
#define itkTriangleContact_h

#include "itkTriangleSurface.h"

namespace itk
{

/** How two triangles of a surface meet, apart from the corners and sides they share. */
enum class TriangleContact : std::uint8_t
{
  Apart,    ///< they have no other point in common
  Touching, ///< they have another point in common, but their insides do not meet
  Crossing  ///< they pass through each other, or lie in one plane and overlap
};

/** Finds how two triangles meet. Exact: no tolerance, and no rounding decides.
 *
 * Corners are shared if their indices are equal; equal positions with different indices touch. Triangles that share all
 * corners are duplicates and cross. A triangle without area is apart from every other. Positions must be finite. */
TriangleContact
FindContact(const TriangleSurface::PointsContainer & points,
            TriangleSurface::TriangleType first,
            TriangleSurface::TriangleType second);

} // namespace itk

#endif
