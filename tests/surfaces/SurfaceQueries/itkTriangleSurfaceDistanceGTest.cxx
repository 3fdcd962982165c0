#include "itkTriangleSurfaceDistance.h"

#include "itkBruteForceDistance.h"
#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using Surface = itk::TriangleSurface;
using itk::TriangleTree;
using itk::example::Append;
using itk::example::MakeRandomTriangles;
using itk::example::MakeSphere;

TEST(TriangleSurfaceDistance, ConcentricSpheresAreTheirRadiiApart)
{
  const auto inner = MakeSphere(10.0, 5);
  const auto outer = MakeSphere(12.0, 5);
  const auto distances = ComputeTriangleSurfaceDistances(*inner, *outer);
  for (const auto & distance : { distances.fromFirst, distances.fromSecond })
  {
    EXPECT_NEAR(distance.mean, 2.0, 0.02);
    EXPECT_NEAR(distance.percentile95, 2.0, 0.02);
    EXPECT_NEAR(distance.maximum, 2.0, 0.02);
  }
  EXPECT_EQ(distances.GetMaximum(), std::max(distances.fromFirst.maximum, distances.fromSecond.maximum));
}

TEST(TriangleSurfaceDistance, IsNotTheSameBothWays)
{
  const auto one = MakeSphere(10.0, 4);
  const auto two = MakeSphere(10.0, 4);
  Append(*two, *MakeSphere(1.0, 2), { 30.0f, 0.0f, 0.0f });
  const auto distances = ComputeTriangleSurfaceDistances(*one, *two);
  EXPECT_NEAR(distances.fromFirst.maximum, 0.0, 1e-6);
  EXPECT_NEAR(distances.fromSecond.maximum, 21.0, 0.1);
  EXPECT_NEAR(distances.fromSecond.percentile95, 0.0, 1e-6) << "the small sphere has a hundredth of the area";
  EXPECT_NEAR(distances.fromSecond.mean, 20.0 / 101.0, 0.01);
}

TEST(TriangleSurfaceDistance, MaximumIsThatOfBruteForceAtTheSamePlaces)
{
  for (const unsigned int seed : { 1u, 2u, 3u })
  {
    const auto one = MakeRandomTriangles(60, 10.0f, 3.0f, seed);
    const auto two = MakeRandomTriangles(60, 10.0f, 3.0f, seed + 100);
    double furthest = 0.0;
    for (const auto & triangle : one->GetTriangles())
    {
      const auto corners = bruteforce::CornersOf(*one, triangle);
      const double third = 1.0 / 3.0;
      for (const auto & [a, b, c] : { bruteforce::Vector{ 1.0, 0.0, 0.0 },
                                      bruteforce::Vector{ 0.0, 1.0, 0.0 },
                                      bruteforce::Vector{ 0.0, 0.0, 1.0 },
                                      bruteforce::Vector{ third, third, third } })
      {
        furthest = std::max(furthest, bruteforce::DistanceToSurface(bruteforce::Mix(corners, a, b, c), *two));
      }
    }
    EXPECT_NEAR(ComputeTriangleSurfaceDistance(*one, TriangleTree(*two)).maximum, furthest, 1e-5);
  }
}

TEST(TriangleSurfaceDistance, LargeTrianglesAreLookedAtInside)
{
  const auto plate = Surface::New();
  plate->GetPoints() = { { 0.0f, 0.0f, 0.0f }, { 100.0f, 0.0f, 0.0f }, { 0.0f, 100.0f, 0.0f } };
  plate->GetTriangles() = { { 0, 1, 2 } };
  const auto other = Surface::New();
  other->GetPoints() = plate->GetPoints();
  other->GetPoints().push_back({ 20.0f, 30.0f, 5.0f }); // a tent
  other->GetTriangles() = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  EXPECT_NEAR(ComputeTriangleSurfaceDistance(*plate, TriangleTree(*other), 2.0).maximum, 5.0, 0.5);
  EXPECT_NEAR(ComputeTriangleSurfaceDistance(*other, TriangleTree(*plate), 2.0).maximum, 5.0, 1e-4);
}

TEST(TriangleSurfaceDistance, EmptySurfaces)
{
  const auto sphere = MakeSphere(10.0, 2);
  const auto empty = Surface::New();
  EXPECT_EQ(ComputeTriangleSurfaceDistance(*empty, TriangleTree(*sphere)).places, 0u);
  EXPECT_EQ(ComputeTriangleSurfaceDistance(*empty, TriangleTree(*sphere)).maximum, 0.0);
  EXPECT_TRUE(std::isinf(ComputeTriangleSurfaceDistance(*sphere, TriangleTree(*empty)).maximum));
}

TEST(TriangleSurfaceDistance, IsTheSameForAnyNumberOfThreads)
{
  const auto one = MakeSphere(10.0, 5);
  const auto two = MakeSphere(10.3, 4, { 0.1, 0.2, 0.3 });
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  double means[2];
  for (const unsigned int threads : { 1u, 5u })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    means[threads == 1 ? 0 : 1] = ComputeTriangleSurfaceDistance(*one, TriangleTree(*two)).mean;
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
  EXPECT_EQ(means[0], means[1]);
}

} // namespace
