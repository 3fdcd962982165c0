#include "rhombicTriangleCells.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double TrianglesPerCell = 500.0; // about, of a surface that is not folded much

/** A grid of cubes over a surface; one for each triangle, at its first point. */
class CellGrid
{
public:
  explicit CellGrid(const itk::TriangleSurface * surface)
    : m_Surface(surface)
  {
    const auto bounds = surface->GetBounds();
    double longest = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Lowest[axis] = static_cast<float>(bounds[2 * axis]);
      longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
    }
    const double cells = std::sqrt(static_cast<double>(surface->GetNumberOfTriangles()) / TrianglesPerCell);
    m_CellsPerMillimetre = static_cast<float>(longest > 0.0 ? std::clamp(cells, 1.0, 100.0) / longest : 0.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Size[axis] = 1 + static_cast<std::size_t>((static_cast<float>(bounds[2 * axis + 1]) - m_Lowest[axis]) *
                                                  m_CellsPerMillimetre);
    }
  }

  std::size_t
  NumberOfCells() const
  {
    return m_Size[0] * m_Size[1] * m_Size[2];
  }

  std::size_t
  CellOf(const itk::TriangleSurface::TriangleType & triangle) const
  {
    const auto & point = m_Surface->GetPoints()[triangle[0]];
    std::size_t cell = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      cell = cell * m_Size[axis] + static_cast<std::size_t>((point[axis] - m_Lowest[axis]) * m_CellsPerMillimetre);
    }
    return cell;
  }

private:
  const itk::TriangleSurface * m_Surface;
  std::array<float, 3> m_Lowest{};
  float m_CellsPerMillimetre = 0.0f;
  std::array<std::size_t, 3> m_Size{};
};

TriangleCell
MakeCell(const itk::TriangleSurface * surface, const TriangleCells & ordered, std::size_t first, std::size_t end)
{
  TriangleCell cell{ surface->GetPoints()[ordered.triangles[first][0]], {}, first, end - first };
  cell.highest = cell.lowest;
  for (std::size_t n = first; n < end; ++n)
  {
    for (const auto index : ordered.triangles[n])
    {
      const auto & point = surface->GetPoints()[index];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cell.lowest[axis] = std::min(cell.lowest[axis], point[axis]);
        cell.highest[axis] = std::max(cell.highest[axis], point[axis]);
      }
    }
  }
  return cell;
}

} // namespace

TriangleCells
SortIntoCells(const itk::TriangleSurface * surface)
{
  const CellGrid grid(surface);
  std::vector<std::size_t> places(grid.NumberOfCells() + 1, 0);
  for (const auto & triangle : surface->GetTriangles())
  {
    ++places[grid.CellOf(triangle) + 1];
  }
  for (std::size_t n = 1; n < places.size(); ++n)
  {
    places[n] += places[n - 1];
  }
  TriangleCells ordered;
  ordered.triangles.resize(surface->GetNumberOfTriangles());
  for (const auto & triangle : surface->GetTriangles())
  {
    ordered.triangles[places[grid.CellOf(triangle)]++] = triangle;
  }
  // Each place is now the end of its cell.
  std::size_t first = 0;
  for (const std::size_t end : places)
  {
    if (end > first)
    {
      ordered.cells.push_back(MakeCell(surface, ordered, first, end));
      first = end;
    }
  }
  return ordered;
}

} // namespace rhombic
