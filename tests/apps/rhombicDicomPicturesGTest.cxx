#include "rhombicPictureIO.h"
#include "rhombicProgram.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

constexpr char render[] = "rhombic render " RHOMBIC_TESTDATA "/phantom/dicom --preset ct-bone --dicom-sc ";

/** The pixels of a binary PPM file of 8 bits. */
std::string
PixelsOfPPM(const fs::path & path)
{
  std::istringstream stream(ReadText(path));
  std::string format;
  int width = 0;
  int height = 0;
  int largest = 0;
  stream >> format >> width >> height >> largest;
  std::string pixels(static_cast<std::size_t>(3 * width * height), '\0');
  stream.ignore(1);
  stream.read(pixels.data(), static_cast<std::streamsize>(pixels.size()));
  return format == "P6" && largest == 255 && stream ? pixels : "";
}

std::string
PixelsOf(const fs::path & picture)
{
  const auto pixels = rhombic::ReadPicture(picture).pixels;
  return std::string(pixels.begin(), pixels.end());
}

// DCMTK reads them, and dicom3tools' validator finds no error.
TEST(DicomPictures, AreThePicturesToOtherPrograms)
{
  if (std::system("command -v dcm2pnm >/dev/null && command -v dciodvfy >/dev/null") != 0)
  {
    GTEST_SKIP() << "dcmtk or dicom3tools is not installed";
  }
  const TemporaryFolder folder;
  for (const char * const output : { "--sheet --dpi 50 -o page.png",
                                     "--view all --slice axial --size 101 -o views.png",
                                     "--turntable 5 --size 99x100 -o turn.png" })
  {
    const Outcome outcome = RunShell(render + std::string(output), folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  }
  std::size_t files = 0;
  for (const auto & entry : fs::directory_iterator(folder.Path()))
  {
    if (entry.path().extension() != ".dcm")
    {
      continue;
    }
    ++files;
    const std::string name = entry.path().stem().string();
    const Outcome valid = RunShell("dciodvfy " + name + ".dcm && dcmdump " + name + ".dcm", folder.Path());
    EXPECT_EQ(valid.exitCode, 0) << name << valid.errors;
    EXPECT_EQ(valid.errors.find("Error"), std::string::npos) << name << valid.errors;
    const Outcome decoded = RunShell("dcm2pnm --all-frames " + name + ".dcm " + name, folder.Path());
    ASSERT_EQ(decoded.exitCode, 0) << decoded.errors;
    for (int frame = 0; name == "turn" && frame < 5; ++frame)
    {
      const std::string number = std::to_string(frame);
      EXPECT_EQ(PixelsOfPPM(folder.Path() / ("turn." + number + ".ppm")),
                PixelsOf(folder.Path() / ("turn-00" + std::to_string(frame + 1) + ".png")));
    }
    if (name != "turn")
    {
      EXPECT_EQ(PixelsOfPPM(folder.Path() / (name + ".0.ppm")), PixelsOf(folder.Path() / (name + ".png"))) << name;
    }
  }
  EXPECT_EQ(files, 9u) << "a page, six views and a slice, a turntable";
}

TEST(DicomPictures, AreTheSameBytesAgainAndForAnyThreads)
{
  const TemporaryFolder folder;
  for (const char * const run : { "--threads 1 --size 80 -o a.png", "--threads 3 --size 80 -o b.png" })
  {
    ASSERT_EQ(RunShell(render + std::string(run), folder.Path()).exitCode, 0);
  }
  EXPECT_EQ(ReadText(folder.Path() / "a.dcm"), ReadText(folder.Path() / "b.dcm"));
  EXPECT_GT(fs::file_size(folder.Path() / "a.dcm"), 80u * 80u * 3u);
}

TEST(DicomPictures, AreMadeOfDicomOnlyAndWhenAsked)
{
  const TemporaryFolder folder;
  ASSERT_EQ(RunShell(render + std::string("--size 64 -o a.png"), folder.Path()).exitCode, 0);
  fs::remove(folder.Path() / "a.dcm");
  const Outcome again =
    RunShell("rhombic -q render " RHOMBIC_TESTDATA "/phantom/dicom --from a.png.json -o b.png", folder.Path());
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_FALSE(fs::exists(folder.Path() / "b.dcm")) << "the report of another picture does not ask for it";
  fs::copy(RHOMBIC_TESTDATA "/phantom/dicom", folder.Path() / "scan");
  const std::pair<const char *, const char *> refused[] = {
    { "render scan --preset ct-bone --size 64 -o b.dcm", "add --dicom-sc" },
    { "render scan --preset ct-bone --size 64 --dicom-sc -o scan/b.png", "the scan's own folder" },
    { "render scan --preset ct-bone --style transparent --dicom-sc -o b.png", "not transparent" },
    { "render " RHOMBIC_TESTDATA "/phantom/phantom.nii.gz --preset ct-bone --dicom-sc -o b.png", "is NIfTI" },
  };
  fs::remove(folder.Path() / "b.png");
  for (const auto & [command, says] : refused)
  {
    const Outcome outcome = RunShell("rhombic " + std::string(command), folder.Path());
    EXPECT_EQ(outcome.exitCode, 2) << command;
    EXPECT_NE(outcome.errors.find(says), std::string::npos) << outcome.errors;
    EXPECT_FALSE(fs::exists(folder.Path() / "b.png"));
  }
}

} // namespace
