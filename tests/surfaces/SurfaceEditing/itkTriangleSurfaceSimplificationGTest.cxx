#include "itkTriangleSurfaceSimplification.h"

#include "itkBruteForceDistance.h"
#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceIntersections.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace
{

using Surface = itk::TriangleSurface;
using Settings = itk::TriangleSurfaceSimplificationSettings;
using itk::SimplificationEnd;
using itk::example::Append;
using itk::example::MakeSphere;
using itk::example::MakeTetrahedron;
using itk::example::MakeTorus;

Surface::Pointer
Copy(const Surface & surface)
{
  auto copy = Surface::New();
  copy->Graft(&surface);
  return copy;
}

/** A sphere whose points are moved along the radius at random. */
Surface::Pointer
MakeRoughSphere(double radius, unsigned int levels, double roughness, unsigned int seed)
{
  auto surface = MakeSphere(radius, levels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> factor(1.0 - roughness, 1.0 + roughness);
  for (auto & point : surface->GetPoints())
  {
    const double by = factor(random);
    for (float & coordinate : point)
    {
      coordinate = static_cast<float>(by * coordinate);
    }
  }
  return surface;
}

/** A sheet of squares in the plane z = 0, each cut into two triangles. */
Surface::Pointer
MakeSheet(std::uint32_t squares)
{
  auto surface = Surface::New();
  for (std::uint32_t row = 0; row <= squares; ++row)
  {
    for (std::uint32_t column = 0; column <= squares; ++column)
    {
      surface->GetPoints().push_back({ static_cast<float>(column), static_cast<float>(row), 0.0f });
    }
  }
  const std::uint32_t width = squares + 1;
  for (std::uint32_t row = 0; row < squares; ++row)
  {
    for (std::uint32_t column = 0; column < squares; ++column)
    {
      const std::uint32_t corner = row * width + column;
      surface->GetTriangles().push_back({ corner, corner + 1, corner + width + 1 });
      surface->GetTriangles().push_back({ corner, corner + width + 1, corner + width });
    }
  }
  return surface;
}

using PositionPair = std::array<Surface::PointType, 2>;

/** Edges of one triangle, by their positions in the triangle's direction. */
std::set<PositionPair>
BorderOf(const Surface & surface)
{
  std::set<PositionPair> border;
  for (const auto & triangle : surface.GetTriangles())
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto & from = surface.GetPoints()[triangle[corner]];
      const auto & to = surface.GetPoints()[triangle[(corner + 1) % 3]];
      if (border.erase({ to, from }) == 0)
      {
        border.insert({ from, to });
      }
    }
  }
  return border;
}

void
ExpectSameTopology(const Surface & before, const Surface & after)
{
  const auto expected = ComputeTriangleSurfaceTopology(before);
  const auto topology = ComputeTriangleSurfaceTopology(after);
  EXPECT_EQ(topology.components, expected.components) << topology;
  EXPECT_EQ(topology.eulerCharacteristic, expected.eulerCharacteristic) << topology;
  EXPECT_EQ(topology.boundaryEdges, expected.boundaryEdges) << topology;
  EXPECT_EQ(topology.nonManifoldEdges + topology.nonManifoldPoints + topology.misorientedEdges +
              topology.degenerateTriangles + topology.unusedPoints,
            0u)
    << topology;
}

itk::SizeValueType
CountContacts(const Surface & surface)
{
  const auto intersections = FindTriangleSurfaceSelfIntersections(itk::TriangleTree(surface));
  return intersections.crossingPairs + intersections.touchingPairs;
}

TEST(TriangleSurfaceSimplification, SphereReachesItsTarget)
{
  const auto before = MakeSphere(20.0, 6); // 32768 triangles
  const auto surface = Copy(*before);
  const auto report = SimplifyTriangleSurface(*surface, Settings{ 3276 });
  EXPECT_EQ(report.end, SimplificationEnd::Target);
  EXPECT_EQ(report.trianglesBefore, 32768u);
  EXPECT_EQ(report.trianglesAfter, surface->GetNumberOfTriangles());
  EXPECT_LE(report.trianglesAfter, 3276u);
  EXPECT_GE(report.trianglesAfter, 3100u);
  ExpectSameTopology(*before, *surface);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  EXPECT_EQ(CountContacts(*surface), 0u);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface),
              ComputeTriangleSurfaceVolume(*before),
              0.005 * ComputeTriangleSurfaceVolume(*before));
  const auto distances = ComputeTriangleSurfaceDistances(*before, *surface);
  EXPECT_LT(distances.fromFirst.GetMean(), 0.015);
  EXPECT_LT(distances.GetMaximum(), 0.06);
}

TEST(TriangleSurfaceSimplification, NormalsAreThoseOfTheirPlaces)
{
  const auto surface = MakeSphere(20.0, 5);
  for (const auto & point : surface->GetPoints())
  {
    surface->GetNormals().push_back({ point[0] / 20.0f, point[1] / 20.0f, point[2] / 20.0f });
  }
  SimplifyTriangleSurface(*surface, Settings{ 800 });
  ASSERT_TRUE(surface->HasNormals());
  EXPECT_LT(surface->GetNumberOfPoints(), 410u);
  for (std::size_t point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(surface->GetNormals()[point][axis], surface->GetPoints()[point][axis] / 20.0, 0.02);
    }
  }
}

TEST(TriangleSurfaceSimplification, MaximumErrorHoldsBothWaysBetweenThePointsToo)
{
  const Surface::Pointer surfaces[] = {
    MakeSphere(10.0, 3), MakeTorus(8.0, 3.0, 20), MakeRoughSphere(10.0, 3, 0.02, 1), MakeRoughSphere(10.0, 3, 0.1, 2)
  };
  for (const auto & before : surfaces)
  {
    for (const double maximumError : { 0.1, 0.6, 2.5 })
    {
      const auto surface = Copy(*before);
      const auto report = SimplifyTriangleSurface(*surface, Settings{ 0, maximumError });
      SCOPED_TRACE(maximumError);
      EXPECT_TRUE(report.end == SimplificationEnd::MaximumError || maximumError > 2.0) << report.end;
      EXPECT_LE(bruteforce::FurthestDistance(*before, *surface, 8), maximumError * 1.000001);
      EXPECT_LE(bruteforce::FurthestDistance(*surface, *before, 8), maximumError * 1.000001);
      ExpectSameTopology(*before, *surface);
      EXPECT_LE(CountContacts(*surface), CountContacts(*before));
      if (maximumError >= 0.6)
      {
        EXPECT_LT(report.trianglesAfter, report.trianglesBefore * 4 / 5);
      }
    }
  }
}

TEST(TriangleSurfaceSimplification, LargerErrorsLeaveFewerTriangles)
{
  itk::SizeValueType last = 8192;
  for (const double maximumError : { 0.02, 0.05, 0.2, 1.0 })
  {
    const auto surface = MakeSphere(20.0, 5);
    const auto report = SimplifyTriangleSurface(*surface, Settings{ 0, maximumError });
    EXPECT_LT(report.trianglesAfter, last) << maximumError;
    last = report.trianglesAfter;
  }
  EXPECT_LT(last, 150u);
}

TEST(TriangleSurfaceSimplification, TargetAndErrorTogetherStopAtTheFirstOfThem)
{
  auto surface = MakeSphere(20.0, 5);
  EXPECT_EQ(SimplifyTriangleSurface(*surface, Settings{ 4000, 1.0 }).end, SimplificationEnd::Target);
  EXPECT_GT(surface->GetNumberOfTriangles(), 3800u);
  surface = MakeSphere(20.0, 5);
  const auto report = SimplifyTriangleSurface(*surface, Settings{ 100, 0.05 });
  EXPECT_EQ(report.end, SimplificationEnd::MaximumError);
  EXPECT_GT(report.trianglesAfter, 100u);
  EXPECT_LE(ComputeTriangleSurfaceDistances(*MakeSphere(20.0, 5), *surface).GetMaximum(), 0.05);
}

TEST(TriangleSurfaceSimplification, TorusKeepsItsHoleAndTetrahedraStay)
{
  const auto before = MakeTorus(8.0, 3.0, 40);
  for (float n = 0; n < 50; ++n)
  {
    Append(*before, *MakeTetrahedron(0.5f), { 20.0f + n, 0.0f, 0.0f });
  }
  const auto surface = Copy(*before);
  const auto report = SimplifyTriangleSurface(*surface, Settings{ 4 });
  EXPECT_EQ(report.end, SimplificationEnd::Topology);
  ExpectSameTopology(*before, *surface);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  EXPECT_GE(report.trianglesAfter, 50u * 4u + 14u) << "a torus has 14 triangles at least";
  EXPECT_LE(report.trianglesAfter, 50u * 4u + 80u);
}

TEST(TriangleSurfaceSimplification, OpenSurfacesKeepTheirBorder)
{
  const auto before = MakeSheet(60); // several patches
  const auto surface = Copy(*before);
  SimplifyTriangleSurface(*surface, Settings{ 0, 0.2 });
  ExpectSameTopology(*before, *surface);
  EXPECT_EQ(BorderOf(*surface), BorderOf(*before));
  EXPECT_EQ(BorderOf(*surface).size(), 240u);
  EXPECT_LT(surface->GetNumberOfTriangles(), 1500u);
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*surface), 3600.0, 1e-3);
}

TEST(TriangleSurfaceSimplification, SheetsCloseToEachOtherNeverMeet)
{
  const auto before = MakeSphere(20.0, 5);
  const auto inner = MakeSphere(19.9, 5);
  itk::example::TurnInsideOut(*inner);
  Append(*before, *inner);
  for (const itk::SizeValueType target : { 2000u, 400u })
  {
    const auto surface = Copy(*before);
    SimplifyTriangleSurface(*surface, Settings{ target });
    ExpectSameTopology(*before, *surface);
    EXPECT_EQ(CountContacts(*surface), 0u) << target;
  }
}

TEST(TriangleSurfaceSimplification, RoughSurfacesGetNoIntersections)
{
  for (const unsigned int seed : { 3u, 4u, 5u })
  {
    const auto before = MakeRoughSphere(20.0, 5, 0.08, seed);
    ASSERT_EQ(CountContacts(*before), 0u);
    const auto surface = Copy(*before);
    const auto report = SimplifyTriangleSurface(*surface, Settings{ 819 });
    EXPECT_EQ(report.end, SimplificationEnd::Target);
    ExpectSameTopology(*before, *surface);
    EXPECT_EQ(CountContacts(*surface), 0u);
  }
}

TEST(TriangleSurfaceSimplification, SurfacesThatIntersectThemselvesMay)
{
  const auto before = MakeSphere(10.0, 4);
  Append(*before, *MakeSphere(10.0, 4), { 9.0f, 0.3f, 0.2f });
  const auto contacts = CountContacts(*before);
  ASSERT_GT(contacts, 0u);
  const auto surface = Copy(*before);
  SimplifyTriangleSurface(*surface, Settings{ 500 });
  ExpectSameTopology(*before, *surface);
  EXPECT_LE(CountContacts(*surface), contacts);
}

TEST(TriangleSurfaceSimplification, IsTheSameForAnyNumberOfThreads)
{
  const auto before = MakeRoughSphere(20.0, 6, 0.03, 6);
  Surface::Pointer results[2];
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  for (const unsigned int threads : { 1u, 5u })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    auto & result = results[threads == 1 ? 0 : 1];
    result = Copy(*before);
    SimplifyTriangleSurface(*result, Settings{ 4000, 0.8 });
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
  EXPECT_EQ(results[0]->GetPoints(), results[1]->GetPoints());
  EXPECT_EQ(results[0]->GetTriangles(), results[1]->GetTriangles());
}

TEST(TriangleSurfaceSimplification, DetailIsLookedAtClosely)
{
  auto before = MakeSheet(20);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> rough(-0.3f, 0.3f);
  for (auto & point : before->GetPoints())
  {
    const bool isDetail = point[0] > 0.0f && point[0] < 10.0f && point[1] > 0.0f && point[1] < 10.0f;
    point[2] = isDetail ? rough(random) : 0.0f;
    for (unsigned int axis = 0; axis < 2; ++axis) // small cells first, then large ones
    {
      point[axis] = point[axis] <= 10.0f ? 0.1f * point[axis] : 1.0f + 10.0f * (point[axis] - 10.0f);
    }
  }
  for (const double maximumError : { 0.01, 0.03, 0.2 })
  {
    const auto surface = Copy(*before);
    SimplifyTriangleSurface(*surface, Settings{ 0, maximumError });
    EXPECT_LE(bruteforce::FurthestDistance(*before, *surface, 4), 1.1 * maximumError);
    EXPECT_LE(bruteforce::FurthestDistance(*surface, *before, 8), 1.1 * maximumError);
    ExpectSameTopology(*before, *surface);
  }
}

TEST(TriangleSurfaceSimplification, PointsOfNoTriangleDoNotMatter)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : { std::nanf(""), infinity, 1e6f })
  {
    const auto surface = MakeSphere(20.0, 4);
    const auto expected = Copy(*surface);
    SimplifyTriangleSurface(*expected, Settings{ 0, 0.2 });
    surface->GetPoints().push_back({ odd, 0.0f, 0.0f });
    SimplifyTriangleSurface(*surface, Settings{ 0, 0.2 });
    EXPECT_EQ(surface->GetTriangles(), expected->GetTriangles()) << odd;
    EXPECT_EQ(surface->GetPoints(), expected->GetPoints()) << odd;
  }
}

TEST(TriangleSurfaceSimplification, SaysWhatEndedIt)
{
  auto surface = MakeSphere(20.0, 4);
  EXPECT_EQ(SimplifyTriangleSurface(*surface, Settings{ 0, 1e30 }).end, SimplificationEnd::Topology);
  EXPECT_EQ(surface->GetNumberOfTriangles(), 4u);
  surface = MakeSphere(20.0, 4);
  EXPECT_EQ(SimplifyTriangleSurface(*surface, Settings{ 0, 0.1 }).end, SimplificationEnd::MaximumError);
}

TEST(TriangleSurfaceSimplification, WhatIsSimpleEnoughStaysAsItIs)
{
  const auto surface = MakeSphere(20.0, 3);
  const auto before = Copy(*surface);
  const auto report = SimplifyTriangleSurface(*surface, Settings{ 5000 });
  EXPECT_EQ(report.end, SimplificationEnd::Target);

  EXPECT_EQ(surface->GetTriangles(), before->GetTriangles());
  EXPECT_EQ(SimplifyTriangleSurface(*Surface::New(), Settings{ 0, 1.0 }).trianglesAfter, 0u);
  EXPECT_THROW(SimplifyTriangleSurface(*Surface::New(), Settings{}), itk::ExceptionObject);
}

TEST(TriangleSurfaceSimplification, RefusesUnsoundSurfacesAndSenselessSettings)
{
  const auto sphere = MakeSphere(20.0, 2);
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{}), itk::ExceptionObject) << "neither target nor error";
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{ 10, 0.0 }), itk::ExceptionObject);
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{ 10, std::nan("") }), itk::ExceptionObject);
  const auto triangles = sphere->GetTriangles();

  sphere->GetTriangles().push_back({ triangles[0][0], triangles[0][1], triangles[77][2] });
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{ 10 }), itk::ExceptionObject) << "an edge of three triangles";
  sphere->GetTriangles() = triangles;
  std::swap(sphere->GetTriangles()[5][0], sphere->GetTriangles()[5][1]);
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{ 10 }), itk::ExceptionObject) << "a triangle turned round";
  sphere->GetTriangles() = triangles;
  sphere->GetPoints()[triangles[0][0]] = sphere->GetPoints()[triangles[0][1]];
  EXPECT_THROW(SimplifyTriangleSurface(*sphere, Settings{ 10 }), itk::ExceptionObject) << "a degenerate triangle";
}

} // namespace
