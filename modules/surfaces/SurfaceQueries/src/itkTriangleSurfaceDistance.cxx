#include "itkTriangleSurfaceDistance.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <cmath>
#include <utility>

namespace itk
{
namespace
{

constexpr SizeValueType BlockSize = 1024;
constexpr unsigned int MostParts = 64; // along a side

double
LongestSide(const CornersType & corners)
{
  return std::max(
    { Distance(corners[0], corners[1]), Distance(corners[1], corners[2]), Distance(corners[2], corners[0]) });
}

double
Area(const CornersType & corners)
{
  return Length(AreaVector(corners)) / 2.0;
}

/** The position with barycentric coordinates 1 - u - v, u and v. */
PositionType
At(const CornersType & corners, double u, double v)
{
  PositionType position;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    position[axis] = (1.0 - u - v) * corners[0][axis] + u * corners[1][axis] + v * corners[2][axis];
  }
  return position;
}

/** Distances of sample points that are mostly close to the sample points before: the triangle nearest to the last
 * sample point bounds the search. */
class Distances
{
public:
  explicit Distances(const TriangleTree & other)
    : m_Other(other)
  {}

  double
  Of(const PositionType & position)
  {
    double bound = std::numeric_limits<double>::infinity();
    if (m_Nearest != TriangleTree::None)
    {
      bound = SquaredDistance(position, m_Other.FindClosestPointOfTriangle(position, m_Nearest));
    }
    const auto closest = m_Other.FindClosestPoint(position, bound);
    m_Nearest = closest.triangle != TriangleTree::None ? closest.triangle : m_Nearest;
    return std::sqrt(closest.squaredDistance);
  }

private:
  const TriangleTree & m_Other;
  std::uint32_t m_Nearest = TriangleTree::None;
};

/** A sample point: its distance in mm and its weight, an area in mm^2. */
struct Place
{
  float distance;
  float area;
};

/** Into how many parts each side of a triangle is divided. */
unsigned int
CountParts(const CornersType & corners, double spacing)
{
  return static_cast<unsigned int>(std::clamp(std::ceil(LongestSide(corners) / spacing), 1.0, double{ MostParts }));
}

/** Calls visit(centre) for each of parts^2 equal parts of a triangle. */
template <typename TVisit>
void
ForEachPart(const CornersType & corners, unsigned int parts, const TVisit & visit)
{
  for (unsigned int row = 0; row < parts; ++row)
  {
    for (unsigned int column = 0; column + row < parts; ++column)
    {
      const auto centre = [&](double shift) {
        const double u = (column + shift) / parts;
        const double v = (row + shift) / parts;
        return At(corners, u, v);
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
    const CornersType corners = CornersOf(surface, triangle);
    sum += Distance(corners[0], corners[1]) + Distance(corners[1], corners[2]) + Distance(corners[2], corners[0]);
  }
  return sum / std::max(1.0, 3.0 * static_cast<double>(surface.GetNumberOfTriangles()));
}

/** Every \a step-th triangle of a surface, divided into parts. */
struct ChosenTriangles
{
  std::size_t step;
  std::vector<std::uint64_t> firstPlace; ///< index of each triangle's first sample point, after the points; and the end
  std::vector<float> pointAreas;         ///< weight of each point, an area in mm^2; 0 for points of no chosen triangle

  std::size_t
  GetNumberOfTriangles() const
  {
    return firstPlace.size() - 1;
  }
};

ChosenTriangles
ChooseTriangles(const TriangleSurface & surface, double spacing, SizeValueType mostTriangles)
{
  const auto & triangles = surface.GetTriangles();
  ChosenTriangles chosen;
  chosen.step =
    std::max<std::size_t>(1, triangles.size() / mostTriangles + (triangles.size() % mostTriangles != 0 ? 1 : 0));
  chosen.firstPlace.assign(1, surface.GetNumberOfPoints());
  chosen.firstPlace.reserve((triangles.size() + chosen.step - 1) / chosen.step + 1);
  chosen.pointAreas.assign(surface.GetNumberOfPoints(), 0.0f);
  for (std::size_t id = 0; id < triangles.size(); id += chosen.step)
  {
    const CornersType corners = CornersOf(surface, triangles[id]);
    const double parts = CountParts(corners, spacing);
    chosen.firstPlace.push_back(chosen.firstPlace.back() + static_cast<std::uint64_t>(parts * parts));
    for (const std::uint32_t point : triangles[id])
    {
      chosen.pointAreas[point] += static_cast<float>(Area(corners) / (12.0 * parts * parts));
    }
  }
  return chosen;
}

void
MeasurePoints(const TriangleSurface & surface,
              const TriangleTree & other,
              const ChosenTriangles & chosen,
              std::vector<Place> & places)
{
  rhombic::ForEachBlock(surface.GetNumberOfPoints(), BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t point = first; point < last; ++point)
    {
      const float area = chosen.pointAreas[point];
      const double distance = area > 0.0f ? distances.Of(ToPosition(surface.GetPoints()[point])) : 0.0;
      places[point] = { static_cast<float>(distance), area };
    }
  });
}

void
MeasureCentres(const TriangleSurface & surface,
               const TriangleTree & other,
               const ChosenTriangles & chosen,
               double spacing,
               std::vector<Place> & places)
{
  rhombic::ForEachBlock(chosen.GetNumberOfTriangles(), BlockSize, [&](std::size_t first, std::size_t last) {
    Distances distances(other);
    for (std::size_t n = first; n < last; ++n)
    {
      const CornersType corners = CornersOf(surface, surface.GetTriangles()[n * chosen.step]);
      const unsigned int parts = CountParts(corners, spacing);
      const double numberOfParts = static_cast<double>(parts) * parts;
      // The inner corners of parts are not sampled; their weight goes to the centres.
      const double area = Area(corners) / numberOfParts * (1.0 - 0.25 / numberOfParts);
      std::size_t place = chosen.firstPlace[n];
      ForEachPart(corners, parts, [&](const PositionType & centre) {
        places[place++] = { static_cast<float>(distances.Of(centre)), static_cast<float>(area) };
      });
    }
  });
}

} // namespace

TriangleSurfaceDistance
ComputeTriangleSurfaceDistance(const TriangleSurface & surface,
                               const TriangleTree & other,
                               double spacing,
                               SizeValueType mostTriangles)
{
  const ChosenTriangles chosen = ChooseTriangles(surface, spacing, mostTriangles);
  std::vector<Place> places(chosen.firstPlace.back());
  MeasurePoints(surface, other, chosen, places);
  MeasureCentres(surface, other, chosen, spacing, places);
  return Summarize(std::move(places));
}

TriangleSurfaceTwoDistances
ComputeTriangleSurfaceDistances(const TriangleSurface & first,
                                const TriangleSurface & second,
                                SizeValueType mostTriangles)
{
  const double spacing = 2.0 * std::min(MeanSide(first), MeanSide(second));
  return { ComputeTriangleSurfaceDistance(first, TriangleTree(second), spacing, mostTriangles),
           ComputeTriangleSurfaceDistance(second, TriangleTree(first), spacing, mostTriangles) };
}

} // namespace itk
