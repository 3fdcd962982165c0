#include "itkBoundedMoves.h"
#include "itkLabelWallsEditing.h"

#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleSurfaceIntersections.h"

namespace itk
{
namespace
{

constexpr unsigned int VolumeCorrections = 8;

/** Moves walls along their normals until each label has its volume, or points are as far as they may go. A wall moves
 * by the sum of what its labels want: each a layer on all of its surface as large as what it lacks. */
void
RestoreVolumes(LabelWalls & walls, const std::vector<LabelWalls::Measures> & wanted, BoundedMoves & moves)
{
  const TrianglesOfPoints fans(walls);
  for (unsigned int n = 0; n < VolumeCorrections; ++n)
  {
    const auto measures = walls.ComputeMeasures();
    std::vector<double> layers(measures.size(), 0.0); // mm; outside takes what is left
    for (std::size_t label = 1; label < layers.size(); ++label)
    {
      const double lacking = wanted[label].volume - measures[label].volume;
      layers[label] = measures[label].area > 0.0 ? lacking / measures[label].area : 0.0;
    }
    moves.Step([&](SizeValueType point) {
      PositionType way{};
      double area = 0.0;
      fans.VisitTriangles(point, [&](std::uint32_t id) {
        const PositionType normal = AreaVector(CornersOf(walls, walls.GetTriangles()[id]));
        const auto & [front, back] = walls.GetTriangleLabels()[id];
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          way[axis] += (layers[back] - layers[front]) * normal[axis];
        }
        area += Length(normal);
      });
      return BoundedMoves::Move(walls.GetPoints()[point], area > 0.0 ? 1.0 / area : 0.0, way);
    });
  }
}

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
  const auto measures = walls.ComputeMeasures();
  BoundedMoves moves(walls, settings.maximumMove);
  const TriangleSurfaceSmoothingReport report = SmoothSurface(walls, settings);
  RestoreVolumes(walls, measures, moves);
  PutBackCrossing(walls, moves.GetStart());
  walls.Modified();
  return report;
}

} // namespace itk
