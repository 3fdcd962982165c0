#include "rhombicFewerTriangles.h"

#include "itkTriangleSurfaceForRendering.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <map>

namespace rhombic
{
namespace
{

using Points = itk::BulkVector<std::uint32_t>;
using Sides = std::array<std::uint32_t, 2>;
using Triangles = itk::TriangleSurface::TrianglesContainer;

/** A wall between two surfaces, or between one and the outside: its triangles with a point on a curve where it meets
 * another wall, or the rest. */
struct SharedWall
{
  Sides sides; ///< as in JoinedSurfaces
  bool isAtCurve;
  Triangles triangles;
};

/** Whether triangles of several walls meet at each point. */
itk::BulkVector<std::uint8_t>
FindCurves(const JoinedSurfaces & joined)
{
  itk::BulkVector<Sides> sidesOfPoint(joined.surface->GetNumberOfPoints(), Sides{}); // of the point's last triangle
  itk::BulkVector<std::uint8_t> isOnCurve(joined.surface->GetNumberOfPoints(), 0);
  for (std::size_t n = 0; n < joined.sides.size(); ++n)
  {
    for (const std::uint32_t point : joined.surface->GetTriangles()[n])
    {
      Sides & last = sidesOfPoint[point];
      isOnCurve[point] |= last != Sides{} && last != joined.sides[n] ? 1 : 0;
      last = joined.sides[n];
    }
  }
  return isOnCurve;
}

std::vector<SharedWall>
WallsOf(const JoinedSurfaces & joined)
{
  const itk::BulkVector<std::uint8_t> isOnCurve = FindCurves(joined);
  std::map<std::pair<Sides, bool>, Triangles> triangles;
  for (std::size_t n = 0; n < joined.sides.size(); ++n)
  {
    const auto & triangle = joined.surface->GetTriangles()[n];
    const bool isAtCurve = (isOnCurve[triangle[0]] | isOnCurve[triangle[1]] | isOnCurve[triangle[2]]) != 0;
    triangles[{ joined.sides[n], isAtCurve }].push_back(triangle);
  }
  std::vector<SharedWall> walls;
  for (auto & [wall, ofWall] : triangles)
  {
    walls.push_back({ wall.first, wall.second, std::move(ofWall) });
  }
  return walls;
}

/** The values of some points. */
template <typename TContainer>
TContainer
Gather(const TContainer & values, const Points & points)
{
  TContainer gathered;
  for (const std::uint32_t point : points)
  {
    gathered.push_back(values[point]);
  }
  return gathered;
}

/** The surface with some of its points, and triangles between these. */
SceneSurface
WithPoints(SceneSurface surface, const Points & points, Triangles triangles)
{
  const auto fewer = itk::TriangleSurface::New();
  fewer->GetPoints() = Gather(surface.surface->GetPoints(), points);
  if (surface.surface->HasNormals())
  {
    fewer->GetNormals() = Gather(surface.surface->GetNormals(), points);
  }
  fewer->GetTriangles() = std::move(triangles);
  surface.surface = fewer;
  if (surface.pointColours)
  {
    surface.pointColours = std::make_shared<const PointColours>(Gather(*surface.pointColours, points));
  }
  if (surface.pointValues)
  {
    surface.pointValues = std::make_shared<const PointValues>(
      PointValues{ surface.pointValues->name, Gather(surface.pointValues->values, points) });
  }
  return surface;
}

/** A surface of its walls.
 * \param joinedPoints those that the surface's points are
 * \param numbers scratch memory: a number for each joined point */
SceneSurface
FromWalls(const SceneSurface & surface,
          std::uint32_t number,
          const std::vector<SharedWall> & walls,
          const Points & joinedPoints,
          Points & numbers)
{
  for (std::uint32_t point = 0; point < joinedPoints.size(); ++point)
  {
    numbers[joinedPoints[point]] = point;
  }
  Triangles triangles;
  itk::BulkVector<std::uint8_t> isUsed(joinedPoints.size(), 0);
  for (const SharedWall & wall : walls)
  {
    const bool isTurned = wall.sides[1] == number;
    for (const auto & [a, b, c] : wall.sides[0] == number || isTurned ? wall.triangles : Triangles())
    {
      triangles.push_back({ numbers[a], numbers[isTurned ? c : b], numbers[isTurned ? b : c] });
      for (const std::uint32_t point : triangles.back())
      {
        isUsed[point] = 1;
      }
    }
  }
  Points used;
  for (std::uint32_t point = 0; point < isUsed.size(); ++point)
  {
    if (isUsed[point] != 0)
    {
      numbers[joinedPoints[point]] = static_cast<std::uint32_t>(used.size());
      used.push_back(point);
    }
  }
  for (auto & triangle : triangles)
  {
    for (std::uint32_t & point : triangle)
    {
      point = numbers[joinedPoints[point]];
    }
  }
  return WithPoints(surface, used, std::move(triangles));
}

} // namespace

std::vector<SceneSurface>
InFewerTriangles(const std::vector<SceneSurface> & surfaces, double distance, double leastShare)
{
  const JoinedSurfaces joined = JoinSurfaces(surfaces);
  std::vector<SharedWall> walls = WallsOf(joined);
  ForEachOnThreads(walls.size(), [&](std::size_t n) {
    if (!walls[n].isAtCurve)
    {
      Triangles & triangles = walls[n].triangles;
      const auto least = static_cast<itk::SizeValueType>(leastShare * static_cast<double>(triangles.size()));
      triangles = itk::SimplifySheetForRendering(joined.surface->GetPoints(), triangles, distance, least);
    }
  });
  std::vector<SceneSurface> fewer;
  Points numbers(joined.surface->GetNumberOfPoints());
  for (std::uint32_t n = 0; n < surfaces.size(); ++n)
  {
    fewer.push_back(FromWalls(surfaces[n], n + 1, walls, joined.points[n], numbers));
  }
  return fewer;
}

} // namespace rhombic
