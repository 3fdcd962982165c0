#include "itkTriangleSurfaceSmoothing.h"

#include "itkBoundedMoves.h"

#include <cmath>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;

// Taubin's filter passes frequencies of the graph Laplacian up to 1 / Inwards + 1 / Outwards = 0.1, of [0, 2].
constexpr double Inwards = 0.5;
constexpr double Outwards = -1.0 / (1.0 / Inwards - 0.1);

PositionType
Difference(const PointType & a, const PointType & b)
{
  return Subtract(ToPosition(a), ToPosition(b));
}

/** A point moved by \a share of the way to the mean of its neighbours. */
PointType
MoveTowardsMean(const Points & points, const TrianglesOfPoints & fans, SizeValueType point, double share)
{
  PositionType sum{};
  fans.VisitNeighbours(point, [&](PointId next, PointId) { sum = Add(sum, Difference(points[next], points[point])); });
  return BoundedMoves::Move(points[point], share / static_cast<double>(fans.GetNumberOfTriangles(point)), sum);
}

/** The same along a curve. */
PointType
MoveAlongCurve(const Points & points, const PointStrata & strata, SizeValueType point, double share)
{
  const auto & [a, b] = strata.FindNeighboursOnCurve(static_cast<PointId>(point));
  return BoundedMoves::Move(
    points[point], 0.5 * share, Add(Difference(points[a], points[point]), Difference(points[b], points[point])));
}

} // namespace

TriangleSurfaceSmoothingReport
SmoothSurface(TriangleSurface & surface, const TriangleSurfaceSmoothingSettings & settings)
{
  const double maximumMove = settings.maximumMove;
  if (!(maximumMove >= 0.0 && std::isfinite(maximumMove)))
  {
    itkGenericExceptionMacro("A point can't move by at most "
                             << maximumMove << " mm when a surface is smoothed; give a number from 0");
  }
  const TrianglesOfPoints fans(surface);
  const PointStrata strata = FindStrata(surface, fans);
  const Points & points = surface.GetPoints();
  BoundedMoves moves(surface, maximumMove);
  for (unsigned int n = 0; n < 2 * settings.iterations; ++n)
  {
    const double share = n % 2 == 0 ? Inwards : Outwards;
    moves.Step([&](SizeValueType point) {
      const Stratum stratum = strata.strata[point];
      return stratum == Stratum::Sheet   ? MoveTowardsMean(points, fans, point, share)
             : stratum == Stratum::Curve ? MoveAlongCurve(points, strata, point, share)
                                         : points[point];
    });
  }
  surface.Modified();
  return moves.Finish(fans, strata);
}

} // namespace itk
