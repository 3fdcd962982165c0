#include "rhombicTriangleCells.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double TrianglesPerCell = 500.0; // about, of an actor that is not folded much

/** A grid of cubes over an actor. A triangle belongs to the cube with its first point. */
class CellGrid
{
public:
  explicit CellGrid(const ActorTriangles & actor)
    : m_Points(actor.points)
    , m_Lowest(actor.box.lowest)
  {
    float longest = 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      longest = std::max(longest, actor.box.highest[axis] - m_Lowest[axis]);
    }
    const double cells =
      std::clamp(std::sqrt(static_cast<double>(actor.triangles.size) / TrianglesPerCell), 1.0, 100.0);
    const auto cellsPerLength = static_cast<float>(cells / static_cast<double>(longest));
    m_CellsPerLength = std::isfinite(cellsPerLength) ? cellsPerLength : 0.0f; // one cell without extent
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Size[axis] = 1 + static_cast<std::size_t>((actor.box.highest[axis] - m_Lowest[axis]) * m_CellsPerLength);
    }
  }

  std::size_t
  NumberOfCells() const
  {
    return m_Size[0] * m_Size[1] * m_Size[2];
  }

  std::size_t
  CellOf(const TriangleOfActor & triangle) const
  {
    const PointOfActor & point = m_Points[triangle[0]];
    std::size_t cell = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      cell = cell * m_Size[axis] + static_cast<std::size_t>((point[axis] - m_Lowest[axis]) * m_CellsPerLength);
    }
    return cell;
  }

private:
  ArrayView<PointOfActor> m_Points;
  PointOfActor m_Lowest;
  float m_CellsPerLength = 0.0f;
  std::array<std::size_t, 3> m_Size{};
};

TriangleCell
MakeCell(const ActorTriangles & actor, const TriangleCells & ordered, std::size_t first, std::size_t end)
{
  const PointOfActor & start = actor.points[ordered.triangles[first][0]];
  TriangleCell cell{ { start, start }, first, end - first };
  for (std::size_t n = first; n < end; ++n)
  {
    for (const auto index : ordered.triangles[n])
    {
      cell.box.Add(actor.points[index]);
    }
  }
  return cell;
}

} // namespace

TriangleCells
SortIntoCells(const ActorTriangles & actor)
{
  if (actor.triangles.size == 0)
  {
    return {};
  }
  const CellGrid grid(actor);
  std::vector<std::size_t> places(grid.NumberOfCells() + 1, 0);
  for (const auto & triangle : actor.triangles)
  {
    ++places[grid.CellOf(triangle) + 1];
  }
  for (std::size_t n = 1; n < places.size(); ++n)
  {
    places[n] += places[n - 1];
  }
  TriangleCells ordered;
  ordered.triangles.resize(actor.triangles.size);
  for (const auto & triangle : actor.triangles)
  {
    ordered.triangles[places[grid.CellOf(triangle)]++] = triangle;
  }
  // Each place is now the end of its cell.
  std::size_t first = 0;
  for (const std::size_t end : places)
  {
    if (end > first)
    {
      ordered.cells.push_back(MakeCell(actor, ordered, first, end));
      first = end;
    }
  }
  return ordered;
}

itk::PointBox
FootprintOf(const itk::PointBox & box, const ActorMatrices & matrices)
{
  constexpr float slack = 1e-4f;
  const auto & matrix = matrices.clipFromCentred;
  itk::PointBox footprint{ { 2.0f, 2.0f, 1.0f }, { -1.0f, -1.0f, -slack } };
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    std::array<float, 4> clip{ matrix[12], matrix[13], matrix[14], matrix[15] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const float coordinate = (corner >> axis & 1U) != 0 ? box.highest[axis] : box.lowest[axis];
      for (std::size_t row = 0; row < 4; ++row)
      {
        clip[row] += matrix[4 * axis + row] * (coordinate - matrices.centre[axis]);
      }
    }
    if (clip[3] <= 0.0f) // beside or behind the viewer
    {
      return { { 0.0f, 0.0f, 0.0f }, { 1.0f, 1.0f, 1.0f } };
    }
    footprint.Add(itk::PointBox::PointType{
      0.5f + 0.5f * clip[0] / clip[3], 0.5f + 0.5f * clip[1] / clip[3], 0.5f + 0.5f * clip[2] / clip[3] });
  }
  const auto & [left, bottom, nearest] = footprint.lowest;
  const auto & [right, top, farthest] = footprint.highest;
  return { { left - slack, bottom - slack, nearest }, { right + slack, top + slack, farthest + slack } };
}

bool
PicturePart::Meets(const itk::PointBox & footprint) const
{
  return footprint.highest[0] >= left && footprint.lowest[0] <= right && footprint.highest[1] >= bottom &&
         footprint.lowest[1] <= top;
}

} // namespace rhombic
