#include "rhombicHiding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using rhombic::ClipPlane;
using rhombic::Projection;
using rhombic::Scene;
using rhombic::SceneSurface;
using rhombic::Vector3;

using Numbers = std::vector<std::size_t>;

constexpr float nothing = std::numeric_limits<float>::infinity();

/** A closed box. */
SceneSurface
Box(const std::string & name, const Vector3 & lowest, const Vector3 & highest, double opacity = 1.0)
{
  const auto surface = itk::TriangleSurface::New();
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::TriangleSurface::PointType point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<float>((corner >> axis & 1U) != 0 ? highest[axis] : lowest[axis]);
    }
    surface->GetPoints().push_back(point);
  }
  surface->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                              { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  SceneSurface item;
  item.name = name;
  item.surface = surface;
  item.opacity = opacity;
  return item;
}

/** A cube around the origin. */
SceneSurface
Cube(const std::string & name, double half, double opacity = 1.0)
{
  return Box(name, { -half, -half, -half }, { half, half, half }, opacity);
}

/** Rays from the front, 1 mm apart, around the origin. */
Projection
FrontRays()
{
  Projection rays;
  rays.frame = rhombic::View().frame;
  rays.width = rays.height = 20;
  return rays;
}

TEST(Hiding, DepthsAreThoseOfTheNearestWall)
{
  const auto depths = rhombic::FindDepths(Box("box", { 1, -3, 2 }, { 4, 5, 7 }), {}, FrontRays());
  for (int row = 0; row < 20; ++row)
  {
    for (int column = 0; column < 20; ++column)
    {
      const double x = column - 9.5;
      const double z = 9.5 - row;
      const bool isMet = x > 1 && x < 4 && z > 2 && z < 7;
      EXPECT_FLOAT_EQ(depths[static_cast<std::size_t>(20 * row + column)], isMet ? -3.0f : nothing)
        << column << ", " << row;
    }
  }
}

TEST(Hiding, RaysPassWhatCutsRemove)
{
  const std::vector<ClipPlane> cuts{ { { 0, 0, 0 }, { 0, -1, 0 }, { "box" } } }; // removes the front
  const SceneSurface box = Cube("box", 6);
  EXPECT_FLOAT_EQ(rhombic::FindDepths(box, cuts, FrontRays())[190], 6.0f);
  EXPECT_FLOAT_EQ(rhombic::FindDepths(Cube("other", 6), cuts, FrontRays())[190], -6.0f);
}

TEST(Hiding, NoRayPassesBetweenTriangles)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  for (int turn = 0; turn < 200; ++turn) // rays meet edges and corners of triangles, or pass them closely
  {
    Projection rays = FrontRays();
    const double c = std::cos(angle(random)), s = std::sin(angle(random)), norm = std::hypot(c, s);
    rays.frame.right = { c / norm, 0.0, s / norm };
    rays.frame.up = { -s / norm, 0.0, c / norm };
    rays.centre = turn % 2 == 0 ? Vector3{ 0.5, 0.0, 0.5 } : Vector3{ 0.0, 0.0, 0.0 };
    const auto surface = itk::TriangleSurface::New(); // a square of 40 mm, with a point for each mm
    constexpr std::uint32_t count = 41;
    for (std::uint32_t n = 0; n < count * count; ++n)
    {
      surface->GetPoints().push_back(
        { static_cast<float>(n % count) - 20.0f, 0.0f, static_cast<float>(n / count) - 20.0f });
      if (n % count + 1 < count && n / count + 1 < count)
      {
        surface->GetTriangles().push_back({ n, n + 1, n + count + 1 });
        surface->GetTriangles().push_back({ n, n + count + 1, n + count });
      }
    }
    SceneSurface square;
    square.surface = surface;
    const auto depths = rhombic::FindDepths(square, {}, rays);
    EXPECT_EQ(std::count(depths.begin(), depths.end(), nothing), 0) << turn;
  }
}

TEST(Hiding, OpaqueSurfacesAroundOthersEncloseThem)
{
  const SceneSurface beside = Box("beside", { 20, -2, -2 }, { 24, 2, 2 });
  EXPECT_EQ(rhombic::FindEnclosing({ { Cube("inner", 5), Cube("outer", 10), beside }, {}, {} }), Numbers{ 1 });
  EXPECT_EQ(rhombic::FindEnclosing({ { Cube("inner", 5), Cube("middle", 7), Cube("outer", 10) }, {}, {} }),
            (Numbers{ 1, 2 }));
  EXPECT_EQ(rhombic::FindEnclosing({ { Cube("inner", 5), Cube("outer", 10, 0.3) }, {}, {} }), Numbers{});
  EXPECT_EQ(rhombic::FindEnclosing({ { Cube("only", 5) }, {}, {} }), Numbers{});
  EXPECT_EQ(rhombic::FindEnclosing({}), Numbers{});
}

TEST(Hiding, WhatIsSeenFromOneSideIsNotEnclosed)
{
  const SceneSurface atTheWall = Box("at the wall", { -2, -11, -2 }, { 2, -7, 2 });
  EXPECT_EQ(rhombic::FindEnclosing({ { atTheWall, Cube("outer", 10) }, {}, {} }), Numbers{});
  const std::vector<ClipPlane> cuts{ { { 0, 0, 0 }, { 0, -1, 0 }, { "outer" } } };
  EXPECT_EQ(rhombic::FindEnclosing({ { Cube("inner", 5), Cube("outer", 10) }, cuts, {} }), Numbers{});
}

TEST(Hiding, WhatLiesBeforeTheFocusHidesItInThatView)
{
  const Scene scene{ { Cube("focus", 5),
                       Box("front", { -4, -20, -4 }, { 4, -16, 4 }),
                       Box("back", { -4, 16, -4 }, { 4, 20, 4 }),
                       Box("skin", { -30, -30, -30 }, { 30, 30, 30 }, 0.2),
                       Box("beside", { 8, -20, -4 }, { 12, -16, 4 }) },
                     {},
                     {} };
  const std::vector<bool> isFocus{ true, false, false, false, false };
  const auto & views = rhombic::StandardViews();
  EXPECT_EQ(rhombic::FindHiding(scene, isFocus, { views[0] }), (Numbers{ 1, 3 }));
  EXPECT_EQ(rhombic::FindHiding(scene, isFocus, { views[1] }), (Numbers{ 2, 3 }));
  EXPECT_EQ(rhombic::FindHiding(scene, isFocus, { views[0], views[1] }), (Numbers{ 1, 2, 3 }));
}

TEST(Hiding, TheBestViewIsTheFirstInWhichLeastIsHidden)
{
  const std::vector<bool> isFocus{ true, false, false };
  Scene scene{ { Cube("focus", 5), Box("front", { -5, -20, -5 }, { 5, -16, 5 }), Cube("skin", 30, 0.2) }, {}, {} };
  EXPECT_EQ(rhombic::FindBestView(scene, isFocus).name, "posterior");
  scene.surfaces[1].opacity = 0.5; // can be seen through
  EXPECT_EQ(rhombic::FindBestView(scene, isFocus).name, "anterior");
  scene.surfaces[1] = Box("front and back", { -5, -20, -5 }, { 3, 20, -5.5 });
  EXPECT_EQ(rhombic::FindBestView(scene, isFocus).name, "anterior");
  scene.surfaces[0] = Box("tube", { -2, -2, -20 }, { 2, 2, 20 }); // half of it is seen, and all of its end
  scene.surfaces[1] = Box("around", { -9, -9, -20 }, { 9, 9, 0 });
  EXPECT_EQ(rhombic::FindBestView(scene, isFocus).name, "anterior");
}

using Seen = std::vector<bool>;

TEST(SeenSurfaces, OpaqueOnesHideAndTranslucentOnesDoNot)
{
  Scene scene; // seen from the front, the small box is behind the large one
  scene.surfaces = { Box("small", { -1, 8, -1 }, { 1, 9, 1 }),
                     Cube("large", 5.0),
                     Cube("inside", 3.0),
                     Box("beside", { 6, 8, 6 }, { 7, 9, 7 }, 0.5) };
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ false, true, false, true }));
  scene.surfaces[1].opacity = 0.3;
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ false, true, true, true })) << "the inner one hides";
  scene.surfaces[2].opacity = 0.3;
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ true, true, true, true }));
}

TEST(SeenSurfaces, CutsOpenTheSurfacesThatTheyName)
{
  Scene scene;
  scene.surfaces = { Cube("shell", 5.0), Cube("inside", 3.0) };
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ true, false }));
  scene.cuts = { { { 0, 0, 0 }, { 0, -1, 0 }, { "shell" } } }; // its front is removed
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ true, true }));
}

TEST(SeenSurfaces, OutsideThePictureNothingIsSeen)
{
  Scene scene;
  scene.surfaces = { Cube("here", 5.0), Box("far", { 100, -5, -5 }, { 110, 5, 5 }) };
  EXPECT_EQ(FindSeenSurfaces(scene, FrontRays()), (Seen{ true, false }));
}

} // namespace
