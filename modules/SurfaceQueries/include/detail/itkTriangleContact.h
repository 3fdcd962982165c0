#ifndef itkTriangleContact_h
#define itkTriangleContact_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class TriangleContactEnums
 * \brief How two triangles of a surface meet, apart from the points and edges they share as corners of the same index.
 *
 * Thread safety: its enumerators are values. */
class TriangleContactEnums
{
public:
  /** What they have in common. */
  enum class Contact : std::uint8_t
  {
    Apart,    ///< they have no other point in common
    Touching, ///< they have, but the inside of neither meets the inside of the other
    Crossing  ///< they pass through each other, or lie in one plane and overlap
  };
};

/** How two triangles meet. Exact: no tolerance, and no rounding decides.
 *
 * Corners are shared if their indices are equal; equal positions of different indices touch. Triangles with all corners
 * shared are duplicates and cross. Triangles without area are apart from everything. Positions must be finite.
 * Thread safe. */
TriangleContactEnums::Contact
FindContact(const TriangleSurface::PointsContainer & points,
            TriangleSurface::TriangleType first,
            TriangleSurface::TriangleType second);

} // namespace itk

#endif
