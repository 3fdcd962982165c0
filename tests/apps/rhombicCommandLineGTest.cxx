#include "rhombicPictureComparison.h"
#include "rhombicPictureIO.h"
#include "rhombicProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

const std::string phantomDicom = RHOMBIC_TESTDATA "/phantom/dicom";
const std::string phantomNifti = RHOMBIC_TESTDATA "/phantom/phantom.nii.gz";
const std::string phantomLabels = RHOMBIC_TESTDATA "/phantom/phantom-labels.nii.gz";

Outcome
Rhombic(const std::string & arguments, const fs::path & folder)
{
  return RunShell("rhombic " + arguments, folder);
}

std::set<std::string>
FilesIn(const fs::path & folder)
{
  std::set<std::string> names;
  for (const auto & entry : fs::directory_iterator(folder))
  {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/** Column or row by column: how many pixels are bright. */
std::vector<int>
BrightPixels(const rhombic::Picture & picture, bool byColumn)
{
  constexpr int bright = 90;
  std::vector<int> counts(static_cast<std::size_t>(byColumn ? picture.width : picture.height), 0);
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      counts[static_cast<std::size_t>(byColumn ? x : y)] += picture.At(x, y)[0] > bright ? 1 : 0;
    }
  }
  return counts;
}

struct ErrorCase
{
  const char * name;
  const char * arguments;
  int exitCode;
  const char * says;
};

// Files of the test's own folder: text.dcm, text.nii, empty/, file/, readonly/, and copies of the phantom, scan.nii.gz,
// and of its labels, labels.nii.gz.
constexpr ErrorCase errorCases[] = {
  { "NoCommand", "", 2, "No command is given" },
  { "UnknownCommand", "paint scan.nii.gz", 2, "paint" },
  { "UnknownOption", "render scan.nii.gz --sharpness 3", 2, "--sharpness" },
  { "UnknownCommandNearAnother", "rendr scan.nii.gz", 2, "no command 'rendr'; did you mean render?" },
  { "UnknownOptionNearAnother", "mesh scan.nii.gz --largst", 2, "no option --largst; did you mean --largest?" },
  { "UnknownOptionWithAValue",
    "render scan.nii.gz --brightness 2",
    2,
    "no option --brightness; see rhombic render --help" },
  { "OptionBeforeItsCommand", "--size 64 render scan.nii.gz", 2, "--size goes behind the command" },
  { "OptionGivenTwice", "mesh scan.nii.gz -t 1 -o a.stl -o b.stl", 2, "--output is given 2 times; give it once." },
  { "OptionWithoutItsValue", "render scan.nii.gz --size", 2, "--size needs a value" },
  { "OptionThatIsNoNumber", "mesh scan.nii.gz -t 1 --density much -o a.stl", 2, "--density = much is no number" },
  { "OneNameTooMany", "info my scan.nii.gz", 2, "'scan.nii.gz' is one name too many" },
  { "BadThreads", "--threads 0 info scan.nii.gz", 2, "threads" },
  { "QuietAndVerbose", "-q -v info scan.nii.gz", 2, "verbose" },
  { "NoScan", "render -o a.png --preset ct-bone", 2, "No scan" },
  { "MissingPath", "render missing.nii.gz --preset ct-bone -o a.png", 3, "missing.nii.gz" },
  { "MissingPathInfo", "info missing", 3, "missing" },
  { "EmptyFolder", "render empty --preset ct-bone -o a.png", 3, "empty" },
  { "TextNamedDicom", "render text.dcm --preset ct-bone -o a.png", 4, "text.dcm" },
  { "TextNamedNifti", "render text.nii --preset ct-bone -o a.png", 4, "text.nii" },
  { "TruncatedVolume", "mesh cut.nii.gz -t 250.5 -o a.stl", 4, "cut.nii.gz" },
  { "TruncatedLattice", "mesh cut.fcc.nrrd -t 250.5 -o a.stl", 4, "cut.fcc.nrrd" },
  { "UnknownPreset", "render scan.nii.gz --preset ct-bnoe -o a.png", 2, "did you mean ct-bone?" },
  { "PresetFarFromAll", "render scan.nii.gz --preset liver -o a.png", 2, "no preset 'liver'; see rhombic render" },
  { "MissingPresetFile", "render scan.nii.gz --preset my.yaml -o a.png", 3, "my.yaml" },
  { "NoPicture", "render scan.nii.gz --preset ct-bone", 2, "-o" },
  { "BadSurface", "render scan.nii.gz --surface bone -o a.png", 2, "bone=250.5" },
  { "BadColour", "render scan.nii.gz --surface bone=250,whit -o a.png", 2, "did you mean white?" },
  { "BadOpacity", "render scan.nii.gz --surface bone=250,#ffffff,2 -o a.png", 2, "opacity" },
  { "BadView", "render scan.nii.gz --preset ct-bone --view front -o a.png", 2, "front" },
  { "BadViewNearAnother", "render scan.nii.gz --preset ct-bone --view fron -o a.png", 2, "'fron'; use anterior" },
  { "BadSize", "render scan.nii.gz --preset ct-bone --size big -o a.png", 2, "1600x1200" },
  { "HugeSize", "render scan.nii.gz --preset ct-bone --size 100000 -o a.png", 2, "8192" },
  { "BadStyle", "render scan.nii.gz --preset ct-bone --style papr -o a.png", 2, "did you mean paper?" },
  { "BadAngles", "render scan.nii.gz --preset ct-bone --view 30,120 -o a.png", 2, "120" },
  { "NamesInPerspective", "render a.nii.gz --preset ct-bone --annotate names --perspective -o a.png", 2, "parallel" },
  { "NamesOfSlices", "render a.nii.gz --preset ct-bone --annotate names --slice axial -o a.png", 2, "beside views" },
  { "FigureOnPage", "render a.nii.gz --preset ct-bone --sheet --annotate figure -o a.png", 2, "choose letters" },
  { "BadAnnotation", "render scan.nii.gz --preset ct-bone --annotate ruler -o a.png", 2, "use letters" },
  { "BadWindow", "render scan.nii.gz --preset ct-bone --slice axial --window bnoe -o a.png", 2, "did you mean bone?" },
  { "BadSlice", "render scan.nii.gz --preset ct-bone --slice axal -o a.png", 2, "did you mean axial?" },
  { "SliceOfNothing", "render scan.nii.gz --preset ct-bone --slice axial= -o a.png", 2, "axial=liver" },
  { "SliceOutside", "render scan.nii.gz --preset ct-bone --slice axial=9000 -o a.png", 2, "9000" },
  { "SliceBeyondTheLast", "render scan.nii.gz --preset ct-bone --slice axial=#900 -o a.png", 2, "900" },
  { "SliceOfAnUnknownLabel", "render labels.nii.gz --slice axial=haert -o a.png", 2, "did you mean heart?" },
  { "BadCut", "render scan.nii.gz --preset ct-bone --cut 'q>1' -o a.png", 2, "x>12" },
  { "CutOutside", "render scan.nii.gz --preset ct-bone --cut 'x>5000' -o a.png", 2, "is outside of what is shown" },
  { "NothingIsCut",
    "render scan.nii.gz --preset ct-bone --cut axial --uncut '*' -o a.png",
    2,
    "No surface is left to cut" },
  { "UnknownFocus", "render scan.nii.gz --preset ct-bone --focus bnoe -o a.png", 2, "did you mean bone?" },
  { "OnlyUnknownLabels", "render labels.nii.gz --only haert -o a.png", 2, "did you mean heart?" },
  { "OnlyUnknownGroups", "render labels.nii.gz --only group:bnoes -o a.png", 2, "did you mean group:bones?" },
  { "NothingLeft", "render labels.nii.gz --only heart --hide 'h*' -o a.png", 2, "No surface is left to show" },
  { "BadRule", "render labels.nii.gz --draw heart=whit -o a.png", 2, "did you mean white?" },
  { "BadColours", "render labels.nii.gz --colours rainbow -o a.png", 2, "anatomy, file or safe" },
  { "AlphaWhereThereIsNone",
    "render scan.nii.gz --preset ct-bone --style transparent -o a.jpg",
    2,
    "transparent background" },
  { "AnimationOfOneView", "render scan.nii.gz --preset ct-bone -o a.gif", 2, ".gif" },
  { "PageOfAnotherFormat", "render scan.nii.gz --preset ct-bone --sheet -o a.gif", 2, ".gif" },
  { "CutOfAnInteractivePage",
    "render scan.nii.gz --preset ct-bone --cut coronal -o a.html",
    2,
    "--cut has no meaning" },
  { "LegendOfAnInteractivePage",
    "render scan.nii.gz --preset ct-bone --annotate legend -o a.html",
    2,
    "--annotate has no meaning" },
  { "ShadowsOfAnInteractivePage",
    "render scan.nii.gz --preset ct-bone --no-shadows -o a.html",
    2,
    "--no-shadows has no meaning" },
  { "DicomOfAnInteractivePage", "render scan.nii.gz --preset ct-bone --dicom-sc -o a.html", 2, "--dicom-sc" },
  { "BadSizeOfAnInteractivePage",
    "render scan.nii.gz --preset ct-bone --page-size big -o a.html",
    2,
    "write it as 8M" },
  { "PictureWithTheSizeOfAPage", "render scan.nii.gz --preset ct-bone --page-size 2M -o a.png", 2, "-o page.html" },
  { "PictureWithoutThePagesSlices", "render scan.nii.gz --preset ct-bone --no-slices -o a.png", 2, "-o page.html" },
  { "OptionsOfNoReport", "render scan.nii.gz --from text.dcm -o a.png", 4, "is no report" },
  { "OptionsOfAMissingReport", "render scan.nii.gz --from a.json -o a.png", 3, "a.json" },
  { "TwoScans", "render scan.nii.gz labels.nii.gz --preset ct-bone -o a.png", 2, "one scan at a time" },
  { "PicturesThatAreNone", "compare-pictures scan.nii.gz scan.nii.gz", 4, "scan.nii.gz" },
  { "OnePictureToCompare", "compare-pictures a.png", 2, "Two pictures" },
  { "OneSegmentation", "compare-labels labels.nii.gz", 2, "name both" },
  { "SegmentationsThatAreNone", "compare-labels scan.nii.gz labels.nii.gz", 4, "no label map" },
  { "UnknownLabelToCompare", "compare-labels labels.nii.gz labels.nii.gz --only haert", 2, "heart" },
  { "BadPair", "compare-labels labels.nii.gz labels.nii.gz --pair heart", 2, "--pair liver=Leber" },
  { "BadTolerance", "compare-labels labels.nii.gz labels.nii.gz --tolerance wide", 2, "neither a length" },
  { "NegativeTolerance", "compare-labels labels.nii.gz labels.nii.gz --tolerance -1", 2, "at least 0 mm" },
  { "TableOfAnotherFormat", "compare-labels labels.nii.gz labels.nii.gz -o a.xls", 2, ".csv, .tsv or .json" },
  { "OneDate", "compare-labels labels.nii.gz labels.nii.gz --dates 2025-01-03", 2, "two dates" },
  { "MissingTransform", "compare-labels labels.nii.gz labels.nii.gz --transform none.tfm", 3, "none.tfm" },
  { "ColourByNothing", "render scan.nii.gz --preset ct-bone --colour-by distance: -o a.png", 2, "distance:other.stl" },
  { "UnknownColourMap", "render scan.nii.gz --preset ct-bone --colour-by a.nii,rainbow -o a.png", 2, "viridis" },
  { "ColoursInSTL", "mesh scan.nii.gz -t 250.5 --colour-by thickness -o a.stl", 2, ".ply, .vtp, .glb" },
  { "ColoursOfAMissingFile", "mesh scan.nii.gz -t 250.5 --colour-by pet.nii -o a.ply", 3, "no pet.nii to colour by" },
  { "NegativeThickness", "mesh scan.nii.gz -t 250.5 --min-thickness -1 -o a.ply", 2, "--min-thickness" },
  { "BadDepth", "render scan.nii.gz --preset ct-bone --colour-by a.nii,max:deep -o a.html", 2, "max:5mm" },
  { "BadBackground", "render scan.nii.gz --preset ct-bone --background '#12345' -o a.png", 2, "#rrggbb" },
  { "BadKernel", "render scan.nii.gz --preset ct-bone --kernel sharp -o a.png", 2, "sharp" },
  { "BadMode", "mesh scan.nii.gz -t 250.5 --mode thin -o a.stl", 2, "use lean, fine" },
  { "BadModeNearAnother", "mesh scan.nii.gz -t 250.5 --mode leen -o a.stl", 2, "did you mean lean?" },
  { "BadDenoising", "render scan.nii.gz --preset ct-bone --denoise blur -o a.png", 2, "gaussian:" },
  { "DenoisingByNothing", "mesh scan.nii.gz -t 250.5 --denoise gaussian:0 -o a.stl", 2, "positive" },
  { "DenoisingBeyondTheLattice", "mesh scan.nii.gz -t 250.5 --denoise gaussian:1e6 -o a.stl", 2, "at most" },
  { "EdgesWithoutSteepness", "resample scan.nii.gz --denoise edges:1 -o a.nrrd", 2, "edges:0.7,60" },
  { "EdgesOnALattice", "mesh scan.fcc.nrrd -t 250.5 --denoise edges:1,60 -o a.stl", 2, "gaussian" },
  { "NestedWithADensity", "mesh scan.nii.gz -t 250.5 --nested --density 1 -o a.stl", 2, "--nested" },
  { "BadModeOfAPicture", "render scan.nii.gz --preset ct-bone --mode thin -o a.png", 2, "use lean, fine" },
  { "NestedWithASpacing", "render scan.nii.gz --preset ct-bone --nested --spacing 2 -o a.png", 2, "--nested" },
  { "NestedWithAKernel", "resample scan.nii.gz --nested --kernel linear -o a.nrrd", 2, "--nested" },
  { "BadDensity", "render scan.nii.gz --preset ct-bone --density 0 -o a.png", 2, "density" },
  { "BadSpacing", "render scan.nii.gz --preset ct-bone --spacing 1,2 -o a.png", 2, "spacing" },
  { "InfiniteSpacing", "render scan.nii.gz --preset ct-bone --spacing inf -o a.png", 2, "spacing" },
  { "TooManySites", "mesh scan.nii.gz -t 250.5 --spacing 1e-7 -o a.stl", 2, "spacing" },
  { "ColourForAMesh", "mesh scan.nii.gz -t 250.5,#ff0000 -o a.stl", 2, "threshold" },
  { "BadPresetColour", "render scan.nii.gz --preset colour.yaml -o a.png", 4, "colour.yaml" },
  { "BadPresetOpacity", "render scan.nii.gz --preset opacity.yaml -o a.png", 4, "opacity.yaml" },
  { "PresetWithoutIsovalue", "render scan.nii.gz --preset bare.yaml -o a.png", 4, "isovalue" },
  { "OutputClosed", "info scan.nii.gz >/dev/full", 7, "standard output" },
  { "OutputOfHelpClosed", "mesh --help >/dev/full", 7, "standard output" },
  { "OutputNotOpen", "info scan.nii.gz >&-", 7, "standard output" },
  { "ComparisonInNoFolder", "compare '" RHOMBIC_SOURCE "/tests/apps/accuracy.yaml' -o /proc/a", 7, "make the folder" },
  { "NegativeSpacing", "render scan.nii.gz --preset ct-bone --spacing=-1 -o a.png", 2, "spacing" },
  { "BadOnGap", "info dicom --on-gap=guess", 2, "interpolate or error" },
  { "BadOnIrregular", "info dicom --on-irregular=bend", 2, "resample or error" },
  { "LevelOfNoPyramid", "info scan.nii.gz --level 1", 2, "leave out --level" },
  { "VoxelSizeThatIsKnown", "info scan.nii.gz --voxel-size 1", 2, "leave out --voxel-size" },
  { "BadVoxelSize", "info text.dcm --raw 5x5x1,uint8 --voxel-size 5ym", 2, "as 5um" },
  { "BadRawLayout", "info text.dcm --raw 5x5,uint8 --voxel-size 1", 2, "2048x2048x2048,uint16,le" },
  { "RawWithoutByteOrder", "info text.dcm --raw 2x2x2,uint16 --voxel-size 1", 2, "byte order" },
  { "RawWithoutVoxelSize", "info text.dcm --raw 5x5x1,uint8", 2, "--voxel-size" },
  { "RawOfAnotherLength", "info text.dcm --raw 2x2x2,uint8 --voxel-size 1", 4, "correct --raw" },
  { "BadMemory", "info dicom --max-memory much", 2, "--max-memory: 'much' is no size" },
  { "NegativeMemory", "info dicom --max-memory=-5M", 2, "'-5M' is no size from 0 on, as 8G or 500M" },
  { "ScanBeyondTheMemoryAllowed", "info dicom --max-memory 1K", 9, "--max-memory 1G" },
  { "LatticeBeyondTheMemoryAllowed",
    "mesh scan.nii.gz -t 250.5 --density 4 --max-memory 400K -o a.stl",
    9,
    "--density 1." },
  { "PictureBeyondTheMemoryAllowed",
    "render text.dcm --preset ct-bone --size 4096 --max-memory 500M -o a.png",
    9,
    "x" },
  { "LabelsThatAreNone", "info dicom --labels scan.nii.gz", 4, "label" },
  { "LabelTableThatIsNone", "info scan.nii.gz --label-table text.dcm", 4, "text.dcm" },
  { "LabelsOfWhatIsNoLabelMap", "mesh scan.nii.gz --label heart -o a.stl", 2, "is no label map" },
  { "LabelsBesideAThreshold", "mesh labels.nii.gz -t 1 --label heart -o a.stl", 2, "--labels" },
  { "LabelsOfALattice", "render scan.fcc.nrrd --label heart -o a.png", 2, "is no label map" },
  { "UnknownLabel", "mesh labels.nii.gz --label haert -o a.stl", 2, "no label 'haert'; did you mean heart?" },
  { "BadSeries", "render dicom --series 7 --preset ct-bone -o a.png", 2, "7" },
  { "ThresholdAboveTheRange", "render scan.nii.gz --surface bone=9000.5 -o a.png", 6, "run from -1000 to" },
  { "ThresholdBelowTheRange", "mesh scan.nii.gz -t -9000 -o a.stl", 6, "run from -1000 to" },
  { "NoThreshold", "mesh scan.nii.gz -o a.stl", 2, "-t" },
  { "BadThreshold", "mesh scan.nii.gz -t high -o a.stl", 2, "no number" },
  { "UnknownPictureFormat", "render scan.nii.gz --preset ct-bone -o a.bmp2", 2, ".png" },
  { "UnknownMeshFormat", "mesh scan.nii.gz -t 250.5 -o a.xyz", 2, ".stl" },
  { "UnknownVolumeFormat", "resample scan.nii.gz -o a.xyz", 2, ".nrrd" },
  { "UnknownVolumeFormatBack", "resample scan.fcc.nrrd -o a.xyz", 2, ".nii.gz" },
  { "PictureFolderMissing", "render scan.nii.gz --preset ct-bone -o missing/a.png", 7, "missing" },
  { "PictureIsAFolder", "render scan.nii.gz --preset ct-bone -o folder.png", 7, "folder" },
  { "InteractivePageFolderMissing", "render scan.nii.gz --preset ct-bone -o missing/a.html", 7, "missing" },
  { "MeshFolderMissing", "mesh scan.nii.gz -t 250.5 -o missing/a.stl", 7, "missing" },
  { "VolumeFolderMissing", "resample scan.nii.gz -o missing/a.nrrd", 7, "missing" },
  { "PictureIsADevice", "render scan.nii.gz --preset ct-bone -o device.png", 7, "device.png" },
  { "OutputIsTheInput", "resample scan.fcc.nrrd -o scan.fcc.nrrd", 2, "input" },
  { "PhantomWithoutFolder", "phantom", 2, "-o" },
  { "PhantomIntoAFullFolder", "phantom -o file", 7, "file" },
  { "PhantomTooFine", "phantom -o new --spacing 0.001", 2, "spacing" },
};

/** How GoogleTest names the case. */
void
PrintTo(const ErrorCase & error, std::ostream * os)
{
  *os << "rhombic " << error.arguments;
}

class CommandLineErrors : public testing::TestWithParam<ErrorCase>
{};

TEST_P(CommandLineErrors, AreOneSentenceAndTheDocumentedExitCode)
{
  const ErrorCase & expected = GetParam();
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "text.dcm") << "this is not a DICOM file\n";
  std::ofstream(folder.Path() / "text.nii") << "this is not a NIfTI file\n";
  const std::string preset = "name: p\nsurfaces: [{name: a, isovalue: 1, ";
  std::ofstream(folder.Path() / "colour.yaml") << preset << "colour: rot}]\n";
  std::ofstream(folder.Path() / "opacity.yaml") << preset << "opacity: 7}]\n";
  std::ofstream(folder.Path() / "bare.yaml") << "name: p\nsurfaces: [{name: a}]\n";
  fs::create_directory(folder.Path() / "empty");
  fs::create_directory(folder.Path() / "file");
  fs::create_directory(folder.Path() / "folder.png");
  fs::create_symlink("/dev/full", folder.Path() / "device.png");
  std::ofstream(folder.Path() / "file" / "something") << "something\n";
  fs::copy(phantomNifti, folder.Path() / "scan.nii.gz");
  fs::copy(phantomLabels, folder.Path() / "labels.nii.gz");
  std::ofstream(folder.Path() / "labels.csv") << "LabelValue,Name\n15,heart\n";
  fs::create_directory_symlink(phantomDicom, folder.Path() / "dicom");
  std::ofstream(folder.Path() / "cut.nii.gz", std::ios::binary) << ReadText(phantomNifti).substr(0, 3000);
  ASSERT_EQ(Rhombic("-q resample scan.nii.gz --density 0.1 -o scan.fcc.nrrd", folder.Path()).exitCode, 0);
  std::ofstream(folder.Path() / "cut.fcc.nrrd", std::ios::binary)
    << ReadText(folder.Path() / "scan.fcc.nrrd").substr(0, 3000);
  const auto before = FilesIn(folder.Path());

  const Outcome outcome = Rhombic("-q " + std::string(expected.arguments), folder.Path());
  EXPECT_EQ(outcome.exitCode, expected.exitCode) << outcome.errors;
  EXPECT_NE(outcome.errors.find(expected.says), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.errors.rfind("rhombic: ", 0), 0u) << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_EQ(outcome.errors.find(".cxx"), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(FilesIn(folder.Path()), before) << "no partial files";
}

INSTANTIATE_TEST_SUITE_P(All, CommandLineErrors, testing::ValuesIn(errorCases), [](const auto & error) {
  return std::string(error.param.name);
});

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which start threads, and have no use for strace
TEST(CommandLine, ThreadsThatTheSystemDoesNotStartAreRefused)
{
  const TemporaryFolder folder;
  if (RunShell("command -v strace", folder.Path()).exitCode != 0)
  {
    GTEST_SKIP() << "strace is not installed";
  }
  for (const std::string which : { "1", "2", "3" })
  {
    const std::string fault = "strace -f -qq -o /dev/null -e inject=clone3:error=EAGAIN:when=" + which;
    const std::string mesh = " rhombic -q --threads 3 mesh " + phantomNifti + " -t 375.5 -o bone.stl";
    const Outcome outcome = RunShell(fault + mesh, folder.Path());
    EXPECT_EQ(outcome.exitCode, 9) << which << outcome.errors;
    EXPECT_NE(outcome.errors.find("Cannot start 3 threads"), std::string::npos) << which << outcome.errors;
    EXPECT_TRUE(FilesIn(folder.Path()).empty()) << which;
  }
}

TEST(CommandLine, PlansAndWorkNeedTheSameAddressSpace)
{
  const TemporaryFolder folder;
  for (const std::string limit : { "250000", "300000", "350000" })
  {
    const std::string mesh =
      "ulimit -v " + limit + "\nrhombic -q --threads 8 mesh '" + phantomNifti + "' -t 300.5 --density 8 -o a.stl";
    EXPECT_EQ(RunShell(mesh + " --dry-run", folder.Path()).exitCode, RunShell(mesh, folder.Path()).exitCode) << limit;
  }
}

TEST(CommandLine, TooLittleAddressSpaceIsADocumentedFailure)
{
  const TemporaryFolder folder;
  for (int limit = 80'000; limit < 160'000; limit += 4000)
  {
    const Outcome outcome = RunShell("ulimit -v " + std::to_string(limit) + "\nrhombic -q render '" + phantomNifti +
                                       "' --surface s=300.5 --size 64 -o a.png",
                                     folder.Path());
    EXPECT_TRUE(outcome.exitCode == 0 || outcome.exitCode == 9 || outcome.exitCode == 10)
      << limit << ": " << outcome.exitCode << ' ' << outcome.errors;
  }
}
#endif

TEST(CommandLine, NamesLongerThanTheSystemAllowsAreRefusedAsThoseOfMissingFiles)
{
  const TemporaryFolder folder;
  const auto scan = [](const std::string & before, const std::string & after) {
    return before + ' ' + phantomNifti + ' ' + after;
  };
  for (const std::string & arguments : { std::string("info $L"),
                                         std::string("audit $L.stl"),
                                         std::string("render $L.vtp -o a.png"),
                                         std::string("batch $L.tsv -o out"),
                                         std::string("mesh $L.nii -t 250.5 -o a.stl"),
                                         "mesh " + phantomLabels + " --label-table $L.tsv -o a.stl",
                                         scan("mesh", "-t 250.5 -o $L.stl"),
                                         scan("mesh", "-t 250.5 --colour-by $L.nii -o a.vtp"),
                                         scan("render", "--labels $L.nii -o a.png"),
                                         scan("render", "--labels " + phantomLabels + " --labels $L.nii -o a.png"),
                                         scan("render", "--preset $L.yaml -o a.png"),
                                         scan("compare-labels $L.nii", "-o a.tsv"),
                                         scan("resample", "-o $L.fcc.nrrd"),
                                         scan("compare-pictures", "$L.png") })
  {
    const Outcome outcome = RunShell("L=$(printf '%0300d' 7)\nrhombic " + arguments, folder.Path());
    EXPECT_GT(outcome.exitCode, 1) << arguments << outcome.errors;
    EXPECT_NE(outcome.errors.find("0007"), std::string::npos) << arguments << outcome.errors;
    EXPECT_TRUE(FilesIn(folder.Path()).empty()) << arguments;
  }
}

TEST(CommandLine, RequestsEndWithTheProcessThatMakesThem)
{
  const TemporaryFolder folder;
  const auto request = [&folder](const std::string & parent) {
    return RunShell("rhombic --request <<< '{\"command\": \"info\", \"parent\": '" + parent +
                      "', \"settings\": {\"scan\": \"" + phantomNifti + "\"}}'",
                    folder.Path());
  };
  EXPECT_EQ(request("$$").exitCode, 0) << request("$$").output;
  EXPECT_EQ(request("1").exitCode, 1);
  EXPECT_EQ(request("1").output, "");
}

TEST(CommandLine, NoFileTakesThePlaceOfAStandardStreamThatIsClosed)
{
  const TemporaryFolder folder;
  const std::string mesh = "mesh '" + phantomNifti + "' -t 375.5 --no-sidecar -o ";
  ASSERT_EQ(Rhombic(mesh + "open.stl", folder.Path()).exitCode, 0);
  ASSERT_EQ(Rhombic(mesh + "closed.stl <&- >&- 2>&-", folder.Path()).exitCode, 0);
  EXPECT_EQ(ReadText(folder.Path() / "open.stl"), ReadText(folder.Path() / "closed.stl"));
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput)
{
  const TemporaryFolder folder;
  const Outcome help = Rhombic("--help", folder.Path());
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_EQ(help.errors, "");
  for (const char * word :
       { "info", "render", "mesh", "resample", "phantom", "doctor", "--threads", "--quiet", "Exit codes", "10" })
  {
    EXPECT_NE(help.output.find(word), std::string::npos) << word;
  }
  for (const char * command : { "info", "render", "mesh", "resample", "phantom", "doctor" })
  {
    const Outcome one = Rhombic(std::string(command) + " --help", folder.Path());
    EXPECT_EQ(one.exitCode, 0);
    EXPECT_NE(one.output.find("Exit codes"), std::string::npos);
  }
  const Outcome version = Rhombic("--version", folder.Path());
  EXPECT_EQ(version.exitCode, 0);
  for (const char * library : { "rhombic", "ITK", "VTK", "OpenImageIO" })
  {
    EXPECT_NE(version.output.find(library), std::string::npos);
  }
}

TEST(CommandLine, InfoKnowsThePhantom)
{
  const TemporaryFolder folder;
  const Outcome text = Rhombic("info " + phantomDicom, folder.Path());
  EXPECT_EQ(text.exitCode, 0) << text.errors;
  for (const char * word : { "DICOM", "CT", "int16", "LPS", "250.5", "only series" })
  {
    EXPECT_NE(text.output.find(word), std::string::npos) << word << text.output;
  }
  const Outcome json = Rhombic("info --json " + phantomNifti, folder.Path());
  EXPECT_EQ(json.exitCode, 0);
  EXPECT_EQ(json.output.front(), '{');
  EXPECT_NE(json.output.find("\"orientation\": \"LPS\""), std::string::npos) << json.output;
}

using Json = nlohmann::json;

/** What `rhombic info --json` says of a scan. */
Json
InfoOf(const std::string & arguments, const fs::path & folder)
{
  const Outcome outcome = Rhombic("info --json " + arguments, folder);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  return Json::parse(outcome.output, nullptr, false);
}

TEST(CommandLine, InfoDescribesEachOfSeveralSeries)
{
  const TemporaryFolder folder;
  ASSERT_EQ(Rhombic("phantom --spacing 10 -o p", folder.Path()).exitCode, 0);
  fs::create_directory(folder.Path() / "study");
  fs::copy(phantomDicom, folder.Path() / "study" / "a");
  fs::copy(folder.Path() / "p" / "dicom", folder.Path() / "study" / "b");
  const Outcome text = Rhombic("info study", folder.Path());
  EXPECT_EQ(text.exitCode, 0) << text.errors;
  for (const char * words : { "CT, 54 x 35 x 91 of 8 x 8 x 8 mm, 91 files", "x 10 x 10 mm", "--series and its id" })
  {
    EXPECT_NE(text.output.find(words), std::string::npos) << words << text.output;
  }
  EXPECT_EQ(text.output.find("problem: "), std::string::npos) << text.output;

  fs::remove(folder.Path() / "study" / "b" / "slice-0020.dcm");
  const Json report = InfoOf("study", folder.Path());
  ASSERT_EQ(report["series"].size(), 2u) << report;
  const std::size_t coarse = report["series"][0].contains("spacing") ? 1 : 0;
  EXPECT_EQ(report["series"][1 - coarse]["spacing"], (std::array<double, 3>{ 8.0, 8.0, 8.0 }));
  EXPECT_EQ(report["series"][1 - coarse]["problem"], "");
  EXPECT_NE(report["series"][coarse]["problem"].get<std::string>().find("1 slice is missing"), std::string::npos);

  const Json chosen = InfoOf("study --series " + report["series"][1 - coarse]["id"].get<std::string>(), folder.Path());
  EXPECT_EQ(chosen["size"], (std::array<int, 3>{ 54, 35, 91 }));
  EXPECT_EQ(Rhombic("mesh study -t 250.5 -o a.stl", folder.Path()).exitCode, 2) << "which one is not for it to choose";
  EXPECT_EQ(Rhombic("info study --series " + report["series"][coarse]["id"].get<std::string>(), folder.Path()).exitCode,
            5);
}

TEST(CommandLine, InfoDescribesTheOtherSeriesWhenTheChosenOneCannotBeRead)
{
  const TemporaryFolder folder;
  ASSERT_EQ(Rhombic("phantom --spacing 10 -o p", folder.Path()).exitCode, 0);
  fs::create_directory(folder.Path() / "study");
  fs::copy(phantomDicom, folder.Path() / "study" / "a");
  fs::copy(folder.Path() / "p" / "dicom", folder.Path() / "study" / "b");
  fs::remove(folder.Path() / "study" / "a" / "slice-0040.dcm");
  for (const std::string & slice : FilesIn(folder.Path() / "study" / "b"))
  {
    if (slice > "slice-0030.dcm") // less than half as many as the other series has
    {
      fs::remove(folder.Path() / "study" / "b" / slice);
    }
  }
  const Outcome text = Rhombic("info study", folder.Path());
  EXPECT_EQ(text.exitCode, 0) << text.errors;
  EXPECT_NE(text.output.find("problem: The slices in"), std::string::npos) << text.output;
  EXPECT_NE(text.output.find("x 30 of 10 x 10 x 10 mm"), std::string::npos) << text.output;
  EXPECT_EQ(Rhombic("info study/a", folder.Path()).exitCode, 5) << "a series alone is read or refused";
}

TEST(CommandLine, InfoDescribesTheFirstVolumeOfAFileOfSeveral)
{
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "series.nrrd")
    << "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 2 3\nkinds: domain domain domain list\nspace: LPS\n"
       "space directions: (2,0,0) (0,3,0) (0,0,4) none\nspace origin: (5,6,7)\nencoding: raw\n\n"
       "abcdefghijklmnopqrstuvwx";
  const Outcome text = Rhombic("info series.nrrd", folder.Path());
  EXPECT_EQ(text.exitCode, 0) << text.errors;
  for (const char * words : { "3, of which this is 0", "--frame N, from 0 to 2", "2 x 3 x 4 mm", "97 to 104" })
  {
    EXPECT_NE(text.output.find(words), std::string::npos) << words << text.output;
  }
  const Json last = InfoOf("series.nrrd --frame 2", folder.Path());
  EXPECT_EQ(last["frames"], 3);
  EXPECT_EQ(last["frame"], 2);
  EXPECT_EQ(last["range"], (std::array<double, 2>{ 'q', 'x' }));
  EXPECT_EQ(Rhombic("info series.nrrd --frame 3", folder.Path()).exitCode, 2);
  EXPECT_EQ(Rhombic("mesh series.nrrd -t 100 -o a.stl", folder.Path()).exitCode, 4)
    << "which one is not for it to choose";
}

TEST(CommandLine, ALabelMapAloneIsMadeOfItsLabels)
{
  const TemporaryFolder folder;
  const std::string options = " --label heart --label 2 --no-sidecar -o ";
  const Outcome twice =
    Rhombic("mesh " + phantomLabels + " --labels " + phantomLabels + options + "twice-{name}.stl", folder.Path());
  ASSERT_EQ(twice.exitCode, 0) << twice.errors;
  const Outcome alone = Rhombic("mesh " + phantomLabels + options + "alone-{name}.stl", folder.Path());
  ASSERT_EQ(alone.exitCode, 0) << alone.errors;
  EXPECT_NE(alone.errors.find("is a label map of 23 labels"), std::string::npos) << alone.errors;
  EXPECT_EQ(alone.errors.find("mean value"), std::string::npos) << "the mean of a label's value says nothing";
  EXPECT_EQ(FilesIn(folder.Path()).size(), 4u);
  for (const std::string & file : FilesIn(folder.Path()))
  {
    const std::string name = file.substr(file.find('-'));
    EXPECT_EQ(ReadText(folder.Path() / ("alone" + name)), ReadText(folder.Path() / ("twice" + name))) << name;
  }
  const Outcome picture = Rhombic("render " + phantomLabels + " --label Heart --size 64 -o a.png", folder.Path());
  EXPECT_EQ(picture.exitCode, 0) << picture.errors;
  EXPECT_TRUE(fs::exists(folder.Path() / "a.png"));
  const Outcome surface = Rhombic("mesh " + phantomLabels + " -t 0.5 -o scan.stl", folder.Path());
  EXPECT_EQ(surface.exitCode, 0) << surface.errors;
  EXPECT_EQ(surface.errors.find("label map"), std::string::npos) << "with a threshold it is a scan: " << surface.errors;
}

TEST(CommandLine, OneOfAThingIsSingular)
{
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "labels.nrrd")
    << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nspace: LPS\n"
       "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (0,0,0)\nencoding: raw\n\n"
    << std::string(13, '\0') << '\1' << std::string(13, '\0');
  const Outcome info = Rhombic("info labels.nrrd", folder.Path());
  EXPECT_NE(info.output.find(", 1 voxel, 0.008 ml"), std::string::npos) << info.output << info.errors;
  const Outcome mesh = Rhombic("mesh labels.nrrd -o a.stl", folder.Path());
  EXPECT_EQ(mesh.exitCode, 0) << mesh.errors;
  EXPECT_NE(mesh.errors.find("label map of 1 label,"), std::string::npos) << mesh.errors;
}

TEST(CommandLine, ColoursHaveNames)
{
  const TemporaryFolder folder;
  const std::string render = "render " + phantomNifti + " --size 64 --no-sidecar --surface bone=250.5,";
  ASSERT_EQ(Rhombic(render + "gold --background white -o names.png", folder.Path()).exitCode, 0);
  ASSERT_EQ(Rhombic(render + "'#ffd700' --background '#fff' -o digits.png", folder.Path()).exitCode, 0);
  EXPECT_EQ(rhombic::ReadPicture(folder.Path() / "names.png").pixels,
            rhombic::ReadPicture(folder.Path() / "digits.png").pixels);
}

TEST(CommandLine, DoctorFindsAWayToDraw)
{
  const TemporaryFolder folder;
  const Outcome outcome = Rhombic("doctor", folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  for (const char * words : { "rendering    works", "NIfTI-1 and -2", "DICOM SEG", ".seg.nrrd" })
  {
    EXPECT_NE(outcome.output.find(words), std::string::npos) << words << outcome.output;
  }
}

TEST(CommandLine, ListsPresets)
{
  const TemporaryFolder folder;
  const Outcome outcome = Rhombic("render --list-presets", folder.Path());
  EXPECT_EQ(outcome.exitCode, 0);
  for (const char * name : { "ct-bone", "ct-skin", "ct-lung", "ct-bone-skin", "mr-head" })
  {
    EXPECT_NE(outcome.output.find(std::string(name) + "\n"), std::string::npos);
  }
  EXPECT_NE(outcome.output.find("smoothed: --denoise gaussian:1\n"), std::string::npos) << outcome.output;
}

TEST(CommandLine, TheTableIsRemovedWhereAPresetOrAnOptionSaysSo)
{
  const TemporaryFolder folder;
  const std::string dicom = RHOMBIC_TESTDATA "/phantom/dicom";
  const std::vector<std::pair<std::string, bool>> expected{
    { "mesh " + dicom + " -t -300.5 -o a.stl", false },
    { "mesh " + dicom + " -t -300.5 --remove-table -o a.stl", true },
    { "mesh " + dicom + " --preset ct-skin --keep-table -o a.stl", false },
    { "mesh " + phantomNifti + " -t -300.5 -o a.stl", false },
    { "mesh " + phantomNifti + " -t -300.5 --remove-table -o a.stl", true },
    { "render " + phantomNifti + " --surface skin=-300.5 -o a.png", false },
    { "render " + phantomNifti + " --preset ct-skin -o a.png", true },
    { "render " + phantomNifti + " --preset ct-skin --keep-table -o a.png", false },
  };
  for (const auto & [command, isRemoved] : expected)
  {
    const Outcome outcome = Rhombic(command, folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << command;
    const bool isAdvised = command.find(dicom) != std::string::npos && command.find("-table") == std::string::npos;
    EXPECT_EQ(outcome.errors.find("--remove-table removes") != std::string::npos, isAdvised) << outcome.errors;
    const char * const output = command.rfind("mesh", 0) == 0 ? "a.stl.json" : "a.png.json";
    std::ifstream stream(folder.Path() / output);
    const std::string report{ std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
    EXPECT_EQ(report.find("\"removed\"") != std::string::npos, isRemoved) << command << report;
  }
}

TEST(CommandLine, SaysNothingWhenQuietAndPlainLinesWithoutATerminal)
{
  const TemporaryFolder folder;
  const Outcome quiet = Rhombic("-q mesh " + phantomNifti + " -t 250.5 -o a.stl", folder.Path());
  EXPECT_EQ(quiet.errors + quiet.output, "");
  const Outcome normal = Rhombic("mesh " + phantomNifti + " -t 250.5 -o a.stl", folder.Path());
  EXPECT_NE(normal.errors.find("triangles"), std::string::npos);
  EXPECT_EQ(normal.errors.find('\r'), std::string::npos) << "no progress bar outside a terminal";
  EXPECT_EQ(normal.output, "");
}

// The marker on the phantom's chest is an F on the patient's left. Seen from the front it is on the picture's right,
// and its stem is on its own left: neither mirrored, nor upside down.
TEST(CommandLine, TheMarkerReadsAsAnFOnThePicturesRight)
{
  const TemporaryFolder folder;
  const std::string marker = " --surface marker=1700.5,#ffffff --annotate none --size 400 -o ";
  ASSERT_EQ(Rhombic("phantom --spacing 3 -o p", folder.Path()).exitCode, 0);
  for (const char * scan : { "p/dicom", "p/phantom.nii.gz" })
  {
    const std::string render = "render " + std::string(scan);
    const Outcome inBody = Rhombic(render + " --surface skin=-300.5,#000000,0.05" + marker + "body.png", folder.Path());
    ASSERT_EQ(inBody.exitCode, 0) << inBody.errors;
    const auto columns = BrightPixels(rhombic::ReadPicture(folder.Path() / "body.png"), true);
    double sum = 0.0;
    double weighted = 0.0;
    for (std::size_t x = 0; x < columns.size(); ++x)
    {
      sum += columns[x];
      weighted += columns[x] * static_cast<double>(x);
    }
    ASSERT_GT(sum, 0.0);
    EXPECT_GT(weighted / sum, 210.0) << "patient's left is on the picture's right";

    const Outcome alone = Rhombic(render + marker + "marker.png", folder.Path());
    ASSERT_EQ(alone.exitCode, 0) << alone.errors;
    const auto picture = rhombic::ReadPicture(folder.Path() / "marker.png");
    const auto byColumn = BrightPixels(picture, true);
    const auto byRow = BrightPixels(picture, false);
    const auto tallest = std::max_element(byColumn.begin(), byColumn.end()) - byColumn.begin();
    const auto widest = std::max_element(byRow.begin(), byRow.end()) - byRow.begin();
    EXPECT_LT(tallest, 200) << "the stem is on the left";
    EXPECT_LT(widest, 200) << "the long arm is at the top";
  }
}

TEST(CommandLine, PicturesDoNotDependOnTheRouteOrTheThreads)
{
  const TemporaryFolder folder;
  const std::string options = " --preset ct-bone-skin --size 300 -o ";
  ASSERT_EQ(Rhombic("render --threads 1 " + phantomDicom + options + "one.png", folder.Path()).exitCode, 0);
  ASSERT_EQ(Rhombic("render --threads 5 " + phantomDicom + options + "five.png", folder.Path()).exitCode, 0);
  ASSERT_EQ(Rhombic("render " + phantomNifti + options + "nifti.png", folder.Path()).exitCode, 0);
  const auto one = rhombic::ReadPicture(folder.Path() / "one.png");
  EXPECT_EQ(one.pixels, rhombic::ReadPicture(folder.Path() / "five.png").pixels);
  const auto difference = rhombic::ComparePictures(one, rhombic::ReadPicture(folder.Path() / "nifti.png"), 0.1);
  EXPECT_LT(difference.meanError, 1e-3) << "NIfTI keeps positions as 32-bit numbers";
}

// Another release of the software renderer may round differently; another colour, view or letter is far more.
TEST(CommandLine, PicturesAreThoseCommitted)
{
  const TemporaryFolder folder;
  const Outcome outcome =
    Rhombic("render " + phantomDicom + " --preset ct-bone-skin --size 300x400 -o p.png", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto difference = rhombic::ComparePictures(rhombic::ReadPicture(folder.Path() / "p.png"),
                                                   rhombic::ReadPicture(RHOMBIC_TESTDATA "/pictures/phantom-8mm.png"),
                                                   0.1);
  EXPECT_LT(difference.meanError, 2e-3);
  EXPECT_LT(difference.differingPixels, 300u) << "of 120,000";
}

TEST(CommandLine, MeshesHaveTheSameBytesForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  for (const char * extension : { "stl", "ply", "vtp" })
  {
    const std::string options = " -t 250.5 " + phantomNifti + " -o ";
    ASSERT_EQ(Rhombic("mesh --threads 1" + options + "one." + extension, folder.Path()).exitCode, 0);
    ASSERT_EQ(Rhombic("mesh --threads 7" + options + "seven." + extension, folder.Path()).exitCode, 0);
    EXPECT_EQ(ReadText(folder.Path() / (std::string("one.") + extension)),
              ReadText(folder.Path() / (std::string("seven.") + extension)));
  }
}

TEST(CommandLine, ModesAndLatticesGiveDifferentMeshesLeanBeingTheDefault)
{
  const TemporaryFolder folder;
  const auto mesh = [&folder](const std::string & options) {
    const Outcome outcome = Rhombic("mesh " + phantomNifti + " -t 250.5 -o a.stl " + options, folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << options << outcome.errors;
    return ReadText(folder.Path() / "a.stl");
  };
  std::set<std::string> meshes;
  const std::vector<std::string> choices{ "--mode fine",      "--mode tetrahedra",
                                          "--mode octahedra", "--mode parallelepipeds",
                                          "--kernel linear",  "--kernel lanczos",
                                          "--nested",         "--mode fine --nested" };
  for (const std::string & options : choices)
  {
    EXPECT_TRUE(meshes.insert(mesh(options)).second) << options;
  }
  const std::string usual = mesh("");
  EXPECT_TRUE(meshes.insert(usual).second);
  EXPECT_EQ(mesh("--mode lean --kernel cubic"), usual);
}

TEST(CommandLine, RendersWithEveryMode)
{
  const TemporaryFolder folder;
  for (const char * mode : { "lean", "fine", "tetrahedra", "octahedra", "parallelepipeds" })
  {
    const std::string picture = std::string(mode) + ".png";
    const Outcome outcome = Rhombic(
      "render " + phantomNifti + " --preset ct-bone-skin --size 64 --mode " + mode + " -o " + picture, folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << mode << outcome.errors;
    EXPECT_TRUE(fs::exists(folder.Path() / picture));
  }
}

TEST(CommandLine, TheLatticeVolumeGivesTheSameMeshAsTheScan)
{
  const TemporaryFolder folder;
  const Outcome outcome = RunShell("rhombic resample '" + phantomNifti +
                                     "' -o p.fcc.nrrd\n"
                                     "rhombic mesh p.fcc.nrrd -t 250.5 -o a.stl\n"
                                     "rhombic mesh '" +
                                     phantomNifti +
                                     "' -t 250.5 -o b.stl\n"
                                     "cmp a.stl b.stl\n"
                                     "rhombic info p.fcc.nrrd\n"
                                     "rhombic resample p.fcc.nrrd -o back.nii.gz\n"
                                     "rhombic info back.nii.gz\n",
                                   folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("face-centered cubic"), std::string::npos) << outcome.output;
}

TEST(CommandLine, SeveralViewsGetTheirNames)
{
  const TemporaryFolder folder;
  ASSERT_EQ(
    Rhombic("render " + phantomNifti + " --preset ct-bone --view all --size 64 --no-sidecar -o p.jpg", folder.Path())
      .exitCode,
    0);
  EXPECT_EQ(FilesIn(folder.Path()),
            (std::set<std::string>{
              "p-anterior.jpg", "p-posterior.jpg", "p-left.jpg", "p-right.jpg", "p-superior.jpg", "p-inferior.jpg" }));
}

TEST(CommandLine, SidecarsTellWhatWasReadAndDone)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "DOE_JOHN");
  fs::copy(phantomNifti, folder.Path() / "DOE_JOHN" / "doe_john_1970.nii.gz");
  ASSERT_EQ(Rhombic("mesh DOE_JOHN/doe_john_1970.nii.gz -t 375.5 --mode fine -o bone.stl", folder.Path()).exitCode, 0);
  const std::string text = ReadText(folder.Path() / "bone.stl.json");
  for (const char * part : { "\"output\": \"bone.stl\"",
                             "\"command\": \"rhombic mesh SCAN --threshold=375.5 --mode=fine\"",
                             "\"format\": \"NIfTI\"",
                             "\"orientation\": \"LPS\"",
                             "\"isovalue_scan_unit\": 375.5",
                             "\"triangles\":",
                             "face-centered cubic" })
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  }
  EXPECT_EQ(text.find("DOE"), std::string::npos) << text;
  EXPECT_EQ(text.find("doe"), std::string::npos) << text;
  ASSERT_EQ(Rhombic("resample " + phantomNifti + " -o a.fcc.nrrd", folder.Path()).exitCode, 0);
  EXPECT_TRUE(fs::exists(folder.Path() / "a.fcc.nrrd.json"));
}

TEST(CommandLine, LabelMapsAreToldWithTheirLabels)
{
  const TemporaryFolder folder;
  const std::string labels = RHOMBIC_TESTDATA "/phantom/phantom-labels.nii.gz";
  const Outcome outcome = Rhombic("info " + phantomDicom + " --labels " + labels, folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find(" ml"), std::string::npos) << outcome.output;
}

TEST(CommandLine, MetadataNamesTheCommandButNeitherTheScanNorItsFolder)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "DOE_JOHN");
  fs::copy(phantomNifti, folder.Path() / "DOE_JOHN" / "doe_john_1970.nii.gz");
  ASSERT_EQ(
    Rhombic("render DOE_JOHN/doe_john_1970.nii.gz --preset ct-bone --size 64 --output=DOE_JOHN/p.tif", folder.Path())
      .exitCode,
    0);
  const std::string bytes = ReadText(folder.Path() / "DOE_JOHN" / "p.tif");
  EXPECT_NE(bytes.find("rhombic render SCAN --preset=ct-bone --size=64"), std::string::npos);
  EXPECT_EQ(bytes.find("p.tif"), std::string::npos) << "the output's name has no effect on the picture";
  EXPECT_NE(bytes.find("Rhombic 0."), std::string::npos);
  ASSERT_EQ(
    Rhombic("render " + phantomDicom + " --series 1 --preset ct-bone --size 64 -o s.tif", folder.Path()).exitCode, 0);
  EXPECT_NE(ReadText(folder.Path() / "s.tif").find("--series=SERIES"), std::string::npos);
  EXPECT_EQ(bytes.find("DOE"), std::string::npos);
  EXPECT_EQ(bytes.find("doe"), std::string::npos);
}

} // namespace
