#include "rhombicNamePlaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

using rhombic::NamePlace;
using rhombic::Projection;
using rhombic::Scene;
using rhombic::SceneSurface;
using rhombic::Vector3;

struct Ball
{
  Vector3 centre;
  double radius;
};

/** A ball of triangles between meridians and parallels, inside the true one by less than 1 %. */
SceneSurface
SurfaceOf(const Ball & ball, double opacity = 1.0)
{
  constexpr std::uint32_t rows = 24;
  constexpr std::uint32_t columns = 48;
  constexpr double pi = 3.14159265358979;
  const auto surface = itk::TriangleSurface::New();
  for (std::uint32_t row = 0; row <= rows; ++row)
  {
    for (std::uint32_t column = 0; column < columns; ++column)
    {
      const double polar = pi * row / rows;
      const double angle = 2.0 * pi * column / columns;
      surface->GetPoints().push_back(
        { static_cast<float>(ball.centre[0] + ball.radius * std::sin(polar) * std::cos(angle)),
          static_cast<float>(ball.centre[1] + ball.radius * std::sin(polar) * std::sin(angle)),
          static_cast<float>(ball.centre[2] + ball.radius * std::cos(polar)) });
      const std::uint32_t here = row * columns + column;
      const std::uint32_t next = row * columns + (column + 1) % columns;
      if (row < rows)
      {
        surface->GetTriangles().push_back({ here, here + columns, next });
        surface->GetTriangles().push_back({ next, here + columns, next + columns });
      }
    }
  }
  SceneSurface item;
  item.surface = surface;
  item.opacity = opacity;
  return item;
}

/** From the front, 0.25 mm a pixel, 200 x 100 mm. */
Projection
FrontPicture()
{
  Projection picture;
  picture.frame = rhombic::View().frame;
  picture.width = 800;
  picture.height = 400;
  picture.pixelSize = 0.25;
  return picture;
}

/** Where the ray from the front through (x, z) meets a ball; infinity where it does not. */
double
DepthOf(const Ball & ball, double x, double z)
{
  const double rest = ball.radius * ball.radius - std::pow(x - ball.centre[0], 2) - std::pow(z - ball.centre[2], 2);
  return rest > 0.0 ? ball.centre[1] - std::sqrt(rest) : std::numeric_limits<double>::infinity();
}

TEST(NamePlaces, TheMiddleOfWhatIsSeen)
{
  const Scene scene{ { SurfaceOf({ { -50, 0, 10 }, 20 }), SurfaceOf({ { 30, 0, 0 }, 40 }) }, {}, {} };
  const std::vector<NamePlace> places = FindNamePlaces(scene, FrontPicture());
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[1].surface, 1u);
  const double ray = 200.0 / 600;
  EXPECT_NEAR(places[0].point[0], -50, 2 * ray);
  EXPECT_NEAR(places[0].point[2], 10, 2 * ray);
  EXPECT_NEAR(places[1].point[0], 30, 2 * ray);
  EXPECT_NEAR(places[0].seen, 3.14159 * 400 / 20000, 0.02 * 3.14159 * 400 / 20000);
}

TEST(NamePlaces, HiddenAndTinySurfacesHaveNone)
{
  const Scene scene{
    { SurfaceOf({ { 0, 50, 0 }, 10 }), SurfaceOf({ { 0, 0, 0 }, 20 }), SurfaceOf({ { 60, 0, 0 }, 0.3 }) }, {}, {}
  };
  const std::vector<NamePlace> places = FindNamePlaces(scene, FrontPicture());
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].surface, 1u);
}

/** The skin is named beside the organ in it, whichever is first in the scene. */
TEST(NamePlaces, TranslucentSurfacesAreNamedWhereNothingElseIsSeen)
{
  const Ball skin{ { 0, 0, 0 }, 45 };
  const Ball lung{ { 20, 0, 0 }, 15 };
  const Ball heart{ { -20, 0, 0 }, 15 };
  for (const bool isSkinFirst : { false, true })
  {
    Scene scene{ { SurfaceOf(heart), SurfaceOf(lung, 0.5), SurfaceOf(skin, 0.2) }, {}, {} };
    if (isSkinFirst)
    {
      std::reverse(scene.surfaces.begin(), scene.surfaces.end());
    }
    const std::vector<NamePlace> places = FindNamePlaces(scene, FrontPicture());
    ASSERT_EQ(places.size(), 3u);
    const auto & [x, y, z] = places[isSkinFirst ? 0 : 2].point;
    EXPECT_LT(std::hypot(x, z), 45);
    EXPECT_GT(std::hypot(x - 20, z), 15);
    EXPECT_GT(std::hypot(x + 20, z), 15);
    EXPECT_NEAR(places[1].point[0], 20, 1);
    EXPECT_NEAR(places[isSkinFirst ? 2 : 0].point[0], -20, 1);
  }
}

/** A ball in a ball, cut through the middle: the face of the cut hides the ball behind it. */
TEST(NamePlaces, OnCutFacesTheInnermostSurfaceCounts)
{
  Scene scene{
    { SurfaceOf({ { 0, 0, 0 }, 40 }, 0.3), SurfaceOf({ { 10, 0, 0 }, 10 }), SurfaceOf({ { -20, 20, 0 }, 8 }) },
    { { { 0, 0, 0 }, { 0, -1, 0 }, {} } },
    {}
  };
  ASSERT_EQ(FindNamePlaces(scene, FrontPicture()).size(), 3u);
  rhombic::ScenePlane face;
  face.picture = rhombic::Picture(800, 400);
  face.projection = FrontPicture();
  scene.planes.push_back(face);
  const std::vector<NamePlace> places = FindNamePlaces(scene, FrontPicture());
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].surface, 0u);
  EXPECT_EQ(places[1].surface, 1u);
  EXPECT_NEAR(places[1].point[0], 10, 1);
  EXPECT_GT(std::hypot(places[0].point[0] - 10, places[0].point[2]), 10);
}

/** Balls in disorder: along the ray through an anchor, the exact ball of that number is the first. */
TEST(NamePlaces, AnchorsLieOnTheirSurfaces)
{
  std::mt19937 random(7);
  std::size_t named = 0;
  for (int turn = 0; turn < 20; ++turn)
  {
    std::vector<Ball> balls;
    Scene scene;
    for (int n = 0; n < 30; ++n)
    {
      balls.push_back({ { random() % 160 - 80.0, random() % 100 - 50.0, random() % 80 - 40.0 }, 4.0 + random() % 20 });
      scene.surfaces.push_back(SurfaceOf(balls.back()));
    }
    for (const NamePlace & place : FindNamePlaces(scene, FrontPicture()))
    {
      const double depth = DepthOf(balls[place.surface], place.point[0], place.point[2]);
      for (const Ball & other : balls)
      {
        EXPECT_GE(DepthOf(other, place.point[0], place.point[2]) + 0.6, depth) << "at most 1 % of a radius before it";
      }
      ++named;
    }
  }
  EXPECT_GT(named, 200u);
}

} // namespace
