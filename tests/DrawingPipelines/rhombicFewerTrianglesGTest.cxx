#include "rhombicPictureSteps.h"

#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using rhombic::InFewerTriangles;
using rhombic::SceneSurface;

/** Balls of some radii around the origin, of 131,072 triangles each, or four times as many. */
std::vector<SceneSurface>
MakeBalls(const std::vector<double> & radii, unsigned int level = 7)
{
  std::vector<SceneSurface> balls;
  for (const double radius : radii)
  {
    balls.push_back({ "ball", itk::example::MakeSphere(radius, level) });
  }
  return balls;
}

TEST(FewerTriangles, AreNearAllAndClosed)
{
  constexpr double pixelSize = 0.5;
  const std::vector<double> radii{ 100.0, 60.0 };
  const auto balls = MakeBalls(radii, 8);
  const auto small = InFewerTriangles(balls, pixelSize);
  ASSERT_EQ(small.size(), balls.size());
  for (std::size_t n = 0; n < small.size(); ++n)
  {
    const itk::TriangleSurface & surface = *small[n].surface;
    EXPECT_EQ(surface.GetPoints(), balls[n].surface->GetPoints()) << "colours of points still fit";
    EXPECT_LT(surface.GetNumberOfTriangles(), balls[n].surface->GetNumberOfTriangles() / 4);
    EXPECT_EQ(balls[n].surface->GetNumberOfTriangles(), 524288u) << "the surfaces themselves stay";
    EXPECT_EQ(ComputeTriangleSurfaceTopology(surface).boundaryEdges, 0u) << "without gaps";
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
      ASSERT_NEAR(std::hypot(centre[0], centre[1], centre[2]), radii[n], pixelSize);
    }
  }
}

TEST(FewerTriangles, FewStayAsTheyAre)
{
  const auto balls = MakeBalls({ 100.0 });
  EXPECT_EQ(InFewerTriangles(balls, 0.5).front().surface, balls.front().surface);
}

} // namespace
