#include "itkTriangleSurfaceDistance.h"

#include "itkForEachBlock.h"
#include "detail/itkPositionArithmetic.h"

#include <cmath>

namespace itk
{
namespace
{

using Position = PositionType;
using Corners = std::array<Position, 3>;

constexpr SizeValueType BlockSize = 1024;
constexpr unsigned int MostParts = 64; // along a side

Corners
CornersOf(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  const auto & points = surface.GetPoints();
  return { ToPosition(points[triangle[0]]), ToPosition(points[triangle[1]]), ToPosition(points[triangle[2]]) };
}

double
Distance(const Position & a, const Position & b)
{
  const Position way = Subtract(a, b);
  return std::sqrt(Dot(way, way));
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
  const Position normal = Cross(Subtract(corners[1], corners[0]), Subtract(corners[2], corners[0]));
  return std::sqrt(Dot(normal, normal)) / 2.0;
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

/** Distances of places that mostly follow each other closely: what was nearest to the last one bounds the search. */
class Distances
{
public:
  explicit Distances(const TriangleTree & other)
    : m_Other(other)
  {}

  double
  Of(const Position & position)
  {
    double bound = std::numeric_limits<double>::infinity();
    if (m_Nearest != TriangleTree::None)
    {
      const Position way = Subtract(position, m_Other.FindClosestPointOfTriangle(position, m_Nearest));
      bound = Dot(way, way);
    }
    const auto closest = m_Other.FindClosestPoint(position, bound);
    m_Nearest = closest.triangle != TriangleTree::None ? closest.triangle : m_Nearest;
    return std::sqrt(closest.squaredDistance);
  }

private:
  const TriangleTree & m_Other;
  std::uint32_t m_Nearest = TriangleTree::None;
};

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
  places.erase(std::remove_if(places.begin(), places.end(), [](const Place & place) { return !(place.area > 0.0f); }),
               places.end());
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

} // namespace

TriangleSurfaceDistance
ComputeDistance(const TriangleSurface & surface,
                const TriangleTree & other,
                double spacing,
                SizeValueType mostTriangles)
{
  const auto & triangles = surface.GetTriangles();
  const std::size_t step =
    std::max<std::size_t>(1, triangles.size() / mostTriangles + (triangles.size() % mostTriangles != 0 ? 1 : 0));
  const std::size_t looked = (triangles.size() + step - 1) / step;
  std::vector<std::uint64_t> begin(looked + 1);
  std::vector<float> pointAreas(surface.GetNumberOfPoints(), 0.0f);
  begin[0] = surface.GetNumberOfPoints();
  for (std::size_t n = 0; n < looked; ++n)
  {
    const auto & triangle = triangles[n * step];
    const Corners corners = CornersOf(surface, triangle);
    const double parts = CountParts(corners, spacing);
    begin[n + 1] = begin[n] + static_cast<std::uint64_t>(parts * parts);
    for (const std::uint32_t point : triangle)
    {
      pointAreas[point] += static_cast<float>(Area(corners) / (12.0 * parts * parts));
    }
  }
  std::vector<Place> places(begin.back());
  ForEachBlock(surface.GetNumberOfPoints(), BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t point = first; point < last; ++point)
    {
      const bool isLookedAt = pointAreas[point] > 0.0f;
      const double distance = isLookedAt ? distances.Of(ToPosition(surface.GetPoints()[point])) : 0.0;
      places[point] = { static_cast<float>(distance), pointAreas[point] };
    }
  });
  ForEachBlock(looked, BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t n = first; n < last; ++n)
    {
      const Corners corners = CornersOf(surface, triangles[n * step]);
      const unsigned int parts = CountParts(corners, spacing);
      const double numberOfParts = static_cast<double>(parts) * parts;
      // the inner corners of parts are not looked at: their share is the centres'
      const double area = Area(corners) / numberOfParts * (1.0 - 0.25 / numberOfParts);
      std::size_t place = begin[n];
      ForEachPart(corners, parts, [&](const Position & centre) {
        places[place++] = { static_cast<float>(distances.Of(centre)), static_cast<float>(area) };
      });
    }
  });
  return Summarize(std::move(places));
}

TriangleSurfaceTwoDistances
ComputeTwoDistances(const TriangleSurface & first, const TriangleSurface & second, SizeValueType mostTriangles)
{
  const double spacing = 2.0 * std::min(MeanSide(first), MeanSide(second));
  return { ComputeDistance(first, TriangleTree(second), spacing, mostTriangles),
           ComputeDistance(second, TriangleTree(first), spacing, mostTriangles) };
}

} // namespace itk
