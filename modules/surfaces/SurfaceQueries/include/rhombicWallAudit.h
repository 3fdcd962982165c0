#ifndef rhombicWallAudit_h
#define rhombicWallAudit_h

#include "rhombicSceneSurface.h"

#include "itkTriangleSurfaceAudit.h"

#include <cstddef>
#include <vector>

namespace rhombic
{

/** Flaws that only show when surfaces are looked at together, as those of labels that share walls. */
struct WallAudit
{
  std::size_t sharedTriangles = 0;   ///< of two surfaces, facing opposite ways in them
  std::size_t oneSidedTriangles = 0; ///< with the same surface on both sides
  std::size_t repeatedTriangles = 0; ///< with the points of another, but no wall between two surfaces: overlaps
  std::size_t loneJunctions = 0;     ///< edges with more than two triangles, where fewer than three regions meet
  itk::TriangleSurfaceIntersections intersections; ///< of triangles of all surfaces, those of walls counted once

  /** Adds the counts of other surfaces, which were looked at by themselves. */
  void
  Add(const WallAudit & other);

  /** Whether each edge joins as many triangles as regions meet there. Crossings do not count. */
  bool
  IsClosed() const
  {
    return oneSidedTriangles + repeatedTriangles + loneJunctions == 0;
  }

  bool
  IsSound() const
  {
    return this->IsClosed() && intersections.crossingPairs == 0;
  }
};

/** Joins surfaces by equal points, and counts. What is outside of all surfaces is a region, too. */
WallAudit
AuditWalls(const std::vector<SceneSurface> & surfaces, const itk::TriangleSurfaceAuditSettings & settings = {});

} // namespace rhombic

#endif
