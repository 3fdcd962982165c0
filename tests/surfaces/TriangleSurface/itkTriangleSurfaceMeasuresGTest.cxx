#include "itkTriangleSurfaceMeasures.h"

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

} // namespace
