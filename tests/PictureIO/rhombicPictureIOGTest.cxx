#include "rhombicFailure.h"
#include "rhombicPictureComparison.h"
#include "rhombicPictureIO.h"

#include <OpenImageIO/imageio.h>
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <array>
#include <filesystem>
#include <functional>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;
using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::Picture;

const rhombic::PictureMetadata Metadata{ "Rhombic test", "rhombic render scan -o picture" };

/** Every 8-bit value in every channel, and then noise that can't be compressed. */
Picture
TestPicture()
{
  Picture picture(256, 40);
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
  {
    state = 1664525u * state + 1013904223u;
    picture.pixels[i] = static_cast<std::uint8_t>(i < 256 * 3 ? i / 3 : state >> 24);
  }
  return picture;
}

/** A photograph-like picture: smooth, so that JPEG keeps it. */
Picture
SmoothPicture()
{
  Picture picture(64, 48);
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      auto * const pixel = picture.pixels.data() + (y * picture.width + x) * Picture::Channels;
      pixel[0] = static_cast<std::uint8_t>(4 * x);
      pixel[1] = static_cast<std::uint8_t>(5 * y);
      pixel[2] = static_cast<std::uint8_t>(2 * (x + y));
    }
  }
  return picture;
}

std::string
BytesOf(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

FailureKind
KindOf(const std::function<void()> & action)
{
  try
  {
    action();
  }
  catch (const Failure & failure)
  {
    return failure.GetKind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return FailureKind::Internal;
}

class PictureIO : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  void
  TearDown() override
  {
    fs::permissions(m_Folder, fs::perms::owner_all);
  }

  std::size_t
  CountFiles() const
  {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_Folder), fs::directory_iterator()));
  }

  const fs::path m_Folder = m_TemporaryFolder.Path();
};

class PictureFormats
  : public PictureIO
  , public testing::WithParamInterface<const char *>
{
protected:
  fs::path
  Path(const std::string & stem = "picture") const
  {
    return m_Folder / (stem + GetParam());
  }
};

INSTANTIATE_TEST_SUITE_P(,
                         PictureFormats,
                         testing::Values(".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".PNG"),
                         [](const auto & extension) { return std::string(extension.param + 1); });

TEST_P(PictureFormats, ComesBack)
{
  const std::string extension = GetParam();
  const bool isLossy = extension.substr(0, 2) == ".j";
  const Picture picture = isLossy ? SmoothPicture() : TestPicture();
  rhombic::WritePicture(picture, Path(), Metadata);
  const Picture read = rhombic::ReadPicture(Path());
  ASSERT_EQ(read.width, picture.width);
  ASSERT_EQ(read.height, picture.height);
  EXPECT_LE(rhombic::ComparePictures(picture, read, 0.0).maxError, isLossy ? 0.03 : 0.0);
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_P(PictureFormats, SaysWhatItIsToldAndNoMore)
{
  rhombic::WritePicture(TestPicture(), Path(), Metadata);
  const auto input = OIIO::ImageInput::open(Path().string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("Software"), Metadata.software);
  EXPECT_EQ(input->spec().get_string_attribute("ImageDescription"), Metadata.commandLine);
  const std::set<std::string> structural{ "Software",
                                          "ImageDescription",
                                          "oiio:ColorSpace",
                                          "oiio:BitsPerSample",
                                          "oiio:subimages",
                                          "Orientation",
                                          "compression",
                                          "tiff:Compression",
                                          "tiff:RowsPerStrip",
                                          "planarconfig",
                                          "tiff:PlanarConfiguration",
                                          "tiff:PhotometricInterpretation",
                                          "PixelAspectRatio",
                                          "screenWindowCenter",
                                          "screenWindowWidth",
                                          "jpeg:subsampling",
                                          "Exif:ExifVersion",
                                          "Exif:FlashPixVersion",
                                          "Exif:ColorSpace",
                                          "IPTC:Caption",
                                          "IPTC:OriginatingProgram" };
  for (const auto & attribute : input->spec().extra_attribs)
  {
    EXPECT_EQ(structural.count(attribute.name().string()), 1u) << attribute.name() << " = " << attribute.get_string();
  }
}

TEST_P(PictureFormats, HasTheSameBytesAtAnotherTime)
{
  rhombic::WritePicture(TestPicture(), Path("first"), Metadata);
  usleep(1100000); // dates in files count seconds
  rhombic::WritePicture(TestPicture(), Path("second"), Metadata);
  EXPECT_EQ(BytesOf(Path("first")), BytesOf(Path("second")));
}

TEST_P(PictureFormats, PrintsNothing)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  rhombic::WritePicture(TestPicture(), Path(), Metadata);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(PictureFormats, FullDiskLeavesTheOldFile)
{
  std::ofstream(Path()) << "old";
  rlimit previous;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &previous), 0);
  const auto previousHandler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{ 1000, previous.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto kind = KindOf([this] { rhombic::WritePicture(TestPicture(), Path(), Metadata); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &previous), 0);
  std::signal(SIGXFSZ, previousHandler);
  EXPECT_EQ(kind, FailureKind::Output);
  EXPECT_EQ(BytesOf(Path()), "old");
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_P(PictureFormats, DamagedFileIsUnreadable)
{
  rhombic::WritePicture(TestPicture(), Path(), Metadata);
  const auto size = fs::file_size(Path());
  fs::resize_file(Path(), 20);
  fs::resize_file(Path(), size); // zeros from byte 20
  EXPECT_EQ(KindOf([this] { rhombic::ReadPicture(Path()); }), FailureKind::Unreadable);
}

TEST_F(PictureIO, EmptyMetadataIsLeftOut)
{
  rhombic::WritePicture(TestPicture(), m_Folder / "picture.png", {});
  const auto input = OIIO::ImageInput::open((m_Folder / "picture.png").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("Software", "none"), "none");
  EXPECT_EQ(input->spec().get_string_attribute("ImageDescription", "none"), "none");
}

TEST_F(PictureIO, ExrHoldsLinearLight)
{
  Picture picture(1, 1);
  picture.pixels = { 188, 255, 0 };
  rhombic::WritePicture(picture, m_Folder / "picture.exr", {});
  const auto input = OIIO::ImageInput::open((m_Folder / "picture.exr").string());
  ASSERT_TRUE(input);
  std::array<float, 3> linear;
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, linear.data()));
  EXPECT_NEAR(linear[0], 0.5029, 1e-3); // sRGB 188 is half the light
  EXPECT_EQ(linear[1], 1.0f);
  EXPECT_EQ(linear[2], 0.0f);
}

TEST_F(PictureIO, GreyAndAlphaAreRead)
{
  const auto path = (m_Folder / "grey.png").string();
  const OIIO::ImageSpec grey(2, 1, 2, OIIO::TypeDesc::UINT8);
  const std::array<std::uint8_t, 4> pixels{ 10, 255, 200, 255 };
  const auto output = OIIO::ImageOutput::create("png");
  ASSERT_TRUE(output && output->open(path, grey) && output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) &&
              output->close());
  EXPECT_EQ(rhombic::ReadPicture(path).pixels, (std::vector<std::uint8_t>{ 10, 10, 10, 200, 200, 200 }));
}

TEST_F(PictureIO, UnknownExtensionListsTheKnownOnes)
{
  for (const char * const name : { "picture.bmp", "picture", "picture.", ".png" })
  {
    try
    {
      rhombic::WritePicture(TestPicture(), m_Folder / name, Metadata);
      ADD_FAILURE() << name;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Usage);
      EXPECT_NE(std::string(failure.GetDescription()).find(".png, .jpg, .jpeg, .tif, .tiff, .exr"), std::string::npos);
    }
  }
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(PictureIO, ImpossibleTargetsAreFailures)
{
  fs::create_directory(m_Folder / "folder.png");
  const auto write = [this](const fs::path & path) {
    return KindOf([&] { rhombic::WritePicture(TestPicture(), m_Folder / path, Metadata); });
  };
  EXPECT_EQ(write("missing/picture.png"), FailureKind::Output);
  EXPECT_EQ(write("folder.png"), FailureKind::Output);
  EXPECT_EQ(KindOf([this] { rhombic::WritePicture({}, m_Folder / "empty.png", Metadata); }), FailureKind::Usage);
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_F(PictureIO, MissingAndForeignFilesAreFailures)
{
  EXPECT_EQ(KindOf([this] { rhombic::ReadPicture(m_Folder / "missing.png"); }), FailureKind::NotFound);
  EXPECT_EQ(KindOf([this] { rhombic::ReadPicture(m_Folder); }), FailureKind::NotFound);
  std::ofstream(m_Folder / "text.png") << "this is no picture";
  EXPECT_EQ(KindOf([this] { rhombic::ReadPicture(m_Folder / "text.png"); }), FailureKind::Unreadable);
}

} // namespace
