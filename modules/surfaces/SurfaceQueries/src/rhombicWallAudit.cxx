#include "rhombicWallAudit.h"

#include <algorithm>
#include <array>
#include <set>

namespace rhombic
{
namespace
{

/** A side of a triangle, from the lower point to the higher. */
struct Side
{
  std::array<std::uint32_t, 2> points;
  std::uint32_t triangle;
};

std::size_t
CountLoneJunctions(const JoinedSurfaces & joined)
{
  itk::BulkVector<Side> sides;
  for (std::uint32_t n = 0; n < joined.sides.size(); ++n)
  {
    const auto & triangle = joined.surface->GetTriangles()[n];
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax({ triangle[corner], triangle[(corner + 1) % 3] });
      sides.push_back({ { low, high }, n });
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side & a, const Side & b) { return a.points < b.points; });
  std::size_t lone = 0;
  for (auto begin = sides.begin(); begin != sides.end();)
  {
    const auto end = std::find_if(begin, sides.end(), [&](const Side & side) { return side.points != begin->points; });
    if (end - begin > 2)
    {
      std::set<std::uint32_t> regions;
      std::for_each(begin, end, [&](const Side & side) {
        regions.insert(joined.sides[side.triangle].begin(), joined.sides[side.triangle].end());
      });
      lone += regions.size() < 3 ? 1 : 0;
    }
    begin = end;
  }
  return lone;
}

std::size_t
CountRepeated(const itk::TriangleSurface & surface)
{
  itk::TriangleSurface::TrianglesContainer triangles(surface.GetTriangles().begin(), surface.GetTriangles().end());
  for (auto & triangle : triangles)
  {
    std::sort(triangle.begin(), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return static_cast<std::size_t>(triangles.end() - std::unique(triangles.begin(), triangles.end()));
}

} // namespace

void
WallAudit::Add(const WallAudit & other)
{
  sharedTriangles += other.sharedTriangles;
  oneSidedTriangles += other.oneSidedTriangles;
  repeatedTriangles += other.repeatedTriangles;
  loneJunctions += other.loneJunctions;
  intersections.testedTriangles += other.intersections.testedTriangles;
  intersections.crossingPairs += other.intersections.crossingPairs;
  intersections.touchingPairs += other.intersections.touchingPairs;
}

WallAudit
AuditWalls(const std::vector<SceneSurface> & surfaces, const itk::TriangleSurfaceAuditSettings & settings)
{
  const JoinedSurfaces joined = JoinSurfaces(surfaces);
  WallAudit audit;
  for (const auto & [first, second] : joined.sides)
  {
    audit.sharedTriangles += second != 0 && second != first ? 1 : 0;
    audit.oneSidedTriangles += second == first ? 1 : 0;
  }
  audit.repeatedTriangles = CountRepeated(*joined.surface);
  audit.loneJunctions = CountLoneJunctions(joined);
  if (settings.testsIntersections)
  {
    audit.intersections =
      FindTriangleSurfaceSelfIntersections(itk::TriangleTree(*joined.surface), settings.maximumTestedTriangles);
  }
  return audit;
}

} // namespace rhombic
