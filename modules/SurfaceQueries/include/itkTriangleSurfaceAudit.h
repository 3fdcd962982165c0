#ifndef itkTriangleSurfaceAudit_h
#define itkTriangleSurfaceAudit_h

#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceQuality.h"
#include "itkTriangleSurfaceSolids.h"
#include "itkTriangleSurfaceTopology.h"

#include <iosfwd>

namespace itk
{

/** \class TriangleSurfaceAuditSettings
 * \brief What an audit looks for.
 *
 * Thread safety: a value. */
struct TriangleSurfaceAuditSettings
{
  bool testsIntersections = true;
  SizeValueType maximumTestedTriangles = 5000000; ///< of larger surfaces, a sample is tested for intersections
};

/** \class TriangleSurfaceAudit
 * \brief All that can be said against a surface.
 *
 * Thread safety: a value. */
struct TriangleSurfaceAudit
{
  SizeValueType points = 0;
  SizeValueType triangles = 0;
  double area = 0.0;   ///< in mm^2
  double volume = 0.0; ///< in mm^3; meaningful if the surface is closed
  TriangleSurfaceTopology topology;
  TriangleSurfaceQuality quality;
  TriangleSurfaceIntersections intersections; ///< without tested triangles if they were not looked for
  ShellCounts shells;                         ///< see CountShells(); counted if the topology is watertight

  /** Closed, oriented, manifold, with neither degenerate nor duplicate triangles, around a positive volume, and with
   * all shells outwards and all cavities inwards. */
  bool
  IsWatertight() const
  {
    return topology.IsWatertight() && topology.duplicateTriangles == 0 && volume > 0.0 && shells.misfacing == 0;
  }

  /** Watertight, and none of the triangles tested crosses another; false if none was tested. Triangles may touch. */
  bool
  BoundsSolid() const
  {
    return this->IsWatertight() && intersections.testedTriangles > 0 && intersections.crossingPairs == 0;
  }
};

/** Computes all of the above, with several threads; the same for any number of them, and but for the last digits of
 * sums for any order of the triangles. Memory about 50 bytes a triangle. Throws ExceptionObject if a triangle has a
 * point that the surface has not. Thread safe. */
TriangleSurfaceAudit
AuditSurface(const TriangleSurface & surface, const TriangleSurfaceAuditSettings & settings = {});

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceAudit & audit);

} // namespace itk

#endif
