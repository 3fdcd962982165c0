#include "itkTriangleSurfaceSmoothing.h"

#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;
using itk::example::MakeSphere;

itk::TriangleSurfaceSmoothingSettings
Within(double maximumMove)
{
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.maximumMove = maximumMove;
  return settings;
}

/** A sphere whose points are moved along the radius by normally distributed steps. */
Surface::Pointer
MakeNoisySphere(double radius, double noise, unsigned int seed)
{
  auto surface = MakeSphere(radius, 5);
  std::mt19937 random(seed);
  std::normal_distribution<double> step(0.0, noise);
  for (auto & point : surface->GetPoints())
  {
    const double factor = 1.0 + step(random) / radius;
    for (float & coordinate : point)
    {
      coordinate = static_cast<float>(factor * coordinate);
    }
  }
  return surface;
}

double
RootMeanSquareFromSphere(const Surface & surface, double radius)
{
  double sum = 0.0;
  for (const auto & point : surface.GetPoints())
  {
    const double away = std::hypot(double{ point[0] }, double{ point[1] }, double{ point[2] }) - radius;
    sum += away * away;
  }
  return std::sqrt(sum / static_cast<double>(surface.GetNumberOfPoints()));
}

TEST(TriangleSurfaceSmoothing, NoiseGoesAndTheVolumeStays)
{
  for (const unsigned int seed : { 1u, 2u, 3u })
  {
    const auto surface = MakeNoisySphere(20.0, 0.1, seed);
    const double noise = RootMeanSquareFromSphere(*surface, 20.0);
    const double volume = ComputeTriangleSurfaceVolume(*surface);
    const auto triangles = surface->GetTriangles();
    const auto report = SmoothTriangleSurface(*surface, Within(0.5));
    EXPECT_LT(RootMeanSquareFromSphere(*surface, 20.0), 0.5 * noise);
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), volume, 0.004 * volume);
    EXPECT_EQ(surface->GetTriangles(), triangles);
    EXPECT_GT(report.meanMove, 0.5 * noise);
    EXPECT_EQ(report.pointsOnBorder, 0u);
  }
}

TEST(TriangleSurfaceSmoothing, NoPointMovesFurtherThanAllowed)
{
  const auto before = MakeNoisySphere(20.0, 0.2, 4);
  itk::SizeValueType last = before->GetNumberOfPoints();
  for (const double maximumMove : { 0.0, 0.02, 0.1, 0.3 })
  {
    const auto surface = Surface::New();
    surface->Graft(before);
    const auto report = SmoothTriangleSurface(*surface, Within(maximumMove));
    double furthest = 0.0;
    for (std::size_t point = 0; point < surface->GetNumberOfPoints(); ++point)
    {
      const auto & from = before->GetPoints()[point];
      const auto & to = surface->GetPoints()[point];
      furthest =
        std::max(furthest, std::hypot(double{ to[0] } - from[0], double{ to[1] } - from[1], double{ to[2] } - from[2]));
    }
    EXPECT_LE(furthest, maximumMove * (1.0 + 1e-5) + 1e-5) << maximumMove;
    EXPECT_NEAR(report.largestMove, furthest, 1e-5);
    EXPECT_LE(report.pointsAtLimit, last) << maximumMove << ": a larger limit holds fewer points back";
    last = maximumMove > 0.0 ? report.pointsAtLimit : last;
  }
}

TEST(TriangleSurfaceSmoothing, SurfacesStaySound)
{
  const auto surface = MakeNoisySphere(20.0, 0.3, 5);
  ASSERT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  SmoothTriangleSurface(*surface, Within(1.0));
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  EXPECT_EQ(FindTriangleSurfaceSelfIntersections(itk::TriangleTree(*surface)).crossingPairs, 0u);
}

TEST(TriangleSurfaceSmoothing, OpenBordersStay)
{
  const auto surface = MakeNoisySphere(20.0, 0.1, 6);
  surface->GetTriangles().resize(surface->GetNumberOfTriangles() / 2);
  surface->RemoveUnusedPoints();
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  ASSERT_GT(topology.boundaryEdges, 0u);
  const auto report = SmoothTriangleSurface(*surface, Within(0.5));
  EXPECT_GT(report.pointsOnBorder, 0u);
  EXPECT_LE(report.pointsOnBorder, topology.boundaryEdges);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).boundaryEdges, topology.boundaryEdges);
}

TEST(TriangleSurfaceSmoothing, NormalsAreNew)
{
  const auto surface = MakeNoisySphere(20.0, 0.05, 7);
  surface->GetNormals().assign(surface->GetNumberOfPoints(), { 0.0f, 0.0f, 1.0f });
  SmoothTriangleSurface(*surface, Within(0.5));
  for (std::size_t point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    const auto & position = surface->GetPoints()[point];
    const auto & normal = surface->GetNormals()[point];
    EXPECT_GT(position[0] * normal[0] + position[1] * normal[1] + position[2] * normal[2], 0.97f * 20.0f);
  }
}

TEST(TriangleSurfaceSmoothing, IsTheSameForAnyNumberOfThreads)
{
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  Surface::Pointer results[2];
  for (const unsigned int threads : { 1u, 5u })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    auto & result = results[threads == 1 ? 0 : 1];
    result = MakeNoisySphere(20.0, 0.2, 8);
    SmoothTriangleSurface(*result, Within(0.2));
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
  EXPECT_EQ(results[0]->GetPoints(), results[1]->GetPoints());
}

TEST(TriangleSurfaceSmoothing, RefusesSenselessMoves)
{
  const auto surface = MakeSphere(20.0, 2);
  EXPECT_THROW(SmoothTriangleSurface(*surface, Within(-0.1)), itk::ExceptionObject);
  EXPECT_THROW(SmoothTriangleSurface(*surface, Within(std::nan(""))), itk::ExceptionObject);
  EXPECT_THROW(SmoothTriangleSurface(*surface, Within(std::numeric_limits<double>::infinity())), itk::ExceptionObject);
  EXPECT_EQ(SmoothTriangleSurface(*Surface::New(), Within(0.1)).meanMove, 0.0) << "an empty surface";
}

} // namespace
