#include "rhombicMeasureTable.h"
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

TEST(ScanReport, NotesNameNoFileAndKeepTheirWords)
{
  rhombic::Scan scan;
  scan.image = itk::Image<short, 3>::New();
  const auto notesOf = [&scan](const std::string & note, const std::string & path) {
    scan.notes = { note };
    return rhombic::ReportWithoutNames(scan, path)["notes"][0].get<std::string>();
  };
  EXPECT_EQ(notesOf("/data/smith.mhd does not say how large its voxels are.", "/data/smith.mhd"),
            "SCAN does not say how large its voxels are.");
  EXPECT_EQ(notesOf("smith.mhd: the values of smith.raw are a guess.", "/data/smith.mhd"),
            "SCAN: the values of SCAN.raw are a guess.");
  EXPECT_EQ(notesOf("g.mhd does not say how large its voxels are; 1 mm is a guess.", "g.mhd"),
            "SCAN does not say how large its voxels are; 1 mm is a guess.");
  EXPECT_EQ(notesOf("a.mhd: 1 mm is a guess.", "a.mhd"), "SCAN: 1 mm is a guess.");
  EXPECT_EQ(notesOf("JD holds 24 pictures, not JD.raw.", "/data/JD"), "SCAN holds 24 pictures, not SCAN.raw.")
    << "initials";
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

TEST(MeasureTable, SaysTheMainMeasuresInALine)
{
  rhombic::MeshedSurface surface;
  surface.scene.name = "liver";
  surface.measures.volume = 1234560.0;
  surface.measures.area = 45670.0;
  surface.measures.longestDiameter = 200.04;
  EXPECT_EQ(rhombic::SummarizeMeasures(surface), "liver: 1234.6 ml, 456.7 cm2, longest diameter 200.0 mm");
  surface.measures.voxelVolume = 1234000.0;
  surface.measures.meanValue = 55.58;
  surface.measures.isosurface = rhombic::IsosurfaceVolume{ 1200000.0, 3000.0 };
  EXPECT_EQ(rhombic::SummarizeMeasures(surface),
            "liver: 1234.6 ml, 2.9 % more than the scan's isosurface encloses (1200.0 +- 3.0 ml), voxels 1234.0 ml, "
            "456.7 cm2, longest diameter 200.0 mm, mean value 55.6");
}

} // namespace
