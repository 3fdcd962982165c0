#include "rhombicBCCCells.h"

#include "rhombicGridSurface.h"

#include <cmath>

namespace rhombic
{
namespace
{

/** Marches the cell that is anchored at a site, if all its corners are sites in the box. */
template <typename TKind>
void
MarchBCCCell(const std::array<int, 3> & anchor, GridSurface & surface)
{
  constexpr const itk::LatticeCell & cell = TKind::Cell;
  std::array<GridSurface::Corner, itk::LatticeCell::MaximumCorners> corners;
  unsigned int pattern = 0;
  for (unsigned int corner = 0; corner < cell.numberOfCorners; ++corner)
  {
    auto & [point, value] = corners[corner];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] = anchor[axis] + static_cast<int>(cell.corners[corner][axis]);
    }
    value = surface.ValueAt(point);
    if (std::isnan(value))
    {
      return;
    }
    pattern |= (value >= 0.0F ? 1U : 0U) << corner;
  }
  const auto & found = TKind::Cases.cases[pattern];
  const auto pointOn = [&](unsigned int n) {
    const auto & edge = cell.edges[n];
    return surface.PointBetween(corners[edge.start], corners[edge.end], edge.type);
  };
  for (unsigned int n = 0; n < found.triangles; ++n)
  {
    const auto & [a, b, c] = found.edges[n];
    surface.AddTriangle(pointOn(a), pointOn(b), pointOn(c));
  }
}

template <typename... TKinds>
itk::TriangleSurface::Pointer
MarchBCCCells(const TetrahedraGrid & grid)
{
  constexpr bool onEvenSitesOnly = (TKinds::OnEvenSitesOnly || ...);
  GridSurface surface(grid);
  for (int z = 0; z < grid.size[2]; z += onEvenSitesOnly ? 2 : 1)
  {
    for (int y = z % 2; y < grid.size[1]; y += 2)
    {
      for (int x = z % 2; x < grid.size[0]; x += 2)
      {
        (MarchBCCCell<TKinds>({ x, y, z }, surface), ...);
      }
    }
  }
  return surface.GetSurface();
}

} // namespace

itk::TriangleSurface::Pointer
MarchBCCOctahedra(const TetrahedraGrid & grid)
{
  return MarchBCCCells<BCCOctahedron<0>, BCCOctahedron<1>, BCCOctahedron<2>>(grid);
}

itk::TriangleSurface::Pointer
MarchBCCHexahedra(const TetrahedraGrid & grid)
{
  return MarchBCCCells<BCCHexahedron>(grid);
}

} // namespace rhombic
