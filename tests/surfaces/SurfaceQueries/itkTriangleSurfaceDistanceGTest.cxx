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
    EXPECT_NEAR(distance.GetMean(), 2.0, 0.02);
    EXPECT_NEAR(distance.FindPercentile(95.0), 2.0, 0.02);
    EXPECT_NEAR(distance.GetMaximum(), 2.0, 0.02);
  }
  EXPECT_EQ(distances.GetMaximum(), std::max(distances.fromFirst.GetMaximum(), distances.fromSecond.GetMaximum()));
}

TEST(TriangleSurfaceDistance, IsNotTheSameBothWays)
{
  const auto one = MakeSphere(10.0, 4);
  const auto two = MakeSphere(10.0, 4);
  Append(*two, *MakeSphere(1.0, 2), { 30.0f, 0.0f, 0.0f });
  const auto distances = ComputeTriangleSurfaceDistances(*one, *two);
  EXPECT_NEAR(distances.fromFirst.GetMaximum(), 0.0, 1e-6);
  EXPECT_NEAR(distances.fromSecond.GetMaximum(), 21.0, 0.1);
  EXPECT_NEAR(distances.fromSecond.FindPercentile(95.0), 0.0, 1e-6) << "the small sphere has a hundredth of the area";
  EXPECT_NEAR(distances.fromSecond.GetMean(), 20.0 / 101.0, 0.01);
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
    EXPECT_NEAR(ComputeTriangleSurfaceDistance(*one, TriangleTree(*two)).GetMaximum(), furthest, 1e-5);
  }
}

/** Surfaces that cross, touch and lie apart, far and near, smooth and edged. */
TEST(TriangleSurfaceDistance, WhatIsAssumedAtCentresIsNearWhatIsMeasured)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-6.0, 6.0);
  std::uniform_real_distribution<float> noise(-0.02f, 0.02f);
  for (int trial = 0; trial < 12; ++trial)
  {
    const auto one = MakeSphere(10.0, 5, { place(random), place(random), place(random) });
    const auto two = trial % 2 == 0 ? MakeSphere(8.0, 5) : itk::example::MakeTorus(9.0, 3.0, 96);
    for (auto & point : two->GetPoints())
    {
      point[0] += noise(random);
    }
    TriangleTree tree(*two);
    itk::TriangleSurfaceDistanceSettings settings;
    settings.mostBent = 0.1;
    const auto measured = ComputeTriangleSurfaceDistance(*one, tree, settings);
    settings.mostAssumed = 0.01;
    const auto assumed = ComputeTriangleSurfaceDistance(*one, tree, settings);
    EXPECT_NEAR(assumed.GetMean(), measured.GetMean(), 5e-4);
    EXPECT_NEAR(assumed.GetMaximum(), measured.GetMaximum(), 2e-3);
    for (const double percent : { 5.0, 50.0, 95.0 })
    {
      EXPECT_NEAR(assumed.FindPercentile(percent), measured.FindPercentile(percent), 2e-3) << percent;
    }
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
  EXPECT_NEAR(ComputeTriangleSurfaceDistance(*plate, TriangleTree(*other), { 2.0 }).GetMaximum(), 5.0, 0.5);
  EXPECT_NEAR(ComputeTriangleSurfaceDistance(*other, TriangleTree(*plate), { 2.0 }).GetMaximum(), 5.0, 1e-4);
}

/** The distance from a plate to a roof over it rises from 0 to 5 mm over two slopes of 10 mm: uniformly distributed. */
TEST(TriangleSurfaceDistance, PercentilesOfLinearDistancesAreExact)
{
  const auto roof = Surface::New();
  roof->GetPoints() = { { 0, 0, 0 }, { 10, 0, 5 }, { 20, 0, 0 }, { 0, 30, 0 }, { 10, 30, 5 }, { 20, 30, 0 } };
  roof->GetTriangles() = { { 0, 1, 3 }, { 1, 4, 3 }, { 1, 2, 4 }, { 2, 5, 4 } };
  const auto plate = Surface::New();
  plate->GetPoints() = { { -9, -9, 0 }, { 99, -9, 0 }, { -9, 99, 0 } };
  plate->GetTriangles() = { { 0, 1, 2 } };
  const auto distance = ComputeTriangleSurfaceDistance(*roof, TriangleTree(*plate));
  for (const double percent : { 0.0, 10.0, 50.0, 95.0, 100.0 })
  {
    EXPECT_NEAR(distance.FindPercentile(percent), percent / 100.0 * 5.0, 1e-4) << percent;
    EXPECT_NEAR(distance.FindAreaWithin(percent / 100.0 * 5.0), percent / 100.0 * distance.GetArea(), 1e-2) << percent;
  }
  EXPECT_NEAR(distance.GetMean(), 2.5, 1e-5);
  EXPECT_EQ(distance.GetMaximum(), 5.0);
  EXPECT_EQ(distance.GetFarthestPoint()[0], 10.0);
}

TEST(TriangleSurfaceDistance, SignsAreThoseOfTheWinding)
{
  const auto ball = MakeSphere(10.0, 5);
  Append(*ball, *MakeSphere(5.0, 4), { 3.0f, 0.0f, 0.0f }); // inside the first: still inside
  const auto points = Surface::New();
  points->GetPoints() = { { 0, 0, 9 }, { 0, 0, 12 }, { 3, 0, 0 }, { -20, 0, 0 } };
  const itk::BulkVector<float> found = ComputeTriangleSurfaceSignedDistances(*points, TriangleTree(*ball));
  EXPECT_NEAR(found[0], -1.0f, 0.01f);
  EXPECT_NEAR(found[1], 2.0f, 0.01f);
  EXPECT_NEAR(found[2], -5.0f, 0.03f);
  EXPECT_NEAR(found[3], 10.0f, 0.01f);
}

TEST(TriangleSurfaceDistance, EmptySurfaces)
{
  const auto sphere = MakeSphere(10.0, 2);
  const auto empty = Surface::New();
  EXPECT_EQ(ComputeTriangleSurfaceDistance(*empty, TriangleTree(*sphere)).GetNumberOfParts(), 0u);
  EXPECT_EQ(ComputeTriangleSurfaceDistance(*empty, TriangleTree(*sphere)).GetMaximum(), 0.0);
  EXPECT_TRUE(std::isinf(ComputeTriangleSurfaceDistance(*sphere, TriangleTree(*empty)).GetMaximum()));
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
    means[threads == 1 ? 0 : 1] = ComputeTriangleSurfaceDistance(*one, TriangleTree(*two)).GetMean();
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
  EXPECT_EQ(means[0], means[1]);
}

} // namespace
