#include "detail/itkTriangleGrid.h"
#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleSurfaceAudit.h"

#include "itkTriangleSurfaceIntersections.h"
#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <sstream>

namespace
{

using namespace itk::example;
using Surface = itk::TriangleSurface;
using Contact = itk::TriangleContact;

itk::TriangleSurfaceIntersections
Intersect(const Surface & surface)
{
  return FindTriangleSurfaceSelfIntersections(itk::TriangleTree(surface));
}

TEST(TriangleSurfaceQuality, IsOneForEquilateralAndZeroForDegenerateTriangles)
{
  using itk::ComputeTriangleQuality;
  EXPECT_NEAR(ComputeTriangleQuality({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1.0, 1e-12);
  EXPECT_NEAR(ComputeTriangleQuality({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }), std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_EQ(ComputeTriangleQuality({ 0, 0, 0 }, { 1, 0, 0 }, { 3, 0, 0 }), 0.0);
  EXPECT_EQ(ComputeTriangleQuality({ 2, 2, 2 }, { 2, 2, 2 }, { 2, 2, 2 }), 0.0);
}

TEST(TriangleSurfaceQuality, OfATetrahedronsFaces)
{
  const auto surface = MakeTetrahedron();
  auto quality = ComputeTriangleSurfaceQuality(*surface);
  EXPECT_NEAR(quality.mean, (1.0 + 3.0 * std::sqrt(3.0) / 2.0) / 4.0, 1e-7);
  EXPECT_NEAR(quality.minimum, std::sqrt(3.0) / 2.0, 1e-7);
  EXPECT_NEAR(quality.smallestAngle, 45.0, 1e-5);
  EXPECT_EQ(quality.poorFraction, 0.0);
  surface->GetPoints()[3] = { 0, 0, 0.01f };
  quality = ComputeTriangleSurfaceQuality(*surface);
  EXPECT_EQ(quality.poorFraction, 0.5);
  EXPECT_NEAR(quality.smallestAngle, std::atan(0.01) * 180.0 / std::acos(-1.0), 1e-5);
  EXPECT_EQ(ComputeTriangleSurfaceQuality(*Surface::New()).mean, 0.0);
}

TEST(TriangleSurfaceIntersections, AreThoseOfAllPairs)
{
  for (unsigned int seed = 0; seed < 5; ++seed)
  {
    const auto surface = MakeRandomTriangles(400, 10.0f, 3.0f, seed);
    std::uint64_t crossing = 0;
    for (std::uint32_t a = 0; a < 400; ++a)
    {
      for (std::uint32_t b = a + 1; b < 400; ++b)
      {
        const auto & triangles = surface->GetTriangles();
        crossing += FindContact(surface->GetPoints(), triangles[a], triangles[b]) == Contact::Crossing;
      }
    }
    EXPECT_GT(crossing, 100u);
    EXPECT_EQ(Intersect(*surface).crossingPairs, crossing);
    EXPECT_EQ(Intersect(*surface).touchingPairs, 0u);
    EXPECT_EQ(Intersect(*surface).testedTriangles, 400u);
    EXPECT_FALSE(Intersect(*surface).isSampled);
  }
}

TEST(TriangleSurfaceIntersections, OfSpheresApartAndThroughEachOther)
{
  const auto surface = MakeSphere(5.0, 4);
  EXPECT_EQ(Intersect(*surface).crossingPairs + Intersect(*surface).touchingPairs, 0u);
  const auto apart = MakeSphere(5.0, 4);
  Append(*apart, *MakeSphere(5.0, 4), { 10.5f, 0, 0 });
  EXPECT_EQ(Intersect(*apart).crossingPairs + Intersect(*apart).touchingPairs, 0u);
  const auto through = MakeSphere(5.0, 4);
  Append(*through, *MakeSphere(5.0, 4), { 6, 0.1f, 0.2f });
  EXPECT_GT(Intersect(*through).crossingPairs, 100u);
  const auto touching = MakeSphere(5.0, 4);
  Append(*touching, *MakeSphere(5.0, 4), { 10, 0, 0 });
  EXPECT_EQ(Intersect(*touching).crossingPairs, 0u);
  EXPECT_EQ(Intersect(*touching).touchingPairs, 16u) << "four triangles of either meet in the point where they touch";
}

TEST(TriangleSurfaceIntersections, OfFoldsAndPiercedNeighbours)
{
  const auto surface = Surface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 2, 2, 0 }, { 0, -4, 0 }, { 0, 0, 4 } };
  surface->GetTriangles() = { { 0, 1, 2 }, { 1, 0, 4 } };
  EXPECT_EQ(Intersect(*surface).crossingPairs, 0u) << "one plane, either side of the edge";
  surface->GetTriangles() = { { 0, 1, 2 }, { 1, 0, 3 } };
  EXPECT_EQ(Intersect(*surface).crossingPairs, 1u) << "folded onto each other";
  surface->GetTriangles() = { { 0, 1, 2 }, { 1, 0, 5 } };
  EXPECT_EQ(Intersect(*surface).crossingPairs, 0u) << "a right angle";
  surface->GetPoints()[3] = { 1, 1, -1 };
  surface->GetPoints()[5] = { 1, 1, 1 };
  surface->GetTriangles() = { { 0, 1, 2 }, { 0, 3, 5 } };
  EXPECT_EQ(Intersect(*surface).crossingPairs, 1u) << "through each other from the common corner on";
  surface->GetPoints()[5] = { 1, 1, -2 };
  EXPECT_EQ(Intersect(*surface).crossingPairs + Intersect(*surface).touchingPairs, 0u);
  surface->GetTriangles() = { { 0, 1, 2 }, { 2, 1, 0 }, { 1, 2, 0 } };
  EXPECT_EQ(Intersect(*surface).crossingPairs, 0u) << "duplicates are the topology's";
}

/** Closed surfaces from smooth to crumpled, with holes, several fans at a point, flat parts, and of any size. */
TEST(TriangleSurfaceIntersections, OfJoinedTrianglesAreThoseOfAllPairs)
{
  constexpr std::array<int, 7> exponents{ 0, 0, -45, 0, 60, 0, -120 }; // of the size, by powers of 2
  itk::SizeValueType surfacesWithout = 0, surfacesWith = 0, grids = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
  {
    const auto surface = MakeSphere(10.0, 3);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    const float width = 0.15f * static_cast<float>(seed % 12); // 0 for some
    for (auto & point : surface->GetPoints())
    {
      for (float & coordinate : point)
      {
        coordinate += width * normal(random);
        coordinate = seed % 3 == 1 ? std::round(coordinate) : coordinate; // flat parts, and equal positions
      }
    }
    auto & triangles = surface->GetTriangles();
    if (seed % 4 == 3)
    {
      std::shuffle(triangles.begin(), triangles.end(), random);
      triangles.resize(triangles.size() - 100);
    }
    if (seed % 5 == 4) // two fans at a point
    {
      Append(*surface, *MakeSphere(3.0, 2), { 13, 0, 0 });
      for (std::uint32_t & corner : triangles.back())
      {
        corner = triangles.front()[0];
      }
      triangles.back()[1] = 7;
      triangles.back()[2] = 11;
    }
    for (auto & point : surface->GetPoints())
    {
      for (float & coordinate : point)
      {
        coordinate = std::ldexp(coordinate, exponents[seed % exponents.size()]);
      }
    }
    itk::SizeValueType crossing = 0, touching = 0;
    std::set<std::uint32_t> found;
    for (std::uint32_t a = 0; a < triangles.size(); ++a)
    {
      for (std::uint32_t b = a + 1; b < triangles.size(); ++b)
      {
        const Contact contact = FindContact(surface->GetPoints(), triangles[a], triangles[b]);
        crossing += contact == Contact::Crossing ? 1 : 0;
        touching += contact == Contact::Touching ? 1 : 0;
        if (contact == Contact::Crossing)
        {
          found.insert({ a, b });
        }
      }
    }
    const auto intersections = Intersect(*surface);
    EXPECT_EQ(intersections.crossingPairs, crossing) << seed;
    EXPECT_EQ(intersections.touchingPairs, touching) << seed;
    const itk::BulkVector<std::uint32_t> ofPairs(found.begin(), found.end());
    const itk::TrianglesOfPoints fans(*surface);
    EXPECT_EQ(FindCrossingTriangles(itk::TriangleTree(*surface), fans), ofPairs);
    if (const auto sizes = itk::TriangleSizes::Find(*surface))
    {
      rhombic::StagedProgress silent({});
      const itk::TriangleGrid grid(*surface, *sizes, FindUnfoldedPoints(*surface, fans));
      EXPECT_EQ(FindCrossingTriangles(grid, silent, 1.0), ofPairs) << seed;
      ++grids;
    }
    ++(crossing == 0 ? surfacesWithout : surfacesWith);
  }
  EXPECT_GE(surfacesWithout, 4u) << "the test's own surfaces";
  EXPECT_GE(surfacesWith, 20u) << "the test's own surfaces";
  EXPECT_GE(grids, 20u) << "the test's own surfaces";
}

TEST(TriangleSurfaceIntersections, OfASampleSaySo)
{
  const auto surface = MakeSphere(5.0, 4);
  Append(*surface, *MakeSphere(5.0, 4), { 6, 0.1f, 0.2f });
  const auto all = Intersect(*surface);
  const auto sampled = FindTriangleSurfaceSelfIntersections(itk::TriangleTree(*surface), 1000);
  EXPECT_TRUE(sampled.isSampled);
  EXPECT_LE(sampled.testedTriangles, 1000u);
  EXPECT_GE(sampled.testedTriangles, 500u);
  EXPECT_GT(sampled.crossingPairs, 0u);
  EXPECT_LT(sampled.crossingPairs, all.crossingPairs);
  EXPECT_EQ(FindTriangleSurfaceSelfIntersections(itk::TriangleTree(*surface), 4096).crossingPairs, all.crossingPairs);
}

TEST(TriangleSurfaceAudit, OfASphere)
{
  const auto surface = MakeSphere(10.0, 5);
  const auto audit = AuditTriangleSurface(*surface);
  EXPECT_TRUE(audit.IsWatertight());
  EXPECT_TRUE(audit.BoundsSolid());
  EXPECT_EQ(audit.points, 4098u);
  EXPECT_EQ(audit.triangles, 8192u);
  EXPECT_NEAR(audit.volume, 4188.79, 10.0);
  EXPECT_NEAR(audit.area, 1256.64, 2.0);
  EXPECT_EQ(audit.topology.genus, 0u);
  EXPECT_GT(audit.quality.minimum, 0.8);
  itk::TriangleSurfaceAuditSettings settings;
  settings.testsIntersections = false;
  EXPECT_FALSE(AuditTriangleSurface(*surface, settings).BoundsSolid());
  EXPECT_TRUE(AuditTriangleSurface(*surface, settings).IsWatertight());
  TurnInsideOut(*surface);
  EXPECT_FALSE(AuditTriangleSurface(*surface).IsWatertight()) << "no solid has a negative volume";
}

TEST(TriangleSurfaceAudit, FindsShellsThatFaceTheWrongWay)
{
  const auto surface = MakeSphere(10.0, 4);
  const auto cavity = MakeSphere(3.0, 3);
  TurnInsideOut(*cavity);
  Append(*surface, *cavity);
  EXPECT_TRUE(AuditTriangleSurface(*surface).IsWatertight());
  Append(*surface, *cavity, { 20, 0, 0 });
  const auto audit = AuditTriangleSurface(*surface);
  EXPECT_TRUE(audit.topology.IsWatertight());
  EXPECT_EQ(audit.shells.misfacing, 1u);
  EXPECT_FALSE(audit.IsWatertight());
}

TEST(TriangleSurfaceAudit, FindsWhatIsWrong)
{
  EXPECT_FALSE(AuditTriangleSurface(*Surface::New()).IsWatertight());
  const auto sheet = MakeTetrahedron();
  Append(*sheet, *MakeTetrahedron(), { 5, 5, 5 });
  sheet->GetTriangles().resize(5);
  sheet->GetTriangles().push_back({ 4, 5, 6 });
  EXPECT_TRUE(AuditTriangleSurface(*sheet).topology.IsWatertight()) << "two sides of one triangle";
  EXPECT_FALSE(AuditTriangleSurface(*sheet).IsWatertight());
  const auto through = MakeSphere(5.0, 3);
  Append(*through, *MakeSphere(5.0, 3), { 6, 0.1f, 0.2f });
  EXPECT_TRUE(AuditTriangleSurface(*through).IsWatertight());
  EXPECT_FALSE(AuditTriangleSurface(*through).BoundsSolid());
  const auto broken = MakeTetrahedron();
  broken->GetTriangles().push_back({ 0, 1, 4 });
  EXPECT_THROW(AuditTriangleSurface(*broken), itk::ExceptionObject);
}

/** The printed audit, without the digits that depend on the order of sums. */
std::string
Counts(const Surface & surface)
{
  const auto audit = AuditTriangleSurface(surface);
  std::ostringstream text;
  text.precision(4);
  text << audit << audit.quality.poorFraction << ' ' << audit.quality.smallestAngle;
  return text.str();
}

TEST(TriangleSurfaceAudit, DependsNeitherOnThreadsNorOnTheOrderOfTriangles)
{
  const auto surface = MakeRandomTriangles(3000, 10.0f, 0.5f, 1);
  Append(*surface, *MakeTorus(5.0, 3.0, 50));
  Append(*surface, *MakeTorus(5.0, 3.0, 50), { 3, 0, 0 });
  Append(*surface, *MakeSphere(5.0, 6), { 2, 0, 0 });
  const auto expected = Counts(*surface);
  const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  for (const itk::ThreadIdType threads : { 1u, 2u, 5u })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    EXPECT_EQ(Counts(*surface), expected);
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
  std::mt19937 random(3);
  for (int trial = 0; trial < 3; ++trial)
  {
    std::shuffle(surface->GetTriangles().begin(), surface->GetTriangles().end(), random);
    for (auto & triangle : surface->GetTriangles())
    {
      std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
    }
    EXPECT_EQ(Counts(*surface), expected);
  }
}

} // namespace
