#ifndef itkTriangleSurfaceSimplification_h
#define itkTriangleSurfaceSimplification_h

#include "itkTriangleSurface.h"
#include "rhombicForEachBlock.h"

#include <iosfwd>
#include <limits>

namespace itk
{

/** \class TriangleSurfaceSimplificationSettings
 * \brief When simplification ends: at a number of triangles or at an error, whichever comes first. */
struct TriangleSurfaceSimplificationSettings
{
  SizeValueType targetTriangles = 0;                             ///< 0 for as few as the error allows
  double maximumError = std::numeric_limits<double>::infinity(); ///< in mm, above 0

  /** Throws ExceptionObject if maximumError is not above 0, or if there is neither a target nor a maximumError. */
  void
  Verify() const;
};

/** Why a simplification ended. */
enum class SimplificationEnd : unsigned char
{
  Target,       ///< the target was reached
  MaximumError, ///< fewer triangles would be farther than maximumError from the original
  Topology      ///< fewer triangles would change the topology, turn over, or meet each other
};

std::ostream &
operator<<(std::ostream & os, SimplificationEnd end);

/** \class TriangleSurfaceSimplificationReport
 * \brief The result of simplification in numbers. */
struct TriangleSurfaceSimplificationReport
{
  SizeValueType trianglesBefore = 0;
  SizeValueType trianglesAfter = 0;
  SimplificationEnd end = SimplificationEnd::Target;
  SizeValueType placesTakenBack = 0; ///< triangles that failed a check; the last collapses there were taken back
};

/** Reduces the number of triangles and keeps the topology.
 *
 * Edges collapse to the position of the least mean squared distance from the planes of the original's triangles
 * (Garland and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997). No component vanishes,
 * and each keeps its Euler characteristic. Border edges stay as they are. Edges and points stay manifold, triangles
 * stay oriented and are not degenerate. New triangles meet others only at shared corners and sides, so there are no new
 * self-intersections: that is tested exactly, in float32, for each pair with a new triangle. Normals, if there are any,
 * are interpolated along the edges.
 *
 * The distance between the two surfaces is checked in both directions against maximumError: while edges collapse, at
 * the points of the original, and then for all triangles of both surfaces. Where nearness is not proven for all of a
 * triangle, it is checked at points an eighth of its sides apart, the centres against 0.9 maximumError; between these
 * points, rough detail much larger than maximumError may be farther away.
 *
 * The surface is cut into patches of some thousand triangles. Where a check fails, the last collapses are taken back.
 * This is repeated with other patches, so that no border between patches stays for good, and with larger errors until
 * the target is reached.
 *
 * Time O(n log n) on several threads, the same bytes for any number of them. Checks take longer the smaller
 * maximumError is compared with the triangles. Points of no triangle are removed. The result may have slightly fewer
 * triangles than the target.
 *
 * \a report receives the share of the triangles to remove that are removed; at an error without a target their number
 * is not known before, and the share may end far below 1. Its exceptions leave the surface unfit for use.
 *
 * Throws ExceptionObject as Verify() of the settings does, and if the surface has non-manifold or misoriented edges,
 * non-manifold points or degenerate triangles. */
TriangleSurfaceSimplificationReport
SimplifyTriangleSurface(TriangleSurface & surface,
                        const TriangleSurfaceSimplificationSettings & settings,
                        const rhombic::ProgressFunction & report = {});

/** The same for sheets that meet in curves, as walls between labels do.
 *
 * \a sheets has the number of each triangle's sheet, small and from 0; it is kept up to date. Edges with three or more
 * triangles make curves; triangles at an edge with two must be of one sheet. Points of curves collapse along their
 * curve, other points onto it; points where curves meet or end, or sheets meet in a point, stay. Distances are checked
 * sheet by sheet.
 *
 * Throws ExceptionObject if an edge with two triangles has two sheets, or if \a sheets has another number of
 * triangles; else as above, but edges and points where sheets meet need not be manifold. */
TriangleSurfaceSimplificationReport
SimplifyTriangleSurface(TriangleSurface & surface,
                        BulkVector<std::uint32_t> & sheets,
                        const TriangleSurfaceSimplificationSettings & settings,
                        const rhombic::ProgressFunction & report = {});

} // namespace itk

#endif
