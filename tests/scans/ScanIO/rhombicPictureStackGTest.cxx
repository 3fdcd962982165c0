#include "rhombicMappedVoxels.h"
#include "rhombicScanTest.h"

#include <OpenImageIO/imageio.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

/** Folders of pictures that are slices. */

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::ScanReadOptions;

constexpr std::size_t Width = 70, Height = 50;

class PictureStack : public ScanTest
{
protected:
  PictureStack()
  {
    m_Options.voxelSize = { 0.005, 0.005, 0.01 };
  }

  /** Writes a picture of random values by OpenImageIO, and returns them. */
  template <typename TValue>
  std::vector<TValue>
  Write(const std::string & name,
        OIIO::TypeDesc type,
        unsigned int seed,
        int width = Width,
        int channels = 1,
        const std::string & compression = "")
  {
    std::mt19937 random(seed);
    std::vector<TValue> values(static_cast<std::size_t>(width * channels) * Height);
    std::generate(values.begin(), values.end(), [&random] { return static_cast<TValue>(random() % 251); });
    const std::string path = (m_Folder / name).string();
    const auto output = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(width, Height, channels, type);
    if (!compression.empty())
    {
      spec.attribute("compression", compression);
    }
    const bool isWritten =
      output && output->open(path, spec) && output->write_image(type, values.data()) && output->close();
    EXPECT_TRUE(isWritten) << name;
    return values;
  }

  /** Expects the values of slices as pixels of a type. */
  template <typename TValue>
  void
  ExpectSlices(const rhombic::Scan & scan, const std::vector<std::vector<TValue>> & slices) const
  {
    const auto & image = ImageOf<TValue>(scan);
    ASSERT_EQ(image.GetBufferedRegion().GetSize(), (itk::Size<3>{ { Width, Height, slices.size() } }));
    for (std::size_t n = 0; n < slices.size(); ++n)
    {
      EXPECT_TRUE(std::equal(slices[n].begin(), slices[n].end(), image.GetBufferPointer() + n * Width * Height)) << n;
    }
  }

  ScanReadOptions m_Options;
};

TEST_F(PictureStack, IsReadInTheOrderOfNumbers)
{
  const auto c = Write<std::uint16_t>("s10.tif", OIIO::TypeDesc::UINT16, 3);
  const auto b = Write<std::uint16_t>("s9.tif", OIIO::TypeDesc::UINT16, 2, Width, 1, "zip");
  const auto a = Write<std::uint16_t>("s2.tif", OIIO::TypeDesc::UINT16, 1, Width, 1, "lzw");
  std::ofstream(m_Folder / "scan.log") << "a microscope's notes";
  const auto scan = ReadScan(m_Folder, m_Options);
  this->ExpectSlices<std::uint16_t>(scan, { a, b, c });
  EXPECT_EQ(scan.format, "pictures");
  EXPECT_FALSE(scan.isOriented);
  EXPECT_EQ(scan.files.size(), 3u);
  const double spacing[] = { 0.005, 0.005, 0.01 };
  EXPECT_EQ(rhombic::GeometryOf(scan.image).GetSpacing(), (itk::Vector<double, 3>(spacing)));
  EXPECT_TRUE(rhombic::ListSeries(m_Folder, m_Options).series.empty());
}

TEST_F(PictureStack, EveryFormatKeepsItsValues)
{
  for (const std::string extension : { ".png", ".bmp", ".tiff", ".jp2" })
  {
    SCOPED_TRACE(extension);
    const auto a = Write<std::uint8_t>("1" + extension, OIIO::TypeDesc::UINT8, 1);
    const auto b = Write<std::uint8_t>("2" + extension, OIIO::TypeDesc::UINT8, 2);
    const auto scan = ReadScan(m_Folder, m_Options);
    this->ExpectSlices<std::uint8_t>(scan, { a, b });
    fs::remove(m_Folder / ("1" + extension));
    fs::remove(m_Folder / ("2" + extension));
  }
  const auto a = Write<float>("1.tif", OIIO::TypeDesc::FLOAT, 1);
  this->ExpectSlices<float>(ReadScan(m_Folder, m_Options), { a });
  const auto b = Write<std::uint32_t>("1.tif", OIIO::TypeDesc::UINT32, 1);
  this->ExpectSlices<std::int32_t>(ReadScan(m_Folder, m_Options), { { b.begin(), b.end() } });
}

TEST_F(PictureStack, IsPutIntoATemporaryFileIfItIsLarge)
{
  const auto a = Write<std::uint16_t>("1.png", OIIO::TypeDesc::UINT16, 1);
  const auto b = Write<std::uint16_t>("2.png", OIIO::TypeDesc::UINT16, 2);
  m_Options.maximumMemory = 4 * Width * Height - 1;
  try
  {
    const auto scan = ReadScan(m_Folder, m_Options);
    EXPECT_EQ(rhombic::PlaceOf(scan.image), rhombic::VoxelPlace::TemporaryFile);
    this->ExpectSlices<std::uint16_t>(scan, { a, b });
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find("it is in memory itself"), std::string::npos);
  }
}

TEST_F(PictureStack, IsRefusedWithoutTheSizeOfItsVoxels)
{
  Write<std::uint16_t>("1.tif", OIIO::TypeDesc::UINT16, 1);
  EXPECT_EQ(KindOfReading(m_Folder, "ScanReadOptions::voxelSize", {}), FailureKind::Usage);
  m_Options.level = 1;
  EXPECT_EQ(KindOfReading(m_Folder, "only OME-Zarr folders have levels", m_Options), FailureKind::Usage);
}

TEST_F(PictureStack, IsRefusedIfPicturesDiffer)
{
  Write<std::uint16_t>("1.tif", OIIO::TypeDesc::UINT16, 1);
  Write<std::uint16_t>("2.tif", OIIO::TypeDesc::UINT16, 2, Width + 1);
  EXPECT_EQ(
    KindOfReading(m_Folder, "2.tif: it has 71 x 50 pixels of 1 channel in uint16, and 1.tif has 70 x 50", m_Options),
    FailureKind::Unreadable);
  Write<std::uint8_t>("2.tif", OIIO::TypeDesc::UINT8, 2);
  EXPECT_EQ(KindOfReading(m_Folder, "in uint8", m_Options), FailureKind::Unreadable);
  Write<std::uint16_t>("2.tif", OIIO::TypeDesc::UINT16, 2, Width, 3);
  EXPECT_EQ(KindOfReading(m_Folder, "3 channels", m_Options), FailureKind::Unreadable);
  Write<std::uint16_t>("1.tif", OIIO::TypeDesc::UINT16, 2, Width, 3);
  EXPECT_EQ(KindOfReading(m_Folder, "convert the pictures to grey", m_Options), FailureKind::Unreadable);
}

TEST_F(PictureStack, DamagedPicturesAreNamed)
{
  Write<std::uint16_t>("1.tif", OIIO::TypeDesc::UINT16, 1);
  Write<std::uint16_t>("2.tif", OIIO::TypeDesc::UINT16, 2, Width, 1, "zip");
  const auto size = fs::file_size(m_Folder / "2.tif");
  for (std::uintmax_t length = 0; length < size; length += size / 10)
  {
    fs::resize_file(m_Folder / "2.tif", length);
    EXPECT_EQ(KindOfReading(m_Folder, "2.tif", m_Options), FailureKind::Unreadable) << length;
    Write<std::uint16_t>("2.tif", OIIO::TypeDesc::UINT16, 2, Width, 1, "zip");
  }
}

} // namespace
