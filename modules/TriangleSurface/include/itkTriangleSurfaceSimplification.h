#ifndef itkTriangleSurfaceSimplification_h
#define itkTriangleSurfaceSimplification_h

#include "itkTriangleSurface.h"

#include <iosfwd>
#include <limits>

namespace itk
{

/** \class TriangleSurfaceSimplificationSettings
 * \brief How far a surface is simplified: to a number of triangles, to an error, or until the first of both. */
struct TriangleSurfaceSimplificationSettings
{
  SizeValueType targetTriangles = 0;                             ///< 0: as few as the error allows
  double maximumError = std::numeric_limits<double>::infinity(); ///< in mm, above 0
};

/** What ended a simplification. */
enum class SimplificationEnd : unsigned char
{
  Target,       ///< as few triangles as were asked for
  MaximumError, ///< fewer triangles would be further from the surface than allowed
  Topology      ///< fewer triangles can't have the surface's shape and topology
};

std::ostream &
operator<<(std::ostream & os, SimplificationEnd end);

/** \class TriangleSurfaceSimplificationReport
 * \brief What simplification did. */
struct TriangleSurfaceSimplificationReport
{
  SizeValueType trianglesBefore = 0;
  SizeValueType trianglesAfter = 0;
  SimplificationEnd end = SimplificationEnd::Target;
  SizeValueType placesTakenBack = 0; ///< places where triangles were put back because a check had failed there
  SizeValueType intersectionsBefore = 0;
};

/** Makes a surface of fewer triangles that keeps the promise of the original.
 *
 * The result's points are some of the surface's own, with their normals. It has the same components, each with the same
 * Euler characteristic, the same border edges, consistent orientation, no non-manifold edge or point and no degenerate
 * triangle; no component vanishes. With a finite maximumError no place of either surface is further than that from the
 * other one: this is proven for every triangle of both, see IsWithinDistance().
 *
 * The surface is cut into patches of some thousand triangles; meshoptimizer simplifies each with its border held. The
 * patches are checked, alone and then all together; where a check fails, the triangles that were there are put back and
 * held while the patch is simplified again. This is repeated with other patches, so that no border is held for good.
 *
 * Time O(n log n), several threads; the same bytes for any number of them. Memory about 100 bytes a triangle while it
 * runs, 60 without a maximumError.
 *
 * Throws ExceptionObject for a surface with non-manifold or misoriented edges, non-manifold points or degenerate
 * triangles, and for a maximumError that is not above 0. */
TriangleSurfaceSimplificationReport
SimplifySurface(TriangleSurface & surface, const TriangleSurfaceSimplificationSettings & settings);

} // namespace itk

#endif
