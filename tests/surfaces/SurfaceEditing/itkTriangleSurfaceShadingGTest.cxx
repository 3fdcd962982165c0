#include "itkTriangleSurfaceShading.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using itk::TriangleSurface;

/** A cube from 0 to 1, two triangles a face. */
TriangleSurface::Pointer
Cube()
{
  const auto cube = TriangleSurface::New();
  for (unsigned int n = 0; n < 8; ++n)
  {
    cube->GetPoints().push_back(
      { static_cast<float>(n & 1), static_cast<float>(n >> 1 & 1), static_cast<float>(n >> 2) });
  }
  cube->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                           { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return cube;
}

/** A cylinder with caps about the z axis. */
TriangleSurface::Pointer
Cylinder(std::uint32_t sides)
{
  const auto cylinder = TriangleSurface::New();
  const double step = 2.0 * std::acos(-1.0) / sides;
  cylinder->GetPoints() = { { 0, 0, 0 }, { 0, 0, 1 } };
  for (std::uint32_t n = 0; n < sides; ++n)
  {
    for (const float z : { 0.0f, 1.0f })
    {
      cylinder->GetPoints().push_back(
        { static_cast<float>(std::cos(step * n)), static_cast<float>(std::sin(step * n)), z });
    }
  }
  for (std::uint32_t n = 0; n < sides; ++n)
  {
    const std::uint32_t a = 2 + 2 * n;
    const std::uint32_t b = 2 + 2 * ((n + 1) % sides);
    cylinder->GetTriangles().push_back({ a, b, b + 1 });
    cylinder->GetTriangles().push_back({ a, b + 1, a + 1 });
    cylinder->GetTriangles().push_back({ 0, b, a });
    cylinder->GetTriangles().push_back({ 1, a + 1, b + 1 });
  }
  return cylinder;
}

TEST(TriangleSurfaceShading, CubesHaveSharpEdges)
{
  const auto cube = Cube();
  const auto before = Cube();
  ComputeTriangleSurfaceShadingNormals(*cube);
  EXPECT_EQ(cube->GetNumberOfPoints(), 24u); // three normals at each corner
  ASSERT_TRUE(cube->HasNormals());
  cube->VerifyTriangles();
  for (std::size_t n = 0; n < 12; ++n)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const auto point = cube->GetTriangles()[n][corner];
      EXPECT_EQ(cube->GetPoints()[point], before->GetPoints()[before->GetTriangles()[n][corner]]);
      const auto & normal = cube->GetNormals()[point];
      EXPECT_EQ(normal, cube->GetNormals()[cube->GetTriangles()[n][0]]) << "faces are flat";
      EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1.0, 1e-6);
    }
  }
}

TEST(TriangleSurfaceShading, CylindersAreRoundBetweenSharpEdges)
{
  constexpr std::uint32_t sides = 24;
  const auto cylinder = Cylinder(sides);
  ComputeTriangleSurfaceShadingNormals(*cylinder);
  EXPECT_EQ(cylinder->GetNumberOfPoints(), 2u + 4u * sides); // each point of an edge is two
  for (std::size_t n = 0; n < cylinder->GetNumberOfTriangles(); ++n)
  {
    for (const auto point : cylinder->GetTriangles()[n])
    {
      const auto & p = cylinder->GetPoints()[point];
      const auto & normal = cylinder->GetNormals()[point];
      if (n % 4 < 2)
      {
        EXPECT_NEAR(normal[0], p[0], 1e-5) << "weighted by angles: in the middle of both sides";
        EXPECT_NEAR(normal[1], p[1], 1e-5);
      }
      else
      {
        EXPECT_NEAR(normal[2], n % 4 == 2 ? -1.0 : 1.0, 1e-6);
      }
    }
  }
  const auto soft = Cylinder(sides);
  ComputeTriangleSurfaceShadingNormals(*soft, 180.0);
  EXPECT_EQ(soft->GetNumberOfPoints(), 2u + 2u * sides);
}

} // namespace
