#include "rhombicLabelMap.h"
#include "rhombicMappedVoxels.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicScanTest.h"

#include <algorithm>
#include <cstring>
#include <random>

/** Files of bare voxels. */
namespace
{

namespace fs = std::filesystem;
using rhombic::FailureKind;
using rhombic::GeometryOf;
using rhombic::ReadScan;
using rhombic::ScanReadOptions;

constexpr std::size_t NumberOfVoxels = 4 * 3 * 2;

class RawVolume : public ScanTest
{
protected:
  RawVolume()
  {
    m_Options.raw = { { 4, 3, 2 }, itk::IOComponentEnum::USHORT, false };
    m_Options.voxelSize = { 0.5, 0.25, 2.0 };
  }

  ScanReadOptions m_Options;
};

/** Values, their bytes in this machine's (little-endian) order, and reversed. */
template <typename TValue>
std::string
BytesOf(const std::vector<TValue> & values, bool isBigEndian)
{
  std::string bytes(values.size() * sizeof(TValue), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  for (std::size_t n = 0; isBigEndian && n < bytes.size(); n += sizeof(TValue))
  {
    std::reverse(bytes.begin() + n, bytes.begin() + n + sizeof(TValue));
  }
  return bytes;
}

template <typename TValue>
void
ExpectAsNRRD(const fs::path & folder, const std::string & type, itk::IOComponentEnum component, ScanReadOptions options)
{
  std::mt19937 random(sizeof(TValue));
  std::vector<TValue> values(NumberOfVoxels);
  std::generate(values.begin(), values.end(), [&random] { return static_cast<TValue>(random()); });
  const std::string header = "NRRD0005\ntype: " + type +
                             "\ndimension: 3\nsizes: 4 3 2\nspace dimension: 3\nspace directions: (0.5,0,0) (0,0.25,0) "
                             "(0,0,2)\nendian: little\nencoding: raw\n\n";
  const auto expected = ReadScan(WriteBytes(folder / "a.nrrd", header + BytesOf(values, false)));
  for (const bool isBigEndian : { false, true })
  {
    options.raw = { { 4, 3, 2 }, component, isBigEndian };
    const auto scan = ReadScan(WriteBytes(folder / "a.raw", BytesOf(values, isBigEndian)), options);
    ASSERT_EQ(scan.image.index(), expected.image.index()) << type;
    std::visit(
      [&](const auto & image) {
        using Pointer = std::decay_t<decltype(image)>;
        const auto * const pixels = std::get<Pointer>(expected.image)->GetBufferPointer();
        EXPECT_TRUE(std::equal(pixels, pixels + NumberOfVoxels, image->GetBufferPointer())) << type;
      },
      scan.image);
    const auto & grid = GeometryOf(scan.image);
    EXPECT_EQ(grid.GetSpacing(), GeometryOf(expected.image).GetSpacing());
    EXPECT_EQ(grid.GetOrigin(), GeometryOf(expected.image).GetOrigin());
    EXPECT_EQ(grid.GetDirection(), GeometryOf(expected.image).GetDirection());
    EXPECT_EQ(grid.GetLargestPossibleRegion(), GeometryOf(expected.image).GetLargestPossibleRegion());
  }
}

TEST_F(RawVolume, IsReadAsTheSameNRRD)
{
  using Component = itk::IOComponentEnum;
  ExpectAsNRRD<std::uint8_t>(m_Folder, "uint8", Component::UCHAR, m_Options);
  ExpectAsNRRD<std::int8_t>(m_Folder, "int8", Component::CHAR, m_Options);
  ExpectAsNRRD<std::uint16_t>(m_Folder, "uint16", Component::USHORT, m_Options);
  ExpectAsNRRD<std::int16_t>(m_Folder, "int16", Component::SHORT, m_Options);
  ExpectAsNRRD<std::uint32_t>(m_Folder, "uint32", Component::UINT, m_Options);
  ExpectAsNRRD<std::int32_t>(m_Folder, "int32", Component::INT, m_Options);
  ExpectAsNRRD<std::uint64_t>(m_Folder, "uint64", Component::ULONG, m_Options);
  ExpectAsNRRD<std::int64_t>(m_Folder, "int64", Component::LONG, m_Options);
  ExpectAsNRRD<float>(m_Folder, "float", Component::FLOAT, m_Options);
  ExpectAsNRRD<double>(m_Folder, "double", Component::DOUBLE, m_Options);
}

TEST_F(RawVolume, IsDescribed)
{
  const auto scan = ReadScan(WriteBytes(m_Folder / "volume.dat", std::string(48, 'x')), m_Options);
  EXPECT_EQ(scan.format, "raw");
  EXPECT_EQ(scan.encoding, "raw");
  EXPECT_FALSE(scan.isOriented);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes.front().find("left and right are a guess"), std::string::npos);
  EXPECT_EQ(scan.files, std::vector<fs::path>{ m_Folder / "volume.dat" });
  EXPECT_TRUE(rhombic::ListSeries(m_Folder / "volume.dat", m_Options).series.empty());
}

TEST_F(RawVolume, StaysInItsFileIfItIsLarge)
{
  const fs::path path = WriteBytes(m_Folder / "a.raw", std::string(48, 'x'));
  m_Options.maximumMemory = 60;
  const auto scan = ReadScan(path, m_Options);
  EXPECT_TRUE(rhombic::IsMapped(scan.image));
  EXPECT_EQ(ImageOf<std::uint16_t>(scan).GetPixel({ { 3, 2, 1 } }), 0x7878);
}

TEST_F(RawVolume, IsRefusedUnlessAllFits)
{
  const fs::path path = WriteBytes(m_Folder / "a.raw", std::string(48, 'x'));
  for (const std::size_t size : { 0, 47, 49 })
  {
    const fs::path other = WriteBytes(m_Folder / "b.raw", std::string(size, 'x'));
    EXPECT_EQ(KindOfReading(other, "it has " + std::to_string(size) + " bytes, and 4 x 3 x 2 voxels", m_Options),
              FailureKind::Unreadable);
  }
  ScanReadOptions options = m_Options;
  options.voxelSize.reset();
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::voxelSize", options), FailureKind::Usage);
  options.voxelSize = { 0, 1, 1 };
  EXPECT_EQ(KindOfReading(path, "no proper size", options), FailureKind::Geometry);
  options = m_Options;
  options.raw->type = itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE;
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::raw", options), FailureKind::Usage);
  options = m_Options;
  options.raw->size = { 4, 0, 2 };
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::raw", options), FailureKind::Usage);
  options.raw->size = { std::size_t(1) << 32, std::size_t(1) << 32, 2 };
  EXPECT_EQ(KindOfReading(path, "ScanReadOptions::raw", options), FailureKind::Usage);
  EXPECT_EQ(KindOfReading(m_Folder, "it is a folder", m_Options), FailureKind::Usage);
}

TEST_F(RawVolume, LayoutIsTheScansAndNotThatOfItsLabels)
{
  const auto scan = ReadScan(WriteBytes(m_Folder / "a.raw", std::string(48, 'x')), m_Options);
  std::string labels(NumberOfVoxels, '\0');
  std::fill(labels.begin() + 4, labels.begin() + 10, '\1');
  const fs::path path =
    WriteBytes(m_Folder / "labels.nrrd",
               "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nspace: LPS\nspace directions: (0.5,0,0) "
               "(0,0.25,0) (0,0,2)\nspace origin: (0,0,0)\nencoding: raw\n\n" +
                 labels);
  const auto map = rhombic::ReadLabelMap({ { path } }, m_Options, scan, m_Folder / "a.raw");
  ASSERT_EQ(map.labels.size(), 1u);
  EXPECT_EQ(map.labels.front().numberOfVoxels, 6u);
}

} // namespace
