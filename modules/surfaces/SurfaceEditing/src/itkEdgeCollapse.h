#ifndef itkEdgeCollapse_h
#define itkEdgeCollapse_h

#include "detail/itkPositionArithmetic.h"
#include "detail/itkPointStrata.h"

#include <memory_resource>

namespace itk
{

/** A point of the original surface, and the triangle that now covers it. */
struct Witness
{
  std::uint32_t point;
  std::uint32_t triangle; ///< index in the part
};

/** Some triangles of a surface with all their witnesses. */
struct SurfacePart
{
  std::pmr::vector<TriangleSurface::TriangleType> triangles;
  std::pmr::vector<std::uint32_t> sheets; ///< the number of each triangle's sheet
  std::pmr::vector<Witness> witnesses;
};

/** Data of each point of a surface. */
struct SurfacePoints
{
  BulkVector<Stratum> strata;
  BulkVector<std::uint32_t> triangles; ///< the number of triangles at the point
  BulkVector<std::uint8_t> isHeld;     ///< 1 if the point must stay
};

/** The surface before simplification, and the limit of the distance from it: new points must be near it, and its points
 * near the new triangles. */
struct OriginalSurface
{
  const TriangleSurface * surface;     ///< null if the distance has no limit; then there are no witnesses
  const TrianglesOfPoints * triangles; ///< of the surface
  double limit;                        ///< largest distance in mm
};

/** A surface whose parts are simplified one by one. */
struct SurfaceOfParts
{
  const TriangleSurface & surface;
  const SurfacePoints & points;
  const OriginalSurface & original;
};

/** An edge that collapses. Points have local ids: indices into the sorted ids of the part's points. */
struct EdgeToCollapse
{
  std::uint32_t from; ///< this point vanishes
  std::uint32_t to;
  PositionType position;       ///< new position of point \a to, relative to that of the part's first point
  std::uint32_t near = 0;      ///< a triangle of the original near the position
  std::uint32_t witnesses = 0; ///< those that move to other triangles with this edge and all before it
  double error;                ///< of this edge and all before it, at most
};

/** The edges that collapse, one after the other. */
struct CollapseLog
{
  std::pmr::vector<EdgeToCollapse> edges;
  std::pmr::vector<std::uint16_t>
    covering;               ///< for each witness that moves, which of the changed triangles then covers it
  bool wasHeldBack = false; ///< whether others stayed because of the error or the distance from the original
};

/** A point that has moved. */
struct MovedPoint
{
  std::uint32_t id;
  TriangleSurface::PointType position;
  TriangleSurface::NormalType normal; ///< zero if the surface has no normals
  std::uint32_t near;                 ///< a triangle of the original nearby
};

/** A part after its edges have collapsed. */
struct CollapsedPart
{
  SurfacePart part;                        ///< first the triangles that have not changed, then the new triangles
  std::pmr::vector<std::uint32_t> ids;     ///< for each triangle, its index before
  std::pmr::vector<std::uint16_t> changes; ///< for each triangle, how often a corner of it moved
  std::pmr::vector<MovedPoint> movedPoints;
};

/** Finds edges of some triangles of a surface to collapse, the edge of least error first, and \a collapsed, the part
 * without them.
 *
 * The error is the root of the weighted mean squared distance from the planes of the triangles that the edge's points
 * have absorbed: Garland and Heckbert, "Surface simplification using quadric error metrics" (SIGGRAPH 1997). An edge
 * collapses to the position of least error, if that is at most \a largestError (in mm), and only if
 * - the link condition holds, so that the topology stays: Dey et al., "Topology preserving edge contraction" (1999);
 * - no triangle turns by much, loses its area or becomes a sliver;
 * - the new point is near the original, and the original's points are near the new triangles.
 *
 * Where sheets meet, points of the curve collapse along it, and other points onto it. The original's points are near
 * new triangles of their own sheet; new points are near any sheet of the original, so that the caller must check the
 * new triangles sheet by sheet.
 *
 * The border of the part stays, and no new edge joins two border points, so that parts simplified one by one fit
 * together. Ends early when \a fewestTriangles or fewer remain. */
CollapseLog
CollapseEdges(const SurfaceOfParts & whole,
              const SurfacePart & part,
              double largestError,
              std::size_t fewestTriangles,
              CollapsedPart & collapsed);

/** Collapses the edges of a log again, without those that would change a triangle more often than \a mostChanges says,
 * and without those that depend on them: the triangles around an edge must be as they were when the log was made. */
CollapsedPart
ReplayCollapses(const SurfaceOfParts & whole,
                const SurfacePart & part,
                const CollapseLog & log,
                const std::pmr::vector<std::uint16_t> & mostChanges);

} // namespace itk

#endif
