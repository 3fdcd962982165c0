#include "itkTriangleSurfaceMeasures.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;

double
LongestDiameterByTrial(const Surface & surface)
{
  double longest = 0.0;
  for (const auto & a : surface.GetPoints())
  {
    for (const auto & b : surface.GetPoints())
    {
      double squared = 0.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double difference = static_cast<double>(a[axis]) - b[axis];
        squared += difference * difference;
      }
      longest = std::max(longest, std::sqrt(squared));
    }
  }
  return longest;
}

TEST(TriangleSurfaceMeasures, LongestDiameterIsThatOfAllPairs)
{
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (int trial = 0; trial < 60; ++trial)
  {
    const auto surface = Surface::New();
    const int count = 1 + trial * 11;
    for (int n = 0; n < count; ++n)
    {
      Surface::PointType point{ normal(random), normal(random), normal(random) };
      if (trial % 2 == 0) // a sphere, where all points are nearly as far from each other as can be
      {
        const float radius = std::hypot(point[0], point[1], point[2]);
        point = { point[0] / radius, point[1] / radius, point[2] / radius };
      }
      else
      {
        point[1] *= 10.0f;
      }
      surface->GetPoints().push_back(point);
    }
    ASSERT_EQ(ComputeTriangleSurfaceLongestDiameter(*surface), LongestDiameterByTrial(*surface)) << count << " points";
  }
  EXPECT_EQ(ComputeTriangleSurfaceLongestDiameter(*Surface::New()), 0.0);
}

TEST(TriangleSurfaceMeasures, LongestDiameterLeavesOutPointsThatAreNowhere)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto surface = Surface::New();
  for (int n = 0; n < 100; ++n)
  {
    surface->GetPoints().push_back({ std::nanf(""), static_cast<float>(n), 0.0f });
    surface->GetPoints().push_back({ infinity, static_cast<float>(n), 0.0f });
  }
  EXPECT_EQ(ComputeTriangleSurfaceLongestDiameter(*surface), 0.0);
  surface->GetPoints().push_back({ 1.0f, 2.0f, 3.0f });
  surface->GetPoints().push_back({ 1.0f, 2.0f, 7.0f });
  EXPECT_EQ(ComputeTriangleSurfaceLongestDiameter(*surface), 4.0);
}

TEST(TriangleSurfaceMeasures, CentroidOfATetrahedronIsTheMeanOfItsCorners)
{
  const auto surface = Surface::New();
  surface->GetPoints() = { { 1000, -500, 8 }, { 1004, -500, 8 }, { 1000, -492, 8 }, { 1000, -500, 20 } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  const auto centroid = ComputeTriangleSurfaceCentroid(*surface);
  EXPECT_NEAR(centroid[0], 1001.0, 1e-9);
  EXPECT_NEAR(centroid[1], -498.0, 1e-9);
  EXPECT_NEAR(centroid[2], 11.0, 1e-9);
}

TEST(TriangleSurfaceMeasures, BendingOfACubeIsThatOfItsTwelveEdges)
{
  const auto cube = Surface::New();
  for (int corner = 0; corner < 8; ++corner)
  {
    cube->GetPoints().push_back(
      { corner % 2 == 0 ? 0.0f : 2.0f, corner / 2 % 2 == 0 ? 0.0f : 2.0f, corner / 4 == 0 ? 0.0f : 2.0f });
  }
  cube->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                           { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  const double rightAngle = std::acos(0.0);
  EXPECT_NEAR(ComputeTriangleSurfaceBending(*cube), 12 * 2.0 * rightAngle / 24.0, 1e-9);
  EXPECT_EQ(ComputeTriangleSurfaceBending(*Surface::New()), 0.0);
}

TEST(TriangleSurfaceMeasures, BendingOfACylinderIsOneOverItsRadius)
{
  constexpr double radius = 3.0;
  constexpr std::uint32_t sides = 100;
  const auto cylinder = Surface::New(); // open at both ends
  for (std::uint32_t n = 0; n < sides; ++n)
  {
    const double angle = 2.0 * std::acos(-1.0) * n / sides;
    for (const float z : { 0.0f, 50.0f })
    {
      cylinder->GetPoints().push_back(
        { static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), z });
    }
    const std::uint32_t next = 2 * ((n + 1) % sides);
    cylinder->GetTriangles().push_back({ 2 * n, next, next + 1 });
    cylinder->GetTriangles().push_back({ 2 * n, next + 1, 2 * n + 1 });
  }
  EXPECT_NEAR(ComputeTriangleSurfaceBending(*cylinder), 1.0 / radius, 1e-3);
}

TEST(TriangleSurfaceMeasures, BendingOfASphereIsAboutTwoOverItsRadiusAndThatOfARoughOneMore)
{
  const auto sphere = itk::example::MakeSphere(8.0, 5);
  EXPECT_NEAR(ComputeTriangleSurfaceBending(*sphere), 2.0 / 8.0, 0.1 * 2.0 / 8.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> noise(-0.05f, 0.05f);
  for (auto & point : sphere->GetPoints())
  {
    point[2] += noise(random);
  }
  EXPECT_GT(ComputeTriangleSurfaceBending(*sphere), 2.0 * 2.0 / 8.0);
}

} // namespace
