#include "rhombicFailure.h"
#include "rhombicPictureComparison.h"
#include "rhombicPictureIO.h"

#include <OpenImageIO/imageio.h>
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
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
      auto * const pixel = picture.pixels.data() + (y * picture.width + x) * picture.channels;
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

/** Every value with every alpha, in each channel. */
Picture
AlphaPicture()
{
  Picture picture(256, 256, 4);
  for (int alpha = 0; alpha < 256; ++alpha)
  {
    for (int value = 0; value < 256; ++value)
    {
      auto * const pixel = picture.pixels.data() + (alpha * 256 + value) * 4;
      pixel[0] = static_cast<std::uint8_t>(value);
      pixel[1] = static_cast<std::uint8_t>(255 - value);
      pixel[2] = static_cast<std::uint8_t>((value * 7 + alpha * 13) % 256);
      pixel[3] = static_cast<std::uint8_t>(alpha);
    }
  }
  return picture;
}

TEST_F(PictureIO, AlphaStaysStraight)
{
  const Picture picture = AlphaPicture();
  for (const char * const name : { "alpha.png", "alpha.tif" })
  {
    rhombic::WritePicture(picture, m_Folder / name, Metadata);
    const Picture read = rhombic::ReadPicture(m_Folder / name);
    EXPECT_EQ(read.channels, 4);
    EXPECT_EQ(read.pixels, picture.pixels) << name;
  }
}

TEST_F(PictureIO, ExrIsMultipliedByAlpha)
{
  const Picture picture = AlphaPicture();
  const auto path = m_Folder / "alpha.exr";
  rhombic::WritePicture(picture, path, {});
  const Picture read = rhombic::ReadPicture(path);
  ASSERT_EQ(read.channels, 4);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
  {
    const bool isAlpha = i % 4 == 3;
    const std::uint8_t alpha = picture.pixels[i / 4 * 4 + 3];
    ASSERT_EQ(read.pixels[i], isAlpha || alpha > 0 ? picture.pixels[i] : 0) << i;
  }
  const auto input = OIIO::ImageInput::open(path.string());
  std::vector<float> linear(picture.pixels.size());
  ASSERT_TRUE(input && input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, linear.data()));
  const std::size_t half = (128 * 256 + 188) * 4; // sRGB 188 is half the light, alpha 128 is half
  EXPECT_NEAR(linear[half], 0.2524, 1e-3);
  EXPECT_NEAR(linear[half + 3], 0.50196, 1e-3);
}

TEST_F(PictureIO, FormatsWithoutAlphaRefuseIt)
{
  const Picture picture(4, 4, 4);
  for (const char * const name : { "alpha.jpg", "alpha.jpeg" })
  {
    EXPECT_EQ(KindOf([&] { rhombic::WritePicture(picture, m_Folder / name, {}); }), FailureKind::Usage);
    EXPECT_EQ(KindOf([&] { rhombic::CheckPicturePath(name, 4); }), FailureKind::Usage);
    rhombic::CheckPicturePath(name, 3);
  }
  EXPECT_EQ(KindOf([&] { rhombic::CheckAnimationPath("alpha.gif", 4); }), FailureKind::Usage);
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(PictureIO, ResolutionIsWritten)
{
  auto metadata = Metadata;
  metadata.pixelsPerInch = 200.0;
  for (const char * const name : { "page.png", "page.tif", "page.jpg" })
  {
    rhombic::WritePicture(SmoothPicture(), m_Folder / name, metadata);
    const auto input = OIIO::ImageInput::open((m_Folder / name).string());
    ASSERT_TRUE(input);
    const auto & spec = input->spec();
    const bool isInches = spec.get_string_attribute("ResolutionUnit").substr(0, 2) == "in"; // else cm
    EXPECT_NEAR(spec.get_float_attribute("XResolution") * (isInches ? 1.0 : 2.54), 200.0, 0.1) << name;
  }
}

TEST_F(PictureIO, EncodedJpegHasThePixelsOfAFileInFewerBytes)
{
  const Picture picture = SmoothPicture();
  rhombic::PictureMetadata metadata;
  metadata.jpegQuality = 85;
  const fs::path file = m_Folder / "file.jpg";
  rhombic::WritePicture(picture, file, metadata);
  const auto readEncoded = [&](bool halvesColour) {
    const std::string bytes = rhombic::EncodeJpeg(picture, metadata.jpegQuality, halvesColour);
    EXPECT_EQ(bytes, rhombic::EncodeJpeg(picture, metadata.jpegQuality, halvesColour));
    EXPECT_LT(bytes.size(), fs::file_size(file));
    EXPECT_EQ(bytes.find("Exif"), std::string::npos);
    const fs::path encoded = m_Folder / "encoded.jpg";
    std::ofstream(encoded, std::ios::binary) << bytes;
    return rhombic::ReadPicture(encoded);
  };
  EXPECT_EQ(readEncoded(false).pixels, rhombic::ReadPicture(file).pixels);
  const auto halved = rhombic::ComparePictures(readEncoded(true), picture, 0.0);
  EXPECT_LT(halved.meanError, 0.02);
  EXPECT_GT(halved.meanError, rhombic::ComparePictures(readEncoded(false), picture, 0.0).meanError);
}

TEST_F(PictureIO, JpegOfImpossiblePicturesIsFailure)
{
  for (const Picture & picture : { Picture(), Picture(70'000, 1), Picture(8, 8, 4) })
  {
    EXPECT_THROW(rhombic::EncodeJpeg(picture, 85, false), Failure);
  }
}

TEST_F(PictureIO, PagesComeBackInOrder)
{
  const std::vector<Picture> pages{ TestPicture(), SmoothPicture(), AlphaPicture() };
  const auto stage = [&](const char * const name) {
    rhombic::StagedFiles staged;
    rhombic::StagePages(pages, m_Folder / name, staged, Metadata);
    EXPECT_FALSE(fs::exists(m_Folder / name));
    staged.Commit();
  };
  stage("pages.tif");
  const std::vector<Picture> read = rhombic::ReadPictures(m_Folder / "pages.tif");
  ASSERT_EQ(read.size(), pages.size());
  for (std::size_t i = 0; i < pages.size(); ++i)
  {
    EXPECT_EQ(read[i].channels, pages[i].channels);
    EXPECT_EQ(read[i].pixels, pages[i].pixels);
  }
  EXPECT_EQ(rhombic::ReadPicture(m_Folder / "pages.tif").pixels, pages[0].pixels);
  usleep(1100000);
  stage("again.tif");
  EXPECT_EQ(BytesOf(m_Folder / "pages.tif"), BytesOf(m_Folder / "again.tif"));
  rhombic::StagedFiles staged;
  EXPECT_EQ(KindOf([&] { rhombic::StagePages(pages, m_Folder / "pages.png", staged, {}); }), FailureKind::Usage);
  EXPECT_EQ(KindOf([&] { rhombic::StagePages({}, m_Folder / "none.tif", staged, {}); }), FailureKind::Usage);
}

/** A shaded ball that moves over a dark gradient. */
std::vector<Picture>
Frames(int count)
{
  std::vector<Picture> frames;
  for (int frame = 0; frame < count; ++frame)
  {
    Picture picture(200, 160);
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        const double dx = (x - 50.0 - 100.0 * frame / count) / 40.0;
        const double dy = (y - 80.0) / 40.0;
        const double depth = 1.0 - dx * dx - dy * dy;
        auto * const pixel = picture.pixels.data() + (y * picture.width + x) * 3;
        pixel[0] = static_cast<std::uint8_t>(depth > 0.0 ? 60.0 + 180.0 * std::sqrt(depth) : 10.0);
        pixel[1] = static_cast<std::uint8_t>(depth > 0.0 ? 40.0 + 150.0 * std::sqrt(depth) : 10.0);
        pixel[2] = static_cast<std::uint8_t>(depth > 0.0 ? 30.0 + 110.0 * std::sqrt(depth) : 30.0 * y / 160.0);
      }
    }
    frames.push_back(std::move(picture));
  }
  return frames;
}

TEST_F(PictureIO, AnimationHasItsFramesAndDelay)
{
  const std::vector<Picture> frames = Frames(12);
  const auto stage = [&](const char * const name) {
    rhombic::StagedFiles staged;
    rhombic::StageAnimation(frames, 0.08, m_Folder / name, staged);
    staged.Commit();
  };
  stage("turn.gif");
  const std::vector<Picture> read = rhombic::ReadPictures(m_Folder / "turn.gif");
  ASSERT_EQ(read.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < frames[i].pixels.size() / 3; ++pixel)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        sum += std::abs(read[i].pixels[pixel * static_cast<std::size_t>(read[i].channels) + c] -
                        frames[i].pixels[3 * pixel + c]);
      }
    }
    EXPECT_LT(sum / static_cast<double>(frames[i].pixels.size()), 3.0) << "frame " << i; // of 255
  }
  const std::string bytes = BytesOf(m_Folder / "turn.gif");
  const auto control = bytes.find(std::string("\x21\xf9\x04", 3)); // then flags, delay in hundredths of a second
  ASSERT_NE(control, std::string::npos);
  EXPECT_EQ(static_cast<int>(bytes[control + 4]), 8);
  EXPECT_NE(bytes.find("NETSCAPE2.0"), std::string::npos); // repeats
  usleep(1100000);
  stage("again.gif");
  EXPECT_EQ(BytesOf(m_Folder / "again.gif"), bytes);
}

TEST_F(PictureIO, EvenAreasOfAnimationsKeepTheirColours)
{
  std::vector<Picture> frames = Frames(6);
  constexpr int swatches = 60;
  const auto colourOf = [](int swatch, int channel) {
    return static_cast<std::uint8_t>((swatch * 37 + channel * 91) % 256);
  };
  for (Picture & frame : frames)
  {
    for (int n = 0; n < swatches * 36; ++n) // 6 x 6 pixels each
    {
      const int swatch = n / 36;
      const auto offset = frame.At(swatch % 30 * 6 + n % 6, swatch / 30 * 6 + n / 6 % 6) - frame.pixels.data();
      for (int channel = 0; channel < 3; ++channel)
      {
        frame.pixels[static_cast<std::size_t>(offset + channel)] = colourOf(swatch, channel);
      }
    }
  }
  rhombic::StagedFiles staged;
  rhombic::StageAnimation(frames, 0.1, m_Folder / "turn.gif", staged);
  staged.Commit();
  for (const Picture & read : rhombic::ReadPictures(m_Folder / "turn.gif"))
  {
    for (int n = 0; n < swatches * 36; ++n)
    {
      const int swatch = n / 36;
      const auto * const pixel = read.At(swatch % 30 * 6 + n % 6, swatch / 30 * 6 + n / 6 % 6);
      for (int channel = 0; channel < 3; ++channel)
      {
        ASSERT_EQ(pixel[channel], colourOf(swatch, channel)) << swatch;
      }
    }
  }
}

TEST_F(PictureIO, ImpossibleAnimationsAreUsage)
{
  rhombic::StagedFiles staged;
  const auto stage = [&](const std::vector<Picture> & frames, double seconds, const char * name) {
    return KindOf([&] { rhombic::StageAnimation(frames, seconds, m_Folder / name, staged); });
  };
  EXPECT_EQ(stage({}, 0.1, "turn.gif"), FailureKind::Usage);
  EXPECT_EQ(stage({ Picture(4, 4), Picture(4, 5) }, 0.1, "turn.gif"), FailureKind::Usage);
  EXPECT_EQ(stage(Frames(2), 0.0, "turn.gif"), FailureKind::Usage);
  EXPECT_EQ(stage(Frames(2), 0.1, "turn.png"), FailureKind::Usage);
  EXPECT_EQ(stage({ Picture(4, 4, 4) }, 0.1, "turn.gif"), FailureKind::Usage);
  EXPECT_EQ(KindOf([&] { rhombic::WritePicture(Picture(4, 4), m_Folder / "still.gif", {}); }), FailureKind::Usage);
  EXPECT_EQ(CountFiles(), 0u);
}

TEST_F(PictureIO, AnimationAndPagesOnAFullDiskLeaveTheOldFile)
{
  for (const std::string name : { "turn.gif", "pages.tif" })
  {
    std::ofstream(m_Folder / name) << "old";
    rlimit previous;
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &previous), 0);
    const auto previousHandler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{ 5000, previous.rlim_max };
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto kind = KindOf([&] {
      rhombic::StagedFiles staged;
      name == "turn.gif" ? rhombic::StageAnimation(Frames(4), 0.1, m_Folder / name, staged)
                         : rhombic::StagePages(Frames(4), m_Folder / name, staged, {});
      staged.Commit();
    });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &previous), 0);
    std::signal(SIGXFSZ, previousHandler);
    EXPECT_EQ(kind, FailureKind::Output);
    EXPECT_EQ(BytesOf(m_Folder / name), "old");
  }
}

TEST_F(PictureIO, PdfIsCheckedAndStaged)
{
  const std::string pdf =
    "%PDF-1.4\n1 0 obj\n<< /Type /Pages\n   /Kids [ 2 0 R 3 0 R ]\n   /Count 2\n>>\nendobj\n%%EOF\n";
  const auto kind = [this](const std::string & bytes, std::size_t pages, const char * name) {
    return KindOf([&] {
      rhombic::StagedFiles staged;
      rhombic::StagePdf(bytes, pages, m_Folder / name, staged);
    });
  };
  EXPECT_EQ(kind(pdf, 2, "page.tif"), FailureKind::Usage);
  EXPECT_EQ(kind(pdf, 3, "page.pdf"), FailureKind::Output);
  EXPECT_EQ(kind(pdf.substr(0, pdf.size() - 6), 2, "page.pdf"), FailureKind::Output);
  EXPECT_EQ(kind(pdf.substr(1), 2, "page.pdf"), FailureKind::Output);
  EXPECT_EQ(kind("", 0, "page.pdf"), FailureKind::Output);
  EXPECT_EQ(CountFiles(), 0u);
  rhombic::StagedFiles staged;
  rhombic::StagePdf(pdf, 2, m_Folder / "page.pdf", staged);
  staged.Commit();
  EXPECT_EQ(BytesOf(m_Folder / "page.pdf"), pdf);
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
