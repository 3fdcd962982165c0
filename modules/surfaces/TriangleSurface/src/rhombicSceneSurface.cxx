#include "rhombicSceneSurface.h"

#include "detail/rhombicPointWelder.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace rhombic
{
namespace
{

/** A triangle of one of the surfaces. */
struct Face
{
  itk::TriangleSurface::TriangleType points; ///< ascending
  bool isEven;                               ///< whether ascending points go round as those of the triangle
  std::uint32_t number;                      ///< among the triangles of all surfaces
};

Face
MakeFace(itk::TriangleSurface::TriangleType points, std::uint32_t number)
{
  bool isEven = true;
  for (const auto & [a, b] : { std::pair{ 0, 1 }, std::pair{ 1, 2 }, std::pair{ 0, 1 } })
  {
    if (points[a] > points[b])
    {
      std::swap(points[a], points[b]);
      isEven = !isEven;
    }
  }
  return { points, isEven, number };
}

bool
HaveSamePoints(const Face & a, const Face & b)
{
  return a.points[0] == b.points[0] && a.points[1] == b.points[1] && a.points[2] == b.points[2];
}

/** The faces ordered by their points, and by their numbers where points are equal. */
itk::BulkVector<Face>
Ordered(const itk::BulkVector<Face> & faces, std::size_t numberOfPoints)
{
  itk::BulkVector<std::size_t> places(numberOfPoints + 1, 0); // of the faces with a lowest point
  for (const Face & face : faces)
  {
    ++places[face.points[0] + 1];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  itk::BulkVector<Face> ordered(faces.size());
  for (const Face & face : faces)
  {
    ordered[places[face.points[0]]++] = face;
  }
  // Each place is now the end of its faces.
  auto begin = ordered.begin();
  for (const std::size_t place : places)
  {
    const auto end = ordered.begin() + static_cast<std::ptrdiff_t>(place);
    std::sort(begin, end, [](const Face & a, const Face & b) {
      return std::tie(a.points[1], a.points[2], a.number) < std::tie(b.points[1], b.points[2], b.number);
    });
    begin = end;
  }
  return ordered;
}

/** For each triangle the number of the triangle that it is turned over, or its own number. */
itk::BulkVector<std::uint32_t>
FindOpposites(const itk::BulkVector<Face> & faces)
{
  itk::BulkVector<std::uint32_t> opposites(faces.size());
  for (auto begin = faces.begin(); begin != faces.end();)
  {
    const auto end = std::find_if(begin, faces.end(), [&](const Face & face) { return !HaveSamePoints(face, *begin); });
    const bool isPair = end - begin == 2 && begin->isEven != (begin + 1)->isEven;
    opposites[begin->number] = isPair ? (begin + 1)->number : begin->number;
    for (auto face = begin + 1; face != end; ++face)
    {
      opposites[face->number] = isPair ? begin->number : face->number;
    }
    begin = end;
  }
  return opposites;
}

} // namespace

JoinedSurfaces
JoinSurfaces(const std::vector<SceneSurface> & surfaces)
{
  JoinedSurfaces joined;
  joined.surface = itk::TriangleSurface::New();
  std::size_t numberOfPoints = 0;
  std::size_t numberOfTriangles = 0;
  for (const SceneSurface & surface : surfaces)
  {
    numberOfPoints += surface.surface->GetNumberOfPoints();
    numberOfTriangles += surface.surface->GetNumberOfTriangles();
  }
  PointWelder welder(joined.surface->GetPoints(), numberOfPoints);
  itk::TriangleSurface::TrianglesContainer triangles;
  itk::BulkVector<Face> faces;
  itk::BulkVector<std::uint32_t> surfaceOf;
  triangles.reserve(numberOfTriangles);
  faces.reserve(numberOfTriangles);
  surfaceOf.reserve(numberOfTriangles);
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const itk::TriangleSurface & surface = *surfaces[n].surface;
    itk::BulkVector<std::uint32_t> & numbers = joined.points.emplace_back();
    numbers.reserve(surface.GetNumberOfPoints());
    for (const auto & point : surface.GetPoints())
    {
      numbers.push_back(welder.Add(point));
    }
    for (const auto & [a, b, c] : surface.GetTriangles())
    {
      triangles.push_back({ numbers[a], numbers[b], numbers[c] });
      faces.push_back(MakeFace(triangles.back(), static_cast<std::uint32_t>(faces.size())));
      surfaceOf.push_back(static_cast<std::uint32_t>(n + 1));
    }
  }
  const itk::BulkVector<std::uint32_t> opposites = FindOpposites(Ordered(faces, joined.surface->GetNumberOfPoints()));
  for (std::uint32_t n = 0; n < triangles.size(); ++n)
  {
    if (opposites[n] >= n)
    {
      joined.surface->GetTriangles().push_back(triangles[n]);
      joined.sides.push_back({ surfaceOf[n], opposites[n] == n ? 0 : surfaceOf[opposites[n]] });
    }
  }
  return joined;
}

} // namespace rhombic
