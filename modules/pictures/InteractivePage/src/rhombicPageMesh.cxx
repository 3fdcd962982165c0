#include "rhombicPageMesh.h"

#include "rhombicPageBytes.h"

#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceSimplification.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace rhombic
{
namespace
{

using Surface = itk::TriangleSurface;
using Sides = std::array<std::uint32_t, 2>;
using Position = std::array<std::uint16_t, 4>; // meshoptimizer codes multiples of 4 bytes

constexpr double LeastOfShare = 0.5; // of a sheet, where others kept more

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

/** Simplifies sheets that have no points in common, each on its own: they may lie in the same place, as walls of
 * neighbours do, where one could not change beside the other. Each is simplified to the same share of its triangles, or
 * to a smaller one where those before it kept more. */
void
SimplifyApart(Surface & surface,
              std::vector<std::uint32_t> & sheets,
              std::size_t numberOfSheets,
              std::size_t triangles,
              double error,
              const ProgressFunction & report)
{
  auto wanted = static_cast<double>(triangles); // of this and the following sheets
  auto remaining = static_cast<double>(sheets.size());
  std::vector<Surface::Pointer> parts;
  for (std::size_t n = 0; n < numberOfSheets; ++n)
  {
    parts.push_back(Surface::New());
    parts.back()->GetPoints() = surface.GetPoints();
    for (std::size_t triangle = 0; triangle < sheets.size(); ++triangle)
    {
      if (sheets[triangle] == n)
      {
        parts.back()->GetTriangles().push_back(surface.GetTriangles()[triangle]);
      }
    }
    parts.back()->RemoveUnusedPoints();
    const auto before = static_cast<double>(parts.back()->GetNumberOfTriangles());
    const double target =
      std::max(LeastOfShare * static_cast<double>(triangles) / static_cast<double>(sheets.size()), wanted / remaining) *
      before;
    // Surfaces of labels may meet themselves at edges and points, as sheets may, but not those of sheet 0 alone.
    std::vector<std::uint32_t> sheet(parts.back()->GetNumberOfTriangles(), 1);
    SimplifyTriangleSurface(
      *parts.back(), sheet, { std::max<std::size_t>(1, static_cast<std::size_t>(target)), error });
    wanted -= static_cast<double>(parts.back()->GetNumberOfTriangles());
    remaining -= before;
    if (report)
    {
      report(static_cast<double>(n + 1) / static_cast<double>(numberOfSheets));
    }
  }
  surface.GetPoints().clear();
  surface.GetTriangles().clear();
  sheets.clear();
  for (std::uint32_t n = 0; n < numberOfSheets; ++n)
  {
    Append(*parts[n], surface);
    sheets.resize(surface.GetNumberOfTriangles(), n);
  }
}

/** The value of a surface's point nearest to a position, linear in the triangle; NaN where a corner has none. */
double
ValueNear(const SceneSurface & surface,
          const itk::TriangleTree & tree,
          const itk::TriangleTree::PositionType & position)
{
  const auto nearest = tree.FindClosestPoint(position);
  if (nearest.triangle == itk::TriangleTree::None)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto & triangle = surface.surface->GetTriangles()[nearest.triangle];
  std::array<Vector3, 3> corners;
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const auto & point = surface.surface->GetPoints()[triangle[corner]];
    corners[corner] = { point[0], point[1], point[2] };
  }
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t corner = 0; corner < 3; ++corner) // the area opposite to a corner is its weight
  {
    const Vector3 & next = corners[(corner + 1) % 3];
    const Vector3 & last = corners[(corner + 2) % 3];
    const double weight = Length(Cross(Subtract(next, nearest.point), Subtract(last, nearest.point)));
    sum += weight * static_cast<double>(surface.pointValues->values[triangle[corner]]);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : static_cast<double>(surface.pointValues->values[triangle[0]]);
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
std::vector<std::uint32_t>
OrderTriangles(const Surface & surface,
               const std::vector<Sides> & sides,
               const std::vector<std::uint32_t> & sheets,
               PageMesh & mesh)
{
  const auto & triangles = surface.GetTriangles();
  const std::size_t points = surface.GetNumberOfPoints();
  std::vector<std::vector<std::uint32_t>> corners(sides.size());
  for (std::size_t n = 0; n < triangles.size(); ++n)
  {
    auto & sheet = corners[sheets[n]];
    sheet.insert(sheet.end(), triangles[n].begin(), triangles[n].end());
  }
  std::vector<std::uint32_t> ordered;
  for (std::size_t n = 0; n < corners.size(); ++n)
  {
    if (!corners[n].empty())
    {
      const std::size_t first = ordered.size();
      ordered.resize(first + corners[n].size());
      meshopt_optimizeVertexCacheStrip(ordered.data() + first, corners[n].data(), corners[n].size(), points);
      mesh.sheets.push_back({ sides[n][0], sides[n][1], corners[n].size() / 3 });
    }
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
Encode(std::vector<std::uint32_t> corners, const std::vector<Position> & positions, PageMesh & mesh)
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

} // namespace

PageMeshMaker::PageMeshMaker(const std::vector<SceneSurface> & surfaces, const std::optional<ColourScale> & scale)
  : m_Scale(scale)
  , m_Valued(scale ? surfaces : std::vector<SceneSurface>())
{
  const JoinedSurfaces joined = scale ? AppendSurfaces(surfaces) : JoinSurfaces(surfaces);
  std::map<Sides, std::uint32_t> numbers;
  for (const Sides & sides : joined.sides)
  {
    numbers.emplace(sides, 0);
  }
  for (auto & [sides, number] : numbers)
  {
    number = static_cast<std::uint32_t>(m_Sides.size());
    m_Sides.push_back(sides);
  }
  for (const Sides & sides : joined.sides)
  {
    m_Sheets.push_back(numbers[sides]);
  }
  m_Surface = joined.surface;
  const auto original = Surface::New();
  original->Graft(m_Surface);
  m_Original = original;
}

std::size_t
PageMeshMaker::GetNumberOfTriangles() const
{
  return m_Surface->GetNumberOfTriangles();
}

void
PageMeshMaker::Simplify(std::size_t triangles, double error, const ProgressFunction & report)
{
  if (triangles >= this->GetNumberOfTriangles() || error <= m_Error || !m_Refusal.empty())
  {
    return;
  }
  const auto before = Surface::New();
  before->Graft(m_Surface);
  const auto sheets = m_Sheets;
  try
  {
    const double further = error - m_Error; // distances add up
    if (this->AreApart())
    {
      SimplifyApart(*m_Surface, m_Sheets, m_Sides.size(), triangles, further, report);
    }
    else
    {
      SimplifyTriangleSurface(*m_Surface, m_Sheets, { triangles, further }, report);
    }
    m_Error = error;
  }
  catch (const itk::ExceptionObject & exception)
  {
    m_Surface = before;
    m_Sheets = sheets;
    m_Refusal = exception.GetDescription();
  }
}

std::vector<std::uint16_t>
PageMeshMaker::NumberValues() const
{
  std::vector<std::uint16_t> numbers;
  if (!m_Scale)
  {
    return numbers;
  }
  std::vector<std::uint32_t> owners(m_Surface->GetNumberOfPoints(), 0); // surfaces of points, from 1
  for (std::size_t n = 0; n < m_Sheets.size(); ++n)
  {
    for (const std::uint32_t point : m_Surface->GetTriangles()[n])
    {
      owners[point] = m_Sides[m_Sheets[n]][0];
    }
  }
  numbers.resize(owners.size(), 0);
  const Surface & simplified = *m_Surface;
  for (std::uint32_t owner = 1; owner <= m_Valued.size(); ++owner)
  {
    const SceneSurface & valued = m_Valued[owner - 1];
    if (!valued.pointValues)
    {
      continue;
    }
    const itk::TriangleTree tree(*valued.surface);
    constexpr std::size_t blockSize = 1024;
    ForEachInBlocks(owners.size(), blockSize, [&](std::size_t n) {
      if (owners[n] == owner)
      {
        const auto & point = simplified.GetPoints()[n];
        numbers[n] = NumberOf(*m_Scale, ValueNear(valued, tree, { point[0], point[1], point[2] }));
      }
    });
  }
  return numbers;
}

PageMesh
PageMeshMaker::Make() const
{
  const Surface & surface = *m_Surface;
  PageMesh mesh;
  mesh.trianglesBefore = m_Original->GetNumberOfTriangles();
  mesh.refusal = m_Refusal;
  mesh.error = m_Error;
  if (m_Error > 0.0)
  {
    constexpr itk::SizeValueType measured = 30'000; // triangles of either surface
    mesh.measuredError = ComputeTriangleSurfaceDistances(*m_Original, surface, measured).GetMaximum();
  }
  mesh.triangles = surface.GetNumberOfTriangles();
  PlaceQuanta(surface, mesh);
  std::vector<std::uint32_t> corners = OrderTriangles(surface, m_Sides, m_Sheets, mesh);
  Encode(std::move(corners), QuantizePoints(surface, mesh, this->NumberValues()), mesh);
  return mesh;
}

} // namespace rhombic
