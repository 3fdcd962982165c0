#ifndef itkTriangleSurfaceAudit_h
#define itkTriangleSurfaceAudit_h

#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceSolids.h"
#include "itkTriangleSurfaceTopology.h"

#include <iosfwd>

namespace itk
{

/** \class TriangleSurfaceAuditSettings
 * \brief Whether and how thoroughly an audit looks for self-intersections. */
struct TriangleSurfaceAuditSettings
{
  bool testsIntersections = true;
  SizeValueType maximumTestedTriangles = 5000000; ///< larger surfaces are tested by a sample
};

/** \class TriangleSurfaceAudit
 * \brief Measures and flaws of a surface. */
struct TriangleSurfaceAudit
{
  SizeValueType points = 0;
  SizeValueType triangles = 0;
  double area = 0.0;   ///< in mm^2
  double volume = 0.0; ///< in mm^3; meaningful only if the surface is closed
  TriangleSurfaceTopology topology;
  TriangleSurfaceQuality quality;
  TriangleSurfaceIntersections intersections; ///< has no tested triangles if the settings left it out
  ShellCounts shells; ///< see CountTriangleSurfaceShells(); all 0 unless the topology is watertight

  /** Closed, oriented and manifold, without degenerate or duplicate triangles, with a positive volume, outer shells
   * that face outwards and cavities that face inwards. */
  bool
  IsWatertight() const
  {
    return topology.IsWatertight() && topology.duplicateTriangles == 0 && volume > 0.0 && shells.misfacing == 0;
  }

  /** Watertight, with at least one triangle tested and no triangle that crosses another. Triangles may touch. */
  bool
  BoundsSolid() const
  {
    return this->IsWatertight() && intersections.testedTriangles > 0 && intersections.crossingPairs == 0;
  }
};

/** Computes all of the above on several threads, with the same result for any number of them. Memory about 50 bytes per
 * triangle. Throws ExceptionObject if a triangle refers to a missing point. */
TriangleSurfaceAudit
AuditTriangleSurface(const TriangleSurface & surface, const TriangleSurfaceAuditSettings & settings = {});

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceAudit & audit);

} // namespace itk

#endif
