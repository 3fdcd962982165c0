#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace
{

using Surface = itk::TriangleSurface;
using namespace itk::example;

TEST(TriangleSurface, IsEmptyWhenNew)
{
  const auto surface = Surface::New();
  EXPECT_EQ(surface->GetNumberOfPoints(), 0u);
  EXPECT_FALSE(surface->HasNormals());
  EXPECT_EQ(surface->GetMemorySize(), 0u);
  EXPECT_EQ(surface->GetBounds(), (std::array<double, 6>{}));
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
}

TEST(TriangleSurface, MeasuresOfATetrahedron)
{
  const auto surface = MakeTetrahedron();
  EXPECT_DOUBLE_EQ(ComputeTriangleSurfaceVolume(*surface), 1.0 / 6.0);
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*surface), 1.5 + std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_EQ(surface->GetBounds(), (std::array<double, 6>{ 0, 1, 0, 1, 0, 1 }));
  EXPECT_EQ(surface->GetMemorySize(), 4u * 12u + 4u * 12u);
}

TEST(TriangleSurface, VolumeFarFromTheOriginKeepsItsDigits)
{
  auto surface = MakeTetrahedron();
  for (auto & point : surface->GetPoints())
  {
    point[0] += 4096.0f;
  }
  EXPECT_DOUBLE_EQ(ComputeTriangleSurfaceVolume(*surface), 1.0 / 6.0);
}

TEST(TriangleSurface, GraftSharesArraysUntilEitherSurfaceChanges)
{
  const auto source = MakeTetrahedron();
  source->GetNormals().assign(4, { 0, 0, 1 });
  const auto target = Surface::New();
  target->Graft(source);
  const Surface & constSource = *source;
  const Surface & constTarget = *target;
  EXPECT_EQ(&constTarget.GetPoints(), &constSource.GetPoints());
  EXPECT_EQ(&constTarget.GetNormals(), &constSource.GetNormals());
  EXPECT_EQ(&constTarget.GetTriangles(), &constSource.GetTriangles());

  target->GetPoints()[0] = { 5, 5, 5 };
  EXPECT_EQ(constSource.GetPoints()[0], (Surface::PointType{ 0, 0, 0 }));
  EXPECT_EQ(constTarget.GetPoints()[1], constSource.GetPoints()[1]);
  EXPECT_EQ(&constTarget.GetTriangles(), &constSource.GetTriangles()) << "only what changes is copied";
  source->GetNormals().clear();
  EXPECT_TRUE(target->HasNormals());

  target->Initialize();
  EXPECT_EQ(target->GetNumberOfTriangles(), 0u);
  EXPECT_EQ(source->GetNumberOfTriangles(), 4u);
  EXPECT_THROW(target->Graft(itk::DataObject::New()), itk::ExceptionObject);
}

TEST(TriangleSurface, AnArrayOfOneSurfaceAloneIsChangedInPlace)
{
  const auto surface = MakeTetrahedron();
  const Surface & constSurface = *surface;
  Surface::New()->Graft(surface);
  const auto * const points = constSurface.GetPoints().data();
  EXPECT_EQ(surface->GetPoints().data(), points);
}

TEST(TriangleSurface, RemovesUnusedPointsOnly)
{
  auto surface = MakeTetrahedron();
  surface->GetPoints().insert(surface->GetPoints().begin(), { 9, 9, 9 });
  surface->GetPoints().push_back({ 8, 8, 8 });
  surface->GetNormals() = { { 0, 0, 9 }, { 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, 2 }, { 0, 0, 3 }, { 0, 0, 8 } };
  for (auto & triangle : surface->GetTriangles())
  {
    for (auto & point : triangle)
    {
      ++point;
    }
  }
  surface->RemoveUnusedPoints();
  EXPECT_EQ(surface->GetPoints(), MakeTetrahedron()->GetPoints());
  EXPECT_EQ(surface->GetTriangles(), MakeTetrahedron()->GetTriangles());
  EXPECT_EQ(surface->GetNormals()[3][2], 3.0f);
  EXPECT_TRUE(surface->HasNormals());
}

TEST(TriangleSurfaceComponents, AreFoundMeasuredAndKept)
{
  auto surface = MakeTetrahedron();
  Append(*surface, *MakeTetrahedron(), { 5, 0, 0 });
  Append(*surface, *MakeTetrahedron(), { -5, 0, 0 });
  surface->GetPoints().push_back({ 7, 7, 7 });
  for (std::size_t n = 4; n < 8; ++n)
  {
    surface->GetPoints()[n][2] *= 3.0f;
  }
  const auto components = FindTriangleSurfaceComponents(*surface);
  EXPECT_EQ(components.count, 3u);
  EXPECT_EQ(components.ofPoint.front(), 0u);
  EXPECT_EQ(components.ofPoint[11], 2u);
  EXPECT_EQ(components.ofPoint.back(), itk::TriangleSurfaceComponents::None);
  const auto volumes = ComputeTriangleSurfaceComponentVolumes(*surface, components);
  EXPECT_NEAR(volumes[0], 1.0 / 6.0, 1e-9);
  EXPECT_NEAR(volumes[1], 0.5, 1e-9);

  KeepTriangleSurfaceComponents(*surface, components, { false, true, false });
  EXPECT_EQ(surface->GetNumberOfPoints(), 4u);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 0.5, 1e-9);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
}

TEST(TriangleSurfaceTopology, ClosedTetrahedronIsWatertight)
{
  const auto topology = ComputeTriangleSurfaceTopology(*MakeTetrahedron());
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(TriangleSurfaceTopology, FindsABoundary)
{
  auto surface = MakeTetrahedron();
  surface->GetTriangles().pop_back();
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_EQ(topology.boundaryEdges, 3u);
  EXPECT_EQ(topology.nonManifoldPoints, 0u) << "a point on a boundary with one path of triangles is manifold";
  EXPECT_EQ(topology.eulerCharacteristic, 1);
  EXPECT_FALSE(topology.IsWatertight());
}

TEST(TriangleSurfaceTopology, FindsAFlippedTriangle)
{
  auto surface = MakeTetrahedron();
  auto & triangle = surface->GetTriangles().back();
  std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).misorientedEdges, 3u);
}

TEST(TriangleSurfaceTopology, FindsAnEdgeOfThreeTriangles)
{
  auto surface = MakeTetrahedron();
  surface->GetPoints().push_back({ 1, -1, 1 });
  surface->GetTriangles().push_back({ 1, 3, 4 });
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_EQ(topology.nonManifoldEdges, 1u);
  EXPECT_EQ(topology.boundaryEdges, 2u);
}

TEST(TriangleSurfaceTopology, FindsTwoFansAtOnePoint)
{
  auto surface = MakeTetrahedron();
  Append(*surface, *MakeTetrahedron(), { 5, 0, 0 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).components, 2u);
  for (auto & triangle : surface->GetTriangles())
  {
    for (auto & point : triangle)
    {
      point = point == 4 ? 0 : point; // the second one's corner becomes the first one's
    }
  }
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_EQ(topology.nonManifoldPoints, 1u);
  EXPECT_EQ(topology.nonManifoldEdges, 0u);
  EXPECT_EQ(topology.unusedPoints, 1u);
  EXPECT_EQ(topology.components, 1u);
}

TEST(TriangleSurfaceTopology, FindsDegenerateTriangles)
{
  auto surface = MakeTetrahedron();
  surface->GetPoints()[3] = surface->GetPoints()[2];
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).degenerateTriangles, 2u)
    << "those on the edge between the two corners";
  surface->GetPoints()[3][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).degenerateTriangles, 3u)
    << "those at a position that is no number";
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).nonFinitePoints, 1u);
}

TEST(TriangleSurfaceTopology, CountsHandles)
{
  const auto sphere = ComputeTriangleSurfaceTopology(*MakeSphere(5.0, 3));
  EXPECT_TRUE(sphere.IsWatertight()) << sphere;
  EXPECT_EQ(sphere.genus, 0u);
  const auto torus = ComputeTriangleSurfaceTopology(*MakeTorus(5.0, 2.0, 24));
  EXPECT_TRUE(torus.IsWatertight()) << torus;
  EXPECT_EQ(torus.eulerCharacteristic, 0);
  EXPECT_EQ(torus.genus, 1u);
  auto both = MakeTorus(5.0, 2.0, 24);
  Append(*both, *MakeTorus(5.0, 2.0, 12), { 20, 0, 0 });
  Append(*both, *MakeSphere(5.0, 1), { 0, 20, 0 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*both).genus, 2u);
  both->GetTriangles().pop_back();
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*both).genus, 2u) << "an open sphere has no genus, and takes none away";
}

/** Two tori, each without one triangle, joined at the corners of the holes. */
TEST(TriangleSurfaceTopology, ADoubleTorusIsOneComponentOfGenusTwo)
{
  auto surface = MakeTorus(5.0, 2.0, 12);
  const auto first = surface->GetTriangles().front();
  const auto offset = static_cast<std::uint32_t>(surface->GetNumberOfPoints());
  Append(*surface, *MakeTorus(5.0, 2.0, 12), { 20, 0, 0 });
  auto & triangles = surface->GetTriangles();
  triangles.erase(triangles.begin() + 2 * offset);
  triangles.erase(triangles.begin());
  for (auto & triangle : triangles)
  {
    for (auto & point : triangle)
    {
      // reversed, so that the second torus does not continue the first one inside out
      point = point == first[0] + offset ? first[1] : point == first[1] + offset ? first[0] : point;
      point = point == first[2] + offset ? first[2] : point;
    }
  }
  const auto topology = ComputeTriangleSurfaceTopology(*surface);
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.eulerCharacteristic, -2);
  EXPECT_EQ(topology.genus, 2u);
  EXPECT_EQ(topology.unusedPoints, 3u);
}

/** A grid of squares, closed to a ring in one direction and joined with a twist in the other, which leaves edges where
 * orientations meet. */
Surface::Pointer
MakeTwisted(std::uint32_t length, std::uint32_t width, bool isRingAcross)
{
  auto surface = Surface::New();
  const std::uint32_t rows = isRingAcross ? width : width + 1;
  for (std::uint32_t n = 0; n < length * rows; ++n)
  {
    surface->GetPoints().push_back({ float(n % rows), float(n / rows), float(n % 7) });
  }
  const auto id = [&](std::uint32_t i, std::uint32_t j) {
    j = isRingAcross ? j % width : j;
    return i == length ? (isRingAcross ? (width - j) % width : width - j) : i * rows + j;
  };
  for (std::uint32_t i = 0; i < length; ++i)
  {
    for (std::uint32_t j = 0; j < width; ++j)
    {
      surface->GetTriangles().push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
      surface->GetTriangles().push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
    }
  }
  return surface;
}

TEST(TriangleSurfaceTopology, OneSidedSurfacesAreManifoldButNotOriented)
{
  const auto strip = ComputeTriangleSurfaceTopology(*MakeTwisted(12, 4, false));
  EXPECT_EQ(strip.misorientedEdges, 4u) << strip;
  EXPECT_EQ(strip.nonManifoldEdges + strip.nonManifoldPoints, 0u) << strip;
  EXPECT_EQ(strip.boundaryEdges, 24u) << "one boundary, twice around";
  EXPECT_EQ(strip.eulerCharacteristic, 0);
  const auto bottle = ComputeTriangleSurfaceTopology(*MakeTwisted(12, 6, true));
  EXPECT_EQ(bottle.misorientedEdges, 6u) << bottle;
  EXPECT_EQ(bottle.boundaryEdges + bottle.nonManifoldEdges + bottle.nonManifoldPoints, 0u) << bottle;
  EXPECT_EQ(bottle.eulerCharacteristic, 0);
  EXPECT_EQ(bottle.genus, 0u);
  EXPECT_FALSE(bottle.IsWatertight());
}

TEST(TriangleSurfaceTopology, FindsDuplicateTrianglesInAnyOrder)
{
  auto surface = MakeTetrahedron();
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).duplicateTriangles, 0u);
  surface->GetTriangles().push_back({ 2, 1, 0 });
  surface->GetTriangles().push_back({ 1, 2, 0 });
  surface->GetTriangles().push_back({ 3, 2, 1 });
  surface->GetTriangles().push_back({ 3, 3, 1 });
  surface->GetTriangles().push_back({ 3, 3, 1 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).duplicateTriangles, 3u);
}

TEST(TriangleSurfaceTopology, FindsRepeatedPositions)
{
  auto surface = MakeTetrahedron();
  Append(*surface, *MakeTetrahedron(), { 1, 0, 0 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).repeatedPositions, 1u);
  Append(*surface, *MakeTetrahedron(), { -1, 0, 0 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).repeatedPositions, 2u);
  surface->GetPoints()[4][1] = -0.0f;
  surface->GetPoints().push_back({ 0, 0, 0 });
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).repeatedPositions, 2u)
    << "0 is at -0, and unused points do not count";
}

/** Compares every count with simple counting over maps of edges, for random triangles. */
TEST(TriangleSurfaceTopology, CountsWhatMapsCount)
{
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial)
  {
    const std::uint32_t points = 4 + trial % 12;
    std::uniform_int_distribution<std::uint32_t> point(0, points - 1);
    auto surface = Surface::New();
    for (std::uint32_t n = 0; n < points; ++n)
    {
      surface->GetPoints().push_back({ float(n), float(n * n), float(n * n * n) });
    }
    std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edges;
    std::set<std::array<std::uint32_t, 3>> triangles;
    itk::SizeValueType duplicates = 0;
    for (int n = 0; n < trial % 40;)
    {
      const Surface::TriangleType triangle{ point(random), point(random), point(random) };
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      {
        continue;
      }
      ++n;
      surface->GetTriangles().push_back(triangle);
      auto sorted = triangle;
      std::sort(sorted.begin(), sorted.end());
      duplicates += triangles.insert(sorted).second ? 0 : 1;
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        const std::uint32_t from = triangle[corner], to = triangle[(corner + 1) % 3];
        ++edges[{ std::min(from, to), std::max(from, to) }][from < to ? 0 : 1];
      }
    }
    const auto topology = ComputeTriangleSurfaceTopology(*surface);
    itk::SizeValueType boundary = 0, misoriented = 0, nonManifold = 0;
    for (const auto & [edge, uses] : edges)
    {
      boundary += uses[0] + uses[1] == 1;
      misoriented += uses[0] + uses[1] == 2 && uses[0] != 1;
      nonManifold += uses[0] + uses[1] > 2;
    }
    ASSERT_EQ(topology.boundaryEdges, boundary);
    ASSERT_EQ(topology.misorientedEdges, misoriented);
    ASSERT_EQ(topology.nonManifoldEdges, nonManifold);
    ASSERT_EQ(topology.duplicateTriangles, duplicates);
    ASSERT_EQ(topology.eulerCharacteristic,
              static_cast<long>(points - topology.unusedPoints + surface->GetNumberOfTriangles()) -
                static_cast<long>(edges.size()));
  }
}

} // namespace
