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
constexpr double ShareForVolumes = 0.1;            // of the largest error of simplification
constexpr TriangleLimits WallLimits{ -0.9, 0.01 }; // the sides of a pit turn by much more than a right angle

/** Moves walls along their normals until each label has its volume, or points are as far as they may go. Fixed points
 * stay. This is one stage of the progress. */
void
RestoreVolumes(const LabelWalls & walls,
               const std::vector<double> & wanted,
               const TrianglesOfPoints & fans,
               const PointStrata & strata,
               BoundedMoves & moves,
               rhombic::StagedProgress & progress,
               double stageEnd)
{
  progress.Begin(stageEnd, MostCorrections * walls.GetNumberOfPoints());
  LabelVolumes volumes(wanted);
  std::vector<double> last(wanted.size(), std::numeric_limits<double>::infinity());
  const auto isMovable = [least = SmallestLayer * moves.GetBound().GetLeast()](double layer, double before) {
    return std::abs(layer) > least && std::abs(layer) < 0.9 * std::abs(before); // clearly thinner than before
  };
  for (unsigned int n = 0; n < MostCorrections; ++n)
  {
    const std::vector<double> & layers = volumes.FindLayers(walls);
    if (!std::inner_product(layers.begin(), layers.end(), last.begin(), false, std::logical_or<>(), isMovable))
    {
      break;
    }
    last = layers;
    moves.Step(
      [&](SizeValueType point) {
        PositionType way{};
        double area = 0.0;
        double sum = 0.0; // of the squared layers
        fans.VisitTriangles(point, [&](std::uint32_t id) {
          const PositionType normal = AreaVector(CornersOf(walls, walls.GetTriangles()[id]));
          const auto & [front, back] = walls.GetTriangleLabels()[id];
          const double layer = layers[back] - layers[front];
          way = Add(way, { layer * normal[0], layer * normal[1], layer * normal[2] });
          area += Length(normal);
          sum += layer * layer * Length(normal);
        });
        // As far as the triangles at the point sweep the layers' volume.
        const bool isMoved = sum > 0.0 && strata.strata[point] != Stratum::Fixed;
        return BoundedMoves::Move(
          walls.GetPoints()[point], isMoved ? std::min(2.0 / area, sum / Dot(way, way)) : 0.0, way);
      },
      progress);
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
  RestoreVolumes(walls, wanted, fans, strata, moves, progress, 0.7);
  const auto restored = walls.GetPoints();
  moves.PutBackMeeting(progress, 0.8);
  if (const auto putBack = walls.GetPoints(); putBack != restored)
  {
    RestoreVolumes(walls, wanted, fans, HoldMoved(strata, restored, putBack), moves, progress, 0.9);
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
  std::vector<std::uint32_t> sheets;
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
