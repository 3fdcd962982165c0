#include "itkTriangleSurface.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using Surface = itk::TriangleSurface;

/** The tetrahedron with corners at the origin and one millimetre along each axis, facing outwards. */
Surface::Pointer
UnitTetrahedron()
{
  auto surface = Surface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return surface;
}

/** Adds a copy of \a other, moved along x. */
void
Append(Surface & surface, const Surface & other, float shift)
{
  const auto first = static_cast<std::uint32_t>(surface.GetNumberOfPoints());
  for (auto point : other.GetPoints())
  {
    point[0] += shift;
    surface.GetPoints().push_back(point);
  }
  for (const auto & triangle : other.GetTriangles())
  {
    surface.GetTriangles().push_back({ triangle[0] + first, triangle[1] + first, triangle[2] + first });
  }
}

TEST(TriangleSurface, IsEmptyWhenNew)
{
  const auto surface = Surface::New();
  EXPECT_EQ(surface->GetNumberOfPoints(), 0u);
  EXPECT_FALSE(surface->HasNormals());
  EXPECT_EQ(surface->GetMemorySize(), 0u);
  EXPECT_EQ(surface->GetBounds(), (std::array<double, 6>{}));
  EXPECT_TRUE(ComputeTopology(*surface).IsWatertight());
}

TEST(TriangleSurface, MeasuresOfATetrahedron)
{
  const auto surface = UnitTetrahedron();
  EXPECT_DOUBLE_EQ(ComputeVolume(*surface), 1.0 / 6.0);
  EXPECT_NEAR(ComputeArea(*surface), 1.5 + std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_EQ(surface->GetBounds(), (std::array<double, 6>{ 0, 1, 0, 1, 0, 1 }));
  EXPECT_EQ(surface->GetMemorySize(), 4u * 12u + 4u * 12u);
}

TEST(TriangleSurface, VolumeFarFromTheOriginKeepsItsDigits)
{
  auto surface = UnitTetrahedron();
  for (auto & point : surface->GetPoints())
  {
    point[0] += 4096.0f;
  }
  EXPECT_DOUBLE_EQ(ComputeVolume(*surface), 1.0 / 6.0);
}

TEST(TriangleSurface, GraftCopiesAndInitializeEmpties)
{
  const auto source = UnitTetrahedron();
  auto target = Surface::New();
  target->Graft(source);
  EXPECT_EQ(target->GetPoints(), source->GetPoints());
  target->Initialize();
  EXPECT_EQ(target->GetNumberOfTriangles(), 0u);
  EXPECT_EQ(source->GetNumberOfTriangles(), 4u);
  EXPECT_THROW(target->Graft(itk::DataObject::New()), itk::ExceptionObject);
}

TEST(TriangleSurface, RemovesUnusedPointsOnly)
{
  auto surface = UnitTetrahedron();
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
  EXPECT_EQ(surface->GetPoints(), UnitTetrahedron()->GetPoints());
  EXPECT_EQ(surface->GetTriangles(), UnitTetrahedron()->GetTriangles());
  EXPECT_EQ(surface->GetNormals()[3][2], 3.0f);
  EXPECT_TRUE(surface->HasNormals());
}

TEST(TriangleSurfaceComponents, AreFoundMeasuredAndKept)
{
  auto surface = UnitTetrahedron();
  Append(*surface, *UnitTetrahedron(), 5.0f);
  Append(*surface, *UnitTetrahedron(), -5.0f);
  surface->GetPoints().push_back({ 7, 7, 7 });
  for (std::size_t n = 4; n < 8; ++n)
  {
    surface->GetPoints()[n][2] *= 3.0f;
  }
  const auto components = FindComponents(*surface);
  EXPECT_EQ(components.count, 3u);
  EXPECT_EQ(components.ofPoint.front(), 0u);
  EXPECT_EQ(components.ofPoint[11], 2u);
  EXPECT_EQ(components.ofPoint.back(), itk::TriangleSurfaceComponents::None);
  const auto volumes = ComputeComponentVolumes(*surface, components);
  EXPECT_NEAR(volumes[0], 1.0 / 6.0, 1e-9);
  EXPECT_NEAR(volumes[1], 0.5, 1e-9);

  KeepComponents(*surface, components, { false, true, false });
  EXPECT_EQ(surface->GetNumberOfPoints(), 4u);
  EXPECT_NEAR(ComputeVolume(*surface), 0.5, 1e-9);
  EXPECT_TRUE(ComputeTopology(*surface).IsWatertight());
}

TEST(TriangleSurfaceTopology, ClosedTetrahedronIsWatertight)
{
  const auto topology = ComputeTopology(*UnitTetrahedron());
  EXPECT_TRUE(topology.IsWatertight()) << topology;
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.eulerCharacteristic, 2);
}

TEST(TriangleSurfaceTopology, FindsABoundary)
{
  auto surface = UnitTetrahedron();
  surface->GetTriangles().pop_back();
  const auto topology = ComputeTopology(*surface);
  EXPECT_EQ(topology.boundaryEdges, 3u);
  EXPECT_EQ(topology.nonManifoldPoints, 0u) << "a point on a boundary with one path of triangles is manifold";
  EXPECT_EQ(topology.eulerCharacteristic, 1);
  EXPECT_FALSE(topology.IsWatertight());
}

TEST(TriangleSurfaceTopology, FindsAFlippedTriangle)
{
  auto surface = UnitTetrahedron();
  auto & triangle = surface->GetTriangles().back();
  std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(ComputeTopology(*surface).misorientedEdges, 3u);
}

TEST(TriangleSurfaceTopology, FindsAnEdgeOfThreeTriangles)
{
  auto surface = UnitTetrahedron();
  surface->GetPoints().push_back({ 1, -1, 1 });
  surface->GetTriangles().push_back({ 1, 3, 4 });
  const auto topology = ComputeTopology(*surface);
  EXPECT_EQ(topology.nonManifoldEdges, 1u);
  EXPECT_EQ(topology.boundaryEdges, 2u);
}

TEST(TriangleSurfaceTopology, FindsTwoFansAtOnePoint)
{
  auto surface = UnitTetrahedron();
  Append(*surface, *UnitTetrahedron(), 5.0f);
  EXPECT_EQ(ComputeTopology(*surface).components, 2u);
  for (auto & triangle : surface->GetTriangles())
  {
    for (auto & point : triangle)
    {
      point = point == 4 ? 0 : point; // the second one's corner becomes the first one's
    }
  }
  const auto topology = ComputeTopology(*surface);
  EXPECT_EQ(topology.nonManifoldPoints, 1u);
  EXPECT_EQ(topology.nonManifoldEdges, 0u);
  EXPECT_EQ(topology.unusedPoints, 1u);
  EXPECT_EQ(topology.components, 1u);
}

TEST(TriangleSurfaceTopology, FindsDegenerateTriangles)
{
  auto surface = UnitTetrahedron();
  surface->GetPoints()[3] = surface->GetPoints()[2];
  EXPECT_EQ(ComputeTopology(*surface).degenerateTriangles, 2u) << "those on the edge between the two corners";
  surface->GetPoints()[3][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(ComputeTopology(*surface).degenerateTriangles, 3u) << "those at a position that is no number";
}

} // namespace
