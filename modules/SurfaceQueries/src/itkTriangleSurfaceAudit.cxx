#include "itkTriangleSurfaceAudit.h"

#include "itkTriangleSurfaceMeasures.h"

#include <ostream>

namespace itk
{
namespace
{

void
CheckIndices(const TriangleSurface & surface)
{
  const auto & triangles = surface.GetTriangles();
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    const std::uint32_t highest = *std::max_element(triangles[n].begin(), triangles[n].end());
    if (highest >= surface.GetNumberOfPoints())
    {
      itkGenericExceptionMacro("Triangle " << n << " has the point " << highest << ", but the surface has only "
                                           << surface.GetNumberOfPoints()
                                           << " points; write the surface again from its source");
    }
  }
}

} // namespace

TriangleSurfaceAudit
AuditSurface(const TriangleSurface & surface, const TriangleSurfaceAuditSettings & settings)
{
  CheckIndices(surface);
  TriangleSurfaceAudit audit;
  audit.points = surface.GetNumberOfPoints();
  audit.triangles = surface.GetNumberOfTriangles();
  audit.area = ComputeArea(surface);
  audit.volume = ComputeVolume(surface);
  audit.topology = ComputeTopology(surface);
  audit.quality = ComputeQuality(surface);
  const TriangleTree tree(surface);
  if (audit.topology.IsWatertight())
  {
    audit.shells = CountShells(tree);
  }
  if (settings.testsIntersections)
  {
    audit.intersections = FindSelfIntersections(tree, settings.maximumTestedTriangles);
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
