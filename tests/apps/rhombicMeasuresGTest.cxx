// The measures that `rhombic mesh` writes are those of the file, as other programs read it.

#include "rhombicProgram.h"
#include "rhombicReadersOfOthers.h"

#include <nlohmann/json.hpp>

#include <vtkCell.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <map>

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

const std::string scan = RHOMBIC_TESTDATA "/phantom/dicom";

/** The one line of a table of measures, by column. */
std::map<std::string, std::string>
ReadRow(const std::filesystem::path & path)
{
  std::ifstream file(path);
  std::string heads, fields, head, field;
  std::getline(file, heads);
  std::getline(file, fields);
  std::istringstream headStream(heads), fieldStream(fields);
  std::map<std::string, std::string> row;
  while (std::getline(headStream, head, ',') && std::getline(fieldStream, field, ','))
  {
    row[head] = field;
  }
  return row;
}

struct Measures
{
  double volume = 0.0; ///< ml
  double area = 0.0;   ///< mm2
  vtkIdType triangles = 0;
};

/** \param unit of the file's coordinates in mm */
Measures
Measure(vtkPolyData & surface, double unit)
{
  Measures measures;
  measures.triangles = surface.GetNumberOfCells();
  for (vtkIdType n = 0; n < measures.triangles; ++n)
  {
    double corners[3][3];
    for (int corner = 0; corner < 3; ++corner)
    {
      surface.GetCell(n)->GetPoints()->GetPoint(corner, corners[corner]);
    }
    const auto & [a, b, c] = corners;
    const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
    const double v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
    const double normal[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    measures.area += 0.5 * unit * unit * std::hypot(normal[0], normal[1], normal[2]);
    measures.volume += unit * unit * unit * (a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]) / 6000.0;
  }
  return measures;
}

class MeasuresOfFiles : public testing::Test
{
protected:
  /** Meshes the phantom's body, and compares what is reported with what the file holds. */
  void
  Check(const std::string & extension, const std::string & options) const
  {
    SCOPED_TRACE(extension + " " + options);
    const auto mesh = m_Folder.Path() / ("body" + extension);
    const Outcome outcome =
      RunShell("rhombic mesh " + scan + " -t -300.5 " + options + " --measures body.csv -o " + mesh.filename().string(),
               m_Folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const Measures file = Measure(*rhombictest::ReadWithVTK(mesh), extension == ".glb" ? 1000.0 : 1.0);
    auto row = ReadRow(m_Folder.Path() / "body.csv");
    EXPECT_NEAR(std::stod(row["volume_ml"]), file.volume, 2e-6 * file.volume);
    EXPECT_NEAR(std::stod(row["area_mm2"]), file.area, 2e-6 * file.area);
    EXPECT_EQ(std::stol(row["triangles"]), file.triangles);
    EXPECT_NEAR(std::stod(row["extracted_volume_ml"]), extracted.volume, 2e-6 * extracted.volume);
    EXPECT_NEAR(std::stod(row["extracted_area_mm2"]), extracted.area, 2e-6 * extracted.area);
    EXPECT_EQ(std::stol(row["extracted_triangles"]), extracted.triangles);
    EXPECT_NEAR(
      std::stod(row["finishing_volume_change_percent"]), 100.0 * (file.volume / extracted.volume - 1.0), 1e-3);
    const auto report = nlohmann::json::parse(ReadText(mesh.string() + ".json"))["surfaces"][0];
    EXPECT_NEAR(report["measures"]["volume_ml"].get<double>(), file.volume, 2e-6 * file.volume);
    EXPECT_EQ(report["measures"]["triangles"].get<vtkIdType>(), file.triangles);
    std::ostringstream printed;
    printed << std::fixed << std::setprecision(1) << "surface: " << std::stod(row["volume_ml"]) << " ml";
    EXPECT_NE(outcome.errors.find(printed.str()), std::string::npos) << printed.str() << "\n" << outcome.errors;
    const bool isChanged = std::abs(file.volume / extracted.volume - 1.0) > 0.01;
    const bool isSaid = outcome.errors.find("changed the volume by") != std::string::npos ||
                        outcome.errors.find(" inside the surface and added ") != std::string::npos ||
                        outcome.errors.find("% of the volume)") != std::string::npos;
    EXPECT_TRUE(isSaid || !isChanged) << outcome.errors;
  }

  void
  SetUp() override
  {
    const Outcome outcome = RunShell("rhombic mesh " + scan + " -t -300.5 -o extracted.stl", m_Folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    extracted = Measure(*rhombictest::ReadWithVTK(m_Folder.Path() / "extracted.stl"), 1.0);
  }

  TemporaryFolder m_Folder;
  Measures extracted;
};

TEST_F(MeasuresOfFiles, AreThoseOfEveryFormat)
{
  for (const char * const extension : { ".stl", ".ply", ".obj", ".vtp", ".glb" })
  {
    this->Check(extension, "--smooth 0.3 --max-triangles 10%");
  }
}

TEST_F(MeasuresOfFiles, AreThoseAfterEveryFinishingOption)
{
  for (const char * const options : { "",
                                      "--min-volume 1",
                                      "--largest",
                                      "--fill",
                                      "--smooth 0.3",
                                      "--max-triangles 10%",
                                      "--max-error 0.5",
                                      "--largest --fill --smooth 0.3 --max-error 1" })
  {
    this->Check(".stl", options);
  }
}

TEST(Measures, AreTheSameOfAPageAndAMesh)
{
  const TemporaryFolder folder;
  const std::string labels = RHOMBIC_TESTDATA "/phantom/phantom-labels.nii.gz";
  const std::string options = " " + scan + " --labels " + labels + " --label 10 --label 14 ";
  const Outcome mesh = RunShell("rhombic mesh" + options + "-o a.ply --measures a.csv", folder.Path());
  ASSERT_EQ(mesh.exitCode, 0) << mesh.errors;
  const Outcome page = RunShell("rhombic render" + options + "--sheet --dpi 40 -o page.png", folder.Path());
  ASSERT_EQ(page.exitCode, 0) << page.errors;
  const auto ofMesh = nlohmann::json::parse(ReadText(folder.Path() / "a.ply.json"))["surfaces"];
  const auto ofPage = nlohmann::json::parse(ReadText(folder.Path() / "page.png.json"))["surfaces"];
  ASSERT_EQ(ofMesh.size(), 2u);
  EXPECT_EQ(ofPage.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n)
  {
    EXPECT_EQ(ofMesh[n]["measures"], ofPage[n]["measures"]);
    for (const char * const measure :
         { "volume_ml", "area_mm2", "mean_scan_unit", "voxel_volume_ml", "extracted_area_mm2" })
    {
      EXPECT_TRUE(ofPage[n]["measures"][measure].is_number()) << measure;
    }
  }
  EXPECT_EQ(std::stod(ReadRow(folder.Path() / "a.csv")["area_mm2"]), ofPage[0]["measures"]["area_mm2"].get<double>());
}

TEST(Measures, AReportNamesItsInputByItsContents)
{
  const TemporaryFolder folder;
  const std::string phantom = RHOMBIC_TESTDATA "/phantom";
  const std::string labels = phantom + "/phantom-labels.nii.gz";
  for (const auto & [command, output, files] :
       { std::tuple<std::string, std::string, std::string>{
           "mesh " + scan + " -t 250.5 -o", "a.stl", phantom + "/dicom/*.dcm" },
         { "mesh " + phantom + "/phantom.nii.gz --labels " + labels + " --label liver -o",
           "b.stl",
           phantom + "/phantom.nii.gz " + labels },
         { "mesh " + labels + " --label liver -o", "c.stl", labels },
         { "resample " + scan + " -o", "d.fcc.nrrd", phantom + "/dicom/*.dcm" },
         { "mesh d.fcc.nrrd -t 250.5 -o", "e.stl", "d.fcc.nrrd" },
         { "resample d.fcc.nrrd -o", "f.nii", "d.fcc.nrrd" } })
  {
    const Outcome outcome =
      RunShell("rhombic -q " + command + " " + output + "; cat " + files + " | md5sum", folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto report = nlohmann::json::parse(ReadText(folder.Path() / (output + ".json")));
    EXPECT_EQ(report["input"]["md5"], outcome.output.substr(0, 32)) << command;
  }
}

} // namespace
