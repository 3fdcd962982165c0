#ifndef itkTriangleSurfaceUntangling_h
#define itkTriangleSurfaceUntangling_h

#include "itkTriangleSurfaceIntersections.h"

#include <optional>

namespace itk
{

/** \class TriangleSurfaceUntanglingReport
 * \brief The result of untangling in numbers. */
struct TriangleSurfaceUntanglingReport
{
  SizeValueType crossingBefore = 0; ///< number of triangles that crossed others
  SizeValueType crossingAfter = 0;  ///< number of triangles that still cross others
  SizeValueType pointsMoved = 0;
  double largestMove = 0.0; ///< in mm
};

/** Moves the points of triangles that cross each other until none does. The connectivity and the normals stay.
 *
 * In each round, the points of crossing triangles move half way to the mean of their neighbours, which resolves most
 * folds. If folds remain, later rounds also push the points outwards and inwards by turns, which separates sheets. No
 * point moves farther than \a maximumMove mm. Ends after 16 rounds without progress, or after 40, with the state that
 * has the fewest crossing triangles and no triangle without area. If triangles cross then, as many rounds follow from
 * that state, in which only moves stay after which fewer triangles cross.
 *
 * Triangles cross only where \a candidates say, if there are any, and are only searched there. \a report receives the
 * share of the work that is done; its exceptions leave the surface partly untangled.
 *
 * Runs on several threads, with the same bytes for any number of them; time is one search for crossings plus rounds
 * over the crossing triangles only. Memory about 40 bytes per triangle. Throws ExceptionObject if \a maximumMove is not
 * above 0 or not finite. */
TriangleSurfaceUntanglingReport
UntangleTriangleSurface(TriangleSurface & surface,
                        double maximumMove,
                        const std::optional<CrossingCandidates> & candidates = std::nullopt,
                        const rhombic::ProgressFunction & report = {});

} // namespace itk

#endif
