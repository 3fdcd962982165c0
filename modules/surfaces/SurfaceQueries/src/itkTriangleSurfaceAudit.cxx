#include "itkTriangleSurfaceAudit.h"

#include "itkTriangleSurfaceMeasures.h"

#include <ostream>

namespace itk
{

TriangleSurfaceAudit
AuditTriangleSurface(const TriangleSurface & surface, const TriangleSurfaceAuditSettings & settings)
{
  surface.VerifyTriangles();
  TriangleSurfaceAudit audit;
  audit.points = surface.GetNumberOfPoints();
  audit.triangles = surface.GetNumberOfTriangles();
  audit.area = ComputeTriangleSurfaceArea(surface);
  audit.volume = ComputeTriangleSurfaceVolume(surface);
  audit.topology = ComputeTriangleSurfaceTopology(surface);
  audit.quality = ComputeTriangleSurfaceQuality(surface);
  const TriangleTree tree(surface);
  if (audit.topology.IsWatertight())
  {
    audit.shells = CountTriangleSurfaceShells(surface);
  }
  if (settings.testsIntersections)
  {
    audit.intersections = FindTriangleSurfaceSelfIntersections(tree, settings.maximumTestedTriangles);
  }
  return audit;
}

std::ostream &
operator<<(std::ostream & os, const TriangleSurfaceAudit & audit)
{
  return os << audit.points << " points, " << audit.triangles << " triangles, area " << audit.area << " mm^2, volume "
            << audit.volume << " mm^3, " << audit.topology << ", triangle quality " << audit.quality.mean
            << " on average and " << audit.quality.minimum << " at least, " << audit.intersections.crossingPairs
            << " crossing pairs, " << audit.intersections.touchingPairs << " touching pairs among "
            << audit.intersections.testedTriangles << " tested triangles";
}

} // namespace itk
