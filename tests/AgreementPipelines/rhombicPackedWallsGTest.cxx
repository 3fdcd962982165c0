#include "rhombicPackedWalls.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

/** Walls of many blocks: points in any place, triangles that share most of their points with those before, labels in
 * runs. */
itk::LabelWalls::Pointer
MakeWalls(std::size_t triangles, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> place(0.0f, 200.0f);
  const auto walls = itk::LabelWalls::New();
  for (std::size_t n = 0; n < triangles / 2 + 3; ++n)
  {
    walls->GetPoints().push_back({ place(random), place(random), place(random) });
  }
  std::uniform_int_distribution<std::uint32_t> near(0, 700);
  for (std::size_t n = 0; n < triangles; ++n)
  {
    const auto points = static_cast<std::uint32_t>(walls->GetNumberOfPoints());
    const std::uint32_t base = static_cast<std::uint32_t>(n / 2);
    walls->GetTriangles().push_back(
      { base, std::min(points - 1, base + near(random)), std::min(points - 1, base + near(random)) });
    walls->GetTriangleLabels().push_back(
      { static_cast<std::uint16_t>(n / 1000 % 61), static_cast<std::uint16_t>(65535 - n / 777 % 61) });
  }
  return walls;
}

TEST(PackedWalls, KeepEverythingInLessMemory)
{
  for (const std::size_t triangles :
       { std::size_t{ 0 }, std::size_t{ 1 }, std::size_t{ 1 } << 18, std::size_t{ 600'000 } })
  {
    const auto walls = MakeWalls(triangles, 5);
    const auto expected = MakeWalls(triangles, 5);
    const rhombic::PackedWalls packed(*walls);
    EXPECT_EQ(walls->GetNumberOfPoints(), 0u);
    EXPECT_EQ(walls->GetMemorySize(), 0u) << "nothing of them stays";
    packed.Unpack(*walls);
    EXPECT_TRUE(walls->GetPoints() == expected->GetPoints()) << triangles;
    EXPECT_TRUE(walls->GetTriangles() == expected->GetTriangles()) << triangles;
    EXPECT_TRUE(walls->GetTriangleLabels() == expected->GetTriangleLabels()) << triangles;
  }
}

} // namespace
