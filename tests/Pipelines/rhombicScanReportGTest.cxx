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
  rhombic::MeshedSurface surface;
  surface.scene.name = "kidney";
  surface.scene.surface = triangles;
  surface.label.emplace();
  surface.label->value = 5;
  surface.label->voxelMillilitres = 100.0;
  surface.label->surfaceMillilitres = 101.0;
  surface.triangles = 1;
  const rhombic::Report report = rhombic::ReportMeshedSurface(surface);
  EXPECT_EQ(report["name"], "kidney");
  EXPECT_EQ(report["measures"]["triangles"], 1u);
  EXPECT_EQ(report["measures"]["label_value"], 5);
  EXPECT_FALSE(report["measures"].contains("mean_scan_unit")) << "which is not known";
  EXPECT_NEAR(report["label"]["volumeDifferenceInPercent"].get<double>(), 1.0, 1e-12);
}

} // namespace
