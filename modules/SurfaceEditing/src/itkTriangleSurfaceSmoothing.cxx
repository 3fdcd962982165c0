#include "itkTriangleSurfaceSmoothing.h"

#include "detail/itkPositionArithmetic.h"
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
using Triangles = TriangleSurface::TrianglesContainer;
using Flags = std::vector<std::uint8_t>;

constexpr SizeValueType SmoothedBlock = 4096;

// Taubin's filter passes frequencies of the graph Laplacian up to 1 / Inwards + 1 / Outwards = 0.1, of [0, 2].
constexpr double Inwards = 0.5;
constexpr double Outwards = -1.0 / (1.0 / Inwards - 0.1);

constexpr double SmallestCosineOfTurn = 0.1736; // cosine of 80 degrees
constexpr double SmallestShareOfArea = 0.1;

PositionType
Difference(const PointType & a, const PointType & b)
{
  return Subtract(ToPosition(a), ToPosition(b));
}

/** A point moved by a multiple of a vector. */
PointType
Move(const PointType & point, double factor, const PositionType & way)
{
  PointType moved;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    moved[axis] = static_cast<float>(point[axis] + factor * way[axis]);
  }
  return moved;
}

/** A point moved by \a share of the way to the mean of its neighbours. */
PointType
MoveTowardsMean(const Points & points, const TrianglesOfPoints & fans, SizeValueType point, double share)
{
  PositionType sum{};
  fans.VisitNeighbours(point, [&](PointId next, PointId) { sum = Add(sum, Difference(points[next], points[point])); });
  return Move(points[point], share / static_cast<double>(fans.GetNumberOfTriangles(point)), sum);
}

/** The same along a curve. */
PointType
MoveTowardsMean(const Points & points, const CurvePoint & place, double share)
{
  const auto & [point, neighbours] = place;
  return Move(points[point],
              0.5 * share,
              Add(Difference(points[neighbours[0]], points[point]), Difference(points[neighbours[1]], points[point])));
}

/** The position itself, or the nearest one that is not farther than \a maximumMove from \a start. */
PointType
LimitMove(const PointType & start, PointType position, double maximumMove)
{
  const PositionType way = Difference(position, start);
  double reach = maximumMove / Length(way);
  while (Length(Difference(position, start)) > maximumMove)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<float>(start[axis] + reach * way[axis]);
    }
    reach -= 1e-3 * reach; // rounding to float may exceed the limit slightly
  }
  return position;
}

/** Whether a triangle has turned or shrunk too much since the start. */
bool
IsSpoilt(const Points & start, const Points & points, const TriangleSurface::TriangleType & triangle)
{
  const auto areaVector = [&triangle](const Points & positions) {
    return AreaVector(
      { ToPosition(positions[triangle[0]]), ToPosition(positions[triangle[1]]), ToPosition(positions[triangle[2]]) });
  };
  const PositionType vectorBefore = areaVector(start);
  const PositionType vectorAfter = areaVector(points);
  const double areaBefore = Length(vectorBefore);
  const double areaAfter = Length(vectorAfter);
  return !(Dot(vectorBefore, vectorAfter) >= SmallestCosineOfTurn * areaBefore * areaAfter &&
           areaAfter >= SmallestShareOfArea * areaBefore);
}

/** Puts the points of spoilt triangles back to where they were before the step. That may spoil other triangles: returns
 * whether any point was put back. */
bool
PutBackBadMoves(const Triangles & triangles, const Points & start, const Points & before, Points & points)
{
  Flags isSpoilt(triangles.size());
  ForEachInBlocks(triangles.size(), SmoothedBlock, [&](SizeValueType id) {
    isSpoilt[id] = IsSpoilt(start, points, triangles[id]) ? 1 : 0;
  });
  bool isAnyPutBack = false;
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    for (unsigned int corner = 0; isSpoilt[id] && corner < 3; ++corner)
    {
      const PointId point = triangles[id][corner];
      isAnyPutBack = isAnyPutBack || points[point] != before[point];
      points[point] = before[point];
    }
  }
  return isAnyPutBack;
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
  Points & points = surface.GetPoints();
  const Points start = points;
  Points next = points;
  const auto step = [&](double share) {
    ForEachInBlocks(points.size(), SmoothedBlock, [&](SizeValueType point) {
      next[point] = strata.strata[point] == Stratum::Sheet
                      ? LimitMove(start[point], MoveTowardsMean(points, fans, point, share), maximumMove)
                      : points[point];
    });
    ForEachInBlocks(strata.curves.size(), SmoothedBlock, [&](SizeValueType n) {
      const PointId point = strata.curves[n].point;
      next[point] = LimitMove(start[point], MoveTowardsMean(points, strata.curves[n], share), maximumMove);
    });
    while (PutBackBadMoves(surface.GetTriangles(), start, points, next))
    {}
    points.swap(next);
  };
  for (unsigned int iteration = 0; iteration < settings.iterations; ++iteration)
  {
    step(Inwards);
    step(Outwards);
  }
  if (surface.HasNormals())
  {
    ComputeNormals(surface, fans);
  }
  surface.Modified();
  return MakeReport(start, points, strata, maximumMove);
}

} // namespace itk
