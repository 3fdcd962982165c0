#include "itkTriangleSurfaceDistance.h"

#include "itkParallelBlocks.h"

#include <cmath>

namespace itk
{
namespace
{

using Position = TriangleTree::PositionType;
using ClosestPoint = TriangleTree::ClosestPoint;
using Corners = std::array<Position, 3>;

constexpr SizeValueType BlockSize = 1024;
constexpr unsigned int MostParts = 64; // along a side
constexpr unsigned int MostCuts = 7;

Position
ToPosition(const TriangleSurface::PointType & point)
{
  return { point[0], point[1], point[2] };
}

Corners
CornersOf(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  const auto & points = surface.GetPoints();
  return { ToPosition(points[triangle[0]]), ToPosition(points[triangle[1]]), ToPosition(points[triangle[2]]) };
}

double
Distance(const Position & a, const Position & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

double
LongestSide(const Corners & corners)
{
  return std::max(
    { Distance(corners[0], corners[1]), Distance(corners[1], corners[2]), Distance(corners[2], corners[0]) });
}

double
Area(const Corners & corners)
{
  double squared = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const unsigned int u = (axis + 1) % 3;
    const unsigned int v = (axis + 2) % 3;
    const double part = (corners[1][u] - corners[0][u]) * (corners[2][v] - corners[0][v]) -
                        (corners[1][v] - corners[0][v]) * (corners[2][u] - corners[0][u]);
    squared += part * part;
  }
  return std::sqrt(squared) / 2.0;
}

/** weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] */
Position
At(const Corners & corners, const std::array<double, 3> & weights)
{
  Position position;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    position[axis] = weights[0] * corners[0][axis] + weights[1] * corners[1][axis] + weights[2] * corners[2][axis];
  }
  return position;
}

double
DistanceTo(const TriangleTree & other, const Position & position)
{
  return std::sqrt(other.FindClosestPoint(position).squaredDistance);
}

struct Place
{
  float distance;
  float area;
};

unsigned int
CountParts(const Corners & corners, double spacing)
{
  return static_cast<unsigned int>(std::clamp(std::ceil(LongestSide(corners) / spacing), 1.0, double{ MostParts }));
}

/** Calls visit(centre) for each of parts^2 equal parts of a triangle. */
template <typename TVisit>
void
ForEachPart(const Corners & corners, unsigned int parts, const TVisit & visit)
{
  for (unsigned int row = 0; row < parts; ++row)
  {
    for (unsigned int column = 0; column + row < parts; ++column)
    {
      const auto centre = [&](double shift) {
        const double u = (column + shift) / parts;
        const double v = (row + shift) / parts;
        return At(corners, { 1.0 - u - v, u, v });
      };
      visit(centre(1.0 / 3.0));
      if (column + row + 1 < parts)
      {
        visit(centre(2.0 / 3.0));
      }
    }
  }
}

TriangleSurfaceDistance
Summarize(std::vector<Place> places)
{
  TriangleSurfaceDistance result;
  result.places = places.size();
  std::sort(places.begin(), places.end(), [](const Place & a, const Place & b) {
    return a.distance != b.distance ? a.distance < b.distance : a.area < b.area;
  });
  double area = 0.0;
  double sum = 0.0;
  for (const Place & place : places)
  {
    area += place.area;
    sum += double{ place.area } * place.distance;
  }
  result.mean = area > 0.0 ? sum / area : 0.0;
  double below = 0.0;
  for (const Place & place : places)
  {
    below += place.area;
    result.percentile95 = place.distance;
    if (below >= 0.95 * area)
    {
      break;
    }
  }
  result.maximum = places.empty() ? 0.0 : places.back().distance;
  return result;
}

double
MeanSide(const TriangleSurface & surface)
{
  double sum = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const Corners corners = CornersOf(surface, triangle);
    sum += Distance(corners[0], corners[1]) + Distance(corners[1], corners[2]) + Distance(corners[2], corners[0]);
  }
  return sum / std::max(1.0, 3.0 * static_cast<double>(surface.GetNumberOfTriangles()));
}

/** A triangle's part, with what is nearest to each of its corners. */
bool
IsPartWithin(const Corners & corners,
             const std::array<ClosestPoint, 3> & closest,
             const TriangleTree & other,
             double limit,
             unsigned int cutsLeft)
{
  double furthest = 0.0;
  for (const ClosestPoint & corner : closest)
  {
    if (corner.triangle == TriangleTree::None)
    {
      return false;
    }
    furthest = std::max(furthest, std::sqrt(corner.squaredDistance));
  }
  const bool isOneTriangleClosest =
    closest[0].triangle == closest[1].triangle && closest[1].triangle == closest[2].triangle;
  // no place of a triangle is further than the longest side / sqrt(3) from its nearest corner
  if (isOneTriangleClosest || furthest + LongestSide(corners) / std::sqrt(3.0) <= limit)
  {
    return true;
  }
  if (cutsLeft == 0)
  {
    return false;
  }
  Corners middles;
  std::array<ClosestPoint, 3> closestToMiddles;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    std::array<double, 3> weights{ 0.5, 0.5, 0.5 };
    weights[corner] = 0.0;
    middles[corner] = At(corners, weights);
    closestToMiddles[corner] = other.FindClosestPoint(middles[corner], limit * limit);
  }
  const auto isWithin = [&](const Corners & part, const std::array<ClosestPoint, 3> & closestToPart) {
    return IsPartWithin(part, closestToPart, other, limit, cutsLeft - 1);
  };
  return isWithin(middles, closestToMiddles) &&
         isWithin({ corners[0], middles[2], middles[1] }, { closest[0], closestToMiddles[2], closestToMiddles[1] }) &&
         isWithin({ middles[2], corners[1], middles[0] }, { closestToMiddles[2], closest[1], closestToMiddles[0] }) &&
         isWithin({ middles[1], middles[0], corners[2] }, { closestToMiddles[1], closestToMiddles[0], closest[2] });
}

} // namespace

TriangleSurfaceDistance
ComputeDistance(const TriangleSurface & surface, const TriangleTree & other, double spacing)
{
  const auto & triangles = surface.GetTriangles();
  std::vector<std::uint64_t> begin(triangles.size() + 1);
  std::vector<float> pointAreas(surface.GetNumberOfPoints(), 0.0f);
  begin[0] = surface.GetNumberOfPoints();
  for (std::size_t id = 0; id < triangles.size(); ++id)
  {
    const Corners corners = CornersOf(surface, triangles[id]);
    const unsigned int parts = CountParts(corners, spacing);
    begin[id + 1] = begin[id] + std::uint64_t{ parts } * parts;
    for (const std::uint32_t point : triangles[id])
    {
      pointAreas[point] += static_cast<float>(Area(corners) / (12.0 * parts * parts));
    }
  }
  std::vector<Place> places(begin.back());
  ForEachInBlocks(surface.GetNumberOfPoints(), BlockSize, [&](SizeValueType point) {
    places[point].area = pointAreas[point];
    places[point].distance =
      pointAreas[point] > 0.0f ? static_cast<float>(DistanceTo(other, ToPosition(surface.GetPoints()[point]))) : 0.0f;
  });
  ForEachInBlocks(triangles.size(), BlockSize, [&](SizeValueType id) {
    const Corners corners = CornersOf(surface, triangles[id]);
    const unsigned int parts = CountParts(corners, spacing);
    const double numberOfParts = static_cast<double>(parts) * parts;
    const double area = Area(corners) / numberOfParts;
    // the inner corners of parts are not looked at: their share is the centres'
    const double share = 1.0 - 0.25 / numberOfParts;
    std::size_t place = begin[id];
    ForEachPart(corners, parts, [&](const Position & centre) {
      places[place++] = { static_cast<float>(DistanceTo(other, centre)), static_cast<float>(area * share) };
    });
  });
  return Summarize(std::move(places));
}

TriangleSurfaceTwoDistances
ComputeTwoDistances(const TriangleSurface & first, const TriangleSurface & second)
{
  const double spacing = std::min(MeanSide(first), MeanSide(second));
  return { ComputeDistance(first, TriangleTree(second), spacing),
           ComputeDistance(second, TriangleTree(first), spacing) };
}

bool
IsWithinDistance(const std::array<TriangleSurface::PointType, 3> & triangle, const TriangleTree & other, double limit)
{
  const Corners corners{ ToPosition(triangle[0]), ToPosition(triangle[1]), ToPosition(triangle[2]) };
  std::array<ClosestPoint, 3> closest;
  for (unsigned int corner = 0; corner < 3; ++corner)
  {
    closest[corner] = other.FindClosestPoint(corners[corner], limit * limit);
    if (closest[corner].triangle == TriangleTree::None)
    {
      return false;
    }
  }
  return IsPartWithin(corners, closest, other, limit, MostCuts);
}

} // namespace itk
