#include "rhombicScanReport.h"
#include "rhombicSurfaceReport.h"

#include <gtest/gtest.h>

namespace
{

TEST(ScanReport, ListsRemovedObjects)
{
  rhombic::ScanObject object;
  object.millilitres = 14.5;
  object.centroid[2] = -3.0;
  rhombic::TableRemoval removal;
  removal.objects = { object };
  removal.airValue = -1000.0;
  const rhombic::Report report = rhombic::ReportTableRemoval(removal);
  ASSERT_EQ(report["objects"].size(), 1u);
  EXPECT_EQ(report["objects"][0]["millilitres"], 14.5);
  EXPECT_EQ(report["objects"][0]["centroid"], rhombic::Report({ 0.0, 0.0, -3.0 }));
  EXPECT_EQ(report["airValue"], -1000.0);
}

TEST(SurfaceReport, ComparesALabelsSurfaceWithItsVoxels)
{
  const auto triangles = itk::TriangleSurface::New();
  triangles->GetTriangles().push_back({ 0, 1, 2 });
  rhombic::LabelSurface surface;
  surface.scene.name = "kidney";
  surface.scene.surface = triangles;
  surface.voxelMillilitres = 100.0;
  surface.surfaceMillilitres = 101.0;
  const rhombic::Report report = rhombic::ReportLabelSurface(surface);
  EXPECT_EQ(report["name"], "kidney");
  EXPECT_EQ(report["triangles"], 1u);
  EXPECT_NEAR(report["volumeDifference"].get<double>(), 0.01, 1e-12);
}

} // namespace
