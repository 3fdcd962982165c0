#include "rhombicNIfTITestFile.h"
#include "rhombicMappedVoxels.h"
#include "rhombicScanTest.h"

#include <numeric>
#include <random>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::GeometryOf;
using rhombic::ReadScan;
using rhombic::ScanReadOptions;

class NIfTIFile : public ScanTest
{
protected:
  fs::path
  Write(const NIfTITestFile & file, const std::string & name = "a.nii") const
  {
    return WriteBytes(m_Folder / name, file.Bytes());
  }

  rhombic::Scan
  Read(const NIfTITestFile & file, const ScanReadOptions & options = {}) const
  {
    return ReadScan(this->Write(file), options);
  }

  FailureKind
  KindOf(const NIfTITestFile & file, const std::string & named, const ScanReadOptions & options = {}) const
  {
    return KindOfReading(this->Write(file), named, options);
  }
};

ScanReadOptions
Frame(std::size_t frame)
{
  ScanReadOptions options;
  options.frame = frame;
  return options;
}

/** The values in the order of the file. */
template <typename TPixel>
std::vector<TPixel>
ValuesOf(const rhombic::Scan & scan)
{
  const auto & image = ImageOf<TPixel>(scan);
  return { image.GetBufferPointer(), image.GetBufferPointer() + image.GetBufferedRegion().GetNumberOfPixels() };
}

std::vector<std::int16_t>
Counting(std::int16_t first, std::size_t count)
{
  std::vector<std::int16_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

TEST_F(NIfTIFile, BothVersionsAndByteOrders)
{
  for (const int version : { 1, 2 })
  {
    for (const bool isBigEndian : { false, true })
    {
      NIfTITestFile file;
      file.version = version;
      file.isBigEndian = isBigEndian;
      file.sform = { -2, 0, 0, 10, 0, 3, 0, -20, 0, 0, 4, 30 };
      file.pixdim = { 1, 2, 3, 4 };
      const auto scan = this->Read(file);
      EXPECT_EQ(ValuesOf<std::int16_t>(scan), Counting(0, 12));
      EXPECT_EQ(GeometryOf(scan.image).GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { 3, 2, 2 } }));
      const double origin[3] = { -10, 20, 30 };
      ExpectNear(GeometryOf(scan.image).GetOrigin(), itk::Point<double, 3>(origin), 1e-9);
      EXPECT_EQ(GeometryOf(scan.image).GetDirection()[0][0], 1);
      EXPECT_EQ(GeometryOf(scan.image).GetDirection()[1][1], -1);
      EXPECT_EQ(GeometryOf(scan.image).GetSpacing()[2], 4);
      EXPECT_TRUE(scan.notes.empty()) << scan.notes.front();
      EXPECT_EQ(scan.encoding, "raw");
      EXPECT_EQ(scan.affine->source, "sform");
    }
  }
}

TEST_F(NIfTIFile, ValuesOfOtherByteOrdersAndWideTypes)
{
  NIfTITestFile file;
  file.isBigEndian = true;
  file.datatype = 1024; // int64
  file.bits = 64;
  std::vector<std::int64_t> values(12, -5);
  file.voxels = file.Values(values);
  EXPECT_EQ(ValuesOf<std::int32_t>(this->Read(file)), std::vector<std::int32_t>(12, -5));
  values.back() = std::int64_t(1) << 40;
  file.voxels = file.Values(values);
  const auto floats = ValuesOf<float>(this->Read(file));
  EXPECT_EQ(floats.front(), -5.0f);
  EXPECT_EQ(floats.back(), static_cast<float>(values.back()));
  file.datatype = 64; // double
  file.voxels = file.Values(std::vector<double>(12, 0.125));
  EXPECT_EQ(ValuesOf<float>(this->Read(file)), std::vector<float>(12, 0.125f));
}

TEST_F(NIfTIFile, PairsInAnyCaseAndCompression)
{
  NIfTITestFile file;
  file.magic = std::string("ni1\0", 4);
  file.offset = 0;
  WriteBytes(m_Folder / "a.hdr", file.Header());
  WriteBytes(m_Folder / "a.img", file.Voxels());
  WriteBytes(m_Folder / "B.HDR", file.Header());
  WriteBytes(m_Folder / "B.IMG.GZ", Gzipped(file.Voxels()));
  for (const char * name : { "a.hdr", "a.img", "B.HDR", "B.IMG.GZ" })
  {
    EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(m_Folder / name)), Counting(0, 12)) << name;
  }
  WriteBytes(m_Folder / "single.nii", file.Header() + std::string(4, '\0') + file.Voxels());
  EXPECT_EQ(KindOfReading(m_Folder / "single.nii", ".img"), FailureKind::Unreadable);
  WriteBytes(m_Folder / "lost.img", file.Voxels());
  EXPECT_EQ(KindOfReading(m_Folder / "lost.img", ".hdr"), FailureKind::Unreadable);
}

TEST_F(NIfTIFile, CompressionIsSeenInTheContent)
{
  const NIfTITestFile file;
  for (const char * name : { "A.NII.GZ", "packed.nii" })
  {
    const auto scan = ReadScan(WriteBytes(m_Folder / name, Gzipped(file.Bytes())));
    EXPECT_EQ(ValuesOf<std::int16_t>(scan), Counting(0, 12)) << name;
    EXPECT_EQ(scan.encoding, "gzip") << name;
  }
  EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(this->Write(file, "plain.nii.gz"))), Counting(0, 12));
  EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(this->Write(file, "LOUD.NII"))), Counting(0, 12));
}

TEST_F(NIfTIFile, DamagedCompressionIsRefused)
{
  const std::string whole = Gzipped(NIfTITestFile().Bytes());
  const auto kindOf = [this](const std::string & bytes) {
    return KindOfReading(WriteBytes(m_Folder / "a.nii.gz", bytes), "a.nii.gz");
  };
  for (std::size_t cut = 1; cut < whole.size(); ++cut)
  {
    ASSERT_EQ(kindOf(whole.substr(0, cut)), FailureKind::Unreadable) << cut;
  }
  for (const std::size_t place : { whole.size() - 1, whole.size() - 6, whole.size() / 2 })
  {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x55);
    EXPECT_EQ(kindOf(damaged), FailureKind::Unreadable) << place;
  }
}

TEST_F(NIfTIFile, WhatFollowsTheVoxelsIsTolerated)
{
  const std::string bytes = NIfTITestFile().Bytes() + "and more";
  EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(WriteBytes(m_Folder / "a.nii", bytes))), Counting(0, 12));
  EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(WriteBytes(m_Folder / "a.nii.gz", Gzipped(bytes)))), Counting(0, 12));
}

TEST_F(NIfTIFile, HugeClaimsAreRefusedBeforeAllocating)
{
  NIfTITestFile file;
  file.dimensions = { 3, 32767, 32767, 32767, 1, 1, 1, 1 };
  file.voxels = "few";
  EXPECT_EQ(this->KindOf(file, "more voxels"), FailureKind::Unreadable);
  EXPECT_EQ(KindOfReading(WriteBytes(m_Folder / "a.nii.gz", Gzipped(file.Bytes())), "more voxels"),
            FailureKind::Unreadable);
  file.version = 2;
  for (const std::int64_t size : { std::int64_t(1) << 31, std::int64_t(1) << 33, std::int64_t(1) << 62 })
  {
    file.dimensions = { 3, size, size, size, 1, 1, 1, 1 };
    EXPECT_EQ(this->KindOf(file, "larger than any volume"), FailureKind::Unreadable);
  }
  file.dimensions = { 7, 2, 2, 2, std::int64_t(1) << 62, std::int64_t(1) << 62, 4, 4 };
  EXPECT_EQ(this->KindOf(file, "dimensions"), FailureKind::Unreadable);

  ScanReadOptions options;
  options.maximumMemory = 20;
  const auto packed = WriteBytes(m_Folder / "packed.nii.gz", Gzipped(NIfTITestFile().Bytes()));
  EXPECT_EQ(KindOfReading(packed, "gunzip -k packed.nii.gz", options), FailureKind::Memory);
  EXPECT_TRUE(rhombic::IsMapped(this->Read(NIfTITestFile(), options).image)) << "raw voxels stay in their file";
  options.maximumMemory = 24;
  EXPECT_NO_THROW(this->Read(NIfTITestFile(), options));
}

TEST_F(NIfTIFile, FramesOfSeries)
{
  for (const int version : { 1, 2 })
  {
    NIfTITestFile file;
    file.version = version;
    file.dimensions = { 5, 3, 2, 2, 2, 3, 1, 1 };
    EXPECT_EQ(this->KindOf(file, "6 volumes"), FailureKind::Unreadable);
    EXPECT_EQ(this->KindOf(file, "holds 6", Frame(6)), FailureKind::Usage);
    EXPECT_EQ(ValuesOf<std::int16_t>(this->Read(file, Frame(0))), Counting(0, 12));
    EXPECT_EQ(ValuesOf<std::int16_t>(this->Read(file, Frame(5))), Counting(60, 12));
    rhombic::ScanReadOptions first;
    first.onSeveralFrames = rhombic::ScanReadOptions::Policy::Accept;
    const auto scan = this->Read(file, first);
    EXPECT_EQ(ValuesOf<std::int16_t>(scan), Counting(0, 12));
    EXPECT_EQ(scan.numberOfFrames, 6u);
    EXPECT_EQ(scan.frame, 0u);
    EXPECT_EQ(this->Read(file, Frame(5)).frame, 5u);
    const auto packed = WriteBytes(m_Folder / "a.nii.gz", Gzipped(file.Bytes()));
    EXPECT_EQ(ValuesOf<std::int16_t>(ReadScan(packed, Frame(4))), Counting(48, 12));

    const auto whole = file.Bytes();
    WriteBytes(m_Folder / "cut.nii", whole.substr(0, whole.size() - 1));
    EXPECT_EQ(KindOfReading(m_Folder / "cut.nii", "cut off", Frame(0)), FailureKind::Unreadable);
  }
  EXPECT_NO_THROW(this->Read(NIfTITestFile(), Frame(0)));
  EXPECT_EQ(this->KindOf(NIfTITestFile(), "ScanReadOptions::frame", Frame(1)), FailureKind::Usage);
}

TEST_F(NIfTIFile, ShearIsKeptOrRefused)
{
  NIfTITestFile file;
  file.sform = { 0.01, 0.003, 0, 0, 0, 0.01, 0, 0, 0, 0, 0.01, 0 }; // 10 micrometres, so that tests must be scale-free
  const auto scan = this->Read(file);
  itk::Point<double, 3> corner;
  GeometryOf(scan.image).TransformIndexToPhysicalPoint(itk::Index<3>{ { 2, 1, 1 } }, corner);
  const double expected[3] = { -0.023, -0.01, 0.01 };
  ExpectNear(corner, itk::Point<double, 3>(expected), 1e-8);
  ASSERT_EQ(scan.notes.size(), 2u) << "shear, and the size of pixdim";
  EXPECT_NE(scan.notes[0].find("16.7 degrees"), std::string::npos) << scan.notes[0];

  ScanReadOptions options;
  options.onTilted = ScanReadOptions::Policy::Refuse;
  EXPECT_EQ(this->KindOf(file, "sform", options), FailureKind::Geometry);
  EXPECT_NO_THROW(this->Read(NIfTITestFile(), options));
}

TEST_F(NIfTIFile, SizesComeFromTheSform)
{
  NIfTITestFile file;
  file.pixdim = { 1, 0.8, 0.8, 0.8 };
  const auto scan = this->Read(file);
  EXPECT_EQ(GeometryOf(scan.image).GetSpacing()[0], 1);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("pixdim"), std::string::npos);
}

TEST_F(NIfTIFile, AffinesThatMakeNoSenseAreRefusedAndNotReplaced)
{
  const double nan = std::nan("");
  NIfTITestFile file;
  file.qformCode = 1; // which would do
  for (const auto & sform : { std::array<double, 12>{},
                              std::array<double, 12>{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0 },
                              std::array<double, 12>{ 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0 },
                              std::array<double, 12>{ 1, 0, 20, 0, 0, 1, 0, 0, 0, 0, 1, 0 }, // sheared by 87 degrees
                              std::array<double, 12>{ 1, 0, 0, nan, 0, 1, 0, 0, 0, 0, 1, 0 } })
  {
    file.sform = sform;
    EXPECT_EQ(this->KindOf(file, "sform"), FailureKind::Geometry);
  }
  file = NIfTITestFile();
  file.sformCode = 0;
  file.qformCode = 1;
  file.quaternion = { 1, 1, 0 };
  EXPECT_EQ(this->KindOf(file, "quaternion"), FailureKind::Geometry);
  file.quaternion = { 0, 0, 0 };
  file.qformOffset[1] = nan;
  EXPECT_EQ(this->KindOf(file, "qform"), FailureKind::Geometry);
  for (const double size : { 0.0, -1.0, nan })
  {
    file = NIfTITestFile();
    file.pixdim[2] = size;
    EXPECT_EQ(this->KindOf(file, "pixdim"), FailureKind::Geometry) << size;
  }
}

TEST_F(NIfTIFile, QformAndItsDisagreement)
{
  NIfTITestFile file;
  file.sformCode = 0;
  file.qformCode = 1;
  file.quaternion = { 0, 0, std::sqrt(0.5) }; // a quarter turn about z
  file.pixdim = { -1, 2, 3, 4 };
  file.qformOffset = { 5, 6, 7 };
  const auto scan = this->Read(file);
  EXPECT_EQ(scan.affine->source, "qform");
  itk::Point<double, 3> corner;
  GeometryOf(scan.image).TransformIndexToPhysicalPoint(itk::Index<3>{ { 1, 1, 1 } }, corner);
  const double expected[3] = { -(5 - 3), -(6 + 2), 7 - 4 };
  ExpectNear(corner, itk::Point<double, 3>(expected), 1e-5);

  file.sformCode = 1;
  file.sform = { 0, -3, 0, 5.005, 2, 0, 0, 6, 0, 0, -4, 7 };
  const auto near = this->Read(file);
  EXPECT_EQ(near.affine->source, "sform");
  EXPECT_NEAR(near.affine->disagreement, 0.005, 1e-5);
  EXPECT_TRUE(near.notes.empty()) << "of a voxel of 2 mm it is little";
  file.sform[3] = 8;
  const auto far = this->Read(file);
  EXPECT_NEAR(far.affine->disagreement, 3, 1e-5);
  EXPECT_EQ(far.notes.size(), 1u);
}

TEST_F(NIfTIFile, Metres)
{
  NIfTITestFile file;
  file.units = 1;
  file.sform = { 0.001, 0, 0, -0.1, 0, 0.001, 0, 0, 0, 0, 0.001, 0 };
  file.pixdim = { 1, 0.001, 0.001, 0.001 };
  const auto scan = this->Read(file);
  EXPECT_NEAR(GeometryOf(scan.image).GetSpacing()[1], 1, 1e-6);
  EXPECT_NEAR(GeometryOf(scan.image).GetOrigin()[0], 100, 1e-5);
  EXPECT_TRUE(scan.notes.empty());
}

TEST_F(NIfTIFile, Scaling)
{
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  NIfTITestFile file;
  file.slope = 0.5;
  file.intercept = -1024;
  const auto scan = this->Read(file);
  EXPECT_EQ(ValuesOf<float>(scan)[3], -1022.5f);
  EXPECT_EQ(scan.scaling, "slope 0.5, intercept -1024");
  for (const double slope : { 0.0, nan })
  {
    file.slope = slope;
    EXPECT_EQ(ValuesOf<std::int16_t>(this->Read(file)), Counting(0, 12)) << slope;
    EXPECT_EQ(this->Read(file).scaling, "");
  }
  for (const auto & [slope, intercept] :
       { std::pair(infinity, 0.0), std::pair(1.0, infinity), std::pair(1.0, nan), std::pair(-infinity, 0.0) })
  {
    file.slope = slope;
    file.intercept = intercept;
    EXPECT_EQ(this->KindOf(file, "scl_slope"), FailureKind::Unreadable);
  }
}

TEST_F(NIfTIFile, WhatIsNotFiniteBecomesTheLowestValue)
{
  NIfTITestFile file;
  file.datatype = 16;
  file.bits = 32;
  std::vector<float> values(12, std::nanf(""));
  file.voxels = file.Values(values);
  EXPECT_EQ(this->KindOf(file, "finite"), FailureKind::Unreadable) << "all";
  values = { 1, -2, 3, std::nanf(""), -std::numeric_limits<float>::infinity(), 5, 6, 7, 8, 9, 10, 11 };
  file.voxels = file.Values(values);
  const auto scan = this->Read(file);
  values[3] = values[4] = -2;
  EXPECT_EQ(ValuesOf<float>(scan), values);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("2 values"), std::string::npos);
}

TEST_F(NIfTIFile, AnalyzeOnlyWhenAskedFor)
{
  NIfTITestFile file;
  file.magic = std::string(4, '\0');
  file.offset = 0;
  file.sformCode = 17; // something else in Analyze
  file.pixdim = { 0, 2, 3, 4 };
  file.isBigEndian = true;
  WriteBytes(m_Folder / "a.hdr", file.Header());
  WriteBytes(m_Folder / "a.img", file.Voxels());
  EXPECT_EQ(KindOfReading(m_Folder / "a.hdr", "Analyze"), FailureKind::Unreadable);
  ScanReadOptions options;
  options.acceptsAnalyze = true;
  const auto scan = ReadScan(m_Folder / "a.hdr", options);
  EXPECT_EQ(ValuesOf<std::int16_t>(scan), Counting(0, 12));
  EXPECT_EQ(GeometryOf(scan.image).GetSpacing()[1], 3);
  EXPECT_FALSE(scan.isOriented);
  EXPECT_EQ(scan.notes.size(), 2u);
  EXPECT_EQ(this->KindOf(file, "magic", options), FailureKind::Unreadable) << "a damaged .nii";
}

TEST_F(NIfTIFile, FieldsThatMakeNoSenseAreRefused)
{
  for (const int version : { 1, 2 })
  {
    const auto kindWith = [this, version](const auto & change) {
      NIfTITestFile file;
      file.version = version;
      change(file);
      return this->KindOf(file, "a.nii");
    };
    EXPECT_EQ(kindWith([](auto & file) { file.dimensions[0] = 0; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.dimensions[0] = 9; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.dimensions[1] = 0; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.dimensions[3] = -2; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.bits = 32; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.datatype = 32; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.datatype = 9999; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.intent = 1007; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.intent = 2003; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.offset = 300; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.offset = 1e9; }), FailureKind::Unreadable);
    EXPECT_EQ(kindWith([](auto & file) { file.magic = "xxxxxxxx"; }), FailureKind::Unreadable);
  }
  NIfTITestFile file;
  file.offset = 352.5;
  EXPECT_EQ(this->KindOf(file, "vox_offset"), FailureKind::Unreadable);
}

/** Any header gives a volume or a Failure, without a huge allocation. */
TEST_F(NIfTIFile, AnyHeaderIsReadOrRefused)
{
  std::mt19937 random(1);
  ScanReadOptions options;
  options.maximumMemory = 1 << 20;
  options.frame = 0;
  int read = 0;
  for (int i = 0; i < 1000; ++i)
  {
    NIfTITestFile file;
    file.version = 1 + i % 2;
    file.qformCode = 1;
    std::string bytes = file.Bytes();
    for (unsigned int change = 0; change <= random() % 4; ++change)
    {
      bytes[4 + random() % (bytes.size() - 4)] = static_cast<char>(random());
    }
    try
    {
      ReadScan(WriteBytes(m_Folder / "a.nii", i % 3 == 0 ? Gzipped(bytes) : bytes), options);
      ++read;
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_NE(failure.GetKind(), FailureKind::Internal) << failure.GetDescription();
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_LT(read, 900);
}

} // namespace
