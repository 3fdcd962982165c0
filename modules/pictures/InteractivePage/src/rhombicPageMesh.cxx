#include "rhombicPageMesh.h"

#include "rhombicPageBytes.h"

#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceSimplification.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace rhombic
{
namespace
{

using Surface = itk::TriangleSurface;
using Sides = std::array<std::uint32_t, 2>;
using Position = std::array<std::uint16_t, 4>; // meshoptimizer codes multiples of 4 bytes

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
QuantizePoints(const Surface & surface, const PageMesh & mesh)
{
  std::vector<Position> positions;
  positions.reserve(surface.GetNumberOfPoints());
  for (const auto & point : surface.GetPoints())
  {
    Position & position = positions.emplace_back(Position{});
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

PageMeshMaker::PageMeshMaker(const std::vector<SceneSurface> & surfaces)
{
  const JoinedSurfaces joined = JoinSurfaces(surfaces);
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
    SimplifyTriangleSurface(*m_Surface, m_Sheets, { triangles, error - m_Error }, report); // distances add up
    m_Error = error;
  }
  catch (const itk::ExceptionObject & exception)
  {
    m_Surface = before;
    m_Sheets = sheets;
    m_Refusal = exception.GetDescription();
  }
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
  Encode(std::move(corners), QuantizePoints(surface, mesh), mesh);
  return mesh;
}

} // namespace rhombic
