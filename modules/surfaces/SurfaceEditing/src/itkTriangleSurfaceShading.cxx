#include "itkTriangleSurfaceShading.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTrianglesOfPoints.h"
#include "itkMath.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

/** A triangle at a point. */
struct FanTriangle
{
  std::uint32_t id = 0;
  std::uint32_t next = 0; ///< the corners behind the point
  std::uint32_t last = 0;
  PositionType normal{}; ///< of length 1, or 0 without area
  double angle = 0.0;    ///< at the point
  std::size_t group = 0; ///< index of the first triangle of those that lead into each other
};

PositionType
Unit(const PositionType & vector)
{
  const double length = Length(vector);
  return length > 0.0 ? Scaled(vector, 1.0 / length) : PositionType{};
}

std::vector<FanTriangle>
FanAt(const TriangleSurface & surface, const TrianglesOfPoints & fans, std::size_t point)
{
  std::vector<FanTriangle> fan;
  const auto positionOf = [&surface](std::size_t id) { return ToPosition(surface.GetPoints()[id]); };
  fans.VisitTriangles(point, [&](std::uint32_t id) {
    FanTriangle triangle;
    triangle.id = id;
    triangle.normal = Unit(AreaVector(CornersOf(surface, surface.GetTriangles()[id])));
    triangle.group = fan.size();
    fan.push_back(triangle);
  });
  std::size_t n = 0;
  fans.VisitNeighbours(point, [&](std::uint32_t next, std::uint32_t last) {
    const PositionType toNext = Unit(Subtract(positionOf(next), positionOf(point)));
    const PositionType toLast = Unit(Subtract(positionOf(last), positionOf(point)));
    fan[n].next = next;
    fan[n].last = last;
    fan[n].angle = std::acos(std::clamp(Dot(toNext, toLast), -1.0, 1.0));
    ++n;
  });
  return fan;
}

/** Joins the groups of triangles with an edge in common below the feature angle. */
void
JoinGroups(double leastCosine, std::vector<FanTriangle> & fan)
{
  for (std::size_t a = 0; a < fan.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      const bool haveEdge = fan[a].next == fan[b].last || fan[a].last == fan[b].next || fan[a].next == fan[b].next ||
                            fan[a].last == fan[b].last;
      const std::size_t first = std::min(fan[a].group, fan[b].group);
      const std::size_t second = std::max(fan[a].group, fan[b].group);
      if (haveEdge && first != second && Dot(fan[a].normal, fan[b].normal) >= leastCosine)
      {
        for (FanTriangle & triangle : fan)
        {
          triangle.group = triangle.group == second ? first : triangle.group;
        }
      }
    }
  }
}

TriangleSurface::NormalType
NormalOfGroup(const std::vector<FanTriangle> & fan, std::size_t group)
{
  PositionType sum{};
  for (const FanTriangle & triangle : fan)
  {
    sum = triangle.group == group ? Add(sum, Scaled(triangle.normal, triangle.angle)) : sum;
  }
  const PositionType normal = Unit(sum);
  return Length(normal) > 0.0 ? ToPoint(normal) : TriangleSurface::NormalType{ 0.0f, 0.0f, 1.0f };
}

} // namespace

void
ComputeTriangleSurfaceShadingNormals(TriangleSurface & surface, double featureAngleInDegrees)
{
  const double leastCosine = std::cos(featureAngleInDegrees * Math::pi_over_180);
  auto points = surface.GetPoints();
  auto triangles = surface.GetTriangles();
  TriangleSurface::NormalsContainer normals(points.size(), { 0.0f, 0.0f, 1.0f });
  const TriangleSurface & given = surface; // changes at the end
  const TrianglesOfPoints fans(given);
  for (std::size_t point = 0; point < given.GetNumberOfPoints(); ++point)
  {
    std::vector<FanTriangle> fan = FanAt(given, fans, point);
    JoinGroups(leastCosine, fan);
    for (std::size_t n = 0; n < fan.size(); ++n)
    {
      if (fan[n].group != n)
      {
        continue; // not the first of its group
      }
      const TriangleSurface::NormalType normal = NormalOfGroup(fan, n);
      if (n == 0)
      {
        normals[point] = normal;
        continue;
      }
      const auto added = static_cast<std::uint32_t>(points.size());
      points.push_back(given.GetPoints()[point]);
      normals.push_back(normal);
      for (const FanTriangle & triangle : fan)
      {
        if (triangle.group == n)
        {
          auto & corners = triangles[triangle.id];
          std::replace(corners.begin(), corners.end(), static_cast<std::uint32_t>(point), added);
        }
      }
    }
  }
  surface.GetPoints().swap(points);
  surface.GetTriangles().swap(triangles);
  surface.GetNormals().swap(normals);
  surface.Modified();
}

} // namespace itk
