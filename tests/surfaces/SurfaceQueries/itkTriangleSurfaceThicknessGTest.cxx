#include "itkTriangleSurfaceThickness.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using itk::TriangleSurface;
using itk::TriangleTree;
using namespace itk::example;

constexpr double Pi = 3.14159265358979323846;

/** A closed box from \a low to \a high, whose sides are divided into squares of \a step mm at most. */
TriangleSurface::Pointer
MakeBox(const std::array<double, 3> & low, const std::array<double, 3> & high, double step)
{
  const auto box = TriangleSurface::New();
  std::map<std::array<float, 3>, std::uint32_t> numbers;
  const auto numberOf = [&](const std::array<double, 3> & point) {
    const TriangleSurface::PointType rounded{ static_cast<float>(point[0]),
                                              static_cast<float>(point[1]),
                                              static_cast<float>(point[2]) };
    const auto [found, isNew] = numbers.try_emplace(rounded, static_cast<std::uint32_t>(box->GetNumberOfPoints()));
    if (isNew)
    {
      box->GetPoints().push_back(rounded);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int across = static_cast<int>(std::ceil((high[u] - low[u]) / step - 1e-9));
    const int along = static_cast<int>(std::ceil((high[v] - low[v]) / step - 1e-9));
    for (const bool isHigh : { false, true })
    {
      const auto at = [&](int i, int j) {
        std::array<double, 3> point{};
        point[axis] = isHigh ? high[axis] : low[axis];
        point[u] = low[u] + (high[u] - low[u]) * i / across;
        point[v] = low[v] + (high[v] - low[v]) * j / along;
        return numberOf(point);
      };
      for (int i = 0; i < across; ++i)
      {
        for (int j = 0; j < along; ++j)
        {
          TriangleSurface::TriangleType first{ at(i, j), at(i + 1, j), at(i + 1, j + 1) };
          TriangleSurface::TriangleType second{ at(i, j), at(i + 1, j + 1), at(i, j + 1) };
          if (!isHigh)
          {
            std::swap(first[1], first[2]);
            std::swap(second[1], second[2]);
          }
          box->GetTriangles().insert(box->GetTriangles().end(), { first, second });
        }
      }
    }
  }
  return box;
}

/** The wall of a tube around z, closed by rings at both ends: like a torus whose cross-section is a rectangle. */
TriangleSurface::Pointer
MakeTube(double inner, double outer, double length, std::uint32_t segments)
{
  const auto tube = TriangleSurface::New();
  const auto rows = static_cast<std::uint32_t>(length);
  std::vector<std::array<double, 2>> section; // radius and z, around the wall's cross-section
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    section.push_back({ outer, length * row / rows });
  }
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    section.push_back({ inner, length - length * row / rows });
  }
  const auto around = static_cast<std::uint32_t>(section.size());
  for (std::uint32_t i = 0; i < segments; ++i)
  {
    const double angle = 2.0 * Pi * i / segments;
    for (std::uint32_t j = 0; j < around; ++j)
    {
      tube->GetPoints().push_back({ static_cast<float>(section[j][0] * std::cos(angle)),
                                    static_cast<float>(section[j][0] * std::sin(angle)),
                                    static_cast<float>(section[j][1]) });
      const std::uint32_t nextI = (i + 1) % segments, nextJ = (j + 1) % around;
      const std::uint32_t a = i * around + j, b = nextI * around + j, c = nextI * around + nextJ,
                          d = i * around + nextJ;
      tube->GetTriangles().insert(tube->GetTriangles().end(), { { a, b, c }, { a, c, d } });
    }
  }
  return tube;
}

void
ExpectAll(const itk::BulkVector<float> & values, double expected, double tolerance)
{
  ASSERT_FALSE(values.empty());
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  EXPECT_NEAR(*lowest, expected, tolerance);
  EXPECT_NEAR(*highest, expected, tolerance);
}

TEST(TriangleSurfaceThickness, OfABallIsItsDiameter)
{
  for (const unsigned int levels : { 3u, 5u }) // sides of 2.6 and 0.65 mm: the coarse ball has facets
  {
    const auto ball = MakeSphere(10.0, levels, { 3.0, -2.0, 1.0 });
    const TriangleTree tree(*ball);
    const auto thickness = ComputeTriangleSurfaceThickness(*ball, tree);
    const double inside = 2.0 * std::sqrt(tree.FindClosestPoint({ 3.0, -2.0, 1.0 }).squaredDistance); // of the facets
    ExpectAll(thickness.balls, inside, levels == 3 ? 0.06 * inside : 0.015 * inside);
    ExpectAll(thickness.walls, 20.0, 0.2);
  }
}

TEST(TriangleSurfaceThickness, OfAShellIsThatOfItsWall)
{
  const auto shell = MakeSphere(20.0, 6);
  const auto cavity = MakeSphere(17.5, 6);
  TurnInsideOut(*cavity);
  Append(*shell, *cavity);
  const auto thickness = ComputeTriangleSurfaceThickness(*shell, TriangleTree(*shell));
  ExpectAll(thickness.balls, 2.5, 0.04);
  ExpectAll(thickness.walls, 2.5, 0.04);
}

TEST(TriangleSurfaceThickness, OfATubeIsThatOfItsWall)
{
  const auto tube = MakeTube(5.0, 7.0, 40.0, 128);
  const auto thickness = ComputeTriangleSurfaceThickness(*tube, TriangleTree(*tube));
  std::size_t far = 0;
  for (std::size_t n = 0; n < tube->GetNumberOfPoints(); ++n)
  {
    const double z = tube->GetPoints()[n][2];
    if (z > 3.0 && z < 37.0) // at the ends balls are smaller
    {
      ++far;
      EXPECT_NEAR(thickness.balls[n], 2.0, 0.03);
      EXPECT_NEAR(thickness.walls[n], 2.0, 0.03);
    }
  }
  EXPECT_GT(far, 8000u);
}

TEST(TriangleSurfaceThickness, OfASlabIsItsHeightAwayFromItsRim)
{
  const auto slab = MakeBox({ 0.0, 0.0, 0.0 }, { 30.0, 20.0, 3.0 }, 1.0);
  const auto thickness = ComputeTriangleSurfaceThickness(*slab, TriangleTree(*slab));
  for (std::size_t n = 0; n < slab->GetNumberOfPoints(); ++n)
  {
    const auto & [x, y, z] = slab->GetPoints()[n];
    if (x > 1.6f && x < 28.4f && y > 1.6f && y < 18.4f) // farther from the rim than half of the height
    {
      EXPECT_NEAR(thickness.balls[n], 3.0, 0.03);
      EXPECT_NEAR(thickness.walls[n], 3.0, 1e-4);
    }
    EXPECT_LE(thickness.balls[n], 3.0 + 1e-4); // on the rim, too, whose rays go along the slab
  }
}

/** A fin on a block: its tip has small balls, though the ray from there goes deep into the block. */
TEST(TriangleSurfaceThickness, OfAFinOnABlockIsThatOfTheFin)
{
  const auto body = MakeBox({ 0.0, 0.0, 0.0 }, { 40.0, 40.0, 40.0 }, 2.0);
  Append(*body, *MakeBox({ 19.0, 5.0, 30.0 }, { 21.0, 35.0, 50.0 }, 1.0));
  const auto thickness = ComputeTriangleSurfaceThickness(*body, TriangleTree(*body));
  std::size_t tips = 0;
  for (std::size_t n = 0; n < body->GetNumberOfPoints(); ++n)
  {
    const auto & [x, y, z] = body->GetPoints()[n];
    if (z > 49.9f && x == 20.0f && y > 7.0f && y < 33.0f)
    {
      ++tips;
      EXPECT_NEAR(thickness.balls[n], 2.0, 0.1);
    }
  }
  EXPECT_GT(tips, 10u);
}

TEST(TriangleSurfaceThickness, IsUnknownWhereTheSurfaceIsOpen)
{
  const auto square = TriangleSurface::New();
  square->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  square->GetTriangles() = { { 0, 1, 2 }, { 0, 2, 3 } };
  const auto thickness = ComputeTriangleSurfaceThickness(*square, TriangleTree(*square));
  for (std::size_t n = 0; n < 4; ++n)
  {
    EXPECT_TRUE(std::isnan(thickness.balls[n]));
    EXPECT_TRUE(std::isnan(thickness.walls[n]));
  }
  EXPECT_EQ(FindThinParts(*square, TriangleTree(*square), 10.0).area, 0.0);
}

/** A plate of 0.8 mm beside a block of 5 mm: its two faces are thin, and nothing of the block, sharp edges included. */
TEST(TriangleSurfaceThickness, FindsThePlateThatIsThinnerThanTheLimit)
{
  const auto body = MakeBox({ 0.0, 0.0, 0.0 }, { 5.0, 6.0, 7.0 }, 0.5);
  Append(*body, *MakeBox({ 20.0, 0.0, 0.0 }, { 60.0, 30.0, 0.8 }, 0.5));
  const auto thin = FindThinParts(*body, TriangleTree(*body), 1.0);
  EXPECT_NEAR(thin.areaOfSurface, 214.0 + 2 * (1200.0 + 0.8 * 70.0), 0.01);
  EXPECT_NEAR(thin.area, 2 * 1200.0, 0.04 * 2400.0); // and some of the sides at its edges
  ASSERT_FALSE(thin.parts.empty());
  EXPECT_NEAR(thin.parts.front().thinnest, 0.8, 0.01);
  EXPECT_GE(thin.parts.front().thinnestAt[0], 20.0);
  EXPECT_EQ(FindThinParts(*body, TriangleTree(*body), 0.7).area, 0.0);
}

} // namespace
