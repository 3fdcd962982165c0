#ifndef itkTriangleSurfaceUntangling_h
#define itkTriangleSurfaceUntangling_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class TriangleSurfaceUntanglingReport
 * \brief What untangling did.
 *
 * Thread safety: a value. */
struct TriangleSurfaceUntanglingReport
{
  SizeValueType crossingBefore = 0; ///< triangles that passed through others
  SizeValueType crossingAfter = 0;
  SizeValueType pointsMoved = 0;
  double largestMove = 0.0; ///< in mm
};

/** Moves the points of triangles that pass through each other until none does, with all triangles as they are
 * connected.
 *
 * Points of crossing triangles go half way to the mean of their neighbours, which unfolds most; where that does not
 * help, they go outwards and inwards in turns, which parts sheets. No point is ever further than \a maximumMove mm from
 * where it was. Ends with the fewest crossing triangles found when 16 rounds brought no fewer, or after 40, and leaves
 * the surface as it was when a triangle would lose its area. Normals stay.
 *
 * One search for crossings on several threads, then work in proportion to what was found; the same bytes for any number
 * of threads. About 60 bytes a triangle while it runs. Throws ExceptionObject when maximumMove is not above 0. Thread
 * safe for different surfaces. */
TriangleSurfaceUntanglingReport
UntangleSurface(TriangleSurface & surface, double maximumMove);

} // namespace itk

#endif
