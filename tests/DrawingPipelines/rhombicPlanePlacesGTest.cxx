#include "rhombicPictureSteps.h"

#include <gtest/gtest.h>

namespace
{

using namespace rhombic;

/** A box. */
SceneSurface
Box(const Vector3 & lowest, const Vector3 & highest)
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
  item.surface = surface;
  return item;
}

/** A tall box with three small ones at its upper end, in a larger scan. */
PictureScene
SceneOfBoxes()
{
  PictureScene scene;
  scene.box = BoxOf({ 0, 0, 0 }, { 100, 100, 300 }, { 1, 1, 1 });
  scene.surfaces = { Box({ 20, 20, 50 }, { 80, 80, 250 }),
                     Box({ 20, 20, 200 }, { 40, 40, 240 }),
                     Box({ 60, 20, 210 }, { 80, 40, 230 }),
                     Box({ 20, 60, 190 }, { 40, 80, 240 }) };
  return scene;
}

TEST(PlanePlaces, APageShowsTheSliceThatMeetsMostSurfaces)
{
  const PictureScene scene = SceneOfBoxes();
  const double axial = PlaceOfMost(SlicePlane::Axial, scene)[2];
  EXPECT_GT(axial, 210.0);
  EXPECT_LT(axial, 216.0) << "nearest to the middle";
  EXPECT_LT(PlaceOfMost(SlicePlane::Coronal, scene)[1], 40.0) << "of the two pairs, one has two in front";
  PictureScene alone = scene;
  alone.surfaces.resize(1);
  EXPECT_DOUBLE_EQ(PlaceOfMost(SlicePlane::Axial, alone)[2], 150.0);
}

/** Two surfaces as one. */
SceneSurface
Together(const SceneSurface & first, const SceneSurface & second)
{
  const auto both = itk::TriangleSurface::New();
  both->Graft(first.surface);
  const auto shift = static_cast<std::uint32_t>(both->GetNumberOfPoints());
  const auto & points = second.surface->GetPoints();
  both->GetPoints().insert(both->GetPoints().end(), points.begin(), points.end());
  for (const auto & [a, b, c] : second.surface->GetTriangles())
  {
    both->GetTriangles().push_back({ a + shift, b + shift, c + shift });
  }
  SceneSurface item;
  item.surface = both;
  return item;
}

TEST(PlanePlaces, APageShowsLargeSectionsNotSpecks)
{
  PictureScene scene;
  scene.box = BoxOf({ 0, 0, 0 }, { 100, 100, 300 }, { 1, 1, 1 });
  scene.surfaces = { Box({ 0, 0, 0 }, { 100, 100, 300 }),
                     Together(Box({ 20, 20, 30 }, { 60, 60, 61 }), Box({ 70, 70, 140 }, { 80, 80, 160 })) };
  const double axial = PlaceOfMost(SlicePlane::Axial, scene)[2];
  EXPECT_GT(axial, 30.0);
  EXPECT_LT(axial, 61.0) << "the speck lies nearer to the middle";
}

TEST(PlanePlaces, FlatSurfacesAreSeenFromTheirFaces)
{
  const auto namesOf = [](const SceneSurface & surface) {
    std::string names;
    for (const View & view : ViewsOfFaces({ surface }))
    {
      names += view.name + ' ';
    }
    return names;
  };
  EXPECT_EQ(namesOf(Box({ 0, 0, 0 }, { 200, 150, 10 })), "inferior superior ");
  EXPECT_EQ(namesOf(Box({ 0, 0, 0 }, { 200, 10, 150 })), "anterior posterior ");
  EXPECT_EQ(namesOf(Box({ 0, 0, 0 }, { 10, 150, 200 })), "left right ");
  EXPECT_EQ(namesOf(Box({ 0, 0, 0 }, { 200, 150, 40 })), "");
  EXPECT_EQ(namesOf(Box({ 0, 0, 0 }, { 200, 10, 10 })), "") << "a rod has no faces";
}

TEST(PlanePlaces, LightboxesRunFromHeadToFeetWhereSurfacesAre)
{
  const PictureScene scene = SceneOfBoxes();
  SliceSettings settings;
  settings.lightbox = 4;
  const auto axial = PlacesInLightbox({ SlicePlane::Axial, "" }, settings, scene);
  ASSERT_EQ(axial.size(), 4u);
  for (std::size_t n = 0; n < 4; ++n)
  {
    EXPECT_DOUBLE_EQ(axial[n][2], 225.0 - 50.0 * static_cast<double>(n));
  }
  const auto coronal = PlacesInLightbox({ SlicePlane::Coronal, "" }, settings, scene);
  EXPECT_DOUBLE_EQ(coronal.front()[1], 27.5) << "from the front";
  const auto sagittal = PlacesInLightbox({ SlicePlane::Sagittal, "" }, settings, scene);
  EXPECT_DOUBLE_EQ(sagittal.front()[0], 72.5) << "from the left";
  settings.outlines = false;
  EXPECT_DOUBLE_EQ(PlacesInLightbox({ SlicePlane::Axial, "" }, settings, scene).front()[2], 262.5);
}

TEST(PlanePlaces, SlicesKnowTheSurfacesThatTheyCut)
{
  const PictureScene scene = SceneOfBoxes();
  const SceneSlice slice = CutScene(scene, { SlicePlane::Axial, "" }, { 50, 50, 195 }, {});
  EXPECT_EQ(slice.isSeen, (std::vector<bool>{ true, false, false, true }));
  EXPECT_EQ(slice.picture.outlines.size(), 2u);
}

TEST(PlanePlaces, SurfacesWithoutNormalsAreShaded)
{
  const PictureScene scene = SceneOfBoxes();
  const std::vector<SceneSurface> shaded = ShadedSurfaces(scene.surfaces);
  ASSERT_EQ(shaded.size(), 4u);
  EXPECT_TRUE(shaded[0].surface->HasNormals());
  EXPECT_EQ(shaded[0].surface->GetNumberOfPoints(), 24u) << "sharp edges";
  EXPECT_EQ(scene.surfaces[0].surface->GetNumberOfPoints(), 8u) << "slices need closed surfaces";
}

} // namespace
