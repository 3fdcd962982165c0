#include "itkTriangleSurfaceSmoothing.h"

#include "itkBoundedMoves.h"
#include "itkForEachBlock.h"
#include "itkPointStrata.h"

#include <algorithm>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;

constexpr SizeValueType SmoothedBlock = 4096;

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

/** Computes each point's normal anew: the triangles' normals weighted by their angles at the point. */
void
ComputeNormals(TriangleSurface & surface, const TrianglesOfPoints & fans)
{
  const Points & points = surface.GetPoints();
  ForEachInBlocks(points.size(), SmoothedBlock, [&](SizeValueType point) {
    PositionType sum{};
    fans.VisitNeighbours(point, [&](PointId next, PointId last) {
      const PositionType a = Difference(points[next], points[point]);
      const PositionType b = Difference(points[last], points[point]);
      const PositionType normal = Cross(a, b);
      const double length = Length(normal);
      const double angle = std::atan2(length, Dot(a, b));
      for (unsigned int axis = 0; axis < 3 && length > 0.0; ++axis)
      {
        sum[axis] += angle * normal[axis] / length;
      }
    });
    if (const double length = Length(sum); length > 0.0)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        surface.GetNormals()[point][axis] = static_cast<float>(sum[axis] / length);
      }
    }
  });
}

TriangleSurfaceSmoothingReport
MakeReport(const Points & start, const Points & points, const PointStrata & strata, double maximumMove)
{
  TriangleSurfaceSmoothingReport report;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const double move = Length(Difference(points[point], start[point]));
    report.meanMove += move / static_cast<double>(points.size());
    report.largestMove = std::max(report.largestMove, move);
    report.pointsAtLimit += move > 0.999 * maximumMove ? 1 : 0;
    report.pointsOnBorder += strata.strata[point] == Stratum::Fixed ? 1 : 0;
  }
  return report;
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
  if (surface.HasNormals())
  {
    ComputeNormals(surface, fans);
  }
  surface.Modified();
  return MakeReport(moves.GetStart(), points, strata, maximumMove);
}

} // namespace itk
