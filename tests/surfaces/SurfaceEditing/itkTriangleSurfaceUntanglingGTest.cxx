#include "itkTriangleSurfaceUntangling.h"

#include "detail/itkTrianglesOfPoints.h"
#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkTriangleTree.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace itk::example;
using itk::TriangleSurface;
using itk::UntangleTriangleSurface;

/** A sphere with some of its points moved sideways by up to \a move, which folds the triangles there. */
TriangleSurface::Pointer
MakeTangledSphere(double radius, double move, int count, unsigned int seed)
{
  const auto surface = MakeSphere(radius, 5);
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> choose(0, surface->GetNumberOfPoints() - 1);
  std::uniform_real_distribution<float> shift(static_cast<float>(-move), static_cast<float>(move));
  for (int n = 0; n < count; ++n)
  {
    for (float & coordinate : surface->GetPoints()[choose(random)])
    {
      coordinate += shift(random);
    }
  }
  return surface;
}

itk::SizeValueType
CrossingsOf(const TriangleSurface & surface)
{
  return FindTriangleSurfaceSelfIntersections(itk::TriangleTree(surface)).crossingPairs;
}

TEST(TriangleSurfaceUntangling, LeavesNoCrossings)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
  {
    const auto surface = MakeTangledSphere(20.0, 2.0, 60, seed);
    const auto before = surface->GetPoints();
    const double volume = ComputeTriangleSurfaceVolume(*surface);
    ASSERT_GT(CrossingsOf(*surface), 0u) << "the test's own surface";
    const auto report = UntangleTriangleSurface(*surface, 1.5);
    EXPECT_GT(report.crossingBefore, 0u);
    EXPECT_EQ(report.crossingAfter, 0u) << "seed " << seed;
    EXPECT_EQ(CrossingsOf(*surface), 0u);
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    EXPECT_TRUE(topology.IsWatertight()) << topology;
    EXPECT_LE(report.largestMove, 1.5);
    EXPECT_LT(report.pointsMoved, 1000u) << "of " << before.size();
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface) / volume, 1.0, 0.002);
    itk::SizeValueType moved = 0;
    for (std::size_t n = 0; n < before.size(); ++n)
    {
      moved += before[n] != surface->GetPoints()[n] ? 1 : 0;
    }
    EXPECT_EQ(moved, report.pointsMoved);
  }
}

TEST(TriangleSurfaceUntangling, LeavesCleanSurfacesAlone)
{
  const auto surface = MakeTorus(10.0, 3.0, 60);
  const auto before = surface->GetPoints();
  const auto report = UntangleTriangleSurface(*surface, 1.0);
  EXPECT_EQ(report.crossingBefore, 0u);
  EXPECT_EQ(report.pointsMoved, 0u);
  EXPECT_TRUE(before == surface->GetPoints());
}

TEST(TriangleSurfaceUntangling, DoesNotMakeThingsWorseWhereItCannotHelp)
{
  // Two spheres that cross each other: no small move separates them.
  const auto surface = MakeSphere(10.0, 3);
  Append(*surface, *MakeSphere(10.0, 3), { 7.0f, 0.5f, 0.25f });
  const auto before = CrossingsOf(*surface);
  const auto report = UntangleTriangleSurface(*surface, 0.5);
  EXPECT_GT(report.crossingAfter, 0u);
  EXPECT_LE(report.crossingAfter, report.crossingBefore);
  EXPECT_EQ(report.crossingAfter,
            FindCrossingTriangles(itk::TriangleTree(*surface), itk::TrianglesOfPoints(*surface)).size());
  EXPECT_LE(CrossingsOf(*surface), 2 * before);
  EXPECT_LE(report.largestMove, 0.5);
  EXPECT_TRUE(itk::ComputeTriangleSurfaceTopology(*surface).IsWatertight());
}

TEST(TriangleSurfaceUntangling, IsTheSameForAnyNumberOfThreads)
{
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  TriangleSurface::PointsContainer points[2];
  for (unsigned int n = 0; n < 2; ++n)
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1 + 4 * n);
    const auto surface = MakeTangledSphere(20.0, 2.0, 60, 3);
    UntangleTriangleSurface(*surface, 1.5);
    points[n] = surface->GetPoints();
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  EXPECT_TRUE(points[0] == points[1]);
}

TEST(TriangleSurfaceUntangling, NeedsRoomToMove)
{
  const auto surface = MakeTetrahedron();
  EXPECT_THROW(UntangleTriangleSurface(*surface, 0.0), itk::ExceptionObject);
}

} // namespace
