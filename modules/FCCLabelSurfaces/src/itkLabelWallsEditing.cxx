#include "itkLabelWallsEditing.h"

#include "itkBoundedMoves.h"
#include "itkTriangleSurfaceIntersections.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr unsigned int VolumeCorrections = 16;
constexpr double ShareForVolumes = 0.1; // of the largest error of simplification

/** Moves walls along their normals until each label has its volume, or points are as far as they may go. A wall moves
 * by the sum of what its labels want: each a layer on all of its surface as large as what it lacks. Fixed points stay.
 */
void
RestoreVolumes(LabelWalls & walls,
               const std::vector<LabelWalls::Measures> & wanted,
               const TrianglesOfPoints & fans,
               const PointStrata & strata,
               BoundedMoves & moves)
{
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
      if (strata.strata[point] == Stratum::Fixed)
      {
        return walls.GetPoints()[point];
      }
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

/** Restores volumes, and puts points of triangles that then meet others back to their start. */
TriangleSurfaceSmoothingReport
FinishMoves(LabelWalls & walls,
            const std::vector<LabelWalls::Measures> & wanted,
            const TrianglesOfPoints & fans,
            const PointStrata & strata,
            BoundedMoves & moves)
{
  RestoreVolumes(walls, wanted, fans, strata, moves);
  TriangleTree tree(walls);
  auto meeting = FindCrossingTriangles(tree, fans, TriangleContact::Touching);
  while (!meeting.empty())
  {
    const auto before = walls.GetPoints();
    const auto changed = moves.PutBackToStart(meeting);
    for (const std::uint32_t id : changed)
    {
      tree.Enlarge(TriangleTree::BoxOf(before, walls.GetTriangles()[id]), tree.GetTriangleBox(id));
    }
    meeting = FindCrossingTriangles(tree, changed, TriangleContact::Touching);
  }
  return moves.Finish(strata);
}

} // namespace

TriangleSurfaceSmoothingReport
RelaxWalls(LabelWalls & walls, const TriangleSurfaceSmoothingSettings & settings, const std::vector<double> & volumes)
{
  auto wanted = walls.ComputeMeasures();
  for (std::size_t label = 1; label < std::min(wanted.size(), volumes.size()); ++label)
  {
    wanted[label].volume = volumes[label] > 0.0 ? volumes[label] : wanted[label].volume;
  }
  const TrianglesOfPoints fans(walls);
  const PointStrata strata = FindStrata(walls, fans);
  BoundedMoves moves(walls, fans, settings.maximumMove);
  TakeSmoothingSteps(walls, fans, strata, settings.iterations, moves);
  const TriangleSurfaceSmoothingReport report = FinishMoves(walls, wanted, fans, strata, moves);
  walls.Modified();
  return report;
}

TriangleSurfaceSimplificationReport
SimplifyWalls(LabelWalls & walls, const TriangleSurfaceSimplificationSettings & settings)
{
  const auto measures = walls.ComputeMeasures();
  auto & labels = walls.GetTriangleLabels();
  std::vector<LabelWalls::LabelPairType> pairs(labels.begin(), labels.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::uint32_t> sheets;
  sheets.reserve(labels.size());
  for (const LabelWalls::LabelPairType & pair : labels)
  {
    sheets.push_back(static_cast<std::uint32_t>(std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin()));
  }
  TriangleSurfaceSimplificationSettings shared = settings;
  shared.maximumError *= 1.0 - ShareForVolumes;
  const auto report = SimplifySurface(walls, sheets, shared);
  labels.resize(sheets.size());
  std::transform(sheets.begin(), sheets.end(), labels.begin(), [&pairs](std::uint32_t sheet) { return pairs[sheet]; });
  if (std::isfinite(settings.maximumError))
  {
    const TrianglesOfPoints fans(walls);
    BoundedMoves moves(walls, fans, ShareForVolumes * settings.maximumError);
    FinishMoves(walls, measures, fans, FindStrata(walls, fans), moves);
  }
  walls.Modified();
  return report;
}

} // namespace itk
