#include "rhombicFewerTrianglesInParts.h"

#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceForRendering.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace
{

using rhombic::FewerTrianglesInParts;
using Surface = itk::TriangleSurface;

constexpr itk::SizeValueType Planes = 100;

/** A ball of radius 100 with waves on it, whose points are in the order of planes: a triangle has points of a plane and
 * of the next one alone. */
struct SortedBall
{
  Surface::Pointer surface = itk::example::MakeSphere(100.0, 7);
  std::vector<itk::SizeValueType> firstPoints; ///< of each plane

  SortedBall()
  {
    std::vector<std::uint32_t> order(surface->GetNumberOfPoints());
    std::iota(order.begin(), order.end(), 0);
    const auto planeOf = [this](std::uint32_t point) {
      const float height = surface->GetPoints()[point][2] + 100.0f;
      return std::clamp<int>(static_cast<int>(height / 200.0f * Planes), 0, Planes - 1);
    };
    std::stable_sort(
      order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return planeOf(a) < planeOf(b); });
    const Surface::PointsContainer points = surface->GetPoints();
    std::vector<std::uint32_t> numbers(order.size());
    firstPoints.resize(Planes + 1, order.size());
    for (std::size_t n = order.size(); n-- > 0;)
    {
      numbers[order[n]] = static_cast<std::uint32_t>(n);
      firstPoints[static_cast<std::size_t>(planeOf(order[n]))] = n;
    }
    surface->GetNormals().clear();
    for (std::size_t n = 0; n < order.size(); ++n)
    {
      auto point = points[order[n]];
      surface->GetNormals().push_back({ point[0] / 100.0f, point[1] / 100.0f, point[2] / 100.0f });
      const float wave = 1.0f + 0.02f * std::sin(point[0] / 9.0f) * std::sin(point[2] / 7.0f);
      surface->GetPoints()[n] = { wave * point[0], wave * point[1], wave * point[2] };
    }
    for (auto & triangle : surface->GetTriangles())
    {
      for (std::uint32_t & point : triangle)
      {
        point = numbers[point];
      }
    }
    std::sort(surface->GetTriangles().begin(), surface->GetTriangles().end(), [](const auto & a, const auto & b) {
      return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
    });
  }

  /** Adds the surface in parts of so many planes. */
  void
  AddTo(FewerTrianglesInParts & fewer, itk::SizeValueType planes) const
  {
    auto triangle = surface->GetTriangles().begin();
    for (itk::SizeValueType begin = 0; begin < Planes; begin += planes)
    {
      const itk::SizeValueType end = std::min(begin + planes, Planes);
      const auto part = Surface::New();
      for (auto n = firstPoints[begin]; n < firstPoints[end]; ++n)
      {
        part->GetPoints().push_back(surface->GetPoints()[n]);
        part->GetNormals().push_back(surface->GetNormals()[n]);
      }
      while (triangle != surface->GetTriangles().end() &&
             *std::min_element(triangle->begin(), triangle->end()) < firstPoints[end])
      {
        part->GetTriangles().push_back(*triangle++);
      }
      fewer.Add(*part, end);
    }
  }
};

TEST(FewerTrianglesInParts, DoNotDependOnTheParts)
{
  const SortedBall ball;
  FewerTrianglesInParts whole(ball.firstPoints, 0.1, 9000);
  ball.AddTo(whole, Planes);
  for (const itk::SizeValueType planes : { 1u, 7u, 60u })
  {
    FewerTrianglesInParts inParts(ball.firstPoints, 0.1, 9000);
    ball.AddTo(inParts, planes);
    EXPECT_TRUE(inParts.GetSurface().GetPoints() == whole.GetSurface().GetPoints());
    EXPECT_TRUE(inParts.GetSurface().GetNormals() == whole.GetSurface().GetNormals());
    EXPECT_TRUE(inParts.GetSurface().GetTriangles() == whole.GetSurface().GetTriangles());
    EXPECT_EQ(inParts.GetWhole().volume, whole.GetWhole().volume);
  }
}

TEST(FewerTrianglesInParts, AreClosedAndFewAndMeasuredBefore)
{
  const SortedBall ball;
  for (const itk::SizeValueType pointsOfBlock : { 3000u, 1'000'000u })
  {
    FewerTrianglesInParts fewer(ball.firstPoints, 0.1, pointsOfBlock);
    ball.AddTo(fewer, 10);
    const Surface & surface = fewer.GetSurface();
    const auto topology = itk::ComputeTriangleSurfaceTopology(surface);
    EXPECT_EQ(topology.boundaryEdges, 0u);
    EXPECT_EQ(topology.components, 1u);
    EXPECT_EQ(topology.unusedPoints, 0u);
    EXPECT_LT(surface.GetNumberOfTriangles(), ball.surface->GetNumberOfTriangles() / 4);
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(surface) / ComputeTriangleSurfaceVolume(*ball.surface), 1.0, 2e-3);
    const rhombic::WholeSurface whole = fewer.GetWhole();
    EXPECT_EQ(whole.points, ball.surface->GetNumberOfPoints());
    EXPECT_EQ(whole.triangles, ball.surface->GetNumberOfTriangles());
    EXPECT_NEAR(whole.volume, ComputeTriangleSurfaceVolume(*ball.surface), 1e-3);
    EXPECT_NEAR(whole.area, ComputeTriangleSurfaceArea(*ball.surface), 1e-3);
    EXPECT_EQ(whole.bounds, ball.surface->GetBounds());
    const auto centroid = ComputeTriangleSurfaceCentroid(*ball.surface);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(whole.centroid[axis], centroid[axis], 1e-5);
    }
  }
}

TEST(FewerTrianglesInParts, HaveTheSmoothNormalsOfTheWholeSurface)
{
  const SortedBall ball;
  const auto smooth = Surface::New();
  smooth->Graft(ball.surface);
  itk::SmoothTriangleSurfaceNormals(*smooth);
  std::map<Surface::PointType, Surface::NormalType> normals;
  for (std::size_t n = 0; n < smooth->GetNumberOfPoints(); ++n)
  {
    normals[smooth->GetPoints()[n]] = smooth->GetNormals()[n];
  }
  FewerTrianglesInParts fewer(ball.firstPoints, 0.1, 9000);
  ball.AddTo(fewer, 10);
  const Surface & surface = fewer.GetSurface();
  ASSERT_EQ(surface.GetNormals().size(), surface.GetNumberOfPoints());
  for (std::size_t n = 0; n < surface.GetNumberOfPoints(); ++n)
  {
    const auto found = normals.find(surface.GetPoints()[n]);
    ASSERT_NE(found, normals.end());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_NEAR(surface.GetNormals()[n][axis], found->second[axis], 1e-5) << n;
    }
  }
}

} // namespace
