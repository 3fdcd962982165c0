#include "rhombicPictureIO.h"
#include "rhombicProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;

const std::string phantomScan = RHOMBIC_TESTDATA "/phantom/phantom.nii.gz";
const std::string phantomLabels = RHOMBIC_TESTDATA "/phantom/phantom-labels.nii.gz";

/** Runs `rhombic render` in a new folder. */
class RenderCommand : public testing::Test
{
protected:
  Outcome
  Run(const std::string & arguments) const
  {
    return rhombictest::RunShell("rhombic " + arguments, m_Folder.Path());
  }

  void
  RunWell(const std::string & arguments) const
  {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.errors;
  }

  rhombic::Picture
  Read(const std::string & name) const
  {
    return rhombic::ReadPicture(m_Folder.Path() / name);
  }

  std::string
  Bytes(const std::string & name) const
  {
    return ReadText(m_Folder.Path() / name);
  }

  std::size_t
  CountFiles() const
  {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_Folder.Path()), fs::directory_iterator()));
  }

  rhombictest::TemporaryFolder m_Folder;
};

/** Middle of the pixels that are redder than blue, from the left and top, as shares of the picture. */
std::array<double, 2>
MiddleOfRed(const rhombic::Picture & picture)
{
  double x = 0.0;
  double y = 0.0;
  double count = 0.0;
  for (int row = 0; row < picture.height; ++row)
  {
    for (int column = 0; column < picture.width; ++column)
    {
      const std::uint8_t * const pixel = picture.At(column, row);
      if (pixel[0] > 100 && pixel[1] < 60 && pixel[2] < 60)
      {
        x += column + 0.5;
        y += row + 0.5;
        count += 1.0;
      }
    }
  }
  EXPECT_GT(count, 0.0);
  return { x / count / picture.width, y / count / picture.height };
}

TEST_F(RenderCommand, TheLiverIsOnTheSideOfItsLetter)
{
  // In the patient the liver is on the right: on the left of the anterior view and of radiological slices.
  const std::string red = phantomLabels + " --draw '*=white' --draw liver=red --no-shadows --no-silhouettes "
                                          "--annotate none --size 300 ";
  RunWell("render " + red +
          "--only 'liver,spleen' --view anterior --view posterior --view superior --view 30,15 -o v.png");
  EXPECT_LT(MiddleOfRed(Read("v-anterior.png"))[0], 0.5);
  EXPECT_GT(MiddleOfRed(Read("v-posterior.png"))[0], 0.5);
  EXPECT_GT(MiddleOfRed(Read("v-superior.png"))[0], 0.5);
  EXPECT_LT(MiddleOfRed(Read("v-az30el15.png"))[0], 0.5);
  for (const bool isNeurological : { false, true })
  {
    const std::string convention = isNeurological ? "--neurological" : "";
    RunWell("render " + red + "--slice axial=liver --slice coronal=liver " + convention + " -o s.png");
    for (const char * name : { "s-axial-liver.png", "s-coronal-liver.png" })
    {
      EXPECT_EQ(MiddleOfRed(Read(name))[0] > 0.5, isNeurological) << name;
    }
  }
}

TEST_F(RenderCommand, NamesStandBesideTheirSurfaces)
{
  const std::string one = phantomLabels + " --only liver --draw liver=red --no-sidecar ";
  RunWell("--threads 1 render " + one + "--size 400x300 --annotate names -o one.png");
  RunWell("--threads 3 render " + one + "--size 400x300 --annotate names -o three.png");
  EXPECT_EQ(Bytes("one.png"), Bytes("three.png"));
  RunWell("render " + one + "--sheet --annotate letters -o plain.pdf");
  RunWell("render " + one + "--sheet --annotate names -o names.pdf");
  if (std::system("command -v pdftotext >/dev/null") != 0)
  {
    GTEST_SKIP() << "pdftotext is not installed (package poppler-utils)";
  }
  const auto count = [this](const std::string & file, const std::string & word) {
    const std::string text = rhombictest::RunShell("pdftotext " + file + " -", m_Folder.Path()).output;
    int found = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
    {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count("names.pdf", "liver"), count("plain.pdf", "liver") + 4) << "once in each view";
  EXPECT_EQ(count("names.pdf", "0 cm"), 0) << "no scale bar";
}

TEST_F(RenderCommand, CutsRemoveTheSideThatIsSaid)
{
  // Of the liver, half is left; the cut at its centroid faces the viewer.
  const std::string options = phantomLabels + " --only liver --draw liver=red --annotate none --size 200 "
                                              "--no-shadows --no-silhouettes --focus liver ";
  RunWell("render " + options + "-o whole.png");
  const auto red = [this](const std::string & name) {
    const rhombic::Picture picture = Read(name);
    int count = 0;
    for (std::size_t n = 0; n < picture.pixels.size(); n += 3)
    {
      count += picture.pixels[n] > 60 ? 1 : 0;
    }
    return count;
  };
  const int whole = red("whole.png");
  for (const char * cut : { "axial=liver", "sagittal=liver", "'x>-70'", "'x<-70'" })
  {
    RunWell("render " + options + "--cut " + cut + " -o cut.png");
    EXPECT_LT(red("cut.png"), 0.9 * whole) << cut;
    EXPECT_GT(red("cut.png"), 0.1 * whole) << cut;
  }
  RunWell("render " + options + "--cut coronal=liver -o front.png");
  EXPECT_GT(red("front.png"), 0.5 * whole) << "the cut face itself is seen";
  EXPECT_NE(Bytes("front.png"), Bytes("whole.png"));
}

/** The number of red pixels. */
int
CountRed(const rhombic::Picture & picture)
{
  int count = 0;
  for (std::size_t n = 0; n < picture.pixels.size(); n += 3)
  {
    const std::uint8_t * const pixel = &picture.pixels[n];
    count += pixel[0] > 30 && pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2] ? 1 : 0;
  }
  return count;
}

TEST_F(RenderCommand, WhatHidesTheFocusIsTranslucent)
{
  const std::string options = phantomLabels + " --draw '*=white' --draw 'right kidney=red' --annotate none --size 200 "
                                              "--no-shadows --no-silhouettes --focus 'right kidney' ";
  RunWell("render " + options + "--view anterior -o ghost.png");
  RunWell("render " + options + "--view anterior --ghost 1 -o as-it-is.png");
  RunWell("render " + options + "--view anterior --ghost 0 -o left-out.png");
  RunWell("render " + options + "--only 'right kidney' --view anterior -o alone.png");
  const int whole = CountRed(Read("alone.png"));
  const int ghost = CountRed(Read("ghost.png"));
  EXPECT_LT(CountRed(Read("as-it-is.png")),
            0.9 * ghost); // skin, fat and muscle, which enclose it, are translucent, too
  EXPECT_GT(ghost, 0.5 * whole);
  EXPECT_GT(CountRed(Read("left-out.png")), 0.9 * whole); // what hides very little of it stays
}

TEST_F(RenderCommand, TheFocusIsSeenFromTheSideWhereLeastOfItIsHidden)
{
  const std::string options = phantomLabels + " --draw '*=white' --draw 'right kidney=red' --annotate none --size 200 "
                                              "--ghost 1 --focus 'right kidney' ";
  RunWell("render " + options + "-o chosen.png");
  RunWell("render " + options + "--view all -o each.png");
  const std::string view = nlohmann::json::parse(Bytes("chosen.png.json"))["focus"]["view"];
  EXPECT_EQ(Read("chosen.png").pixels, Read("each-" + view + ".png").pixels) << view;
  EXPECT_FALSE(nlohmann::json::parse(Bytes("each-left.png.json"))["focus"].contains("view"));
}

TEST_F(RenderCommand, SurfacesAroundOthersAreTranslucentUnlessAnOpacityWasAskedFor)
{
  // Of the phantom's torso as an isosurface, with the labels inside it.
  const std::string options = phantomScan + " --labels " + phantomLabels + " --only liver,torso --size 64 --surface ";
  RunWell("render " + options + "torso=-300.5,white -o opened.png");
  EXPECT_EQ(nlohmann::json::parse(Bytes("opened.png.json"))["opened"], nlohmann::json({ "torso" }));
  RunWell("render " + options + "torso=-300.5,white,1 -o asked.png");
  EXPECT_FALSE(nlohmann::json::parse(Bytes("asked.png.json")).contains("opened"));
}

TEST_F(RenderCommand, WithoutSurfacesThePresetIsThatOfAuto)
{
  const Outcome unasked = Run("render " + phantomScan + " --size 64 -o unasked.png");
  EXPECT_EQ(unasked.exitCode, 0) << unasked.errors;
  EXPECT_NE(unasked.errors.find("no surface is chosen; --preset auto takes ct-bone-skin"), std::string::npos)
    << unasked.errors;
  RunWell("render " + phantomScan + " --size 64 --preset auto -o auto.png");
  EXPECT_EQ(Read("unasked.png").pixels, Read("auto.png").pixels);
  RunWell("render " + phantomLabels + " --size 64 -o labels.png");
  EXPECT_FALSE(nlohmann::json::parse(Bytes("labels.png.json")).contains("preset"));
}

TEST_F(RenderCommand, TheSameCommandMakesTheSameFilesWithAnyNumberOfThreads)
{
  const std::string options = phantomScan + " --labels " + phantomLabels +
                              " --preset ct-organs --cut coronal=liver --slice axial=liver --view 20,10 --size 250 ";
  RunWell("--threads 1 render " + options + "-o one.png");
  RunWell("--threads 5 render " + options + "-o five.png");
  for (const char * view : { "-az20el10.png", "-axial-liver.png" })
  {
    EXPECT_EQ(Bytes(std::string("one") + view), Bytes(std::string("five") + view)) << view;
  }
  RunWell("--threads 1 render " + phantomLabels + " --sheet --no-sidecar -o one.pdf");
  RunWell("--threads 3 render " + phantomLabels + " --sheet --no-sidecar -o three.pdf");
  EXPECT_EQ(Bytes("one.pdf"), Bytes("three.pdf"));
}

TEST_F(RenderCommand, AReportMakesItsPictureAgain)
{
  RunWell("--threads 2 render " + phantomScan + " --preset auto --view left --style paper --size 200 -o first.png");
  RunWell("-q --threads 1 render " + phantomScan + " --from first.png.json -o second.png");
  EXPECT_EQ(Bytes("first.png"), Bytes("second.png")) << "metadata holds what has an effect on the picture only";
  EXPECT_EQ(Run("compare-pictures first.png second.png").exitCode, 0);
  RunWell("render " + phantomScan + " --from second.png.json -o third.png");
  EXPECT_EQ(Bytes("first.png"), Bytes("third.png")) << "the report of a repetition holds all settings";
  RunWell("render " + phantomScan + " --from second.png.json --size 100 -o small.png");
  EXPECT_EQ(Read("small.png").width, 100) << "settings that are given count more";
  RunWell("render " + phantomScan + " --preset ct-bone-skin --view right --style paper --size 200 -o other.png");
  const Outcome outcome = Run("compare-pictures first.png other.png --tolerance 2");
  EXPECT_EQ(outcome.exitCode, 11);
  EXPECT_NE(outcome.errors.find("by more than 2 of 255"), std::string::npos) << outcome.errors;
}

TEST_F(RenderCommand, InteractivePagesTellWhetherAFaceIsInThem)
{
  const std::string command = "render " + phantomScan + " --labels " + phantomLabels;
  RunWell(command + " --label brain -o head.html");
  EXPECT_NE(Bytes("head.html").find("but the head is, and a face can be recognised"), std::string::npos);
  RunWell(command + " --label liver -o body.html");
  EXPECT_NE(Bytes("body.html").find("if the head is in the scan, the face can be recognised"), std::string::npos);
  RunWell(command + " --label liver --no-slices -o liver.html");
  EXPECT_NE(Bytes("liver.html").find("privacy: no name"), std::string::npos);
  EXPECT_EQ(Bytes("liver.html").find("face can be recognised"), std::string::npos);
}

TEST_F(RenderCommand, ReportsHoldSettingsAndNothingOfThePatient)
{
  fs::create_directories(m_Folder.Path() / "Doe");
  fs::copy(RHOMBIC_SOURCE "/pipelines/presets/ct-bone.yaml", m_Folder.Path() / "Doe/mine.yaml");
  RunWell("-v --threads 2 render " + phantomScan + " --labels " + phantomLabels +
          " --preset Doe/mine.yaml --slice axial --window 350/50 --only 'bone,liver' --dpi=90 --sheet --max-memory 2G "
          "-o Doe/page.png");
  const auto report = nlohmann::ordered_json::parse(Bytes("Doe/page.png.json"));
  const nlohmann::ordered_json expected{ { "scan", "SCAN" },
                                         { "preset", "mine.yaml" },
                                         { "labels", { "LABELS" } },
                                         { "only", { "bone", "liver" } },
                                         { "slice", { "axial" } },
                                         { "sheet", true },
                                         { "dpi", 90 },
                                         { "window", "350/50" } };
  EXPECT_EQ(report["settings"], expected) << report["settings"];
  EXPECT_EQ(report["command"],
            "rhombic render SCAN --preset=mine.yaml --labels=LABELS --only=bone --only=liver --slice=axial --sheet "
            "--dpi=90 --window=350/50");
}

TEST_F(RenderCommand, AReportOfBeforeMakesItsPictureAgain)
{
  const std::string options = " --preset auto --view left --size 150 --window bone";
  RunWell("render " + phantomScan + options + " -o first.png");
  std::ofstream(m_Folder.Path() / "old.json")
    << R"({"command": "rhombic -q render SCAN", "arguments": ["-q", "--threads",
    "2", "render", "SCAN", "--preset", "auto", "--view", "left", "--size=150", "-ofirst.png", "--window", "bone",
    "--dicom-sc"]})";
  RunWell("render " + phantomScan + " --from old.json -o second.png");
  EXPECT_EQ(Bytes("first.png"), Bytes("second.png"));
  EXPECT_FALSE(fs::exists(m_Folder.Path() / "second.dcm"));
}

TEST_F(RenderCommand, AReportOfLabelsMakesItsPictureAgainOnlyWithLabels)
{
  const std::string labels = " --labels " + phantomLabels;
  RunWell("render " + phantomScan + labels + " --only liver --size 150 -o first.png");
  const Outcome refused = Run("render " + phantomScan + " --from first.png.json -o second.png");
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.errors.find("give --labels again"), std::string::npos) << refused.errors;
  RunWell("render " + phantomScan + labels + " --from first.png.json -o second.png");
  EXPECT_EQ(Bytes("first.png"), Bytes("second.png"));
  RunWell("render " RHOMBIC_TESTDATA "/phantom/dicom --series 1 --surface s=375.5 --size 150 -o series.png");
  RunWell("render " + phantomScan + " --from series.png.json -o third.png"); // which has no series
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep memory for themselves

/** Runs the program. Returns the most memory that it had, in MiB. One thread draws all: where other threads of Mesa
 * draw, a picture begins before they have ended the last one if the machine is busy, and then takes another 20 MiB. */
double
FindPeakMemory(std::vector<std::string> arguments)
{
  const std::string program = RHOMBIC_PROGRAM_FOLDER "/rhombic";
  arguments.insert(arguments.begin(), { program, "-q", "--threads", "1" });
  std::vector<char *> words;
  for (std::string & argument : arguments)
  {
    words.push_back(argument.data());
  }
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0)
  {
    setenv("LP_NUM_THREADS", "0", 1);
    execv(program.c_str(), words.data());
    _exit(127);
  }
  int status = -1;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

TEST_F(RenderCommand, InteractivePagesNeedNoMoreMemoryThanSheetsButForTheirSize)
{
  const std::vector<std::string> labels{ "render", phantomScan, "--labels", phantomLabels };
  const auto draw = [&](const std::string & option, const fs::path & file) {
    std::vector<std::string> arguments = labels;
    arguments.insert(arguments.end(), { option, "-o", file });
    return FindPeakMemory(arguments);
  };
  constexpr double ofMorePictures = 6.0; // MiB: 28 pictures of 3D, not 4, leave about 2 MiB
  const double ofSheet = draw("--sheet", m_Folder.Path() / "sheet.pdf");
  const double ofPage = draw("--no-sidecar", m_Folder.Path() / "page.html");
  const double sizeOfPage = static_cast<double>(fs::file_size(m_Folder.Path() / "page.html")) / (1024.0 * 1024.0);
  EXPECT_LT(ofPage, ofSheet + sizeOfPage + ofMorePictures);
}

#endif

TEST_F(RenderCommand, PagesListAllLabelsWithTheirVolumes)
{
  RunWell("render " + phantomLabels + " --sheet -o page.pdf");
  EXPECT_EQ(CountFiles(), 2u) << "the page and its report";
  if (std::system("command -v pdftotext >/dev/null") != 0)
  {
    GTEST_SKIP() << "pdftotext is not installed (package poppler-utils)";
  }
  const std::string text = rhombictest::RunShell("pdftotext -layout page.pdf -", m_Folder.Path()).output;
  std::ifstream organs(RHOMBIC_TESTDATA "/phantom/phantom-organs.csv");
  std::string line;
  std::getline(organs, line);
  int found = 0;
  while (std::getline(organs, line))
  {
    const std::string name = line.substr(0, line.find(','));
    found += text.find(name) != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(found, 15) << text;
  EXPECT_EQ(text.find("phantom-labels"), std::string::npos) << "a file's name may be the patient's";
}

TEST_F(RenderCommand, TurntablesAreOneAnimationOrNumberedPictures)
{
  RunWell("render " + phantomLabels + " --only liver --turntable 6 --size 120 --no-sidecar -o turn.gif");
  EXPECT_EQ(rhombic::ReadPictures(m_Folder.Path() / "turn.gif").size(), 6u);
  RunWell("render " + phantomLabels + " --only liver --turntable 3 --size 120 --no-sidecar -o turn.png");
  std::set<std::string> pictures;
  for (const char * name : { "turn-001.png", "turn-002.png", "turn-003.png" })
  {
    EXPECT_TRUE(pictures.insert(Bytes(name)).second) << name;
  }
}

TEST_F(RenderCommand, SurfaceFilesAreDrawnAsTheirScanIs)
{
  RunWell("mesh " + phantomScan + " --surface bone=375.5,white -o bone.ply");
  RunWell("render bone.ply --size 200 --annotate letters -o file.png");
  RunWell("render " + phantomScan + " --surface bone=375.5,white --size 200 --annotate letters -o scan.png");
  EXPECT_EQ(Run("compare-pictures file.png scan.png --tolerance 40").exitCode, 0);
}

TEST_F(RenderCommand, NamesOfSurfaceFilesAreNotWritten)
{
  RunWell("mesh " + phantomScan + " -t 375.5 --no-sidecar -o Doe.ply");
  fs::copy(m_Folder.Path() / "Doe.ply", m_Folder.Path() / "Jane.ply");
  RunWell("render Doe.ply Jane.ply --size 100 -o both.png");
  for (const char * file : { "both.png", "both.png.json" })
  {
    EXPECT_EQ(Bytes(file).find("Doe"), std::string::npos) << file;
    EXPECT_EQ(Bytes(file).find("Jane"), std::string::npos) << file;
  }
}

TEST_F(RenderCommand, AReportOfOneOfSeveralPicturesMakesThatOne)
{
  RunWell("render " + phantomScan +
          " --preset ct-bone --view left --view superior --slice axial=bone --size 0x200 -o a.png");
  for (const char * picture : { "a-left", "a-superior", "a-axial-bone" })
  {
    const std::string name = picture;
    RunWell("render " + phantomScan + " --from " + name + ".png.json -o again.png");
    EXPECT_EQ(Read(name + ".png").pixels, Read("again.png").pixels) << name;
    RunWell("render " + phantomScan + " --from again.png.json -o third.png");
    EXPECT_EQ(Read(name + ".png").pixels, Read("third.png").pixels) << name;
  }
  RunWell("render " + phantomScan + " --from a-left.png.json --view right -o right.png");
  EXPECT_NE(Read("right.png").pixels, Read("a-left.png").pixels);
}

TEST_F(RenderCommand, PicturesHaveTheScaleThatIsAskedFor)
{
  const std::string render = "render " + phantomScan + " --preset ct-skin --annotate none --no-letters ";
  RunWell(render + "--pixel-size 1 -o coarse.png");
  RunWell(render + "--pixel-size 0.5 -o fine.png");
  EXPECT_NEAR(Read("fine.png").width, 2 * Read("coarse.png").width, 4);
  EXPECT_NEAR(Read("fine.png").height, 2 * Read("coarse.png").height, 4);
  RunWell(render + "--same-scale --view anterior --view superior -o view.png");
  EXPECT_EQ(Read("view-anterior.png").width, Read("view-superior.png").width) << "both from right to left";
  EXPECT_NE(Read("view-anterior.png").height, Read("view-superior.png").height);
}

TEST_F(RenderCommand, LightboxesAndTurntablesHaveOneSize)
{
  const auto expectSize = [this](const std::string & name, int width, int height) {
    const rhombic::Picture picture = Read(name);
    EXPECT_EQ(picture.width, width) << name;
    EXPECT_EQ(picture.height, height) << name;
  };
  const std::string lightbox = "render " + phantomScan + " --preset ct-bone --slice axial --lightbox 7 --size ";
  RunWell(lightbox + "501x407 -o box.png");
  expectSize("box.png", 501, 407);
  RunWell(lightbox + "501x0 -o wide.png");
  EXPECT_EQ(Read("wide.png").width, 501);
  RunWell("render " + phantomLabels + " --only 'liver,*lung*' --turntable 3 -o turn.png");
  const rhombic::Picture first = Read("turn-001.png");
  expectSize("turn-002.png", first.width, first.height);
  expectSize("turn-003.png", first.width, first.height);
  EXPECT_EQ(std::max(first.width, first.height), 1200);
}

TEST_F(RenderCommand, SlicesOfLabelsWithoutAScanAreFilled)
{
  RunWell("render " + phantomLabels +
          " --only liver --draw liver=red --slice axial=liver --annotate none --no-outlines "
          "-o slice.png");
  const rhombic::Picture slice = Read("slice.png");
  const std::uint8_t * const outside = slice.At(5, 5);
  EXPECT_GT(outside[0], 30) << "not black";
  EXPECT_EQ(outside[0], outside[2]);
  const auto middle = MiddleOfRed(slice);
  const std::uint8_t * const inside =
    slice.At(static_cast<int>(middle[0] * slice.width), static_cast<int>(middle[1] * slice.height));
  EXPECT_GT(inside[0], 120);
  EXPECT_LT(inside[2], 60);
}

TEST_F(RenderCommand, BadRequestsAreRefusedInOneSentenceAndLeaveNothing)
{
  struct Request
  {
    const char * arguments;
    int exitCode;
    const char * says;
  };
  const std::string bone = "render " + phantomScan + " --preset ct-bone ";
  const std::string labels = "render " + phantomLabels + " ";
  for (const Request & request : std::vector<Request>{
         { "--size 31", 2, "at least 32 pixels" },
         { "--cut axial=1e9", 2, "reaches from -14 to 714 mm" },
         { "--cut 'axial>1e9'", 2, "reaches from -14 to 714 mm" },
         { "--cut 'sideways>1'", 2, "not understood" },
         { "--slice coronal=-1e9", 2, "choose a place in between" },
         { "--show-slice sagittal=#999", 2, "slices 0 to 53" },
         { "--focus bon", 2, "did you mean bone?" },
         { "--cut axial --uncut bon", 2, "did you mean bone?" },
         { "--slice axial=bon", 2, "did you mean bone?" },
         { "--turntable 720 --size 3000 --max-memory 1G", 9, "--size" },
         { "--sheet --dpi 600 --max-memory 100M", 9, "--dpi" },
       })
  {
    const Outcome outcome = Run(bone + request.arguments + " -q -o picture.png");
    EXPECT_EQ(outcome.exitCode, request.exitCode) << request.arguments << outcome.errors;
    EXPECT_NE(outcome.errors.find(request.says), std::string::npos) << request.arguments << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_EQ(CountFiles(), 0u) << request.arguments;
  }
  EXPECT_NE(Run(labels + "-o a.gif").errors.find("Only --turntable writes .gif"), std::string::npos);
  EXPECT_NE(Run(labels + "-o a.pdf").errors.find("Only --sheet writes .pdf"), std::string::npos);
  EXPECT_NE(Run(labels + "--turntable 8 -o a.webm").errors.find("ffmpeg"), std::string::npos);
  EXPECT_NE(Run(labels + "--only livr -o a.png").errors.find("did you mean liver?"), std::string::npos);
  EXPECT_NE(Run(labels + "--only liver --hide liver -o a.png").errors.find("No surface is left"), std::string::npos);
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(RenderCommand, SurfaceFilesTakeNoOptionsThatChooseSurfacesOfScans)
{
  RunWell("mesh " + phantomScan + " -t 375.5 -o bone.stl");
  for (const std::string & options :
       std::vector<std::string>{ "--preset ct-bone-skin", "--surface bone=375.5", "--labels " + phantomLabels })
  {
    const Outcome outcome = Run("render bone.stl " + options + " -o bone.png");
    EXPECT_EQ(outcome.exitCode, 2) << options;
    EXPECT_NE(outcome.errors.find("of surface files, --only and --hide"), std::string::npos) << outcome.errors;
  }
}

/** A scan whose voxels can't be read tells what is checked before they are. */
TEST_F(RenderCommand, OptionsAndHeadersAreCheckedBeforeVoxelsAreRead)
{
  const std::string whole = ReadText(phantomScan);
  std::ofstream(m_Folder.Path() / "cut.nii.gz", std::ios::binary) << whole.substr(0, whole.size() / 2);
  for (const std::string preset : { "ct-bone", "auto" })
  {
    const std::string command = "render cut.nii.gz --preset " + preset + " -o a.png ";
    EXPECT_EQ(Run(command).exitCode, 4) << "the voxels";
    for (const auto & [options, expected] :
         { std::pair<std::string, std::string>{ "--slice axial=#500", "There is no axial slice 500" },
           { "--slice axial=#x", "'#x' is no slice" },
           { "--slice axial=9999", "is outside of what is shown" },
           { "--show-slice axial=#500", "There is no axial slice 500" },
           { "--cut 'x>9999'", "is outside of what is shown" },
           { "--slice axial --window lungs", "did you mean lung?" },
           { "--sheet --window lungs", "did you mean lung?" },
           { "--sheet --slice axial=#500", "There is no axial slice 500" },
           { "--view lefft", "did you mean left?" },
           { "--annotate leters", "did you mean letters?" },
           { "--size 3", "is no picture size" } })
    {
      const Outcome outcome = Run(command + options);
      EXPECT_EQ(outcome.exitCode, 2) << preset << " " << options << "\n" << outcome.errors;
      EXPECT_NE(outcome.errors.find(expected), std::string::npos) << options << "\n" << outcome.errors;
    }
    EXPECT_EQ(Run("mesh cut.nii.gz --preset " + preset + " -o a.xyz").exitCode, 2);
    EXPECT_EQ(Run("mesh cut.nii.gz --preset " + preset + " -o a.glb --measures a.txt").exitCode, 2);
  }
  for (const std::string option : { "--focus bonne", "--only bonne", "--hide bonne", "--slice axial=bonne" })
  {
    const Outcome outcome = Run("render cut.nii.gz --preset ct-bone -o a.png " + option);
    EXPECT_EQ(outcome.exitCode, 2) << option;
    EXPECT_NE(outcome.errors.find("did you mean bone?"), std::string::npos) << outcome.errors;
  }
  const Outcome kidney = Run("render " + phantomLabels + " --focus kidny -o a.png");
  EXPECT_EQ(kidney.exitCode, 2);
  EXPECT_NE(kidney.errors.find("did you mean "), std::string::npos) << kidney.errors;
  EXPECT_EQ(CountFiles(), 1u);
}

} // namespace
