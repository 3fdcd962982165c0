#ifndef itkExampleSurfaces_h
#define itkExampleSurfaces_h

#include "itkTriangleSurface.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>

/** Closed surfaces of known shape, facing outwards, and triangles at random. */
namespace itk::example
{

/** Adds a copy of \a other, moved by \a shift. */
inline void
Append(TriangleSurface & surface, const TriangleSurface & other, const TriangleSurface::PointType & shift = {})
{
  const auto first = static_cast<std::uint32_t>(surface.GetNumberOfPoints());
  for (const auto & point : other.GetPoints())
  {
    surface.GetPoints().push_back({ point[0] + shift[0], point[1] + shift[1], point[2] + shift[2] });
  }
  for (const auto & triangle : other.GetTriangles())
  {
    surface.GetTriangles().push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
}

/** Turns every triangle round, as the wall of a cavity. */
inline void
TurnInsideOut(TriangleSurface & surface)
{
  for (auto & triangle : surface.GetTriangles())
  {
    std::swap(triangle[1], triangle[2]);
  }
}

/** The tetrahedron with corners at the origin and \a size along each axis. */
inline TriangleSurface::Pointer
MakeTetrahedron(float size = 1.0f)
{
  auto surface = TriangleSurface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { size, 0, 0 }, { 0, size, 0 }, { 0, 0, size } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return surface;
}

/** An octahedron whose triangles are quartered \a levels times, on a sphere around \a centre: 8 4^levels triangles. */
inline TriangleSurface::Pointer
MakeSphere(double radius, unsigned int levels, const std::array<double, 3> & centre = {})
{
  using Direction = std::array<double, 3>;
  std::vector<Direction> directions{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  std::vector<TriangleSurface::TriangleType> triangles{ { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                                        { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (unsigned int level = 0; level < levels; ++level)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions.size()));
      if (isNew)
      {
        Direction sum{ directions[a][0] + directions[b][0],
                       directions[a][1] + directions[b][1],
                       directions[a][2] + directions[b][2] };
        const double length = std::hypot(sum[0], sum[1], sum[2]);
        directions.push_back({ sum[0] / length, sum[1] / length, sum[2] / length });
      }
      return found->second;
    };
    std::vector<TriangleSurface::TriangleType> finer;
    for (const auto & [a, b, c] : triangles)
    {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles = std::move(finer);
  }
  auto surface = TriangleSurface::New();
  for (const Direction & direction : directions)
  {
    surface->GetPoints().push_back({ static_cast<float>(centre[0] + radius * direction[0]),
                                     static_cast<float>(centre[1] + radius * direction[1]),
                                     static_cast<float>(centre[2] + radius * direction[2]) });
  }
  surface->GetTriangles().assign(triangles.begin(), triangles.end());
  return surface;
}

/** A torus around z, \a segments along and across. */
inline TriangleSurface::Pointer
MakeTorus(double radius, double tubeRadius, std::uint32_t segments)
{
  auto surface = TriangleSurface::New();
  const double step = 2.0 * std::acos(-1.0) / segments;
  for (std::uint32_t i = 0; i < segments; ++i)
  {
    for (std::uint32_t j = 0; j < segments; ++j)
    {
      const double fromAxis = radius + tubeRadius * std::cos(j * step);
      surface->GetPoints().push_back({ static_cast<float>(fromAxis * std::cos(i * step)),
                                       static_cast<float>(fromAxis * std::sin(i * step)),
                                       static_cast<float>(tubeRadius * std::sin(j * step)) });
      const std::uint32_t nextI = (i + 1) % segments * segments, nextJ = (j + 1) % segments;
      const std::uint32_t a = i * segments + j, b = nextI + j, c = nextI + nextJ, d = i * segments + nextJ;
      surface->GetTriangles().push_back({ a, b, c });
      surface->GetTriangles().push_back({ a, c, d });
    }
  }
  return surface;
}

/** \a count triangles of no common point in a cube of \a extent, each at most \a size wide. */
inline TriangleSurface::Pointer
MakeRandomTriangles(std::uint32_t count, float extent, float size, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0.0f, extent);
  std::uniform_real_distribution<float> offset(0.0f, size);
  auto surface = TriangleSurface::New();
  for (std::uint32_t n = 0; n < count; ++n)
  {
    const TriangleSurface::PointType corner{ place(random), place(random), place(random) };
    for (unsigned int point = 0; point < 3; ++point)
    {
      surface->GetPoints().push_back(
        { corner[0] + offset(random), corner[1] + offset(random), corner[2] + offset(random) });
    }
    surface->GetTriangles().push_back({ 3 * n, 3 * n + 1, 3 * n + 2 });
  }
  return surface;
}

} // namespace itk::example

#endif
