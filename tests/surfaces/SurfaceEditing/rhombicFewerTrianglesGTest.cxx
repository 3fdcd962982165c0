#include "rhombicFewerTriangles.h"

#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using rhombic::InFewerTriangles;
using rhombic::SceneSurface;

double
RadiusOf(const itk::TriangleSurface::PointType & point)
{
  return std::hypot(point[0], point[1], point[2]);
}

/** The distance from the origin of each triangle's centre. */
std::vector<double>
RadiiOfCentres(const itk::TriangleSurface & surface)
{
  std::vector<double> radii;
  for (const auto & triangle : surface.GetTriangles())
  {
    std::array<double, 3> centre{};
    for (const std::uint32_t point : triangle)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        centre[axis] += static_cast<double>(surface.GetPoints()[point][axis]) / 3.0;
      }
    }
    radii.push_back(std::hypot(centre[0], centre[1], centre[2]));
  }
  return radii;
}

/** A ball whose points have their heights as values and as red. */
SceneSurface
MakeBall(double radius, unsigned int level)
{
  SceneSurface ball{ "ball", itk::example::MakeSphere(radius, level) };
  rhombic::PointValues values{ "height", {} };
  std::vector<std::array<std::uint8_t, 3>> colours;
  for (const auto & point : ball.surface->GetPoints())
  {
    values.values.push_back(point[2]);
    colours.push_back({ static_cast<std::uint8_t>(point[2] + 128.0f), 0, 0 });
  }
  ball.pointValues = std::make_shared<rhombic::PointValues>(values);
  ball.pointColours = std::make_shared<rhombic::PointColours>(colours.begin(), colours.end());
  return ball;
}

TEST(FewerTriangles, AreNearTheSurfacesAndClosed)
{
  const std::vector<double> radii{ 100.0, 60.0 };
  const std::vector<SceneSurface> balls{ MakeBall(100.0, 7), MakeBall(60.0, 7) };
  const auto small = InFewerTriangles(balls, 0.125);
  ASSERT_EQ(small.size(), balls.size());
  for (std::size_t n = 0; n < small.size(); ++n)
  {
    const itk::TriangleSurface & surface = *small[n].surface;
    EXPECT_LT(surface.GetNumberOfTriangles(), balls[n].surface->GetNumberOfTriangles() / 4);
    EXPECT_EQ(balls[n].surface->GetNumberOfTriangles(), 131072u) << "the surfaces themselves stay";
    EXPECT_EQ(ComputeTriangleSurfaceTopology(surface).boundaryEdges, 0u) << "without gaps";
    for (const double radius : RadiiOfCentres(surface))
    {
      ASSERT_NEAR(radius, radii[n], 0.5);
    }
  }
}

TEST(FewerTriangles, HaveThePointsOfTheSurfacesWithTheirValuesAndColours)
{
  const SceneSurface ball = MakeBall(50.0, 6);
  const SceneSurface small = InFewerTriangles({ ball }, 0.2).front();
  const auto & points = small.surface->GetPoints();
  EXPECT_LT(points.size(), ball.surface->GetNumberOfPoints() / 2);
  ASSERT_EQ(small.pointValues->values.size(), points.size());
  ASSERT_EQ(small.pointColours->size(), points.size());
  EXPECT_EQ(small.surface->HasNormals(), ball.surface->HasNormals());
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    ASSERT_NEAR(RadiusOf(points[n]), 50.0, 1e-3);
    ASSERT_EQ(small.pointValues->values[n], points[n][2]);
    ASSERT_EQ((*small.pointColours)[n][0], static_cast<std::uint8_t>(points[n][2] + 128.0f));
  }
}

/** The half of a ball on one side of the plane z = 0, closed by a fan around the origin. */
itk::TriangleSurface::Pointer
MakeHalf(bool isUpper)
{
  const auto ball = itk::example::MakeSphere(40.0, 6);
  const auto half = itk::TriangleSurface::New();
  half->GetPoints() = ball->GetPoints();
  half->GetPoints().push_back({ 0.0f, 0.0f, 0.0f });
  const auto origin = static_cast<std::uint32_t>(half->GetNumberOfPoints() - 1);
  const auto isOnSide = [&](const auto & triangle) {
    const float sum =
      ball->GetPoints()[triangle[0]][2] + ball->GetPoints()[triangle[1]][2] + ball->GetPoints()[triangle[2]][2];
    return (sum > 0.0f) == isUpper;
  };
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const auto & triangle : ball->GetTriangles())
  {
    if (isOnSide(triangle))
    {
      half->GetTriangles().push_back(triangle);
      for (unsigned int corner = 0; corner < 3; ++corner)
      {
        sides.push_back({ triangle[corner], triangle[(corner + 1) % 3] });
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  for (const auto & [from, to] : sides)
  {
    if (!std::binary_search(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{ to, from }))
    {
      half->GetTriangles().push_back({ to, from, origin });
    }
  }
  half->RemoveUnusedPoints();
  return half;
}

TEST(FewerTriangles, WallsThatSurfacesShareStayShared)
{
  const std::vector<SceneSurface> halves{ { "upper", MakeHalf(true) }, { "lower", MakeHalf(false) } };
  const auto sharedOf = [](const std::vector<SceneSurface> & surfaces) {
    const auto sides = JoinSurfaces(surfaces).sides;
    return std::count(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{ 1, 2 });
  };
  ASSERT_GT(sharedOf(halves), 100);
  const auto small = InFewerTriangles(halves, 0.3);
  std::size_t triangles = 0;
  for (const SceneSurface & half : small)
  {
    const auto topology = ComputeTriangleSurfaceTopology(*half.surface);
    EXPECT_EQ(topology.boundaryEdges, 0u);
    EXPECT_EQ(topology.misorientedEdges, 0u);
    triangles += half.surface->GetNumberOfTriangles();
  }
  EXPECT_LT(triangles, 20000u);
  EXPECT_GT(sharedOf(small), 50);
  EXPECT_EQ(JoinSurfaces(small).sides.size() + static_cast<std::size_t>(sharedOf(small)), triangles);
}

TEST(FewerTriangles, AShareOfThemIsKept)
{
  const SceneSurface ball = MakeBall(50.0, 6);
  const auto half = InFewerTriangles({ ball }, 10.0, 0.5).front().surface->GetNumberOfTriangles();
  EXPECT_NEAR(static_cast<double>(half), 0.5 * static_cast<double>(ball.surface->GetNumberOfTriangles()), 200.0);
}

TEST(FewerTriangles, NoneStayNone)
{
  const SceneSurface none{ "none", itk::TriangleSurface::New() };
  EXPECT_EQ(InFewerTriangles({ none }, 1.0).front().surface->GetNumberOfTriangles(), 0u);
  EXPECT_TRUE(InFewerTriangles({}, 1.0).empty());
}

} // namespace
