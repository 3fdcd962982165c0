#include "itkLabelWallsEditing.h"

#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleSurfaceIntersections.h"

namespace itk
{
namespace
{

/** Puts the points of triangles that cross others back to their start, until none does. */
void
PutBackCrossing(LabelWalls & walls, const LabelWalls::PointsContainer & start)
{
  const TrianglesOfPoints fans(walls);
  for (bool isAnyPutBack = true; isAnyPutBack;)
  {
    isAnyPutBack = false;
    for (const std::uint32_t triangle : FindCrossingTriangles(TriangleTree(walls), fans))
    {
      for (const std::uint32_t point : walls.GetTriangles()[triangle])
      {
        isAnyPutBack = isAnyPutBack || walls.GetPoints()[point] != start[point];
        walls.GetPoints()[point] = start[point];
      }
    }
  }
}

} // namespace

TriangleSurfaceSmoothingReport
RelaxWalls(LabelWalls & walls, const TriangleSurfaceSmoothingSettings & settings)
{
  const LabelWalls::PointsContainer start = walls.GetPoints();
  const TriangleSurfaceSmoothingReport report = SmoothSurface(walls, settings);
  PutBackCrossing(walls, start);
  return report;
}

} // namespace itk
