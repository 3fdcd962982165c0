#include "itkScanImageIO.h"
#include "rhombicLabelMap.h"
#include "rhombicMappedVoxels.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicScanTest.h"

#include "itkImageFileReader.h"

#include <cstdlib>
#include <random>

/** OME-Zarr folders as scans. */
namespace
{

namespace fs = std::filesystem;
using rhombic::FailureKind;
using rhombic::GeometryOf;
using rhombic::ReadScan;
using rhombic::ScanReadOptions;
using rhombictest::OMEZarrTestFolder;

class OMEZarrVolume : public ScanTest
{
protected:
  OMEZarrVolume()
  {
    m_Zarr.codec = rhombictest::DeflateCodecs().front();
  }

  OMEZarrTestFolder m_Zarr; ///< z, y, x of 4 x 5 x 6 voxels of 4, 3 and 2 um
  const fs::path m_Image = m_Folder / "image.ome.zarr";
};

template <typename TValue>
std::vector<TValue>
RandomValues(unsigned int seed)
{
  std::mt19937 random(seed);
  std::vector<TValue> values(120);
  std::generate(values.begin(), values.end(), [&random] { return static_cast<TValue>(random() / TValue(3)); });
  return values;
}

/** An NRRD file of the same values at the same places, of which it does not say how they lie in the patient. */
template <typename TValue>
fs::path
WriteNRRD(const fs::path & path, const std::string & type, const std::vector<TValue> & values)
{
  const std::string header =
    "NRRD0005\ntype: " + type +
    "\ndimension: 3\nsizes: 6 5 4\nspace dimension: 3\nspace directions: (0.002,0,0) (0,0.003,0) "
    "(0,0,0.004)\nendian: little\nencoding: raw\n\n";
  return WriteBytes(path, header + std::string(reinterpret_cast<const char *>(values.data()), 120 * sizeof(TValue)));
}

template <typename TValue>
void
ExpectAsNRRD(OMEZarrTestFolder zarr, const fs::path & folder, const std::string & type)
{
  const auto values = RandomValues<TValue>(sizeof(TValue));
  for (const bool isBigEndian : { false, true })
  {
    zarr.isBigEndian = isBigEndian;
    fs::remove_all(folder);
    const auto scan = ReadScan(zarr.Write(folder, values));
    const auto expected = ReadScan(WriteNRRD(folder.parent_path() / "a.nrrd", type, values));
    ASSERT_EQ(scan.image.index(), expected.image.index()) << type;
    std::visit(
      [&](const auto & image) {
        using Pointer = std::decay_t<decltype(image)>;
        const auto * const pixels = std::get<Pointer>(expected.image)->GetBufferPointer();
        EXPECT_TRUE(std::equal(pixels, pixels + 120, image->GetBufferPointer())) << type;
      },
      scan.image);
    const auto & grid = GeometryOf(scan.image);
    const auto & nrrd = GeometryOf(expected.image);
    EXPECT_EQ(grid.GetLargestPossibleRegion(), nrrd.GetLargestPossibleRegion());
    EXPECT_EQ(grid.GetSpacing(), nrrd.GetSpacing());
    EXPECT_EQ(grid.GetOrigin(), nrrd.GetOrigin());
    EXPECT_EQ(grid.GetDirection(), nrrd.GetDirection());
    EXPECT_EQ(scan.isOriented, expected.isOriented);
  }
}

TEST_F(OMEZarrVolume, IsReadAsTheSameNRRD)
{
  ExpectAsNRRD<std::uint8_t>(m_Zarr, m_Image, "uint8");
  ExpectAsNRRD<std::int8_t>(m_Zarr, m_Image, "int8");
  ExpectAsNRRD<std::uint16_t>(m_Zarr, m_Image, "uint16");
  ExpectAsNRRD<std::int16_t>(m_Zarr, m_Image, "int16");
  ExpectAsNRRD<std::uint32_t>(m_Zarr, m_Image, "uint32");
  ExpectAsNRRD<std::int32_t>(m_Zarr, m_Image, "int32");
  ExpectAsNRRD<std::uint64_t>(m_Zarr, m_Image, "uint64");
  ExpectAsNRRD<std::int64_t>(m_Zarr, m_Image, "int64");
  ExpectAsNRRD<float>(m_Zarr, m_Image, "float");
  ExpectAsNRRD<double>(m_Zarr, m_Image, "double");
}

TEST_F(OMEZarrVolume, IsDescribed)
{
  m_Zarr.Write(m_Image, std::vector<std::int16_t>(120, 7));
  fs::remove(m_Image / "0/1/1/1");
  const auto scan = ReadScan(m_Image);
  EXPECT_EQ(scan.format, "OME-Zarr");
  EXPECT_EQ(scan.encoding, "zlib");
  EXPECT_FALSE(scan.isOriented);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes.front().find("left, posterior and superior"), std::string::npos);
  EXPECT_EQ(scan.files.size(), 2u + 7u) << "metadata, and the chunks that there are";
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 5, 4, 3 } }), 0) << "the fill value";
  EXPECT_EQ(rhombic::OpenScan(m_Image).scan.files.size(), 2u);
  ScanReadOptions options;
  options.series = "1";
  EXPECT_EQ(KindOfReading(m_Image, "series", options), FailureKind::Usage);
  EXPECT_TRUE(rhombic::ListSeries(m_Image).series.empty());
}

TEST_F(OMEZarrVolume, FramesAndLevelsAreChosen)
{
  const std::string space = m_Zarr.axes.substr(1);
  m_Zarr.axes = R"([{"name": "c", "type": "channel"}, )" + space;
  m_Zarr.transformations = R"([{"type": "scale", "scale": [1, 4, 3, 2]}])";
  m_Zarr.shape = { 2, 4, 5, 6 };
  m_Zarr.chunks = { 1, 4, 5, 6 };
  std::vector<std::uint8_t> values(240, 1);
  std::fill(values.begin() + 120, values.end(), 2);
  m_Zarr.Write(m_Image, values);
  m_Zarr.shape = m_Zarr.chunks = { 2, 2, 2, 2 };
  m_Zarr.WriteArray(m_Image / "1", std::vector<std::uint8_t>(16, 9));
  OMEZarrTestFolder::WriteText(m_Image / ".zattrs", m_Zarr.Attributes(2));
  EXPECT_EQ(KindOfReading(m_Image, "ScanReadOptions::frame, from 0 to 1"), FailureKind::Unreadable);
  ScanReadOptions options;
  options.frame = 1;
  EXPECT_EQ(ImageOf<std::uint8_t>(ReadScan(m_Image, options)).GetPixel({ { 0, 0, 0 } }), 2);
  options.level = 1;
  const auto scan = ReadScan(m_Image, options);
  EXPECT_EQ(ImageOf<std::uint8_t>(scan).GetLargestPossibleRegion().GetNumberOfPixels(), 8u);
  EXPECT_EQ(scan.numberOfLevels, 2u);
  EXPECT_EQ(scan.level, 1u);
  options.level = 2;
  EXPECT_EQ(KindOfReading(m_Image, "2 levels", options), FailureKind::Usage);
}

TEST_F(OMEZarrVolume, OtherFormatsHaveNoLevels)
{
  const fs::path path = WriteNRRD(m_Folder / "a.nrrd", "uint8", std::vector<std::uint8_t>(120));
  ScanReadOptions options;
  options.level = 1;
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::level", options), FailureKind::Usage);
  options.level = 0;
  options.voxelSize = { 1, 1, 1 };
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::voxelSize", options), FailureKind::Usage);
}

TEST_F(OMEZarrVolume, ValuesThatAreNotFiniteAreReplaced)
{
  const double notFinite[] = { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() };
  std::vector<double> values(120, 5.0);
  values[3] = notFinite[0];
  values[119] = -2.0;
  m_Zarr.fill = "\"NaN\"";
  m_Zarr.Write(m_Image, values);
  fs::remove(m_Image / "0/1/0/1");
  const auto scan = ReadScan(m_Image);
  EXPECT_EQ(ImageOf<float>(scan).GetPixel({ { 3, 0, 0 } }), -2.0f);
  EXPECT_EQ(ImageOf<float>(scan).GetPixel({ { 5, 0, 3 } }), -2.0f) << "of the missing chunk";
  ASSERT_EQ(scan.notes.size(), 2u);
  EXPECT_NE(scan.notes.back().find("13 values that are not finite"), std::string::npos) << scan.notes.back();

  const auto reader = itk::ImageFileReader<itk::Image<double, 3>>::New(); // of a region without the lowest value
  reader->SetImageIO(itk::ScanImageIO::New());
  reader->SetFileName(m_Image.string());
  reader->UpdateOutputInformation();
  EXPECT_TRUE(reader->GetImageIO()->CanStreamRead());
  reader->GetOutput()->SetRequestedRegion(itk::ImageRegion<3>({ { 3, 0, 0 } }, { { 1, 1, 1 } }));
  reader->GetOutput()->Update();
  EXPECT_EQ(reader->GetOutput()->GetPixel({ { 3, 0, 0 } }), -2.0);
}

TEST_F(OMEZarrVolume, MemoryIsLimited)
{
  m_Zarr.Write(m_Image, std::vector<std::uint32_t>(120));
  m_Zarr.WriteArray(m_Image / "1", std::vector<std::uint32_t>(120));
  OMEZarrTestFolder::WriteText(m_Image / ".zattrs", m_Zarr.Attributes(2));
  ScanReadOptions options;
  options.maximumMemory = 100;
  try
  {
    EXPECT_EQ(rhombic::PlaceOf(ReadScan(m_Image, options).image), rhombic::VoxelPlace::TemporaryFile);
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find("it is in memory itself"), std::string::npos);
  }
}

/** Changes a variable of the environment for a test. */
class TemporaryVariable
{
public:
  TemporaryVariable(const char * name, const std::string & value)
    : m_Name(name)
  {
    const char * const old = std::getenv(name);
    m_WasSet = old != nullptr;
    m_Old = m_WasSet ? old : "";
    setenv(name, value.c_str(), 1);
  }
  ~TemporaryVariable()
  {
    m_WasSet ? setenv(m_Name, m_Old.c_str(), 1) : unsetenv(m_Name);
  }
  TemporaryVariable(const TemporaryVariable &) = delete;
  TemporaryVariable &
  operator=(const TemporaryVariable &) = delete;

private:
  const char * const m_Name;
  bool m_WasSet;
  std::string m_Old;
};

TEST_F(OMEZarrVolume, LargeOnesAreUnpackedToATemporaryFile)
{
  const auto values = RandomValues<std::uint16_t>(1);
  m_Zarr.Write(m_Image, values);
  ScanReadOptions options;
  options.maximumMemory = 100;
  const fs::path folder = m_Folder / "temporary";
  fs::create_directory(folder);
  const TemporaryVariable variable("TMPDIR", folder);
  try
  {
    const auto scan = ReadScan(m_Image, options);
    EXPECT_TRUE(rhombic::IsMapped(scan.image));
    EXPECT_TRUE(std::equal(values.begin(), values.end(), ImageOf<std::uint16_t>(scan).GetBufferPointer()));
    EXPECT_TRUE(fs::is_empty(folder)) << "it has no name";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_NE(std::string(failure.GetDescription()).find("it is in memory itself"), std::string::npos);
  }
  fs::remove(folder);
  EXPECT_EQ(KindOfReading(m_Image, "TMPDIR", options), FailureKind::Memory);
}

TEST_F(OMEZarrVolume, LabelMapsAreRead)
{
  std::vector<std::uint8_t> values(120, 0);
  std::fill(values.begin() + 10, values.begin() + 40, 1);
  std::fill(values.begin() + 40, values.begin() + 50, 2);
  m_Zarr.Write(m_Image, values);
  const auto scan = ReadScan(m_Image);
  ASSERT_TRUE(rhombic::IsLabelMap(scan));
  const auto map = rhombic::ReadLabelMap({ { m_Image } }, {}, scan, m_Image);
  ASSERT_EQ(map.labels.size(), 2u);
  EXPECT_EQ(map.labels.front().numberOfVoxels, 30u);
}

} // namespace
