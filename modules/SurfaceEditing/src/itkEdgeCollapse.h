#ifndef itkEdgeCollapse_h
#define itkEdgeCollapse_h

#include "itkTriangleTree.h"

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
  std::vector<TriangleSurface::TriangleType> triangles;
  std::vector<Witness> witnesses;
};

/** The surface before simplification, and the limit of the distance from it: sampled positions of the new triangles
 * must be near it, and its witnesses near the new triangles. */
struct OriginalSurface
{
  const TriangleTree * tree;                     ///< null if the distance has no limit; then there are no witnesses
  double limit;                                  ///< largest distance in mm
  const std::vector<std::uint32_t> * nearPoints; ///< for each point of the surface, a triangle of the original nearby
};

/** Where collapsing ends: at the first of the two limits. */
struct CollapseGoal
{
  double error;              ///< largest error of an edge in mm, see CollapseEdges()
  std::size_t triangles = 0; ///< fewest triangles
};

/** How many triangles are left after all edges of up to an error have collapsed. */
struct CollapseProgress
{
  double error;
  std::size_t triangles;
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
  SurfacePart part;                     ///< first the triangles that have not changed, then the new ones
  std::size_t numberOfOldTriangles = 0; ///< triangles that have not changed
  std::vector<MovedPoint> movedPoints;
  std::vector<CollapseProgress> progress; ///< by growing error
  bool wasHeldBack = false; ///< whether edges stayed because of the error or the distance from the original
};

/** Collapses edges of some triangles of a surface, the edge of least error first.
 *
 * The error is the root of the weighted mean squared distance from the planes of the triangles that the edge's points
 * have absorbed: Garland and Heckbert, "Surface simplification using quadric error metrics" (SIGGRAPH 1997). An edge
 * collapses to the position of least error, and only if
 * - the link condition holds, so that the topology stays: Dey et al., "Topology preserving edge contraction" (1999);
 * - no triangle turns by much, loses its area or becomes a sliver;
 * - the surface stays near the original.
 *
 * The border of the part stays, and no new edge joins two border points, so that parts simplified one by one fit
 * together. The points of a triangle stay if \a isHeld is 1 for it. */
CollapsedPart
CollapseEdges(const TriangleSurface & surface,
              const SurfacePart & part,
              const std::vector<std::uint8_t> & isHeld,
              const OriginalSurface & original,
              const CollapseGoal & goal);

} // namespace itk

#endif
