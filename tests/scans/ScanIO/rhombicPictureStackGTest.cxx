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

  /** Writes a TIFF file of several pages with widths, and an ImageDescription in each, and returns their values. */
  std::vector<std::vector<std::uint16_t>>
  WritePages(const std::string & name, const std::vector<int> & widths, const std::string & description) const
  {
    std::mt19937 random(static_cast<unsigned int>(widths.size()));
    const std::string path = (m_Folder / name).string();
    std::vector<OIIO::ImageSpec> specs;
    for (const int width : widths)
    {
      specs.emplace_back(width, Height, 1, OIIO::TypeDesc::UINT16);
      specs.back().attribute("ImageDescription", description);
    }
    std::vector<std::vector<std::uint16_t>> pages;
    const auto output = OIIO::ImageOutput::create(path);
    bool isWritten = output && output->open(path, static_cast<int>(specs.size()), specs.data());
    for (std::size_t n = 0; n < specs.size() && isWritten; ++n)
    {
      auto & values = pages.emplace_back(static_cast<std::size_t>(widths[n]) * Height);
      std::generate(values.begin(), values.end(), [&random] { return static_cast<std::uint16_t>(random() % 60000); });
      isWritten = (n == 0 || output->open(path, specs[n], OIIO::ImageOutput::AppendSubimage)) &&
                  output->write_image(OIIO::TypeDesc::UINT16, values.data());
    }
    EXPECT_TRUE(isWritten && output->close()) << name;
    return pages;
  }

  /** OME-XML as Bio-Formats writes it. */
  static std::string
  DescribeByOME(const std::string & attributes)
  {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\">"
           "<Image ID=\"Image:0\"><Pixels BigEndian=\"false\" DimensionOrder=\"XYCZT\" ID=\"Pixels:0\" " +
           attributes + " Type=\"uint16\"><TiffData/></Pixels></Image></OME>";
  }

  ScanReadOptions m_Options;
};

TEST_F(PictureStack, PagesOfATIFFFileAreSlices)
{
  const std::vector<int> widths(5, Width);
  const auto pages = this->WritePages("a.tif", widths, "notes of a microscope");
  const auto scan = ReadScan(m_Folder / "a.tif", m_Options);
  this->ExpectSlices<std::uint16_t>(scan, pages);
  EXPECT_EQ(scan.files.size(), 1u);
  EXPECT_TRUE(rhombic::ListSeries(m_Folder / "a.tif", m_Options).series.empty());
  this->ExpectSlices<std::uint16_t>(ReadScan(m_Folder, m_Options), pages); // the only picture of a folder
  EXPECT_EQ(KindOfReading(m_Folder / "a.tif", "ScanReadOptions::voxelSize", {}), FailureKind::Usage);
  Write<std::uint16_t>("b.tif", OIIO::TypeDesc::UINT16, 2);
  EXPECT_EQ(KindOfReading(m_Folder, "a.tif: it has 5 pages", m_Options), FailureKind::Unreadable);
  EXPECT_EQ(KindOfReading(m_Folder / "b.tif", "single picture", m_Options), FailureKind::Unreadable);
}

TEST_F(PictureStack, PagesThatAreNoSlicesAreRefused)
{
  this->WritePages("levels.tif", { Width, Width / 2 }, "");
  EXPECT_EQ(KindOfReading(m_Folder / "levels.tif", "single picture", m_Options), FailureKind::Unreadable);
  this->WritePages("levels.tif", { Width, Width, Width / 2 }, "");
  EXPECT_EQ(KindOfReading(m_Folder / "levels.tif", "another size than the first", m_Options), FailureKind::Unreadable);
  this->WritePages("channels.tif", { Width, Width }, DescribeByOME("SizeC=\"2\" SizeT=\"1\" SizeZ=\"1\""));
  EXPECT_EQ(KindOfReading(m_Folder / "channels.tif", "2 channels", m_Options), FailureKind::Unreadable);
  this->WritePages("some.tif", { Width, Width }, DescribeByOME("SizeC=\"1\" SizeT=\"1\" SizeZ=\"9\""));
  EXPECT_EQ(KindOfReading(m_Folder / "some.tif", "9 slices, and it has 2 pages", m_Options), FailureKind::Unreadable);
  this->WritePages("imagej.tif", { Width }, "ImageJ=1.53\nimages=900\nslices=900\n");
  EXPECT_EQ(KindOfReading(m_Folder / "imagej.tif", "ImageJ has written 900 pictures", m_Options),
            FailureKind::Unreadable);

  this->WritePages("cut.tif", std::vector<int>(4, Width), "");
  fs::resize_file(m_Folder / "cut.tif", fs::file_size(m_Folder / "cut.tif") - Width * Height);
  EXPECT_EQ(KindOfReading(m_Folder / "cut.tif", "cut.tif", m_Options), FailureKind::Unreadable);
}

TEST_F(PictureStack, OMEXMLTellsTheSizeOfVoxels)
{
  const std::string sizes = "SizeC=\"1\" SizeT=\"1\" SizeZ=\"2\" ";
  const std::vector<std::pair<std::string, std::array<double, 3>>> cases{
    { R"(PhysicalSizeX="0.5" PhysicalSizeY="0.25" PhysicalSizeZ="2")", { 0.0005, 0.00025, 0.002 } },
    { R"(PhysicalSizeX="500" PhysicalSizeXUnit="nm" PhysicalSizeY="0.25" PhysicalSizeYUnit="mm" PhysicalSizeZ="2")",
      { 0.0005, 0.25, 0.002 } },
    { "PhysicalSizeX='5' PhysicalSizeXUnit='\xC2\xB5m' PhysicalSizeY = '5' PhysicalSizeYUnit='&#181;m' "
      "PhysicalSizeZ='1' PhysicalSizeZUnit='cm'",
      { 0.005, 0.005, 10.0 } }
  };
  for (const auto & [attributes, expected] : cases)
  {
    const auto pages = this->WritePages("a.ome.tif", { Width, Width }, DescribeByOME(sizes + attributes));
    const auto scan = rhombic::ReadScan(m_Folder / "a.ome.tif");
    this->ExpectSlices<std::uint16_t>(scan, pages);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      EXPECT_DOUBLE_EQ(rhombic::GeometryOf(scan.image).GetSpacing()[axis], expected[axis]) << attributes;
    }
  }
  const auto given = ReadScan(m_Folder / "a.ome.tif", m_Options); // wins, and is told
  EXPECT_DOUBLE_EQ(rhombic::GeometryOf(given.image).GetSpacing()[2], 0.01);
  EXPECT_TRUE(std::any_of(given.notes.begin(), given.notes.end(), [](const std::string & note) {
    return note.find("OME-XML") != std::string::npos;
  }));
  for (const char * const attributes : { "PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.25\"",
                                         "PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"-1\"",
                                         "PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"nan\"",
                                         "PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"1\" "
                                         "PhysicalSizeZUnit=\"pixel\"" })
  {
    this->WritePages("a.ome.tif", { Width, Width }, DescribeByOME(sizes + attributes));
    EXPECT_EQ(KindOfReading(m_Folder / "a.ome.tif", "along each axis", {}), FailureKind::Usage) << attributes;
  }
}

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

TEST_F(PictureStack, IsRefusedIfASliceIsMissing)
{
  using Names = std::vector<const char *>;
  const auto write = [this](const Names & names) {
    fs::remove_all(m_Folder);
    fs::create_directory(m_Folder);
    for (const char * const name : names)
    {
      Write<std::uint8_t>(name, OIIO::TypeDesc::UINT8, 1);
    }
  };
  const std::vector<std::pair<Names, std::string>> refused{
    { { "0000.tif", "0001.tif", "0002.tif", "0004.tif" },
      "1 slice is missing by the numbers in their names, the first "
      "between 0002.tif and 0004.tif; find" },
    { { "a10b4.png", "a20b4.png", "a50b4.png", "a60b4.png" }, "2 slices are missing" },
    { { "slice_8_of_12.tif", "slice_9_of_12.tif", "slice_10_of_12.tif", "slice_12_of_12.tif" }, "between slice_10_of" },
    { { "scan-2024-01_z005.bmp", "scan-2024-02_z010.bmp", "scan-2024-03_z015.bmp", "scan-2024-05_z025.bmp" },
      "between scan-2024-03" },
    { { "1.tif", "2.tif", "02.tif" }, "differs from 02.tif by zeros" },
    { { "1.tif", "1.tiff" }, "differs from 1.tif by zeros" },
  };
  for (const auto & [names, sentence] : refused)
  {
    write(names);
    EXPECT_EQ(KindOfReading(m_Folder, sentence, m_Options), FailureKind::Geometry);
  }
  for (const auto & [names, isEven] : std::vector<std::pair<Names, bool>>{
         { { "10.tif", "20.tif", "30.tif" }, true },
         { { "t1704103199_1.tif", "t1704103201_2.tif", "t1704103202_3.tif" }, true },
         { { "5.png", "6.png" }, true },
         { { "a.tif", "b.tif", "c.tif" }, false },
         { { "1.tif", "2.tif", "3.tif", "5 (copy).tif" }, false },
         { { "0.5.tif", "1.0.tif", "1.5.tif", "2.0.tif" }, false },
         { { "1.25.tif", "2.50.tif", "3.75.tif", "5.00.tif", "6.25.tif", "7.50.tif" }, false },
         { { "1.05.tif", "1.5.tif", "2.tif" }, false },
         { { "t_120057.tif", "t_120058.tif", "t_120059.tif", "t_120100.tif" }, false },
         { { "#1.tif", "1#.tif" }, false },
         { { "#12a3.tif", "5#a#.tif" }, false },
         { { "20240101115958.tif", "20240101115959.tif", "20240101120000.tif" }, false },
         { { "7.tif", "10.tif", "12.tif", "14.tif", "16.tif" }, false } })
  {
    write(names);
    const auto notes = ReadScan(m_Folder, m_Options).notes;
    EXPECT_EQ(notes.front().find("Whether slices are missing can't be told") != 0, isEven) << names.front();
  }
}

TEST_F(PictureStack, SlicesBesideAGapStayInTheirPlaces)
{
  for (const char * const name : { "1.tif", "2.tif", "3.tif", "5.tif" })
  {
    Write<std::uint8_t>(name, OIIO::TypeDesc::UINT8, 1);
  }
  m_Options.onGap = ScanReadOptions::Policy::Accept;
  const auto scan = ReadScan(m_Folder, m_Options);
  ASSERT_EQ(scan.sliceOrigins.size(), 4u);
  EXPECT_DOUBLE_EQ(scan.sliceOrigins[2][2], 0.02);
  EXPECT_DOUBLE_EQ(scan.sliceOrigins[3][2], 0.04);
  EXPECT_DOUBLE_EQ(rhombic::GeometryOf(scan.image).GetSpacing()[2], 0.04 / 3);
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
