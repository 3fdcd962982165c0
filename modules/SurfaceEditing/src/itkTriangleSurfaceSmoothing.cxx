#include "itkTriangleSurfaceSmoothing.h"

#include "itkForEachBlock.h"
#include "detail/itkPositionArithmetic.h"

#include <cmath>
#include <numeric>

namespace itk
{
namespace
{

using PointId = std::uint32_t;
using TriangleId = std::uint32_t;
using Points = TriangleSurface::PointsContainer;
using PointType = TriangleSurface::PointType;
using TriangleType = TriangleSurface::TriangleType;

constexpr SizeValueType BlockSize = 4096;

// Frequencies up to 1 / Inwards + 1 / Outwards = 0.1 of the graph Laplacian's [0, 2] pass.
constexpr double Inwards = 0.5;
constexpr double Outwards = -1.0 / (1.0 / Inwards - 0.1);

constexpr double SmallestCosineOfTurn = 0.1736; // of 80 degrees
constexpr double SmallestShareOfArea = 0.1;

PositionType
Difference(const PointType & a, const PointType & b)
{
  return Subtract(ToPosition(a), ToPosition(b));
}

double
Length(const PositionType & a)
{
  return std::sqrt(Dot(a, a));
}

PositionType
AreaVector(const Points & points, const TriangleType & triangle)
{
  return Cross(Difference(points[triangle[1]], points[triangle[0]]),
               Difference(points[triangle[2]], points[triangle[0]]));
}

/** The triangles of each point, and where in them the point is. */
class Fans
{
public:
  explicit Fans(const TriangleSurface & surface)
    : m_Triangles(surface.GetTriangles())
    , m_Begin(surface.GetNumberOfPoints() + 1, 0)
    , m_Ids(3 * surface.GetNumberOfTriangles())
  {
    for (const auto & triangle : m_Triangles)
    {
      for (const PointId point : triangle)
      {
        ++m_Begin[point];
      }
    }
    std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
    for (std::size_t id = m_Triangles.size(); id-- > 0;)
    {
      for (const PointId point : m_Triangles[id])
      {
        m_Ids[--m_Begin[point]] = static_cast<TriangleId>(id);
      }
    }
  }

  std::size_t
  Size(PointId point) const
  {
    return m_Begin[point + 1] - m_Begin[point];
  }

  /** Calls visit(next, last) for each triangle {point, next, last} of a point. */
  template <typename TVisit>
  void
  ForEach(PointId point, const TVisit & visit) const
  {
    for (std::size_t i = m_Begin[point]; i < m_Begin[point + 1]; ++i)
    {
      const TriangleType & triangle = m_Triangles[m_Ids[i]];
      const unsigned int corner = triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
      visit(triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
    }
  }

  /** Whether each neighbour of the point follows it in one triangle and precedes it in another. */
  bool
  IsInside(PointId point) const
  {
    std::vector<PointId> following;
    std::vector<PointId> preceding;
    ForEach(point, [&](PointId next, PointId last) {
      following.push_back(next);
      preceding.push_back(last);
    });
    std::sort(following.begin(), following.end());
    std::sort(preceding.begin(), preceding.end());
    return !following.empty() && following == preceding &&
           std::adjacent_find(following.begin(), following.end()) == following.end();
  }

private:
  const TriangleSurface::TrianglesContainer & m_Triangles;
  std::vector<std::size_t> m_Begin;
  std::vector<TriangleId> m_Ids;
};

class Smoothing
{
public:
  Smoothing(TriangleSurface & surface, double maximumMove)
    : m_Surface(surface)
    , m_Points(surface.GetPoints())
    , m_Start(surface.GetPoints())
    , m_Next(surface.GetPoints())
    , m_Fans(surface)
    , m_MaximumMove(maximumMove)
    , m_IsInside(m_Points.size())
    , m_IsBad(surface.GetNumberOfTriangles())
  {
    ForEachInBlocks(m_Points.size(), BlockSize, [this](SizeValueType point) {
      m_IsInside[point] = m_Fans.IsInside(static_cast<PointId>(point)) ? 1 : 0;
    });
  }

  /** Moves each point by \a share of the way to the mean of its neighbours, as far as it may go. */
  void
  Step(double share)
  {
    ForEachInBlocks(m_Points.size(), BlockSize, [this, share](SizeValueType point) {
      m_Next[point] =
        m_IsInside[point] ? WithinReach(point, Towards(static_cast<PointId>(point), share)) : m_Points[point];
    });
    while (TakeBackBadMoves())
    {}
    m_Points.swap(m_Next);
  }

  void
  ComputeNormals()
  {
    ForEachInBlocks(m_Points.size(), BlockSize, [this](SizeValueType point) {
      PositionType sum{};
      m_Fans.ForEach(static_cast<PointId>(point), [&](PointId next, PointId last) {
        const PositionType a = Difference(m_Points[next], m_Points[point]);
        const PositionType b = Difference(m_Points[last], m_Points[point]);
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
          m_Surface.GetNormals()[point][axis] = static_cast<float>(sum[axis] / length);
        }
      }
    });
  }

  TriangleSurfaceSmoothingReport
  Report() const
  {
    TriangleSurfaceSmoothingReport report;
    for (std::size_t point = 0; point < m_Points.size(); ++point)
    {
      const double move = Length(Difference(m_Points[point], m_Start[point]));
      report.meanMove += move / static_cast<double>(m_Points.size());
      report.largestMove = std::max(report.largestMove, move);
      report.pointsAtLimit += move > 0.999 * m_MaximumMove ? 1 : 0;
      report.pointsOnBorder += m_IsInside[point] ? 0 : 1;
    }
    return report;
  }

private:
  PointType
  Towards(PointId point, double share) const
  {
    PositionType sum{};
    m_Fans.ForEach(point, [&](PointId next, PointId) {
      const PositionType way = Difference(m_Points[next], m_Points[point]);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += way[axis];
      }
    });
    const double factor = share / static_cast<double>(m_Fans.Size(point));
    PointType moved;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      moved[axis] = static_cast<float>(m_Points[point][axis] + factor * sum[axis]);
    }
    return moved;
  }

  /** The position itself, or the nearest one that is not too far from the point's start. */
  PointType
  WithinReach(SizeValueType point, PointType position) const
  {
    const PointType & start = m_Start[point];
    const PositionType way = Difference(position, start);
    double reach = m_MaximumMove / Length(way);
    while (Length(Difference(position, start)) > m_MaximumMove)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        position[axis] = static_cast<float>(start[axis] + reach * way[axis]);
      }
      reach -= 1e-3 * reach; // rounding to float may go beyond by a hair
    }
    return position;
  }

  /** Finds the triangles that the next points would spoil and leaves their points where they are. Where a point has
   * stayed for one triangle, another one may be spoilt: returns whether anything was taken back. */
  bool
  TakeBackBadMoves()
  {
    const auto & triangles = m_Surface.GetTriangles();
    ForEachInBlocks(triangles.size(), BlockSize, [this, &triangles](SizeValueType id) {
      m_IsBad[id] = IsSpoilt(triangles[id]) ? 1 : 0;
    });
    bool isAnyTakenBack = false;
    for (std::size_t id = 0; id < triangles.size(); ++id)
    {
      for (unsigned int corner = 0; m_IsBad[id] && corner < 3; ++corner)
      {
        const PointId point = triangles[id][corner];
        isAnyTakenBack = isAnyTakenBack || m_Next[point] != m_Points[point];
        m_Next[point] = m_Points[point];
      }
    }
    return isAnyTakenBack;
  }

  bool
  IsSpoilt(const TriangleType & triangle) const
  {
    const PositionType was = AreaVector(m_Start, triangle);
    const PositionType will = AreaVector(m_Next, triangle);
    const double areaWas = Length(was);
    const double areaWill = Length(will);
    return !(Dot(was, will) >= SmallestCosineOfTurn * areaWas * areaWill && areaWill >= SmallestShareOfArea * areaWas);
  }

  TriangleSurface & m_Surface;
  Points & m_Points;
  const Points m_Start;
  Points m_Next;
  const Fans m_Fans;
  const double m_MaximumMove;
  std::vector<std::uint8_t> m_IsInside;
  std::vector<std::uint8_t> m_IsBad;
};

} // namespace

TriangleSurfaceSmoothingReport
SmoothSurface(TriangleSurface & surface, const TriangleSurfaceSmoothingSettings & settings)
{
  if (!(settings.maximumMove >= 0.0 && std::isfinite(settings.maximumMove)))
  {
    itkGenericExceptionMacro("A point can't move by at most "
                             << settings.maximumMove << " mm when a surface is smoothed; give a number from 0");
  }
  Smoothing smoothing(surface, settings.maximumMove);
  for (unsigned int iteration = 0; iteration < settings.iterations; ++iteration)
  {
    smoothing.Step(Inwards);
    smoothing.Step(Outwards);
  }
  if (surface.HasNormals())
  {
    smoothing.ComputeNormals();
  }
  surface.Modified();
  return smoothing.Report();
}

} // namespace itk
