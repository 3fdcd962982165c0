#include "rhombicPageMesh.h"

#include "rhombicPageBytes.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rhombic
{
namespace
{

using Surface = itk::TriangleSurface;
using Sides = std::array<std::uint32_t, 2>;
using Corners = std::vector<std::uint32_t>;    // points of triangles, three for each
using Position = std::array<std::uint16_t, 4>; // meshoptimizer codes multiples of 4 bytes

/** Adds points and triangles of a surface to others. */
void
Append(const Surface & surface, Surface & joined)
{
  const auto first = static_cast<std::uint32_t>(joined.GetNumberOfPoints());
  auto & points = joined.GetPoints();
  points.insert(points.end(), surface.GetPoints().begin(), surface.GetPoints().end());
  for (const auto & [a, b, c] : surface.GetTriangles())
  {
    joined.GetTriangles().push_back({ first + a, first + b, first + c });
  }
}

/** All surfaces as one mesh, in which each has its own points and triangles. */
JoinedSurfaces
AppendSurfaces(const std::vector<SceneSurface> & surfaces)
{
  JoinedSurfaces joined;
  joined.surface = Surface::New();
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    Append(*surfaces[n].surface, *joined.surface);
    joined.sides.resize(joined.surface->GetNumberOfTriangles(), { static_cast<std::uint32_t>(n + 1), 0 });
  }
  return joined;
}

/** The number of a value: 1 at the scale's lower end, 255 at its upper end, 0 for none. */
std::uint16_t
NumberOf(const ColourScale & scale, double value)
{
  constexpr double steps = 254.0;
  const double share = (value - scale.low) / (scale.high - scale.low);
  return std::isnan(share) ? 0 : static_cast<std::uint16_t>(1 + std::lround(steps * ToUnit(share)));
}

/** Triangles in the order of their sheets, and in each in the order of the vertex cache. */
Corners
OrderTriangles(const std::map<Sides, Corners> & sheets, std::size_t points, PageMesh & mesh)
{
  Corners ordered;
  for (const auto & [sides, corners] : sheets)
  {
    const std::size_t first = ordered.size();
    ordered.resize(first + corners.size());
    meshopt_optimizeVertexCacheStrip(ordered.data() + first, corners.data(), corners.size(), points);
    mesh.sheets.push_back({ sides[0], sides[1], corners.size() / 3 });
  }
  return ordered;
}

/** The place of the 16-bit positions: a cube around all points. */
void
PlaceQuanta(const Surface & surface, PageMesh & mesh)
{
  constexpr double largest = 65535.0;
  const std::array<double, 6> bounds = surface.GetBounds();
  mesh.origin = { bounds[0], bounds[2], bounds[4] };
  mesh.extent = { bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] };
  const double side = *std::max_element(mesh.extent.begin(), mesh.extent.end());
  mesh.quantum = side > 0.0 ? side / largest : 1.0;
}

std::vector<Position>
QuantizePoints(const Surface & surface, const PageMesh & mesh, const std::vector<std::uint16_t> & values)
{
  std::vector<Position> positions;
  positions.reserve(surface.GetNumberOfPoints());
  for (const auto & point : surface.GetPoints())
  {
    Position & position = positions.emplace_back(Position{});
    position[3] = values.empty() ? 0 : values[positions.size() - 1];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<std::uint16_t>(std::lround((point[axis] - mesh.origin[axis]) / mesh.quantum));
    }
  }
  return positions;
}

void
Encode(Corners corners, const std::vector<Position> & positions, PageMesh & mesh)
{
  std::vector<unsigned int> newNumbers(positions.size());
  mesh.points = meshopt_optimizeVertexFetchRemap(newNumbers.data(), corners.data(), corners.size(), positions.size());
  meshopt_remapIndexBuffer(corners.data(), corners.data(), corners.size(), newNumbers.data());
  std::vector<Position> ordered(positions.size());
  meshopt_remapVertexBuffer(ordered.data(), positions.data(), positions.size(), sizeof(Position), newNumbers.data());
  meshopt_encodeVertexVersion(0);
  meshopt_encodeIndexVersion(1);
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(mesh.points, sizeof(Position)));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), ordered.data(), mesh.points, sizeof(Position)));
  mesh.pointBytes = Deflate({ reinterpret_cast<const char *>(bytes.data()), bytes.size() });
  bytes.resize(meshopt_encodeIndexBufferBound(corners.size(), mesh.points));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), corners.size()));
  mesh.triangleBytes = Deflate({ reinterpret_cast<const char *>(bytes.data()), bytes.size() });
}

/** The numbers of the values of the points of surfaces, one surface after the other. */
std::vector<std::uint16_t>
NumberValues(const std::vector<SceneSurface> & surfaces, const ColourScale & scale)
{
  std::vector<std::uint16_t> numbers;
  for (const SceneSurface & surface : surfaces)
  {
    for (std::size_t n = 0; n < surface.surface->GetNumberOfPoints(); ++n)
    {
      numbers.push_back(surface.pointValues ? NumberOf(scale, surface.pointValues->values[n]) : 0);
    }
  }
  return numbers;
}

} // namespace

PageMesh
MakePageMesh(const std::vector<SceneSurface> & surfaces, const std::optional<ColourScale> & scale)
{
  const JoinedSurfaces joined = scale ? AppendSurfaces(surfaces) : JoinSurfaces(surfaces);
  std::map<Sides, Corners> sheets;
  for (std::size_t n = 0; n < joined.sides.size(); ++n)
  {
    const auto & triangle = joined.surface->GetTriangles()[n];
    Corners & corners = sheets[joined.sides[n]];
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  PageMesh mesh;
  mesh.triangles = joined.sides.size();
  PlaceQuanta(*joined.surface, mesh);
  const auto values = scale ? NumberValues(surfaces, *scale) : std::vector<std::uint16_t>();
  Encode(OrderTriangles(sheets, joined.surface->GetNumberOfPoints(), mesh),
         QuantizePoints(*joined.surface, mesh, values),
         mesh);
  return mesh;
}

} // namespace rhombic
