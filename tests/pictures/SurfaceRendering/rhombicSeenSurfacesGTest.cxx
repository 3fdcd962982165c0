#include "rhombicSeenSurfaces.h"
#include "rhombicTestScenes.h"
#include "rhombicView.h"

#include <gtest/gtest.h>

namespace
{

using namespace rhombic;
using namespace rhombic::test;

std::vector<bool>
SeenFromTheFront(const Scene & scene)
{
  return FindSeenSurfaces(scene, SurfaceRenderer::Plan(scene, Small(), { StandardViews()[0] }).at(0));
}

TEST(SeenSurfaces, OpaqueOnesHideAndTranslucentOnesDoNot)
{
  const auto small = Sphere({ 0, 40, 0 }, 5); // behind the large one, seen from the front
  const auto large = Sphere({ 0, 0, 0 }, 20);
  const auto inside = Sphere({ 0, 0, 0 }, 10);
  const auto beside = Sphere({ 40, 40, 0 }, 5);
  Scene scene;
  scene.surfaces = { Item(small, Red), Item(large, Green), Item(inside, Blue), Item(beside, Red, 0.5) };
  EXPECT_EQ(SeenFromTheFront(scene), (std::vector<bool>{ false, true, false, true }));
  scene.surfaces[1].opacity = 0.3;
  EXPECT_EQ(SeenFromTheFront(scene), (std::vector<bool>{ false, true, true, true })) << "the inner one hides";
  scene.surfaces[2].opacity = 0.3;
  EXPECT_EQ(SeenFromTheFront(scene), (std::vector<bool>{ true, true, true, true }));
}

TEST(SeenSurfaces, CutsOpenTheSurfacesThatTheyName)
{
  Scene scene;
  scene.surfaces = { Item(Sphere({ 0, 0, 0 }, 20), Red), Item(Sphere({ 0, 0, 0 }, 10), Green) };
  scene.surfaces[0].name = "shell";
  EXPECT_EQ(SeenFromTheFront(scene), (std::vector<bool>{ true, false }));
  scene.cuts = { { { 0, 0, 0 }, { 0, -1, 0 }, { "shell" } } }; // its front is removed
  EXPECT_EQ(SeenFromTheFront(scene), (std::vector<bool>{ true, true }));
}

TEST(SeenSurfaces, OutsideThePictureNothingIsSeen)
{
  Scene scene;
  scene.surfaces = { Item(Sphere({ 0, 0, 0 }, 20), Red), Item(Sphere({ 200, 0, 0 }, 20), Green) };
  Projection projection = SurfaceRenderer::Plan(scene, Small(), { StandardViews()[0] }).at(0);
  projection.pixelSize *= 0.3;
  projection.centre = { 0, 0, 0 };
  EXPECT_EQ(FindSeenSurfaces(scene, projection), (std::vector<bool>{ true, false }));
}

} // namespace
