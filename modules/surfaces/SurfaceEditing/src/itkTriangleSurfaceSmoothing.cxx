#include "itkTriangleSurfaceSmoothing.h"

#include "detail/itkSheetSmoothing.h"

namespace itk
{
namespace
{

using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;

// Taubin's filter passes frequencies of the graph Laplacian up to 1 / Inwards + 1 / Outwards = 0.1, of [0, 2].
constexpr double Inwards = 0.5;
constexpr double Outwards = -1.0 / (1.0 / Inwards - 0.1);

/** A point moved by \a share of the way to the mean of its neighbours. */
PointType
MoveTowardsMean(const SheetNeighbours & neighbours, const Points & points, SizeValueType point, double share)
{
  const PositionType position = ToPosition(points[point]);
  PositionType sum{};
  const std::size_t count = neighbours.Visit(
    point, [&](std::uint32_t other) { sum = Add(sum, Subtract(ToPosition(points[other]), position)); });
  return count > 0 ? BoundedMoves::Move(points[point], share / static_cast<double>(count), sum) : points[point];
}

/** Steps towards and away from the means in turn, as one stage of the progress. */
void
TakeSmoothingSteps(const TriangleSurface & surface,
                   const TrianglesOfPoints & fans,
                   const PointStrata & strata,
                   unsigned int iterations,
                   BoundedMoves & moves,
                   rhombic::StagedProgress & progress,
                   double stageEnd)
{
  const SheetNeighbours neighbours(fans, strata);
  progress.Begin(stageEnd, 2 * iterations * surface.GetNumberOfPoints());
  for (unsigned int n = 0; n < 2 * iterations; ++n)
  {
    const double share = n % 2 == 0 ? Inwards : Outwards;
    moves.Step([&](SizeValueType point) { return MoveTowardsMean(neighbours, surface.GetPoints(), point, share); },
               progress);
  }
}

} // namespace

void
TriangleSurfaceSmoothingSettings::Verify() const
{
  if (!(maximumMove >= 0.0 && std::isfinite(maximumMove)))
  {
    itkGenericExceptionMacro("A point can't move by at most "
                             << maximumMove << " mm when a surface is smoothed; give a number from 0");
  }
  if (halfAxes &&
      !(std::abs(MoveBound::FindVolume(*halfAxes)) > 0.0 && std::isfinite(MoveBound::FindVolume(*halfAxes))))
  {
    itkGenericExceptionMacro("The half axes of the ellipsoid in which a point may move are not three directions in "
                             "space; give the edges of a voxel, for example");
  }
}

TriangleSurfaceSmoothingReport
SmoothTriangleSurface(TriangleSurface & surface,
                      const TriangleSurfaceSmoothingSettings & settings,
                      const rhombic::ProgressFunction & report)
{
  settings.Verify();
  rhombic::StagedProgress progress(report);
  const TrianglesOfPoints fans(surface);
  const PointStrata strata = FindStrata(surface, fans);
  BoundedMoves moves(surface, fans, MoveBound(settings));
  TakeSmoothingSteps(surface, fans, strata, settings.iterations, moves, progress, 0.7);
  moves.PutBackMeeting(progress, 1.0);
  surface.Modified();
  return moves.Finish(strata);
}

} // namespace itk
