#ifndef itkTestSurfaces_h
#define itkTestSurfaces_h

#include "itkTriangleSurface.h"

#include <cmath>

/** Triangle surfaces made from formulas, for tests. */
namespace surfacetest
{

using Surface = itk::TriangleSurface;

constexpr double Pi = 3.14159265358979323846;

/** Two triangles for each square of \a columns x \a rows squares of points; indices wrap around where told. Faces
 * outwards where the direction of columns, that of rows and the outward normal are a right-handed frame. */
inline void
AddGrid(Surface & surface, std::uint32_t columns, std::uint32_t rows, bool wrapColumns, bool wrapRows)
{
  const std::uint32_t width = wrapColumns ? columns : columns + 1;
  const std::uint32_t height = wrapRows ? rows : rows + 1;
  const auto          first = static_cast<std::uint32_t>(surface.GetNumberOfPoints() - width * height);
  const auto          id = [=](std::uint32_t column, std::uint32_t row) {
    return first + column % width + width * (row % height);
  };
  for (std::uint32_t row = 0; row < rows; ++row)
  {
    for (std::uint32_t column = 0; column < columns; ++column)
    {
      surface.GetTriangles().push_back({ id(column, row), id(column + 1, row), id(column + 1, row + 1) });
      surface.GetTriangles().push_back({ id(column, row), id(column + 1, row + 1), id(column, row + 1) });
    }
  }
}

/** A torus about the z axis. */
inline Surface::Pointer
MakeTorus(double major, double minor, std::uint32_t around, std::uint32_t across)
{
  auto surface = Surface::New();
  for (std::uint32_t row = 0; row < across; ++row)
  {
    for (std::uint32_t column = 0; column < around; ++column)
    {
      const double u = 2.0 * Pi * column / around;
      const double v = 2.0 * Pi * row / across;
      const double ring = major + minor * std::cos(v);
      surface->GetPoints().push_back({ static_cast<float>(ring * std::cos(u)),
                                       static_cast<float>(ring * std::sin(u)),
                                       static_cast<float>(minor * std::sin(v)) });
    }
  }
  AddGrid(*surface, around, across, true, true);
  return surface;
}

/** A sheet of squares of side \a step in the plane at height \a z, its corner at the origin, facing up. */
inline Surface::Pointer
MakeSheet(std::uint32_t columns, std::uint32_t rows, double step, double z = 0.0)
{
  auto surface = Surface::New();
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    for (std::uint32_t column = 0; column <= columns; ++column)
    {
      surface->GetPoints().push_back(
        { static_cast<float>(step * column), static_cast<float>(step * row), static_cast<float>(z) });
    }
  }
  AddGrid(*surface, columns, rows, false, false);
  return surface;
}

/** The tetrahedron with corners at \a corner and \a size from it along each axis, facing outwards. */
inline Surface::Pointer
MakeTetrahedron(const Surface::PointType & corner = {}, float size = 1.0f)
{
  auto surface = Surface::New();
  surface->GetPoints() = { corner, corner, corner, corner };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    surface->GetPoints()[axis + 1][axis] += size;
  }
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return surface;
}

/** Adds a copy of \a other, moved. */
inline void
Append(Surface & surface, const Surface & other, const Surface::PointType & shift = {})
{
  const auto first = static_cast<std::uint32_t>(surface.GetNumberOfPoints());
  for (auto point : other.GetPoints())
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] += shift[axis];
    }
    surface.GetPoints().push_back(point);
  }
  for (const auto & triangle : other.GetTriangles())
  {
    surface.GetTriangles().push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
}

} // namespace surfacetest

#endif
