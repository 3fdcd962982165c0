#include "detail/itkBoundedMoves.h"

#include "itkTriangleSurfaceIntersections.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace itk
{
namespace
{

constexpr double SmallestCosineOfTurn = 0.1736; // cosine of 80 degrees
constexpr double SmallestShareOfArea = 0.1;

/** The triangles' normals at a point weighted by their angles there; zero if no triangle has an area. */
PositionType
SumNormals(const TriangleSurface::PointsContainer & points, const TrianglesOfPoints & fans, SizeValueType point)
{
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
  return sum;
}

} // namespace

BoundedMoves::BoundedMoves(TriangleSurface & surface, const TrianglesOfPoints & fans, double maximumMove)
  : m_Surface(surface)
  , m_Fans(fans)
  , m_MaximumMove(maximumMove)
  , m_Start(surface.GetPoints())
  , m_StartAreas(surface.GetNumberOfTriangles())
  , m_Next(surface.GetPoints())
{
  rhombic::ForEachInBlocks(m_StartAreas.size(), MovedBlock, [&](SizeValueType id) {
    m_StartAreas[id] = AreaVector(CornersOf(m_Start, std::as_const(m_Surface).GetTriangles()[id]));
  });
}

/** The position itself, or the nearest position that is not too far from \a start. */
BoundedMoves::PointType
BoundedMoves::LimitMove(const PointType & start, PointType position) const
{
  const PositionType way = Subtract(ToPosition(position), ToPosition(start));
  double reach = m_MaximumMove / Length(way);
  while (Distance(ToPosition(position), ToPosition(start)) > m_MaximumMove)
  {
    position = Move(start, reach, way);
    reach -= 1e-3 * reach; // rounding to float may exceed the limit slightly
  }
  return position;
}

/** Whether a triangle has turned or shrunk too much since the start. */
bool
BoundedMoves::IsSpoilt(std::uint32_t triangle) const
{
  const PositionType & before = m_StartAreas[triangle];
  const PositionType after = AreaVector(CornersOf(m_Next, std::as_const(m_Surface).GetTriangles()[triangle]));
  const double cosine = Dot(before, after);
  const double squareBefore = Dot(before, before);
  const double squareAfter = Dot(after, after);
  return !(cosine >= 0.0 &&
           cosine * cosine >= SmallestCosineOfTurn * SmallestCosineOfTurn * squareBefore * squareAfter &&
           squareAfter >= SmallestShareOfArea * SmallestShareOfArea * squareBefore);
}

void
BoundedMoves::FinishStep()
{
  const auto findSpoilt = [this](std::size_t begin, std::size_t end, std::vector<std::uint32_t> & spoilt) {
    for (auto id = static_cast<std::uint32_t>(begin); id < end; ++id)
    {
      if (this->IsSpoilt(id))
      {
        spoilt.push_back(id);
      }
    }
  };
  this->PutBack(CollectIds(m_Surface.GetNumberOfTriangles(), MovedBlock, findSpoilt));
  m_Surface.GetPoints().swap(m_Next);
}

/** Puts the next points of some triangles back to the surface's points. That may spoil other triangles at these points:
 * puts them back, too. Returns the points that were put back. */
std::vector<std::uint32_t>
BoundedMoves::PutBack(std::vector<std::uint32_t> spoilt)
{
  std::vector<std::uint32_t> putBack;
  for (std::size_t done = 0; !spoilt.empty(); done = putBack.size())
  {
    for (const std::uint32_t id : spoilt)
    {
      for (const std::uint32_t point : std::as_const(m_Surface).GetTriangles()[id])
      {
        if (m_Next[point] != m_Surface.GetPoints()[point])
        {
          m_Next[point] = m_Surface.GetPoints()[point];
          putBack.push_back(point);
        }
      }
    }
    spoilt.clear();
    for (std::size_t n = done; n < putBack.size(); ++n)
    {
      m_Fans.VisitTriangles(putBack[n], [&](std::uint32_t id) {
        if (this->IsSpoilt(id))
        {
          spoilt.push_back(id);
        }
      });
    }
  }
  return putBack;
}

/** Puts the points of some triangles back to their start, and those of triangles that have then turned or shrunk too
 * much. Returns the triangles at points that had moved, ascending. */
std::vector<std::uint32_t>
BoundedMoves::PutBackToStart(const std::vector<std::uint32_t> & triangles)
{
  m_Next.swap(m_Surface.GetPoints());
  m_Surface.GetPoints() = m_Start;
  std::vector<std::uint32_t> changed;
  for (const std::uint32_t point : this->PutBack(triangles))
  {
    m_Fans.VisitTriangles(point, [&](std::uint32_t id) { changed.push_back(id); });
  }
  m_Surface.GetPoints().swap(m_Next);
  SortUnique(changed);
  return changed;
}

void
BoundedMoves::PutBackMeeting(rhombic::StagedProgress & progress, double stageEnd)
{
  const TriangleTree tree(m_Surface); // keeps the places that triangles had before they are put back
  std::set<std::uint32_t> putBack;
  auto meeting = FindCrossingTriangles(tree, m_Fans, TriangleContact::Touching, &progress, stageEnd);
  while (!meeting.empty())
  {
    progress.Completed(0);
    const auto latest = this->PutBackToStart(meeting);
    putBack.insert(latest.begin(), latest.end());
    const TriangleTree others(m_Surface, { putBack.begin(), putBack.end() });
    meeting = FindCrossingTriangles(tree, latest, TriangleContact::Touching);
    const auto more = FindCrossingTriangles(others, latest, TriangleContact::Touching);
    meeting.insert(meeting.end(), more.begin(), more.end());
  }
}

TriangleSurfaceSmoothingReport
BoundedMoves::Finish(const PointStrata & strata)
{
  const Points & points = m_Surface.GetPoints();
  auto & normals = m_Surface.GetNormals();
  rhombic::ForEachInBlocks(normals.size(), MovedBlock, [&](SizeValueType point) {
    const PositionType sum = SumNormals(points, m_Fans, point);
    const double length = Length(sum);
    for (unsigned int axis = 0; axis < 3 && length > 0.0; ++axis)
    {
      normals[point][axis] = static_cast<float>(sum[axis] / length);
    }
  });
  TriangleSurfaceSmoothingReport report;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const double move = Distance(ToPosition(points[point]), ToPosition(m_Start[point]));
    report.meanMove += move / static_cast<double>(points.size());
    report.largestMove = std::max(report.largestMove, move);
    report.pointsAtLimit += move > 0.999 * m_MaximumMove ? 1 : 0;
    report.pointsOnBorder += strata.strata[point] == Stratum::Fixed ? 1 : 0;
  }
  return report;
}

} // namespace itk
