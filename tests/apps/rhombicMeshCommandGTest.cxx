#include "rhombicNIfTITestFile.h"
#include "rhombicProgram.h"
#include "rhombicSurfaceIO.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

const std::string scan = RHOMBIC_TESTDATA "/phantom/dicom";
const std::string labels = RHOMBIC_TESTDATA "/phantom/phantom-labels.nii.gz";

class MeshCommand : public testing::Test
{
protected:
  Outcome
  Mesh(const std::string & arguments) const
  {
    return RunShell("rhombic mesh " + scan + " " + arguments, m_Folder.Path());
  }

  std::vector<rhombic::SceneSurface>
  Read(const std::string & file) const
  {
    return rhombic::ReadSurfaces(m_Folder.Path() / file);
  }

  nlohmann::json
  Sidecar(const std::string & file) const
  {
    return nlohmann::json::parse(ReadText(m_Folder.Path() / (file + ".json")));
  }

  TemporaryFolder m_Folder;
};

TEST_F(MeshCommand, ScenesHoldTheSurfacesOfAPreset)
{
  for (const std::string extension : { "glb", "vtp", "ply", "obj", "3mf" })
  {
    ASSERT_EQ(this->Mesh("--preset ct-bone-skin -o scene." + extension).exitCode, 0) << extension;
    const auto scene = this->Read("scene." + extension);
    ASSERT_EQ(scene.size(), 2u) << extension;
    EXPECT_EQ(scene[0].name, "bone") << extension;
    EXPECT_EQ(scene[1].name, "skin") << extension;
    EXPECT_NEAR(scene[1].opacity, 0.25, 0.01) << extension;
    EXPECT_GT(ComputeTriangleSurfaceVolume(*scene[1].surface), ComputeTriangleSurfaceVolume(*scene[0].surface))
      << extension;
  }
}

TEST_F(MeshCommand, FilesOfBareVoxelsGiveTheMeshOfAHeaderThatSaysTheSame)
{
  std::ofstream volume(m_Folder.Path() / "volume.raw", std::ios::binary);
  for (int n = 0; n < 20 * 20 * 20; ++n)
  {
    const int x = n % 20 - 9, y = n / 20 % 20 - 10, z = n / 400 - 10;
    const int value = 5000 - 100 * (x * x + y * y + z * z);
    volume.put(static_cast<char>(value & 255)).put(static_cast<char>(value >> 8 & 255)); // int16, little-endian
  }
  volume.close();
  std::ofstream(m_Folder.Path() / "volume.mhd")
    << "ObjectType = Image\nNDims = 3\nDimSize = 20 20 20\nElementSpacing = 0.005 0.005 0.01\nElementType = MET_SHORT\n"
       "BinaryDataByteOrderMSB = False\nElementDataFile = volume.raw\n";
  const auto outcome =
    RunShell("rhombic -q mesh volume.mhd -t 0.5 -o header.ply\n"
             "rhombic -q mesh volume.raw --raw 20x20x20,int16,le --voxel-size 5um,5um,0.01 -t 0.5 -o bare.ply\n"
             "cmp header.ply bare.ply\n"
             "test $(grep -c int16,le bare.ply.json) -gt 0",
             m_Folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.output << outcome.errors;
}

TEST_F(MeshCommand, TheReportTellsWhatIsLeftOutOfTheLungs)
{
  ASSERT_EQ(this->Mesh("--preset ct-lung -o lungs.stl").exitCode, 0);
  ASSERT_EQ(this->Mesh("--surface 'air=<-500.5' -o air.stl").exitCode, 0);
  const auto volumeOf = [](const nlohmann::json & surface) { return surface["measures"]["volume_ml"].get<double>(); };
  const nlohmann::json lungs = this->Sidecar("lungs.stl")["surfaces"][0];
  const nlohmann::json air = this->Sidecar("air.stl")["surfaces"][0];
  const auto around = lungs["enclosed"]["leftOutAroundBodyInMillilitres"].get<double>();
  const auto small = lungs["enclosed"]["leftOutSmallPartsInMillilitres"].get<double>();
  EXPECT_GT(around, volumeOf(lungs));
  EXPECT_NEAR(volumeOf(lungs) + around + small, volumeOf(air), 0.001 * volumeOf(air));
  EXPECT_EQ(lungs["enclosed"]["keptPartsCutBySides"], 0);
  EXPECT_FALSE(air.contains("enclosed"));
}

TEST_F(MeshCommand, NamesInBracesMakeAFileForEach)
{
  ASSERT_EQ(
    this->Mesh("--surface bone=375.5 --surface 'soft parts=-300.5' --surface bone=500.5 -o 'a-{name}.stl'").exitCode,
    0);
  std::set<std::string> names;
  for (const auto & entry : fs::directory_iterator(m_Folder.Path()))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{ "a-bone.stl",
                                    "a-bone.stl.json",
                                    "a-soft_parts.stl",
                                    "a-soft_parts.stl.json",
                                    "a-bone-2.stl",
                                    "a-bone-2.stl.json" }));
  EXPECT_EQ(this->Sidecar("a-bone-2.stl")["surfaces"][0]["measures"]["isovalue_scan_unit"], 500.5);
  ASSERT_EQ(this->Mesh("--surface 'M\xc3\xbcller=375.5' -o '{name}-{name}.stl'").exitCode, 0);
  EXPECT_TRUE(fs::exists(m_Folder.Path() / "M_ller-M_ller.stl"));
}

TEST_F(MeshCommand, RASIsTheSamePlaceInOtherAxes)
{
  ASSERT_EQ(this->Mesh("-t 375.5 -o lps.ply").exitCode, 0);
  ASSERT_EQ(this->Mesh("-t 375.5 --space ras -o ras.ply").exitCode, 0);
  EXPECT_NE(ReadText(m_Folder.Path() / "lps.ply").find("SPACE=LPS"), std::string::npos);
  EXPECT_NE(ReadText(m_Folder.Path() / "ras.ply").find("SPACE=RAS"), std::string::npos);
  EXPECT_TRUE(this->Read("lps.ply")[0].surface->GetPoints() == this->Read("ras.ply")[0].surface->GetPoints());
}

TEST_F(MeshCommand, LabelsBecomeClosedSurfacesOfTheirVolume)
{
  ASSERT_EQ(this->Mesh("--labels " + labels + " --label 10 --label 14 -o organs.glb").exitCode, 0);
  const auto organs = this->Read("organs.glb");
  ASSERT_EQ(organs.size(), 2u);
  constexpr double millilitres[] = { 1446.91, 456.192 }; // brain, left lung: their voxels
  for (std::size_t n = 0; n < 2; ++n)
  {
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*organs[n].surface).IsWatertight());
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*organs[n].surface) / 1000.0 / millilitres[n], 1.0, 0.01);
  }
  const auto report = this->Sidecar("organs.glb")["surfaces"];
  EXPECT_TRUE(report[0]["measures"]["mean_scan_unit"].is_number()) << "of the scan inside the label";
}

TEST_F(MeshCommand, MeasuresAreATable)
{
  ASSERT_EQ(this->Mesh("-t -485.5 -o skin.ply --measures table.csv").exitCode, 0);
  const std::string table = ReadText(m_Folder.Path() / "table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2);
  EXPECT_NE(table.find("volume_ml"), std::string::npos);
  const auto line = table.substr(table.find('\n') + 1);
  EXPECT_EQ(std::count(line.begin(), line.end(), ','),
            std::count(table.begin(), table.end() - static_cast<std::ptrdiff_t>(line.size()), ','));
  const auto measures = this->Sidecar("skin.ply")["surfaces"][0]["measures"];
  const double volume = measures["volume_ml"];
  EXPECT_NEAR(volume, ComputeTriangleSurfaceVolume(*this->Read("skin.ply")[0].surface) / 1000.0, 1e-3 * volume);
  EXPECT_NEAR(measures["voxel_volume_ml"].get<double>() / volume, 1.0, 0.01);
  EXPECT_NEAR(measures["isosurface_volume_ml"].get<double>() / volume, 1.0, 0.01);
  EXPECT_LT(std::abs(measures["volume_error_percent"].get<double>()), 1.0);
}

TEST_F(MeshCommand, SimplificationStaysWithinItsError)
{
  const Outcome outcome = this->Mesh("-t 375.5 --max-error 0.5 --audit --require-watertight -o small.stl");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto report = this->Sidecar("small.stl")["surfaces"][0];
  EXPECT_LT(report["simplification"]["trianglesAfter"].get<int>(),
            report["simplification"]["trianglesBefore"].get<int>());
  EXPECT_LE(report["simplification"]["maximumDistanceInMillimetres"].get<double>(), 0.5 + 1e-6);
  EXPECT_TRUE(report["audit"]["watertight"].get<bool>());
  EXPECT_GT(report["audit"]["intersections"]["testedTriangles"].get<int>(), 0);
  EXPECT_GT(report["deviation"]["samples"].get<int>(), 100);

  ASSERT_EQ(this->Mesh("-t 375.5 --max-triangles 50% -o half.stl").exitCode, 0);
  const auto half = this->Sidecar("half.stl")["surfaces"][0]["simplification"];
  EXPECT_LE(half["trianglesAfter"].get<int>(), half["trianglesBefore"].get<int>() / 2 + 1);
}

TEST_F(MeshCommand, SmallPartsGoAndSmoothingIsBounded)
{
  const auto outcome = this->Mesh("-t -300.5 --largest --fill --smooth 0.3 -o one.ply");
  ASSERT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.errors.find("smoothing moved points by"), std::string::npos) << outcome.errors;
  const auto topology = ComputeTriangleSurfaceTopology(*this->Read("one.ply")[0].surface);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_TRUE(topology.IsWatertight());
  const auto report = this->Sidecar("one.ply")["surfaces"][0];
  EXPECT_GT(report["parts"]["filled"]["cavities"].get<int>(), 0);
  EXPECT_GT(report["parts"]["filled"]["volumeChangeInMillilitres"].get<double>(), 0.0);
  EXPECT_NE(outcome.errors.find("leave out --fill to measure it"), std::string::npos) << outcome.errors;
  EXPECT_LE(report["smoothing"]["largestMoveInMillimetres"].get<double>(),
            report["smoothing"]["maximumMoveInMillimetres"].get<double>());
  EXPECT_EQ(this->Mesh("-t 375.5 --min-volume 1e6 -o none.ply").exitCode, 6);
  EXPECT_FALSE(fs::exists(m_Folder.Path() / "none.ply"));
}

TEST_F(MeshCommand, AuditJudgesFilesOfOthers)
{
  std::ofstream(m_Folder.Path() / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  std::ofstream(m_Folder.Path() / "closed.obj")
    << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto audit = [&](const std::string & arguments) {
    return RunShell("rhombic audit " + arguments, m_Folder.Path());
  };
  EXPECT_EQ(audit("closed.obj").exitCode, 0);
  const Outcome leaking = audit("closed.obj open.obj");
  EXPECT_EQ(leaking.exitCode, 8);
  EXPECT_NE(leaking.errors.find("3 boundary edges"), std::string::npos) << leaking.errors;
  EXPECT_EQ(audit("open.obj --require-watertight").exitCode, 8) << "of earlier scripts";
  const Outcome leakingReport = audit("open.obj --json");
  EXPECT_EQ(leakingReport.exitCode, 8);
  EXPECT_FALSE(nlohmann::json::parse(leakingReport.output)[0]["watertight"].get<bool>());
  std::ofstream(m_Folder.Path() / "loose.obj")
    << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\nf 4 5 6\n";
  EXPECT_NE(audit("loose.obj").output.find("2 points lie where another one does"), std::string::npos);
  std::ofstream(m_Folder.Path() / "nowhere.obj") << "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n";
  const Outcome nowhere = audit("nowhere.obj");
  EXPECT_NE((nowhere.output + nowhere.errors).find("NaN"), std::string::npos) << nowhere.output << nowhere.errors;
  const auto report = nlohmann::json::parse(audit("closed.obj --json").output);
  EXPECT_EQ(report[0]["misfacingShells"], 0);
  EXPECT_EQ(report[0]["eulerCharacteristic"], 2);
  EXPECT_TRUE(report[0]["watertight"].get<bool>());
}

TEST_F(MeshCommand, CrossingsAreNoHoles)
{
  std::ofstream(m_Folder.Path() / "crossing.obj")
    << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
       "v .1 .1 .1\nv 1.1 .1 .1\nv .1 1.1 .1\nv .1 .1 1.1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  const Outcome outcome = RunShell("rhombic audit crossing.obj --json", m_Folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_TRUE(report[0]["watertight"].get<bool>());
  EXPECT_GT(report[0]["intersections"]["crossingPairs"].get<int>(), 0);
}

/** Two half boxes that share a wall, from the probabilities of both in one file. */
TEST_F(MeshCommand, ProbabilitiesBecomeSurfacesThatShareWalls)
{
  NIfTITestFile file;
  file.dimensions = { 4, 20, 12, 10, 2, 1, 1, 1 };
  file.datatype = 16;
  file.bits = 32;
  std::vector<float> values;
  for (const bool isRight : { false, true })
  {
    for (int n = 0; n < 20 * 12 * 10; ++n)
    {
      const float right = std::clamp(0.5f + 0.2f * (static_cast<float>(n % 20) - 8.3f), 0.0f, 1.0f);
      values.push_back(isRight ? right : 1.0f - right);
    }
  }
  file.voxels = file.Values(values);
  std::ofstream(m_Folder.Path() / "soft.nii", std::ios::binary) << file.Bytes();
  const auto run = [&](const std::string & arguments) {
    return RunShell("rhombic mesh soft.nii --frame 0 --probabilities soft.nii " + arguments, m_Folder.Path());
  };
  ASSERT_EQ(run("-o both.vtp --audit --require-watertight").exitCode, 0);
  const auto walls = this->Sidecar("both.vtp")["walls"];
  EXPECT_TRUE(walls["sound"].get<bool>());
  EXPECT_GT(walls["sharedTriangles"].get<int>(), 100);
  EXPECT_EQ(walls["crossingPairs"], 0);
  const auto both = this->Read("both.vtp");
  ASSERT_EQ(both.size(), 2u);
  const double widths[2] = { 8.8, 11.2 };
  for (std::size_t n = 0; n < 2; ++n)
  {
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*both[n].surface).IsWatertight());
    EXPECT_NEAR(
      ComputeTriangleSurfaceVolume(*both[n].surface), widths[n] * 12.0 * 10.0, 0.02 * widths[n] * 12.0 * 10.0);
  }
  ASSERT_EQ(run("--label 2 -o right.stl").exitCode, 0);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*this->Read("right.stl")[0].surface),
              ComputeTriangleSurfaceVolume(*both[1].surface),
              0.1);
  EXPECT_EQ(run("--labels soft.nii -o x.vtp").exitCode, 2) << "one of the two";
  file.voxels = file.Values(std::vector<float>(values.size(), 0.3f));
  std::ofstream(m_Folder.Path() / "low.nii", std::ios::binary) << file.Bytes();
  const auto low = RunShell("rhombic mesh soft.nii --frame 0 --probabilities low.nii -o x.vtp", m_Folder.Path());
  EXPECT_EQ(low.exitCode, 6) << low.errors;
  EXPECT_EQ(run("-o soft.nii").exitCode, 2);
}

TEST_F(MeshCommand, NumbersOutOfRangeAreNamedInAShortSentence)
{
  for (const auto & [arguments, sentence] :
       std::vector<std::pair<std::string, std::string>>{ { "--spacing 0", "--spacing: '0' is not a number above 0" },
                                                         { "--spacing x", "--spacing: 'x' is not a number above 0" },
                                                         { "--frame -1", "--frame: '-1' is not a number from 0 on" } })
  {
    const auto outcome = this->Mesh(arguments + " -t 375.5 -o x.stl");
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << outcome.errors;
  }
}

TEST_F(MeshCommand, OutputsTakeNobodysPlace)
{
  const fs::path table = m_Folder.Path() / "table.csv";
  fs::copy_file(RHOMBIC_TESTDATA "/phantom/phantom-labels.tsv", table);
  fs::copy_file(table, m_Folder.Path() / "same.mtl");
  fs::copy_file(table, m_Folder.Path() / "other.obj.json");
  const std::string before = ReadText(table);
  for (const std::string & arguments :
       std::vector<std::string>{ "--labels " + labels + " --label-table table.csv -o h.ply --measures table.csv",
                                 "--labels " + labels + " --label-table same.mtl -o same.obj",
                                 "--labels " + labels + " --label-table other.obj.json -o other.obj",
                                 "-t 375.5 -o x.stl --measures x.stl.json",
                                 "-t 375.5 -o x.stl --measures ./x.stl.json" })
  {
    const auto outcome = this->Mesh(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_TRUE(outcome.errors.find("another name") != std::string::npos) << outcome.errors;
  }
  fs::copy_file(table, m_Folder.Path() / "p.png.json");
  const auto rendered =
    RunShell("rhombic render " + scan + " --labels " + labels + " --label-table p.png.json -o p.png", m_Folder.Path());
  EXPECT_EQ(rendered.exitCode, 2) << rendered.errors;
  for (const char * const kept : { "table.csv", "same.mtl", "other.obj.json", "p.png.json" })
  {
    EXPECT_EQ(ReadText(m_Folder.Path() / kept), before) << kept;
  }
}

TEST_F(MeshCommand, OneLabelFitsIntoAnSTL)
{
  ASSERT_EQ(this->Mesh("--labels " + labels + " --label 14 -o lung.stl --measures lung.csv").exitCode, 0);
  EXPECT_EQ(this->Read("lung.stl").size(), 1u);
  EXPECT_NE(ReadText(m_Folder.Path() / "lung.csv").find(",456.19"), std::string::npos) << "the voxels' volume";
  EXPECT_EQ(this->Mesh("--labels " + labels + " --label 14 --label 10 -o two.stl").exitCode, 2);
  EXPECT_EQ(this->Mesh("--labels nothing.nii.gz -o one.stl").exitCode, 3) << "no such file";
}

TEST_F(MeshCommand, IsosurfaceVolumeIsOfTheScanOrUnknown)
{
  const auto measuresOf = [this](const std::string & options) {
    const auto outcome = this->Mesh("-t 375.5 " + options + " -o bone.stl");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    return this->Sidecar("bone.stl")["surfaces"][0]["measures"];
  };
  const auto plain = measuresOf("");
  EXPECT_EQ(plain["volume_error_reference"], "isosurface");
  EXPECT_GT(plain["isosurface_uncertainty_ml"].get<double>(), 0.0);
  for (const char * const options : { "--nested", "--density 0.5", "--denoise gaussian:4" })
  {
    const auto measures = measuresOf(options);
    EXPECT_FALSE(measures.contains("isosurface_volume_ml")) << options;
    EXPECT_EQ(measures["volume_error_reference"], "voxels") << options;
  }
  const auto dense = this->Mesh("-t 375.5 --spacing 6 -o bone.stl");
  EXPECT_EQ(dense.errors.find("try --density"), std::string::npos) << "has no effect beside --spacing";
}

TEST_F(MeshCommand, ALabelTableMakesNoLabelMapOfACT)
{
  std::ofstream(m_Folder.Path() / "table.txt") << "1 255 0 0 1 1 1 \"a\"\n";
  const auto outcome = this->Mesh("--label-table table.txt -o a.stl");
  EXPECT_EQ(outcome.exitCode, 2) << outcome.errors;
}

/** VTK reads these files, in a child process of the program that draws. */
TEST_F(MeshCommand, AuditsOfVTPFilesAreThoseOfPLYFiles)
{
  const auto audit = [this](const std::string & file) {
    return RunShell("rhombic audit --json " + file, m_Folder.Path());
  };
  ASSERT_EQ(this->Mesh("-t 375.5 -o same.ply").exitCode, 0);
  ASSERT_EQ(this->Mesh("-t 375.5 -o same.VTP").exitCode, 0);
  const Outcome outcome = audit("same.VTP");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, audit("same.ply").output);

  fs::resize_file(m_Folder.Path() / "same.VTP", fs::file_size(m_Folder.Path() / "same.VTP") / 2);
  const Outcome cut = audit("same.VTP");
  EXPECT_EQ(cut.exitCode, 4);
  EXPECT_EQ(cut.errors.find("rhombic: Cannot read same.VTP: "), 0u) << cut.errors;
  EXPECT_EQ(std::count(cut.errors.begin(), cut.errors.end(), '\n'), 1) << cut.errors;
  EXPECT_EQ(audit("nowhere.vtp").exitCode, 3);
}

TEST_F(MeshCommand, AuditTellsSolidsFromCavities)
{
  const auto outcome = this->Mesh("-t -300.5 --largest --audit -o body.stl");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto audit = this->Sidecar("body.stl")["surfaces"][0]["audit"];
  EXPECT_EQ(audit["solids"], 1);
  EXPECT_EQ(audit["cavities"].get<int>(), audit["components"].get<int>() - 1);
  EXPECT_GT(audit["cavities"].get<int>(), 0) << "lungs and airways";
  EXPECT_NE(outcome.errors.find("1 solid with "), std::string::npos) << outcome.errors;
}

/** The second file does not fit: the first one must not stay, and older files must. */
TEST_F(MeshCommand, AllFilesOfACommandAppearOrNone)
{
  std::ofstream(m_Folder.Path() / "a-small.stl") << "older";
  const auto outcome = RunShell("ulimit -f 500; rhombic mesh " + scan +
                                  " --surface small=1200 --surface large=-300.5 -o 'a-{name}.stl' --measures a.csv",
                                m_Folder.Path());
  EXPECT_EQ(outcome.exitCode, 7) << outcome.errors;
  EXPECT_TRUE(ReadText(m_Folder.Path() / "a-small.stl") == "older");
  EXPECT_EQ(std::distance(fs::directory_iterator(m_Folder.Path()), fs::directory_iterator()), 1);
  ASSERT_EQ(this->Mesh("--surface small=1200 --surface large=-300.5 -o 'b-{name}.stl'").exitCode, 0);
  EXPECT_LT(fs::file_size(m_Folder.Path() / "b-small.stl"), 500u * 1024u) << "the limit is reached by the second file";
  EXPECT_GT(fs::file_size(m_Folder.Path() / "b-large.stl"), 500u * 1024u);
}

TEST_F(MeshCommand, AllPicturesOfACommandAppearOrNone)
{
  const std::string render = "rhombic render " + scan + " --preset ct-bone --view all --size 300 -o a.png";
  ASSERT_EQ(RunShell(render, m_Folder.Path()).exitCode, 0);
  std::uintmax_t largest = 0;
  for (const auto & entry : fs::directory_iterator(m_Folder.Path()))
  {
    largest = entry.path().extension() == ".png" ? std::max(largest, fs::file_size(entry.path())) : largest;
  }
  const std::uintmax_t limit = largest / 1024; // KiB
  ASSERT_LT(fs::file_size(m_Folder.Path() / "a-anterior.png"), limit * 1024) << "the first one fits";
  TemporaryFolder empty;
  const auto outcome = RunShell("ulimit -f " + std::to_string(limit) + "; " + render, empty.Path());
  EXPECT_EQ(outcome.exitCode, 7) << outcome.errors;
  EXPECT_TRUE(fs::is_empty(empty.Path()));
}

TEST_F(MeshCommand, WhatIsTooSmallIsLeftOut)
{
  const auto outcome = this->Mesh("--labels " + labels + " --label 10 --label 14 --min-volume 1000 -o large.glb");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(this->Read("large.glb").size(), 1u);
  EXPECT_EQ(this->Mesh("--labels " + labels + " --label 10 --label 14 --min-volume 9000 -o none.glb").exitCode, 6);
}

TEST_F(MeshCommand, OptionsThatRemoveNothingHideNothing)
{
  ASSERT_EQ(this->Mesh("-t -300.5 -o a.stl").exitCode, 0);
  ASSERT_EQ(this->Mesh("-t -300.5 --min-volume 0.000001 -o b.stl").exitCode, 0);
  EXPECT_EQ(this->Sidecar("a.stl")["surfaces"][0]["measures"], this->Sidecar("b.stl")["surfaces"][0]["measures"]);
}

TEST_F(MeshCommand, SmoothedAndSimplifiedSurfacesDoNotCrossThemselves)
{
  const auto outcome = this->Mesh("-t 500 --smooth 0.3 --max-error 1 --audit -o thin.ply");
  ASSERT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(this->Sidecar("thin.ply")["surfaces"][0]["audit"]["intersections"]["crossingPairs"], 0);
}

TEST_F(MeshCommand, NothingMeasuredIsNotZero)
{
  ASSERT_EQ(this->Mesh("-t '<-500.5' --fill --largest -o box.stl").exitCode, 0);
  const auto box = this->Sidecar("box.stl")["surfaces"][0];
  EXPECT_EQ(box["deviation"]["samples"], 0);
  EXPECT_FALSE(box["measures"].contains("deviation_mean_mm"));
}

TEST_F(MeshCommand, LabelsShareTheirWalls)
{
  ASSERT_EQ(RunShell("rhombic -q phantom --spacing 10 -o coarse", m_Folder.Path()).exitCode, 0);
  const auto mesh = [this](const std::string & options) {
    return RunShell("rhombic mesh coarse/phantom-labels.nii.gz " + options, m_Folder.Path());
  };
  ASSERT_EQ(mesh("--max-triangles 30% -o '{name}.stl'").exitCode, 0);
  ASSERT_EQ(mesh("-o walls.vtp").exitCode, 0);
  for (const std::string files : { "*.stl", "walls.vtp" })
  {
    const Outcome audit = RunShell("rhombic audit " + files, m_Folder.Path());
    EXPECT_EQ(audit.exitCode, 0) << audit.errors;
    const auto together = audit.output.find("all surfaces together");
    ASSERT_NE(together, std::string::npos) << audit.output;
    const std::string all = audit.output.substr(together);
    EXPECT_GT(std::atoi(all.c_str() + all.find('\n')), 500) << all;
    EXPECT_NE(all.find("; 0 have one surface on both sides, 0 are there twice; 0 edges "), std::string::npos) << all;
    EXPECT_NE(all.find("; 0 pairs of triangles cross"), std::string::npos) << all;
    EXPECT_EQ(audit.output.find("not watertight"), std::string::npos) << audit.output;
  }
}

TEST_F(MeshCommand, TellsWhatItCannotDo)
{
  const std::pair<const char *, int> cases[] = { { "--preset ct-bone-skin -o two.stl", 2 },
                                                 { "-t 375.5 -o a.stl --max-triangles none", 2 },
                                                 { "-t 375.5 -o a.stl --max-triangles 120%", 2 },
                                                 { "-t 375.5 -o a.stl --max-error -1", 2 },
                                                 { "-t 375.5 -o a.stl --smooth 2", 2 },
                                                 { "-t 375.5 -o a.stl --space mars", 2 },
                                                 { "-t 375.5 -o a.stl --measures a.txt", 2 },
                                                 { "-t 375.5 -o a.stl --label heart", 2 },
                                                 { "-o a.stl", 2 },
                                                 { "-t 375.5 -o missing/a-{name}.stl", 7 } };
  for (const auto & [arguments, exitCode] : cases)
  {
    EXPECT_EQ(this->Mesh(arguments).exitCode, exitCode) << arguments;
    EXPECT_TRUE(fs::is_empty(m_Folder.Path())) << arguments;
  }
}

} // namespace
