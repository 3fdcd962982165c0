#include "itkLabelWallsEditing.h"

#include "detail/itkSheetSmoothing.h"
#include "itkLabelVolumes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace itk
{
namespace
{

constexpr unsigned int MostCorrections = 16;
constexpr double SmallestLayer = 1e-3;             // to correct a volume by, of the largest move
constexpr double VolumeTolerance = 1e-5;           // share of volumes that are restored
constexpr double ToleranceAgain = 1e-4;            // the same after a few points were put back
constexpr double ShareForVolumes = 0.1;            // of the largest error of simplification
constexpr TriangleLimits WallLimits{ -0.9, 0.01 }; // the sides of a pit turn by much more than a right angle

/** The points that layers move, ascending: those of walls between labels of different layers. Fixed points stay. */
BulkVector<std::uint32_t>
FindPointsToMove(const LabelWalls & walls, const std::vector<double> & layers, const PointStrata & strata)
{
  BulkVector<std::uint8_t> isMoved(walls.GetNumberOfPoints(), 0);
  for (std::size_t id = 0; id < walls.GetNumberOfTriangles(); ++id)
  {
    const auto & [front, back] = walls.GetTriangleLabels()[id];
    if (layers[front] != layers[back])
    {
      for (const std::uint32_t point : walls.GetTriangles()[id])
      {
        isMoved[point] = strata.strata[point] != Stratum::Fixed ? 1 : 0;
      }
    }
  }
  return FindMarked(isMoved);
}

/** Where layers move a point of walls: as far as the triangles at the point sweep the layers' volume. */
TriangleSurface::PointType
MoveByLayers(const LabelWalls & walls,
             const TrianglesOfPoints & fans,
             const std::vector<double> & layers,
             std::uint32_t point)
{
  PositionType way{};
  double area = 0.0;
  double sum = 0.0; // of the squared layers
  fans.VisitTriangles(point, [&](std::uint32_t id) {
    const PositionType normal = AreaVector(CornersOf(walls, walls.GetTriangles()[id]));
    const auto & [front, back] = walls.GetTriangleLabels()[id];
    const double layer = layers[back] - layers[front];
    way = Along(way, normal, layer);
    area += Length(normal);
    sum += layer * layer * Length(normal);
  });
  return BoundedMoves::Move(walls.GetPoints()[point], sum > 0.0 ? std::min(2.0 / area, sum / Dot(way, way)) : 0.0, way);
}

/** Moves walls along their normals until each label has its volume, or points are as far as they may go: in each round
 * only the walls of labels that do not have it yet. Fixed points stay. This is one stage of the progress. */
void
RestoreVolumes(const LabelWalls & walls,
               const std::vector<double> & wanted,
               double tolerance,
               const TrianglesOfPoints & fans,
               const PointStrata & strata,
               BoundedMoves & moves,
               rhombic::StagedProgress & progress,
               double stageEnd)
{
  progress.Begin(stageEnd, MostCorrections);
  LabelVolumes volumes(wanted, tolerance);
  LabelSizes sizes(walls, wanted.size());
  std::vector<double> last(wanted.size());
  const auto isMovable = [least = SmallestLayer * moves.GetBound().GetLeast()](double layer, double before) {
    return std::abs(layer) > least &&
           (before == 0.0 || std::abs(layer) < 0.9 * std::abs(before)); // clearly thinner than before
  };
  for (unsigned int n = 0; n < MostCorrections; ++n)
  {
    const std::vector<double> & layers = volumes.FindLayers(sizes);
    if (!std::inner_product(layers.begin(), layers.end(), last.begin(), false, std::logical_or<>(), isMovable))
    {
      break;
    }
    last = layers;
    const auto points = FindPointsToMove(walls, layers, strata);
    const auto triangles = moves.FindTrianglesAt(points);
    moves.StepSome(points, triangles, [&](std::uint32_t point) { return MoveByLayers(walls, fans, layers, point); });
    sizes.Update(walls, triangles);

    progress.Completed(1);
  }
}

/** Strata in which points that have moved are fixed: others make up for the volumes that they have changed. */
PointStrata
HoldMoved(PointStrata strata,
          const TriangleSurface::PointsContainer & before,
          const TriangleSurface::PointsContainer & after)
{
  for (std::size_t point = 0; point < before.size(); ++point)
  {
    strata.strata[point] = before[point] == after[point] ? strata.strata[point] : Stratum::Fixed;
  }
  return strata;
}

} // namespace

TriangleSurfaceSmoothingReport
RelaxLabelWalls(LabelWalls & walls,
                const TriangleSurfaceSmoothingSettings & settings,
                const std::vector<double> & volumes,
                const rhombic::ProgressFunction & report)
{
  settings.Verify();
  rhombic::StagedProgress progress(report);
  auto wanted = walls.ComputeVolumes();
  for (std::size_t label = 1; label < std::min(wanted.size(), volumes.size()); ++label)
  {
    wanted[label] = volumes[label] > 0.0 ? volumes[label] : wanted[label];
  }
  const TrianglesOfPoints fans(walls);
  const PointStrata strata = FindStrata(walls, fans);
  BoundedMoves moves(walls, fans, MoveBound(settings), WallLimits);
  SmoothSheets(walls, fans, strata, settings.iterations, moves, progress, 0.5);
  RestoreVolumes(walls, wanted, VolumeTolerance, fans, strata, moves, progress, 0.7);
  const auto restored = walls.GetPoints();
  moves.PutBackMeeting(progress, 0.8);
  if (const auto putBack = walls.GetPoints(); putBack != restored)
  {
    RestoreVolumes(walls, wanted, ToleranceAgain, fans, HoldMoved(strata, restored, putBack), moves, progress, 0.9);
    moves.PutBackMeeting(progress, 1.0);
  }
  progress.Begin(1.0, 1);
  progress.Completed(1);
  walls.Modified();
  return moves.Finish(strata);
}

TriangleSurfaceSimplificationReport
SimplifyLabelWalls(LabelWalls & walls,
                   const TriangleSurfaceSimplificationSettings & settings,
                   const rhombic::ProgressFunction & report)
{
  constexpr double shareOfVolumes = 0.1; // of the work
  const auto reportFrom = [&report](double begin, double share) -> rhombic::ProgressFunction {
    return [&report, begin, share](double done) { report ? report(begin + share * done) : void(); };
  };
  const auto volumes = walls.ComputeVolumes();
  auto & labels = walls.GetTriangleLabels();
  std::vector<LabelWalls::LabelPairType> pairs(labels.begin(), labels.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  BulkVector<std::uint32_t> sheets;
  sheets.reserve(labels.size());
  for (const LabelWalls::LabelPairType & pair : labels)
  {
    sheets.push_back(static_cast<std::uint32_t>(std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin()));
  }
  TriangleSurfaceSimplificationSettings shared = settings;
  shared.maximumError *= 1.0 - ShareForVolumes;
  const auto result = SimplifyTriangleSurface(walls, sheets, shared, reportFrom(0.0, 1.0 - shareOfVolumes));
  labels.resize(sheets.size());
  std::transform(sheets.begin(), sheets.end(), labels.begin(), [&pairs](std::uint32_t sheet) { return pairs[sheet]; });
  if (std::isfinite(settings.maximumError))
  {
    TriangleSurfaceSmoothingSettings volumesOnly;
    volumesOnly.iterations = 0;
    volumesOnly.maximumMove = ShareForVolumes * settings.maximumError;
    RelaxLabelWalls(walls, volumesOnly, volumes, reportFrom(1.0 - shareOfVolumes, shareOfVolumes));
  }
  walls.Modified();
  return result;
}

} // namespace itk
