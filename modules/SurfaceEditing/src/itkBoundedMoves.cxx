#include "itkBoundedMoves.h"

#include "itkForEachBlock.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;

constexpr SizeValueType MovedBlock = 4096;
constexpr double SmallestCosineOfTurn = 0.1736; // cosine of 80 degrees
constexpr double SmallestShareOfArea = 0.1;

/** The position itself, or the nearest one that is not farther than \a maximumMove from \a start. */
PointType
LimitMove(const PointType & start, PointType position, double maximumMove)
{
  const PositionType way = Subtract(ToPosition(position), ToPosition(start));
  double reach = maximumMove / Length(way);
  while (Length(Subtract(ToPosition(position), ToPosition(start))) > maximumMove)
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

/** Computes each point's normal anew: the triangles' normals weighted by their angles at the point. */
void
ComputeNormals(TriangleSurface & surface, const TrianglesOfPoints & fans)
{
  const Points & points = surface.GetPoints();
  ForEachInBlocks(points.size(), MovedBlock, [&](SizeValueType point) {
    PositionType sum{};
    fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t last) {
      const PositionType a = Subtract(ToPosition(points[next]), ToPosition(points[point]));
      const PositionType b = Subtract(ToPosition(points[last]), ToPosition(points[point]));
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

} // namespace

BoundedMoves::BoundedMoves(TriangleSurface & surface, double maximumMove)
  : m_Surface(surface)
  , m_MaximumMove(maximumMove)
  , m_Start(surface.GetPoints())
  , m_Next(surface.GetPoints())
{}

BoundedMoves::PointType
BoundedMoves::Move(const PointType & point, double factor, const PositionType & way)
{
  PointType moved;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    moved[axis] = static_cast<float>(point[axis] + factor * way[axis]);
  }
  return moved;
}

void
BoundedMoves::Step(const std::function<PointType(SizeValueType point)> & find)
{
  ForEachInBlocks(m_Next.size(), MovedBlock, [&](SizeValueType point) {
    m_Next[point] = LimitMove(m_Start[point], find(point), m_MaximumMove);
  });
  std::vector<std::uint8_t> isPutBack(m_Next.size(), 1); // in the last round; in the first, all are tested
  while (this->PutBackBadMoves(isPutBack))
  {}
  m_Surface.GetPoints().swap(m_Next);
}

bool
BoundedMoves::PutBackToStart(const std::vector<std::uint32_t> & triangles)
{
  Points & points = m_Surface.GetPoints();
  m_Next.swap(points);
  points = m_Start;
  std::vector<std::uint8_t> isPutBack(m_Next.size(), 0);
  bool isAnyPutBack = false;
  for (const std::uint32_t id : triangles)
  {
    for (const std::uint32_t point : m_Surface.GetTriangles()[id])
    {
      isPutBack[point] = isPutBack[point] | (m_Next[point] != m_Start[point] ? 1 : 0);
      isAnyPutBack = isAnyPutBack || isPutBack[point];
      m_Next[point] = m_Start[point];
    }
  }
  while (this->PutBackBadMoves(isPutBack))
  {}
  points.swap(m_Next);
  return isAnyPutBack;
}

TriangleSurfaceSmoothingReport
BoundedMoves::Finish(const TrianglesOfPoints & fans, const PointStrata & strata)
{
  if (m_Surface.HasNormals())
  {
    ComputeNormals(m_Surface, fans);
  }
  const Points & points = m_Surface.GetPoints();
  TriangleSurfaceSmoothingReport report;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const double move = Length(Subtract(ToPosition(points[point]), ToPosition(m_Start[point])));
    report.meanMove += move / static_cast<double>(points.size());
    report.largestMove = std::max(report.largestMove, move);
    report.pointsAtLimit += move > 0.999 * m_MaximumMove ? 1 : 0;
    report.pointsOnBorder += strata.strata[point] == Stratum::Fixed ? 1 : 0;
  }
  return report;
}

/** Puts the points of spoilt triangles back to where they were before the step. That may spoil other triangles at these
 * points: tests those at points that were put back, and returns whether any other was. */
bool
BoundedMoves::PutBackBadMoves(std::vector<std::uint8_t> & isPutBack)
{
  const auto & triangles = m_Surface.GetTriangles();
  std::vector<std::uint8_t> isSpoilt(triangles.size());
  ForEachInBlocks(triangles.size(), MovedBlock, [&](SizeValueType id) {
    const auto & [a, b, c] = triangles[id];
    isSpoilt[id] = (isPutBack[a] | isPutBack[b] | isPutBack[c]) != 0 && IsSpoilt(m_Start, m_Next, triangles[id]);
  });
  std::fill(isPutBack.begin(), isPutBack.end(), std::uint8_t{ 0 });
  bool isAnyPutBack = false;
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    for (unsigned int corner = 0; isSpoilt[id] && corner < 3; ++corner)
    {
      const std::uint32_t point = triangles[id][corner];
      if (m_Next[point] != m_Surface.GetPoints()[point])
      {
        m_Next[point] = m_Surface.GetPoints()[point];
        isPutBack[point] = 1;
        isAnyPutBack = true;
      }
    }
  }
  return isAnyPutBack;
}

} // namespace itk
