#include "itkTriangleSurfaceThickness.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace itk
{
namespace
{

constexpr std::size_t ThicknessBlock = 256;
constexpr float NoThickness = std::numeric_limits<float>::quiet_NaN();
constexpr double ShareOfWay = 0.05;      // by which normals may be off: 18 degrees
constexpr double RelativeError = 0.01;   // of radii
constexpr double SmallestError = 0.005;  // mm
constexpr double NearestExit = 1e-3;     // mm; the triangles around the point are no exit
constexpr std::size_t MostMeasured = 48; // centres on one ray

/** A part of a ray between two places whose distances to the surface are known, all in mm. */
struct Stretch
{
  double begin;
  double atBegin;
  double end;
  double atEnd;

  /** The distance that no place between exceeds, as distances change by no more than the way. */
  double
  GetBound() const
  {
    return 0.5 * (atBegin + atEnd + end - begin);
  }
  /** The only place that can have that distance. */
  double
  GetPeak() const
  {
    return 0.5 * (begin + end + atEnd - atBegin);
  }
};

bool
HasLowerBound(const Stretch & a, const Stretch & b)
{
  return a.GetBound() < b.GetBound();
}

/** \class BallSearch
 * \brief Finds the largest ball inside of a surface on rays. */
class BallSearch
{
public:
  /** \param slack mm that a centre may be farther from the ray's begin than its radius */
  BallSearch(const TriangleTree & tree, double slack)
    : m_Tree(tree)
    , m_Slack(slack)
  {}

  /** The radius on a ray that leaves the surface after \a length mm. */
  double
  FindRadius(const PositionType & from, const PositionType & direction, double length)
  {
    double best = 0.0;
    m_Stretches.assign(1, { 0.0, 0.0, length, 0.0 });
    for (std::size_t n = 0; n < MostMeasured && !m_Stretches.empty(); ++n)
    {
      std::pop_heap(m_Stretches.begin(), m_Stretches.end(), HasLowerBound);
      const Stretch stretch = m_Stretches.back();
      m_Stretches.pop_back();
      const double bound = stretch.GetBound();
      if (bound <= best + std::max(RelativeError * best, SmallestError))
      {
        break;
      }
      const double place = stretch.GetPeak();
      if (!this->Touches(place, bound)) // nor does any other place
      {
        continue;
      }
      const double distance =
        std::sqrt(m_Tree.FindClosestPoint(Along(from, direction, place), bound * bound).squaredDistance);
      if (this->Touches(place, distance))
      {
        best = std::max(best, distance);
      }
      this->Push({ stretch.begin, stretch.atBegin, place, distance });
      this->Push({ place, distance, stretch.end, stretch.atEnd });
    }
    return best;
  }

private:
  bool
  Touches(double place, double radius) const
  {
    return place - radius <= m_Slack + ShareOfWay * place;
  }

  void
  Push(const Stretch & stretch)
  {
    if (stretch.end - stretch.begin > SmallestError)
    {
      m_Stretches.push_back(stretch);
      std::push_heap(m_Stretches.begin(), m_Stretches.end(), HasLowerBound);
    }
  }

  const TriangleTree & m_Tree;
  double m_Slack;
  std::vector<Stretch> m_Stretches; ///< a heap
};

/** Measures walls, and balls if asked. */
TriangleSurfaceThickness
Measure(const TriangleSurface & surface, const TriangleTree & tree, bool measuresBalls)
{
  const BulkVector<PositionType> normals = ComputeTriangleSurfacePointNormals(surface);
  const double slack = MeanSideOf(surface);
  TriangleSurfaceThickness thickness;
  thickness.walls.assign(normals.size(), NoThickness);
  thickness.balls.assign(measuresBalls ? normals.size() : 0, NoThickness);
  rhombic::ForEachBlock(normals.size(), ThicknessBlock, [&](std::size_t begin, std::size_t end) {
    BallSearch search(tree, slack);
    for (std::size_t n = begin; n < end; ++n)
    {
      if (normals[n] == PositionType{} || !IsFinite(surface.GetPoints()[n]))
      {
        continue;
      }
      const PositionType from = ToPosition(surface.GetPoints()[n]);
      const PositionType inwards = Scaled(normals[n], -1.0);
      const double wall = tree.FindExit(from, inwards, NearestExit);
      if (std::isfinite(wall))
      {
        thickness.walls[n] = static_cast<float>(wall);
        if (measuresBalls)
        {
          thickness.balls[n] = static_cast<float>(2.0 * search.FindRadius(from, inwards, wall));
        }
      }
    }
  });
  return thickness;
}

/** Connected parts by links between points. */
class LinkedParts
{
public:
  explicit LinkedParts(std::size_t points)
    : m_Parents(points)
  {
    std::iota(m_Parents.begin(), m_Parents.end(), std::uint32_t{ 0 });
  }

  std::uint32_t
  Find(std::uint32_t point)
  {
    while (m_Parents[point] != point)
    {
      point = m_Parents[point] = m_Parents[m_Parents[point]];
    }
    return point;
  }

  void
  Link(std::uint32_t a, std::uint32_t b)
  {
    const auto [low, high] = std::minmax({ this->Find(a), this->Find(b) });
    m_Parents[high] = low;
  }

private:
  BulkVector<std::uint32_t> m_Parents;
};

} // namespace

BulkVector<std::array<double, 3>>
ComputeTriangleSurfacePointNormals(const TriangleSurface & surface)
{
  surface.VerifyTriangles();
  BulkVector<PositionType> normals(surface.GetNumberOfPoints(), PositionType{});
  for (const auto & triangle : surface.GetTriangles())
  {
    const PositionType area = AreaVector(CornersOf(surface, triangle));
    for (const std::uint32_t point : triangle)
    {
      normals[point] = Add(normals[point], area);
    }
  }
  for (PositionType & normal : normals)
  {
    const double length = Length(normal);
    normal = length > 0.0 ? Scaled(normal, 1.0 / length) : PositionType{};
  }
  return normals;
}

TriangleSurfaceThickness
ComputeTriangleSurfaceThickness(const TriangleSurface & surface, const TriangleTree & tree)
{
  return Measure(surface, tree, true);
}

BulkVector<float>
ComputeTriangleSurfaceWalls(const TriangleSurface & surface, const TriangleTree & tree)
{
  return Measure(surface, tree, false).walls;
}

ThinParts
FindThinParts(const TriangleSurface & surface, const TriangleTree & tree, double limit)
{
  const TriangleSurfaceThickness thickness = Measure(surface, tree, true);
  const auto isThin = [&](std::uint32_t point) {
    return thickness.balls[point] < limit && thickness.walls[point] < limit; // false for NaN
  };
  ThinParts thin;
  thin.limit = limit;
  LinkedParts linked(surface.GetNumberOfPoints());
  BulkVector<double> areas(surface.GetNumberOfPoints(), 0.0); // of thin corners
  for (const auto & triangle : surface.GetTriangles())
  {
    const double area = Length(AreaVector(CornersOf(surface, triangle))) / 2.0;
    thin.areaOfSurface += area;
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const std::uint32_t point = triangle[corner];
      const std::uint32_t next = triangle[(corner + 1) % 3];
      if (isThin(point))
      {
        areas[point] += area / 3.0;
        thin.area += area / 3.0;
        if (isThin(next))
        {
          linked.Link(point, next);
        }
      }
    }
  }
  BulkVector<std::size_t> numbers(surface.GetNumberOfPoints(), 0); // of parts, from 1, by their first points
  for (std::uint32_t point = 0; point < surface.GetNumberOfPoints(); ++point)
  {
    if (areas[point] == 0.0)
    {
      continue;
    }
    std::size_t & number = numbers[linked.Find(point)];
    if (number == 0)
    {
      thin.parts.push_back({ 0.0, std::numeric_limits<double>::infinity(), {} });
      number = thin.parts.size();
    }
    ThinPart & part = thin.parts[number - 1];
    part.area += areas[point];
    if (thickness.walls[point] < part.thinnest)
    {
      part.thinnest = thickness.walls[point];
      part.thinnestAt = ToPosition(surface.GetPoints()[point]);
    }
  }
  std::stable_sort(
    thin.parts.begin(), thin.parts.end(), [](const ThinPart & a, const ThinPart & b) { return a.area > b.area; });
  return thin;
}

} // namespace itk
