#include "rhombicPictureIO.h"
#include "rhombicProgram.h"

#include "itkEuler3DTransform.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

/** The programs of apps/examples, on a phantom whose volumes are known. */
namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;

const std::string phantom = RHOMBIC_TESTDATA "/phantom";

/** Runs an example in a new folder. */
class Examples : public testing::Test
{
protected:
  std::string
  Run(const std::string & commandLine) const
  {
    const Outcome outcome = rhombictest::RunShell(commandLine, m_Folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << commandLine << "\n" << outcome.errors;
    return outcome.output;
  }

  rhombictest::TemporaryFolder m_Folder;
};

/** The numbers behind "name:" in what a program said. */
std::vector<double>
Figures(const std::string & output, const std::string & name)
{
  std::istringstream line(output.substr(output.find(name + ": ") + name.size() + 2));
  std::vector<double> figures;
  for (double figure; line >> figure;)
  {
    figures.push_back(figure);
  }
  if (figures.empty())
  {
    throw std::runtime_error("no " + name + " in " + output);
  }
  return figures;
}

/** The organs' exact volumes in ml, by name. */
std::map<std::string, double>
OrganVolumes()
{
  std::map<std::string, double> volumes;
  std::ifstream table(phantom + "/phantom-organs.csv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line))
  {
    std::istringstream cells(line);
    std::string name, label, hounsfield, volume;
    std::getline(cells, name, ',');
    std::getline(cells, label, ',');
    std::getline(cells, hounsfield, ',');
    std::getline(cells, volume, ',');
    volumes[name] = std::stod(volume);
  }
  return volumes;
}

/** What is inside the skin but neither lung nor airway. */
double
BodyVolume()
{
  double sum = 0.0;
  for (const auto & [name, volume] : OrganVolumes())
  {
    const bool isAir = name == "airway" || name == "left lung" || name == "right lung";
    sum += isAir ? 0.0 : volume;
  }
  return sum;
}

TEST_F(Examples, ResampleAndSaveMakesTheFileThatRhombicResampleMakes)
{
  const std::string output = Run("ResampleAndSave " + phantom + "/dicom example.fcc.nrrd");
  const double ratio = Figures(output, "sites").front() / Figures(output, "voxels").front();
  EXPECT_GT(ratio, 0.77);
  EXPECT_LT(ratio, 0.85) << "0.77, and what covers the border of a small scan";
  Run("rhombic -q resample " + phantom + "/dicom -o program.fcc.nrrd");
  EXPECT_TRUE(ReadText(m_Folder.Path() / "example.fcc.nrrd") == ReadText(m_Folder.Path() / "program.fcc.nrrd"));
}

TEST_F(Examples, ShrinkScanReadsEachFormatAndWritesNothingAboutThePatient)
{
  std::string voxels;
  for (const std::string & scan : { phantom + "/dicom", phantom + "/phantom.nii.gz" })
  {
    Run("ShrinkScan " + scan + " 4 small.mha");
    const std::string file = ReadText(m_Folder.Path() / "small.mha");
    const std::size_t end = file.find("ElementDataFile = LOCAL");
    ASSERT_NE(end, std::string::npos);
    const std::string header = file.substr(0, end);
    EXPECT_NE(header.find("ElementType = MET_SHORT"), std::string::npos) << header;
    EXPECT_EQ(header.find("0010|"), std::string::npos) << header;
    EXPECT_TRUE(voxels.empty() || file.substr(end) == voxels) << scan;
    voxels = file.substr(end);
  }
  const Outcome outcome = rhombictest::RunShell("ShrinkScan missing 4 small.mha", m_Folder.Path());
  EXPECT_EQ(outcome.exitCode, 1);
}

TEST_F(Examples, DrawInVTKDrawsTheSameOnBothSides)
{
  Run("DrawInVTK picture.png");
  const rhombic::Picture picture = rhombic::ReadPicture(m_Folder.Path() / "picture.png");
  ASSERT_EQ(picture.width, 800);
  int others = 0;
  int balls = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      const auto * const ours = picture.At(x, y);
      const auto * const theirs = picture.At(x + 400, y);
      others += std::abs(ours[0] - theirs[0]) + std::abs(ours[1] - theirs[1]) + std::abs(ours[2] - theirs[2]) > 12;
      balls += theirs[1] < 200;
    }
  }
  EXPECT_GT(balls, 30000);
  EXPECT_LT(others, 6000); // edges and cavities, which are smooth and dark on the left
}

TEST_F(Examples, SliceInSurfaceShowsSurfaceSliceAndAxes)
{
  Run("SliceInSurface " + phantom + "/dicom 300 picture.png");
  const rhombic::Picture picture = rhombic::ReadPicture(m_Folder.Path() / "picture.png");
  int bone = 0;
  int slice = 0;
  int axes = 0;
  for (std::size_t n = 0; n < picture.pixels.size(); n += static_cast<std::size_t>(picture.channels))
  {
    const int red = picture.pixels[n];
    const int green = picture.pixels[n + 1];
    const int blue = picture.pixels[n + 2];
    bone += red > green && green > blue && red - blue > 30 && green > 40;
    slice += red == green && green == blue && red > 100 && red < 180;
    axes += red > 150 && green < 60 && blue < 60;
  }
  EXPECT_GT(bone, 10000);
  EXPECT_GT(slice, 5000);
  EXPECT_GT(axes, 30);
}

TEST_F(Examples, SlicesAreWhereTheScanSaysOrRefused)
{
  const auto slices = m_Folder.Path() / "slices";
  std::filesystem::copy(phantom + "/dicom", slices);
  std::string first = ReadText(slices / "slice-0001.dcm");
  const std::size_t position = first.find("\\-10 ", first.find("-212\\-140"));
  ASSERT_NE(position, std::string::npos);
  std::ofstream(slices / "slice-0001.dcm", std::ios::binary) << first.replace(position, 5, "\\-13 ");
  Run("ResampleAndSave slices example.fcc.nrrd");
  Run("rhombic -q resample slices -o program.fcc.nrrd");
  EXPECT_TRUE(ReadText(m_Folder.Path() / "example.fcc.nrrd") == ReadText(m_Folder.Path() / "program.fcc.nrrd"));
  std::ofstream(m_Folder.Path() / "shift.tfm") << "#Insight Transform File V1.0\n#Transform 0\n"
                                                  "Transform: TranslationTransform_double_3_3\n"
                                                  "Parameters: 1 0 0\nFixedParameters:\n";
  for (const char * const commandLine : { "FromMarchingCubes slices 0",
                                          "SegmentationToSurface slices 72.4 2.3 294.8 2 lung.stl",
                                          "RegisteredScanToLattice slices slices shift.tfm moved.fcc.nrrd" })
  {
    const Outcome outcome = rhombictest::RunShell(commandLine, m_Folder.Path());
    EXPECT_EQ(outcome.exitCode, 1) << commandLine;
    EXPECT_NE(outcome.errors.find("no regular volume"), std::string::npos) << outcome.errors;
  }
}

TEST_F(Examples, ExtractAndMeasureFindsTheVolumeOfTheBody)
{
  // Half way between air and skin, where sampling and resampling leave the surface in its place.
  const std::string output = Run("ExtractAndMeasure " + phantom + "/dicom -485 body.stl");
  EXPECT_NEAR(Figures(output, "volume").front() / BodyVolume(), 1.0, 0.01);
  EXPECT_EQ(Figures(output, "watertight").front(), 1.0);
  EXPECT_GT(std::filesystem::file_size(m_Folder.Path() / "body.stl"), 100000u);
}

TEST_F(Examples, SegmentationToSurfaceFindsTheVolumeOfTheLung)
{
  const std::string output = Run("SegmentationToSurface " + phantom + "/phantom.nii.gz 72.4 2.3 294.8 2 lung.stl");
  const double volume = Figures(output, "volume").front();
  EXPECT_NEAR(volume / (Figures(output, "voxels").front() * 0.512), 1.0, 0.02) << "the surface keeps the mask's volume";
  EXPECT_NEAR(volume / OrganVolumes()["left lung"], 1.0, 0.05) << "half of the mask's voxels are on its border";
  EXPECT_EQ(Figures(output, "watertight").front(), 1.0);
}

TEST_F(Examples, RegisteredScanToLatticeMovesTheBodyAsTheTransformSays)
{
  // About z, so that the scan's ends cut the body where they did before.
  std::ofstream(m_Folder.Path() / "motion.tfm") << "#Insight Transform File V1.0\n#Transform 0\n"
                                                   "Transform: Euler3DTransform_double_3_3\n"
                                                   "Parameters: 0 0 0.05 6 -4 0\n"
                                                   "FixedParameters: 0 0 350 0\n";
  const std::string scan = phantom + "/phantom.nii.gz";
  Run("RegisteredScanToLattice " + scan + " " + scan + " motion.tfm moved.fcc.nrrd");
  const std::string moved = Run("ExtractAndMeasure moved.fcc.nrrd -485 moved.stl");
  const std::string unmoved = Run("ExtractAndMeasure " + scan + " -485 unmoved.stl");
  EXPECT_NEAR(Figures(moved, "volume").front() / Figures(unmoved, "volume").front(), 1.0, 0.002);

  const auto motion = itk::Euler3DTransform<double>::New();
  const double center[3] = { 0.0, 0.0, 350.0 };
  const double translation[3] = { 6.0, -4.0, 0.0 };
  motion->SetCenter(center);
  motion->SetRotation(0.0, 0.0, 0.05);
  motion->SetTranslation(translation);
  const auto at = Figures(moved, "centre"), before = Figures(unmoved, "centre");
  const auto back = motion->TransformPoint(itk::Point<double, 3>(at.data()));
  EXPECT_LT(back.EuclideanDistanceTo(itk::Point<double, 3>(before.data())), 0.2) << "mm, of voxels of 8";
}

/** A cube in a volume of 8 x 8 x 8. */
void
WriteMetaImage(const std::filesystem::path & path, const std::string & type, std::size_t bytes)
{
  std::ofstream file(path, std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 8 8 8\nElementSpacing = 1 1 1\n"
       << "ElementType = " << type << "\nElementDataFile = LOCAL\n";
  for (int n = 0; n < 512; ++n)
  {
    const auto isInside = [n](int step) { return n / step % 8 >= 2 && n / step % 8 < 6; };
    file << std::string(bytes, isInside(1) && isInside(8) && isInside(64) ? 'A' : '\0');
  }
}

/** A program, and a part of the sentence with which it ends. */
struct Refusal
{
  std::string commandLine;
  std::string sentence;
};

TEST_F(Examples, SayWhatIsWrongInsteadOfCrashing)
{
  const std::string scan = phantom + "/phantom.nii.gz";
  const auto & folder = m_Folder.Path();
  WriteMetaImage(folder / "int16.mha", "MET_SHORT", 2);
  WriteMetaImage(folder / "uint16.mha", "MET_USHORT", 2);
  WriteMetaImage(folder / "float.mha", "MET_FLOAT", 4);
  std::ofstream(folder / "fraction.nhdr") << "NRRD0004\ntype: double\ndimension: 3\nsizes: 1 1 2\nencoding: raw\n"
                                             "endian: little\ndata file: fraction.raw\n\n";
  const double fractions[] = { 0.5, 1.0 };
  std::ofstream(folder / "fraction.raw").write(reinterpret_cast<const char *>(fractions), sizeof(fractions));
  WriteMetaImage(folder / "vectors.mha", "MET_SHORT\nElementNumberOfChannels = 3", 6);
  const std::string flat = "Transform: Euler2DTransform_double_2_2\nParameters: 0 0 0\nFixedParameters: 0 0\n";
  const std::string shift = "Transform: TranslationTransform_double_3_3\nParameters: 1 0 0\nFixedParameters:\n";
  const std::string begin = "#Insight Transform File V1.0\n";
  std::ofstream(folder / "none.tfm") << begin;
  std::ofstream(folder / "flat.tfm") << begin << "#Transform 0\n" << flat;
  std::ofstream(folder / "two.tfm") << begin << "#Transform 0\n" << shift << "#Transform 1\n" << shift;
  std::filesystem::copy_file(scan, folder / "scan.nii.gz");
  std::filesystem::copy(phantom + "/dicom", folder / "dicom");
  Run("StreamLargeVolume int16.mha 1000.5 4294967295 out.stl");
  Run("ResampleAndSave scan.nii.gz lattice.fcc.nrrd");
  std::filesystem::remove(folder / "out.stl");

  for (const Refusal & refusal :
       { Refusal{ "ResampleAndSave", "usage: " },
         Refusal{ "ResampleAndSave missing out.fcc.nrrd", "no such file" },
         Refusal{ "ResampleAndSave scan.nii.gz ./scan.nii.gz", "is an input too" },
         Refusal{ "ResampleAndSave dicom dicom/slice-0001.dcm", "is an input too" },
         Refusal{ "ResampleAndSave lattice.fcc.nrrd out.fcc.nrrd", "on the face-centered cubic lattice" },
         Refusal{ "ExtractAndMeasure", "usage: " },
         Refusal{ "ExtractAndMeasure missing 0 out.stl", "no such file" },
         Refusal{ "ExtractAndMeasure scan.nii.gz bone out.stl", "THRESHOLD can't be 'bone'; give a number" },
         Refusal{ "ExtractAndMeasure scan.nii.gz 250HU out.stl", "THRESHOLD can't be '250HU'" },
         Refusal{ "ExtractAndMeasure scan.nii.gz nan out.stl", "THRESHOLD can't be 'nan'" },
         Refusal{ "ExtractAndMeasure scan.nii.gz 1e9 out.stl", "no triangles" },
         Refusal{ "ExtractAndMeasure scan.nii.gz 0 out.xyz", "names no surface format" },
         Refusal{ "HowFarApart", "usage: " },
         Refusal{ "HowFarApart missing.stl missing.stl 1", "missing.stl" },
         Refusal{ "LabelsToWalls", "usage: " },
         Refusal{ "LabelsToWalls missing out.vtp", "no such file" },
         Refusal{ "SegmentationToSurface", "usage: " },
         Refusal{ "SegmentationToSurface missing 0 0 0 2 out.stl", "no such file" },
         Refusal{ "SegmentationToSurface scan.nii.gz 7000 2.3 294.8 2 out.stl", "outside of the scan" },
         Refusal{ "SegmentationToSurface scan.nii.gz 72.4 inf 294.8 2 out.stl", "Y can't be 'inf'" },
         Refusal{ "SegmentationToSurface scan.nii.gz 72.4 2.3 294.8 -2 out.stl", "give a number from 0" },
         Refusal{ "FromMarchingCubes", "usage: " },
         Refusal{ "FromMarchingCubes missing 0", "no such file" },
         Refusal{ "FromMarchingCubes scan.nii.gz nan", "THRESHOLD can't be 'nan'" },
         Refusal{ "ScanToSurface", "usage: " },
         Refusal{ "ScanToSurface missing 0 out.stl", "no such file" },
         Refusal{ "ScanToSurface fraction.nhdr 0 out.stl", "as int16: it holds 0.5, and is float itself" },
         Refusal{ "StreamLargeVolume", "usage: " },
         Refusal{ "StreamLargeVolume missing 0 2 out.stl", "missing can't be read as a MetaImage or NRRD volume" },
         Refusal{ "StreamLargeVolume lattice.fcc.nrrd 1000.5 2 out.stl", "on the lattice already" },
         Refusal{ "StreamLargeVolume uint16.mha 1000.5 2 out.stl", "holds 1 x unsigned_short in 3 dimensions" },
         Refusal{ "StreamLargeVolume float.mha 1 2 out.stl", "holds 1 x float in 3 dimensions" },
         Refusal{ "StreamLargeVolume vectors.mha 1000.5 2 out.stl", "holds 3 x short in 3 dimensions" },
         Refusal{ "StreamLargeVolume int16.mha nan 2 out.stl", "ISOVALUE can't be 'nan'" },
         Refusal{ "StreamLargeVolume int16.mha 1000.5 -1 out.stl", "SLABS can't be '-1'; give a whole number from 1" },
         Refusal{ "StreamLargeVolume int16.mha 1000.5 0 out.stl", "SLABS can't be '0'" },
         Refusal{ "StreamLargeVolume int16.mha 1000.5 2.5 out.stl", "SLABS can't be '2.5'" },
         Refusal{ "RegisteredScanToLattice", "usage: " },
         Refusal{ "RegisteredScanToLattice missing missing missing.tfm out.fcc.nrrd", "missing.tfm can't be read as" },
         Refusal{ "RegisteredScanToLattice scan.nii.gz scan.nii.gz none.tfm out.fcc.nrrd", "can't be read as" },
         Refusal{ "RegisteredScanToLattice scan.nii.gz scan.nii.gz flat.tfm out.fcc.nrrd", "Only one transform" },
         Refusal{ "RegisteredScanToLattice scan.nii.gz scan.nii.gz two.tfm out.fcc.nrrd", "Only one transform" },
         Refusal{ "RegisteredScanToLattice scan.nii.gz scan.nii.gz two.tfm two.tfm", "is an input too" },
         Refusal{ "RegisteredScanToLattice lattice.fcc.nrrd scan.nii.gz two.tfm scan.nii.gz", "is an input too" } })
  {
    const Outcome outcome = rhombictest::RunShell(refusal.commandLine, folder);
    EXPECT_EQ(outcome.exitCode, 1) << refusal.commandLine;
    EXPECT_EQ(outcome.output, "") << refusal.commandLine;
    EXPECT_NE(outcome.errors.find(refusal.sentence), std::string::npos) << refusal.commandLine << '\n'
                                                                        << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.stl") || std::filesystem::exists(folder / "out.fcc.nrrd"));
  }
  EXPECT_TRUE(ReadText(folder / "scan.nii.gz") == ReadText(scan)) << "it was not written over";
}

TEST_F(Examples, ScanToSurfaceMakesTheSurfaceOfRhombicMesh)
{
  for (const char * const scan : { "/dicom", "/phantom.nii.gz" })
  {
    Run("ScanToSurface " + phantom + scan + " -485.5 example.stl");
    Run("rhombic -q mesh " + phantom + scan + " -t -485.5 -o program.stl");
    const auto ours = nlohmann::json::parse(Run("rhombic audit example.stl --json"))[0];
    const auto theirs = nlohmann::json::parse(Run("rhombic audit program.stl --json"))[0];
    EXPECT_TRUE(ours["watertight"]);
    EXPECT_EQ(ours["triangles"], theirs["triangles"]);
    EXPECT_NEAR(ours["volumeInMillilitres"].get<double>() / theirs["volumeInMillilitres"].get<double>(), 1.0, 0.02)
      << "rhombic mesh moves the ends, where the scan cuts the body, onto the scan's faces";
  }
}

TEST_F(Examples, FromMarchingCubes)
{
  const std::string output = this->Run("FromMarchingCubes " + phantom + "/phantom.nii.gz -485.5");
  EXPECT_GT(Figures(output, "Rhombic")[0], 1000.0);
  EXPECT_LT(Figures(output, "Rhombic")[0], Figures(output, "vtkFlyingEdges3D")[0]);
}

/** Isosurfaces of one scan at two thresholds: a surface agrees with itself, and the lower threshold's encloses more. */
TEST_F(Examples, HowFarApartMeasuresTwoIsosurfaces)
{
  this->Run("ScanToSurface " + phantom + "/dicom 300.5 inner.stl && ScanToSurface " + phantom +
            "/dicom 200.5 outer.stl");
  const std::string same = this->Run("HowFarApart inner.stl inner.stl 0.5");
  EXPECT_EQ(Figures(same, "Hausdorff distance").front(), 0.0);
  EXPECT_EQ(Figures(same, "normalised surface Dice").front(), 1.0);
  const std::string apart = this->Run("HowFarApart inner.stl outer.stl 0.5");
  EXPECT_GT(Figures(apart, "mean distance").front(), 0.01);
  EXPECT_LT(Figures(apart, "normalised surface Dice").front(), 1.0);
}

TEST_F(Examples, LabelsToWallsKeepsTheVolumesOfOrgans)
{
  const std::string output = this->Run("LabelsToWalls " + phantom + "/phantom-labels.nii.gz walls.vtp");
  EXPECT_GT(Figures(output, "triangles").front(), 1000.0);
  EXPECT_NEAR(Figures(output, "left lung").front() / OrganVolumes()["left lung"], 1.0, 0.03);
  EXPECT_NE(ReadText((m_Folder.Path() / "walls.vtp").string()).find("Name=\"BoundaryLabels\""), std::string::npos);
}

/** What the page for VTK's users shows is what the program runs. */
TEST(ExamplesPage, ShowsTheExample)
{
  const std::string page = ReadText(RHOMBIC_SOURCE "/modules/surfaces/SurfaceVTK/README.md");
  const std::string begin = "vtkSmartPointer<vtkPolyData>\nExtractSurface";
  const std::size_t from = page.find(begin);
  ASSERT_NE(from, std::string::npos);
  const std::string shown = page.substr(from, page.find("```", from) - from);
  EXPECT_NE(ReadText(RHOMBIC_SOURCE "/apps/examples/FromMarchingCubes.cxx").find(shown), std::string::npos) << shown;
}

} // namespace
