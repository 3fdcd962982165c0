#include "detail/itkSingleSheets.h"

#include "detail/itkTrianglesOfPoints.h"
#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceIntersections.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace itk::example;
using Ids = itk::BulkVector<std::uint32_t>;

std::optional<Ids>
FindSuspects(const itk::TriangleSurface & surface)
{
  const auto sizes = itk::TriangleSizes::Find(surface);
  auto suspects = sizes ? FindTrianglesOutsideSingleSheets(surface, *sizes) : std::nullopt;
  if (suspects)
  {
    itk::SortUnique(*suspects);
  }
  return suspects;
}

/** Spheres with folds and spikes, and spheres through each other, from many places. */
TEST(SingleSheets, HoldNoCrossings)
{
  unsigned int crossing = 0;
  for (unsigned int seed = 0; seed < 12; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> shift(-1.0f, 1.0f);
    const auto surface = MakeSphere(20.0, 7);
    const std::size_t points = surface->GetNumberOfPoints();
    for (unsigned int n = 0; n < 40 * (seed % 4); ++n)
    {
      auto & point = surface->GetPoints()[std::uniform_int_distribution<std::size_t>(0, points - 1)(random)];
      const float size = seed % 2 == 0 ? 0.3f : 0.8f;
      point = { point[0] + size * shift(random), point[1] + size * shift(random), point[2] + size * shift(random) };
    }
    if (seed % 3 == 1)
    {
      Append(*surface, *MakeSphere(20.0, 7), { 0.2f * shift(random), 38.0f, 9.0f * shift(random) });
    }
    const Ids found = FindCrossingTriangles(itk::TriangleTree(*surface), itk::TrianglesOfPoints(*surface));
    const auto suspects = FindSuspects(*surface);
    ASSERT_TRUE(suspects) << seed;
    EXPECT_LT(suspects->size(), surface->GetNumberOfTriangles() / 4) << seed;
    EXPECT_TRUE(std::includes(suspects->begin(), suspects->end(), found.begin(), found.end())) << seed;
    crossing += found.empty() ? 0 : 1;
  }
  EXPECT_GE(crossing, 6u) << "the test's own surfaces";
}

/** Two spheres nearly in the same place: their triangles face the same way. */
TEST(SingleSheets, AreNotFoundWhereTwoSheetsLieInOneAnother)
{
  const auto surface = MakeSphere(20.0, 7);
  Append(*surface, *MakeSphere(20.0, 7), { 1e-3f, 2e-3f, 3e-3f });
  const Ids found = FindCrossingTriangles(itk::TriangleTree(*surface), itk::TrianglesOfPoints(*surface));
  const auto suspects = FindSuspects(*surface);
  EXPECT_FALSE(found.empty()) << "the test's own surface";
  EXPECT_TRUE(!suspects || std::includes(suspects->begin(), suspects->end(), found.begin(), found.end()));
}

TEST(SingleSheets, AreOfClosedSurfaces)
{
  const auto surface = MakeSphere(20.0, 7);
  EXPECT_TRUE(FindSuspects(*surface));
  std::swap(surface->GetTriangles().back()[0], surface->GetTriangles().back()[1]);
  EXPECT_FALSE(FindSuspects(*surface)) << "a triangle that faces the other way";
  surface->GetTriangles().pop_back();
  EXPECT_FALSE(FindSuspects(*surface)) << "a hole";
}

} // namespace
