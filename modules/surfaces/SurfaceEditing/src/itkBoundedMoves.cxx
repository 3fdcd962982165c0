#include "detail/itkBoundedMoves.h"

#include "itkTriangleSurfaceIntersections.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

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

MoveBound::MoveBound(const TriangleSurfaceSmoothingSettings & settings)
  : m_PerMove(1.0 / settings.maximumMove)
  , m_Least(settings.maximumMove)
{
  if (settings.halfAxes)
  {
    const auto & [a, b, c] = *settings.halfAxes;
    const double perVolume = 1.0 / FindVolume(*settings.halfAxes);
    m_ToUnit = { Scaled(Cross(b, c), perVolume), Scaled(Cross(c, a), perVolume), Scaled(Cross(a, b), perVolume) };
    m_Least = std::min({ m_Least, Length(a), Length(b), Length(c) });
  }
}

BoundedMoves::BoundedMoves(TriangleSurface & surface,
                           const TrianglesOfPoints & fans,
                           const MoveBound & bound,
                           const TriangleLimits & limits)
  : m_Surface(surface)
  , m_Fans(fans)
  , m_Bound(bound)
  , m_Limits(limits)
  , m_Start(surface.GetPoints())
  , m_StartAreas(surface.GetNumberOfTriangles())
  , m_Next(surface.GetNumberOfPoints())
{
  rhombic::ForEachInBlocks(m_StartAreas.size(), MovedBlock, [&](SizeValueType id) {
    m_StartAreas[id] = AreaVector(CornersOf(m_Start, std::as_const(m_Surface).GetTriangles()[id]));
  });
}

/** The position itself, or the last position on the way from \a start that is in bounds. */
BoundedMoves::PointType
BoundedMoves::LimitMove(const PointType & start, PointType position) const
{
  const PositionType way = Subtract(ToPosition(position), ToPosition(start));
  double reach = 1.0 / m_Bound.Measure(way);
  while (m_Bound.Measure(Subtract(ToPosition(position), ToPosition(start))) > 1.0)
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
  const double lengthBefore = Length(before);
  const double lengthAfter = Length(after);
  return !(Dot(before, after) >= m_Limits.leastCosineOfTurn * lengthBefore * lengthAfter &&
           lengthAfter >= m_Limits.leastShareOfArea * lengthBefore);
}

BulkVector<std::uint32_t>
BoundedMoves::FindSpoilt() const
{
  return CollectIds(
    m_StartAreas.size(), MovedBlock, [this](std::size_t begin, std::size_t end, BulkVector<std::uint32_t> & spoilt) {
      for (auto id = static_cast<std::uint32_t>(begin); id < end; ++id)
      {
        if (this->IsSpoilt(id))
        {
          spoilt.push_back(id);
        }
      }
    });
}

/** The spoilt triangles of some, in their order. */
BulkVector<std::uint32_t>
BoundedMoves::FindSpoilt(const BulkVector<std::uint32_t> & triangles) const
{
  BulkVector<std::uint8_t> areSpoilt(triangles.size());
  rhombic::ForEachInBlocks(
    triangles.size(), MovedBlock, [&](SizeValueType n) { areSpoilt[n] = this->IsSpoilt(triangles[n]) ? 1 : 0; });
  BulkVector<std::uint32_t> spoilt;
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    if (areSpoilt[n] != 0)
    {
      spoilt.push_back(triangles[n]);
    }
  }
  return spoilt;
}

/** Puts the next points of spoilt triangles back to the surface's points. That may spoil other triangles at these
 * points: puts them back, too. */
void
BoundedMoves::PutBackSpoilt(BulkVector<std::uint32_t> spoilt)
{
  while (!spoilt.empty())
  {
    BulkVector<std::uint32_t> next;
    for (const std::uint32_t point : this->FindCorners(spoilt))
    {
      if (m_Next[point] != m_Surface.GetPoints()[point])
      {
        m_Next[point] = m_Surface.GetPoints()[point];
        m_Fans.VisitTriangles(point, [&](std::uint32_t id) { next.push_back(id); });
      }
    }
    SortUnique(next);
    next.erase(std::remove_if(next.begin(), next.end(), [this](std::uint32_t id) { return !this->IsSpoilt(id); }),
               next.end());
    spoilt.swap(next);
  }
}

/** Copies the positions of the corners of some triangles, or all positions where these are many: on threads, as no two
 * of them write the same. Others do not differ, or are not used. */
void
BoundedMoves::CopyCorners(const BulkVector<std::uint32_t> & triangles, const Points & from, Points & to) const
{
  constexpr std::size_t many = 16; // of so many triangles, one
  if (triangles.size() > m_StartAreas.size() / many)
  {
    rhombic::ForEachInBlocks(to.size(), MovedBlock, [&](SizeValueType point) { to[point] = from[point]; });
    return;
  }
  for (const std::uint32_t id : triangles)
  {
    for (const std::uint32_t point : std::as_const(m_Surface).GetTriangles()[id])
    {
      to[point] = from[point];
    }
  }
}

BulkVector<std::uint32_t>
BoundedMoves::FindTrianglesAt(const BulkVector<std::uint32_t> & points) const
{
  BulkVector<std::uint8_t> isAtPoint(m_StartAreas.size(), 0);
  for (const std::uint32_t point : points)
  {
    m_Fans.VisitTriangles(point, [&isAtPoint](std::uint32_t id) { isAtPoint[id] = 1; });
  }
  return FindMarked(isAtPoint);
}

/** The points of some triangles, ascending. */
BulkVector<std::uint32_t>
BoundedMoves::FindCorners(const BulkVector<std::uint32_t> & triangles) const
{
  BulkVector<std::uint32_t> corners;
  for (const std::uint32_t id : triangles)
  {
    const auto & triangle = std::as_const(m_Surface).GetTriangles()[id];
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  SortUnique(corners);
  return corners;
}

/** Begins retreats from the next points. */
void
BoundedMoves::BeginRetreats()
{
  m_Moved = m_Next;
  m_Retreats.assign(m_Moved.size(), 0);
}

/** Moves the next points of some triangles a quarter of their way back towards the start, and so on until no triangle
 * is spoilt. Neighbours differ by one quarter at most. Returns the triangles at points that have moved, ascending. */
BulkVector<std::uint32_t>
BoundedMoves::Retreat(BulkVector<std::uint32_t> triangles)
{
  BulkVector<std::uint32_t> changed;
  while (!triangles.empty())
  {
    BulkVector<std::uint32_t> points = this->FindCorners(triangles);
    points.erase(std::remove_if(points.begin(),
                                points.end(),
                                [this](std::uint32_t point) { return m_Retreats[point] == MostRetreats; }),
                 points.end());
    for (const std::uint32_t point : points)
    {
      ++m_Retreats[point];
    }
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const auto least = static_cast<std::uint8_t>(m_Retreats[points[n]] - 1);
      m_Fans.VisitNeighbours(points[n], [&](std::uint32_t next, std::uint32_t last) {
        for (const std::uint32_t other : { next, last })
        {
          if (m_Retreats[other] < least)
          {
            m_Retreats[other] = least;
            points.push_back(other);
          }
        }
      });
    }
    triangles.clear();
    SortUnique(points);
    for (const std::uint32_t point : points)
    {
      const double share = 1.0 - static_cast<double>(m_Retreats[point]) / MostRetreats;
      const PositionType way = Subtract(ToPosition(m_Moved[point]), ToPosition(m_Start[point]));
      m_Next[point] = share > 0.0 ? Move(m_Start[point], share, way) : m_Start[point];
      m_Fans.VisitTriangles(point, [&](std::uint32_t id) { triangles.push_back(id); });
    }
    SortUnique(triangles);
    changed.insert(changed.end(), triangles.begin(), triangles.end());
    triangles.erase(
      std::remove_if(triangles.begin(), triangles.end(), [this](std::uint32_t id) { return !this->IsSpoilt(id); }),
      triangles.end());
  }
  SortUnique(changed);
  return changed;
}

/** The triangles of which points are no longer where the tree has them, ascending. */
BulkVector<std::uint32_t>
BoundedMoves::FindMovedInTree() const
{
  const Points & points = m_Surface.GetPoints();
  BulkVector<std::uint32_t> moved;
  for (std::uint32_t point = 0; point < points.size(); ++point)
  {
    if (points[point] != m_InTree[point])
    {
      moved.push_back(point);
    }
  }
  return this->FindTrianglesAt(moved);
}

/** Makes the tree that of the surface; some triangles have moved. */
void
BoundedMoves::UpdateTree(const BulkVector<std::uint32_t> & triangles)
{
  constexpr std::size_t many = 128; // of so many triangles, one
  if (triangles.size() > m_StartAreas.size() / many)
  {
    m_Tree->Refit();
  }
  else
  {
    for (const std::uint32_t id : triangles)
    {
      const auto & triangle = std::as_const(m_Surface).GetTriangles()[id];
      m_Tree->Enlarge(TriangleTree::BoxOf(m_InTree, triangle), m_Tree->GetTriangleBox(id));
    }
  }
  this->CopyCorners(triangles, m_Surface.GetPoints(), m_InTree);
}

void
BoundedMoves::PutBackMeeting(rhombic::StagedProgress & progress, double stageEnd)
{
  m_Next = m_Surface.GetPoints();
  this->BeginRetreats();
  BulkVector<std::uint32_t> meeting;
  if (m_Tree)
  {
    const auto moved = this->FindMovedInTree(); // all others have been put back if they meet
    this->UpdateTree(moved);
    progress.Begin(stageEnd, 1);
    meeting = FindCrossingTriangles(*m_Tree, m_Fans, moved, TriangleContact::Touching);
  }
  else
  {
    m_Tree.emplace(m_Surface);
    m_InTree = m_Next;
    meeting = FindCrossingTriangles(*m_Tree, m_Fans, TriangleContact::Touching, &progress, stageEnd);
  }
  while (!meeting.empty())
  {
    progress.Completed(0);
    const auto latest = this->Retreat(meeting);

    this->CopyCorners(latest, m_Next, m_Surface.GetPoints());
    this->UpdateTree(latest);
    meeting = FindCrossingTriangles(*m_Tree, m_Fans, latest, TriangleContact::Touching);
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
    const PositionType way = Subtract(ToPosition(points[point]), ToPosition(m_Start[point]));
    const double move = Length(way);
    report.meanMove += move / static_cast<double>(points.size());
    report.largestMove = std::max(report.largestMove, move);
    report.pointsAtLimit += m_Bound.Measure(way) > 0.999 ? 1 : 0;
    report.pointsOnBorder += strata.strata[point] == Stratum::Fixed ? 1 : 0;
  }
  return report;
}

} // namespace itk
