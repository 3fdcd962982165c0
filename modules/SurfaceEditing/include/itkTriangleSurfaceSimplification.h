#ifndef itkTriangleSurfaceSimplification_h
#define itkTriangleSurfaceSimplification_h

#include "itkTriangleSurface.h"

#include <iosfwd>
#include <limits>

namespace itk
{

/** \class TriangleSurfaceSimplificationSettings
 * \brief How far a surface is simplified: to a number of triangles, to an error, or until the first of both.
 *
 * Thread safety: a value. */
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
  Topology      ///< fewer triangles would change the surface's topology, turn round, or meet each other
};

std::ostream &
operator<<(std::ostream & os, SimplificationEnd end);

/** \class TriangleSurfaceSimplificationReport
 * \brief What simplification did.
 *
 * Thread safety: a value. */
struct TriangleSurfaceSimplificationReport
{
  SizeValueType trianglesBefore = 0;
  SizeValueType trianglesAfter = 0;
  SimplificationEnd end = SimplificationEnd::Target;
  SizeValueType placesTakenBack = 0; ///< places where a check failed and triangles were put back
};

/** Makes a surface of fewer triangles that is as sound as it was.
 *
 * Edges shrink to places where the mean squared distance from the planes of the original's triangles is least (Garland
 * and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997). The result's components are those
 * of the original, each with the same Euler characteristic; none vanishes. Border edges stay as they are. Edges and
 * points are manifold, triangles are oriented and not degenerate. No triangle that was not there before meets another
 * one but in the points and edges they share, so there are no new self-intersections. Normals, if there are any, are
 * those of the edges' places.
 *
 * Neither surface is further than maximumError from the other one at any place that is looked at: each edge shrinks
 * only where the points of the original stay near the triangles that stand for them, and all triangles of both surfaces
 * are looked at afterwards (see IsWithinDistance()). Where the distance is not proven for all of a triangle, these
 * places are a quarter of its sides apart and within 0.9 maximumError; rough detail much larger than maximumError can
 * be further away between them.
 *
 * The surface is cut into patches of some thousand triangles. Where a check fails, the triangles from before are put
 * back. This is repeated with other patches, so that no border between patches stays for good, and with larger errors
 * until the target is reached.
 *
 * Time O(n log n), several threads; the same bytes for any number of them. The smaller the maximumError is compared
 * with the triangles, the longer it takes to look at them.
 *
 * Points of no triangle are dropped. The result may have some triangles less than were asked for.
 *
 * Throws ExceptionObject for a surface with non-manifold or misoriented edges, non-manifold points or degenerate
 * triangles, for a maximumError that is not above 0, and when there is neither a target nor a maximumError. Thread safe
 * for different surfaces. */
TriangleSurfaceSimplificationReport
SimplifySurface(TriangleSurface & surface, const TriangleSurfaceSimplificationSettings & settings);

} // namespace itk

#endif
