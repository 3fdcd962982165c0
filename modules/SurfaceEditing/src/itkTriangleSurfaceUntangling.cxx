#include "itkTriangleSurfaceUntangling.h"

#include "detail/itkExactOrientation.h"
#include "itkForEachBlock.h"
#include "detail/itkPositionArithmetic.h"
#include "detail/itkTriangleContact.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

namespace itk
{
namespace
{

using Ids = std::vector<std::uint32_t>; ///< of points or triangles, ascending, each once

void
SortOut(Ids & ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/** Which of some triangles pass through others, and these. */
Ids
FindCrossing(const TriangleSurface & surface, const Ids & candidates)
{
  constexpr std::size_t blockSize = 4096;
  const TriangleTree tree(surface);
  const auto & triangles = surface.GetTriangles();
  Ids crossing;
  std::mutex mutex;
  ForEachBlock(candidates.size(), blockSize, [&](std::size_t begin, std::size_t end) {
    Ids ofBlock;
    for (std::size_t n = begin; n < end; ++n)
    {
      const std::uint32_t a = candidates[n];
      tree.VisitTriangles(tree.GetTriangleBox(a), [&](std::uint32_t b) {
        if (a != b &&
            FindContact(surface.GetPoints(), triangles[a], triangles[b]) == TriangleContactEnums::Contact::Crossing)
        {
          ofBlock.insert(ofBlock.end(), { a, b });
        }
      });
    }
    const std::lock_guard<std::mutex> lock(mutex);
    crossing.insert(crossing.end(), ofBlock.begin(), ofBlock.end());
  });
  SortOut(crossing);
  return crossing;
}

/** The triangles at each point: those of point n are triangles[begin[n]] to triangles[begin[n + 1]]. */
class TrianglesOfPoints
{
public:
  explicit TrianglesOfPoints(const TriangleSurface & surface)
    : m_Begin(surface.GetNumberOfPoints() + 1, 0)
    , m_Triangles(3 * surface.GetNumberOfTriangles())
  {
    for (const auto & triangle : surface.GetTriangles())
    {
      for (const std::uint32_t point : triangle)
      {
        ++m_Begin[point + 1];
      }
    }
    std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
    auto next = m_Begin;
    for (std::uint32_t n = 0; n < surface.GetNumberOfTriangles(); ++n)
    {
      for (const std::uint32_t point : surface.GetTriangles()[n])
      {
        m_Triangles[next[point]++] = n;
      }
    }
  }

  template <typename TVisitor>
  void
  Visit(std::uint32_t point, const TVisitor & visit) const
  {
    std::for_each(m_Triangles.begin() + static_cast<std::ptrdiff_t>(m_Begin[point]),
                  m_Triangles.begin() + static_cast<std::ptrdiff_t>(m_Begin[point + 1]),
                  visit);
  }

private:
  std::vector<std::uint64_t> m_Begin;
  Ids m_Triangles;
};

class Untangling
{
public:
  Untangling(TriangleSurface & surface, double maximumMove)
    : m_Surface(surface)
    , m_MaximumMove(maximumMove)
    , m_Fans(surface)
    , m_Original(surface.GetPoints())
  {}

  void
  Run(Ids crossing)
  {
    constexpr int rounds = 40;
    constexpr int patience = 16; // relaxing, and pushing outwards and inwards, twice
    Ids touched;                 // triangles that have a point that was moved
    TriangleSurface::PointsContainer best;
    std::size_t fewest = crossing.size();
    int lastBetter = 0;
    for (int round = 0; round < rounds && round <= lastBetter + patience && !crossing.empty(); ++round)
    {
      const Ids points = this->FindPoints(crossing, round % 4 == 3);
      this->MovePoints(points, round);
      for (const std::uint32_t point : points)
      {
        m_Fans.Visit(point, [&](std::uint32_t triangle) { touched.push_back(triangle); });
      }
      SortOut(touched);
      crossing = FindCrossing(m_Surface, touched);
      if (crossing.size() < fewest && this->HaveAreas(touched))
      {
        fewest = crossing.size();
        lastBetter = round;
        best = m_Surface.GetPoints();
      }
    }
    m_Surface.GetPoints() = best.empty() ? m_Original : best;
    m_Surface.Modified();
    m_Crossing = fewest;
  }

  TriangleSurfaceUntanglingReport
  MakeReport(SizeValueType crossingBefore) const
  {
    TriangleSurfaceUntanglingReport report;
    report.crossingBefore = crossingBefore;
    report.crossingAfter = m_Crossing;
    for (std::size_t n = 0; n < m_Original.size(); ++n)
    {
      if (m_Original[n] != m_Surface.GetPoints()[n])
      {
        ++report.pointsMoved;
        report.largestMove = std::max(report.largestMove, Length(this->OffsetOf(n, m_Surface.GetPoints()[n])));
      }
    }
    return report;
  }

private:
  static double
  Length(const PositionType & vector)
  {
    return std::sqrt(Dot(vector, vector));
  }

  PositionType
  OffsetOf(std::size_t point, const TriangleSurface::PointType & place) const
  {
    return Subtract(ToPosition(place), ToPosition(m_Original[point]));
  }

  /** The points of triangles, and maybe all their neighbours. */
  Ids
  FindPoints(const Ids & triangles, bool withNeighbours) const
  {
    Ids points;
    const auto add = [&](std::uint32_t triangle) {
      const auto & corners = m_Surface.GetTriangles()[triangle];
      points.insert(points.end(), corners.begin(), corners.end());
    };
    std::for_each(triangles.begin(), triangles.end(), add);
    SortOut(points);
    if (withNeighbours)
    {
      for (const std::uint32_t point : Ids(points))
      {
        m_Fans.Visit(point, add);
      }
      SortOut(points);
    }
    return points;
  }

  /** Half way to the mean of the neighbours, each counted once for each triangle at it. */
  PositionType
  Relax(std::uint32_t point) const
  {
    PositionType sum{};
    double count = 0.0;
    m_Fans.Visit(point, [&](std::uint32_t triangle) {
      for (const std::uint32_t corner : m_Surface.GetTriangles()[triangle])
      {
        if (corner != point)
        {
          const auto & place = m_Surface.GetPoints()[corner];
          sum = { sum[0] + place[0], sum[1] + place[1], sum[2] + place[2] };
          count += 1.0;
        }
      }
    });
    const PositionType place = ToPosition(m_Surface.GetPoints()[point]);
    return { 0.5 * (place[0] + sum[0] / count), 0.5 * (place[1] + sum[1] / count), 0.5 * (place[2] + sum[2] / count) };
  }

  /** By \a distance along the normal, weighted by the areas of the triangles. */
  PositionType
  Push(std::uint32_t point, double distance) const
  {
    PositionType normal{};
    m_Fans.Visit(point, [&](std::uint32_t triangle) {
      const auto & corners = m_Surface.GetTriangles()[triangle];
      const PositionType origin = ToPosition(m_Surface.GetPoints()[corners[0]]);
      const PositionType area = Cross(Subtract(ToPosition(m_Surface.GetPoints()[corners[1]]), origin),
                                      Subtract(ToPosition(m_Surface.GetPoints()[corners[2]]), origin));
      normal = { normal[0] + area[0], normal[1] + area[1], normal[2] + area[2] };
    });
    const double length = Length(normal);
    const double scale = length > 0.0 ? distance / length : 0.0;
    const PositionType place = ToPosition(m_Surface.GetPoints()[point]);
    return { place[0] + scale * normal[0], place[1] + scale * normal[1], place[2] + scale * normal[2] };
  }

  /** Rounds come in fours: all relax first, later ones relax once and are then pushed, outwards or inwards. */
  void
  MovePoints(const Ids & points, int round)
  {
    constexpr int firstPushed = 4;
    constexpr double pushOverMove = 1.0 / 12.0;
    const bool isPushed = round >= firstPushed && round % 4 != 0;
    const double push = (round / 4 % 2 == 1 ? pushOverMove : -pushOverMove) * m_MaximumMove;
    std::vector<PositionType> places;
    places.reserve(points.size());
    for (const std::uint32_t point : points)
    {
      places.push_back(isPushed ? this->Push(point, push) : this->Relax(point));
    }
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const PositionType origin = ToPosition(m_Original[points[n]]);
      const PositionType offset = Subtract(places[n], origin);
      const double length = Length(offset);
      constexpr double rounding = 1.0 - 1e-6; // so that the nearest float is not beyond
      const double scale = length > rounding * m_MaximumMove ? rounding * m_MaximumMove / length : 1.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        m_Surface.GetPoints()[points[n]][axis] = static_cast<float>(origin[axis] + scale * offset[axis]);
      }
    }
  }

  bool
  HaveAreas(const Ids & triangles) const
  {
    return std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
      const auto & [a, b, c] = m_Surface.GetTriangles()[triangle];
      return HasArea(m_Surface.GetPoints()[a], m_Surface.GetPoints()[b], m_Surface.GetPoints()[c]);
    });
  }

  TriangleSurface & m_Surface;
  double m_MaximumMove;
  TrianglesOfPoints m_Fans;
  TriangleSurface::PointsContainer m_Original;
  std::size_t m_Crossing = 0;
};

} // namespace

TriangleSurfaceUntanglingReport
UntangleSurface(TriangleSurface & surface, double maximumMove)
{
  if (!(maximumMove > 0.0) || !std::isfinite(maximumMove))
  {
    itkGenericExceptionMacro("Untangling needs a distance above 0 mm that points may move, not " << maximumMove << ".");
  }
  const Ids crossing = FindCrossingTriangles(TriangleTree(surface));
  if (crossing.empty())
  {
    return {};
  }
  Untangling untangling(surface, maximumMove);
  untangling.Run(crossing);
  return untangling.MakeReport(crossing.size());
}

} // namespace itk
