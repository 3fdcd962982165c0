#include "rhombicNIfTITestFile.h"
#include "rhombicScanTest.h"

#include "itkImageFileWriter.h"
#include "itkMetaImageIO.h"
#include "itkNiftiImageIO.h"
#include "itkNrrdImageIO.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::ReadScan;

class VolumeFile : public ScanTest
{};

itk::ImageIOBase::Pointer
ImageIOFor(const fs::path & path)
{
  const std::string name = path.string();
  if (name.find(".nrrd") != std::string::npos || name.find(".nhdr") != std::string::npos)
  {
    return itk::NrrdImageIO::New().GetPointer();
  }
  if (name.find(".mh") != std::string::npos)
  {
    return itk::MetaImageIO::New().GetPointer();
  }
  return itk::NiftiImageIO::New().GetPointer();
}

template <typename TImage>
void
Write(const TImage * image, const fs::path & path, bool compress = false)
{
  auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetInput(image);
  writer->SetFileName(path.string());
  writer->SetImageIO(ImageIOFor(path));
  writer->SetUseCompression(compress);
  writer->Update();
}

const itk::Index<3> Marked{ { 5, 1, 3 } };

/** An oblique volume of zeros with one marked voxel. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeVolume(TPixel mark)
{
  auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { 7, 6, 5 } });
  itk::Matrix<double, 3, 3> direction;
  const double values[3][3] = { { 2, -2, 1 }, { 2, 1, -2 }, { 1, 2, 2 } };
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 3; ++column)
    {
      direction[row][column] = values[row][column] / 3;
    }
  }
  image->SetDirection(direction);
  const double spacing[3] = { 0.5, 0.75, 2 };
  const double origin[3] = { -20, 31, 4.5 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->Allocate(true);
  image->SetPixel(Marked, mark);
  itk::EncapsulateMetaData<std::string>(image->GetMetaDataDictionary(), "0010|0010", "Secret^Name");
  return image;
}

/** Where the marked voxel is: origin + direction * spacing * index, by hand. */
const double MarkedPoint[3] = { -20 + (2 * 2.5 - 2 * 0.75 + 6) / 3,
                                31 + (2 * 2.5 + 0.75 - 12) / 3,
                                4.5 + (2.5 + 1.5 + 12) / 3 };

template <typename TStored, typename TRead>
void
ExpectRoundTrip(const fs::path & path, TStored mark)
{
  Write(MakeVolume<TStored>(mark).GetPointer(), path);
  const auto scan = ReadScan(path);
  ASSERT_TRUE((std::holds_alternative<typename itk::Image<TRead, 3>::Pointer>(scan.image)))
    << path << " was read as " << rhombic::PixelTypeName(scan.image);
  const auto & image = ImageOf<TRead>(scan);
  EXPECT_EQ(image.GetPixel(Marked), static_cast<TRead>(mark)) << path;
  itk::Point<double, 3> point;
  image.TransformIndexToPhysicalPoint(Marked, point);
  ExpectNear(point, itk::Point<double, 3>(MarkedPoint), 1e-4);
  EXPECT_TRUE(image.GetMetaDataDictionary().GetKeys().empty()) << path;
  EXPECT_TRUE(scan.series.empty());
  EXPECT_TRUE(scan.notes.empty()) << scan.notes.front();
}

TEST_F(VolumeFile, EveryFormatAndPixelTypeLiesRightAndStaysNative)
{
  for (const char * extension : { ".nii", ".nii.gz", ".hdr", ".nrrd", ".nhdr", ".mha", ".mhd" })
  {
    const auto path = [this, extension](const char * name) { return m_Folder / (std::string(name) + extension); };
    ExpectRoundTrip<std::uint8_t, std::uint8_t>(path("uint8"), 200);
    ExpectRoundTrip<std::int8_t, std::int16_t>(path("int8"), -100);
    ExpectRoundTrip<std::int16_t, std::int16_t>(path("int16"), -3000);
    ExpectRoundTrip<std::uint16_t, std::uint16_t>(path("uint16"), 60000);
    ExpectRoundTrip<std::int32_t, std::int32_t>(path("int32"), -70000);
    ExpectRoundTrip<std::uint32_t, std::int32_t>(path("uint32"), 70000);
    ExpectRoundTrip<std::uint32_t, float>(path("large"), 4000000000u);
    ExpectRoundTrip<float, float>(path("float"), 0.25f);
    ExpectRoundTrip<double, float>(path("double"), -0.125);
  }
}

TEST_F(VolumeFile, CompressedFiles)
{
  for (const char * name : { "a.nrrd", "a.mha", "a.mhd" })
  {
    Write(MakeVolume<std::int16_t>(-7).GetPointer(), m_Folder / name, true);
    EXPECT_EQ(ImageOf<std::int16_t>(ReadScan(m_Folder / name)).GetPixel(Marked), -7) << name;
  }
}

TEST_F(VolumeFile, FormatsAreNamed)
{
  const auto image = MakeVolume<std::uint8_t>(1);
  Write(image.GetPointer(), m_Folder / "a.nii.gz");
  Write(image.GetPointer(), m_Folder / "a.nrrd");
  Write(image.GetPointer(), m_Folder / "a.mha");
  EXPECT_EQ(ReadScan(m_Folder / "a.nii.gz").format, "NIfTI");
  EXPECT_EQ(ReadScan(m_Folder / "a.nrrd").format, "NRRD");
  EXPECT_EQ(ReadScan(m_Folder / "a.mha").format, "MetaImage");
  EXPECT_EQ(KindOfReading(m_Folder / "a.mha", "a.mha", Series("2")), FailureKind::Usage);
}

TEST_F(VolumeFile, WhatIsNotFiniteBecomesTheLowestValue)
{
  auto image = MakeVolume<float>(3);
  image->SetPixel({ { 0, 0, 0 } }, std::nanf(""));
  image->SetPixel({ { 1, 0, 0 } }, -std::numeric_limits<float>::infinity());
  Write(image.GetPointer(), m_Folder / "a.mha");
  const auto scan = ReadScan(m_Folder / "a.mha");
  EXPECT_EQ(rhombictest::IntensityRange(scan.image), std::make_pair(0.0, 3.0));
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("2 values"), std::string::npos) << scan.notes[0];
  const auto & pixels = *std::get<itk::Image<float, 3>::Pointer>(scan.image);
  EXPECT_EQ(pixels.GetPixel({ { 0, 0, 0 } }), 0.0f);
  EXPECT_EQ(pixels.GetPixel({ { 1, 0, 0 } }), 0.0f);
}

TEST_F(VolumeFile, CutOffCompressedMetaImageIsRefused)
{
  Write(MakeVolume<std::int16_t>(3).GetPointer(), m_Folder / "whole.mha", true);
  EXPECT_NO_THROW(ReadScan(m_Folder / "whole.mha"));
  fs::copy(m_Folder / "whole.mha", m_Folder / "cut.mha");
  fs::resize_file(m_Folder / "cut.mha", fs::file_size(m_Folder / "whole.mha") - 20);
  EXPECT_EQ(KindOfReading(m_Folder / "cut.mha", "cut.mha"), FailureKind::Unreadable);
}

TEST_F(VolumeFile, NRRDWithoutSpaceIsNoted)
{
  std::ofstream(m_Folder / "bare.nrrd")
    << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n01234567";
  const auto bare = ReadScan(m_Folder / "bare.nrrd");
  EXPECT_FALSE(bare.isOriented);
  ASSERT_EQ(bare.notes.size(), 1u);
  EXPECT_NE(bare.notes[0].find("left and right"), std::string::npos);
  Write(MakeVolume<std::int16_t>(3).GetPointer(), m_Folder / "full.nrrd");
  EXPECT_TRUE(ReadScan(m_Folder / "full.nrrd").isOriented);
}

TEST_F(VolumeFile, TrailingSingleDimensionIsDropped)
{
  auto image = itk::Image<std::int16_t, 4>::New();
  image->SetRegions(itk::Size<4>{ { 4, 3, 2, 1 } });
  itk::Matrix<double, 4, 4> direction;
  direction.SetIdentity();
  direction[0][0] = direction[1][1] = -1;
  image->SetDirection(direction);
  image->Allocate(true);
  for (const char * name : { "a.nii", "a.mha", "a.nrrd" })
  {
    Write(image.GetPointer(), m_Folder / name);
    const auto scan = ReadScan(m_Folder / name);
    EXPECT_EQ(rhombic::GeometryOf(scan.image).GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { 4, 3, 2 } }));
    EXPECT_EQ(rhombic::GeometryOf(scan.image).GetDirection()[0][0], -1) << name;
  }
}

TEST_F(VolumeFile, OtherThanOneScalarVolumeIsRefused)
{
  auto series = itk::Image<std::int16_t, 4>::New();
  series->SetRegions(itk::Size<4>{ { 4, 3, 2, 2 } });
  series->Allocate(true);
  auto flat = itk::Image<std::int16_t, 2>::New();
  flat->SetRegions(itk::Size<2>{ { 4, 3 } });
  flat->Allocate(true);
  auto vectors = itk::Image<itk::Vector<float, 3>, 3>::New();
  vectors->SetRegions(itk::Size<3>{ { 4, 3, 2 } });
  vectors->Allocate(true);
  for (const std::string extension : { ".nii", ".mha", ".nrrd" })
  {
    Write(series.GetPointer(), m_Folder / ("series" + extension));
    Write(flat.GetPointer(), m_Folder / ("flat" + extension));
    Write(vectors.GetPointer(), m_Folder / ("vectors" + extension));
    for (const std::string name : { "series", "flat", "vectors" })
    {
      EXPECT_EQ(KindOfReading(m_Folder / (name + extension), name + extension), FailureKind::Unreadable);
    }
  }
}

TEST_F(VolumeFile, CutOffFilesAreRefused)
{
  for (const std::string name : { "a.nii", "a.nii.gz", "a.mha", "a.nrrd" })
  {
    Write(MakeVolume<std::int16_t>(-7).GetPointer(), m_Folder / name);
    fs::resize_file(m_Folder / name, fs::file_size(m_Folder / name) - 20);
    EXPECT_EQ(KindOfReading(m_Folder / name, name), FailureKind::Unreadable);
  }
  Write(MakeVolume<std::int16_t>(-7).GetPointer(), m_Folder / "b.mhd");
  fs::remove(m_Folder / "b.raw");
  EXPECT_EQ(KindOfReading(m_Folder / "b.mhd", "b.raw"), FailureKind::Unreadable);
  Write(MakeVolume<std::int16_t>(-7).GetPointer(), m_Folder / "c.hdr");
  fs::remove(m_Folder / "c.img");
  EXPECT_EQ(KindOfReading(m_Folder / "c.hdr", "c.hdr"), FailureKind::Unreadable);
}

TEST_F(VolumeFile, ContentThatIsNotWhatTheNameSaysIsRefused)
{
  for (const std::string name : { "a.nii", "a.nii.gz", "a.hdr", "a.nrrd", "a.mha", "a.mhd", "a.what" })
  {
    std::ofstream(m_Folder / name) << "This is a letter. " << std::string(1000, 'x');
    EXPECT_EQ(KindOfReading(m_Folder / name, name), FailureKind::Unreadable);
    std::ofstream(m_Folder / name, std::ios::trunc).flush();
    EXPECT_EQ(KindOfReading(m_Folder / name, name), FailureKind::Unreadable) << "empty";
  }
}

/** Changes bytes of a file, at an offset, to those of a value. */
template <typename TValue>
void
Patch(const fs::path & path, std::streamoff offset, TValue value)
{
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(offset);
  file.write(reinterpret_cast<const char *>(&value), sizeof(value));
}

/** A fresh NIfTI file with one field of its header changed. */
template <typename TValue>
fs::path
WritePatched(const fs::path & folder, std::streamoff offset, TValue value)
{
  fs::path path = folder / "patched.nii";
  Write(MakeVolume<std::int16_t>(-7).GetPointer(), path);
  Patch(path, offset, value);
  return path;
}

TEST_F(VolumeFile, HeadersThatMakeNoSenseAreRefused)
{
  const auto kindWith = [this](std::streamoff offset, auto value) {
    return KindOfReading(WritePatched(m_Folder, offset, value), "patched.nii");
  };
  const float nan = std::nanf("");
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(kindWith(280, nan), FailureKind::Geometry) << "srow_x";
  EXPECT_EQ(kindWith(268, infinity), FailureKind::Geometry) << "qoffset_x";
  EXPECT_EQ(kindWith(84, nan), FailureKind::Geometry) << "pixdim";
  EXPECT_EQ(kindWith(84, 0.0f), FailureKind::Geometry) << "pixdim";
  EXPECT_EQ(kindWith(108, nan), FailureKind::Unreadable) << "vox_offset";
  EXPECT_EQ(kindWith(108, 0.0f), FailureKind::Unreadable) << "vox_offset";
  EXPECT_EQ(kindWith(108, 1e6f), FailureKind::Unreadable) << "vox_offset";
  EXPECT_EQ(kindWith(112, infinity), FailureKind::Unreadable) << "scl_slope";
  EXPECT_EQ(kindWith(70, std::int16_t(32)), FailureKind::Unreadable) << "complex";
  EXPECT_EQ(kindWith(70, std::int16_t(128)), FailureKind::Unreadable) << "RGB";
  EXPECT_EQ(kindWith(72, std::int16_t(8)), FailureKind::Unreadable) << "bitpix";
  EXPECT_EQ(kindWith(68, std::int16_t(1007)), FailureKind::Unreadable) << "vector intent";
  EXPECT_EQ(kindWith(42, std::int16_t(30000)), FailureKind::Unreadable) << "larger than the file";
  EXPECT_EQ(kindWith(42, std::int16_t(-7)), FailureKind::Unreadable) << "negative size";
  EXPECT_EQ(kindWith(344, 'x'), FailureKind::Unreadable) << "magic";
  EXPECT_EQ(kindWith(0, std::int32_t(540)), FailureKind::Unreadable) << "NIfTI-2";
}

TEST_F(VolumeFile, DamagedGzipIsRefused)
{
  const fs::path path = m_Folder / "a.nii.gz";
  Write(MakeVolume<std::int16_t>(-7).GetPointer(), path);
  Patch(path, static_cast<std::streamoff>(fs::file_size(path)) - 6, '\x55'); // in the checksum
  EXPECT_EQ(KindOfReading(path, "a.nii.gz"), FailureKind::Unreadable);
}

// Unpacked to its end, a small file would take hours.
TEST_F(VolumeFile, LongTailsOfCompressedVoxelsAreRefused)
{
  const std::string tail(2 << 20, '\0');
  const auto write = [this](const std::string & name, const std::string & bytes) {
    std::ofstream(m_Folder / name, std::ios::binary) << bytes;
    return m_Folder / name;
  };
  const std::string voxels = NIfTITestFile().Bytes();
  EXPECT_EQ(KindOfReading(write("a.nii.gz", Gzipped(voxels + tail)), "goes on behind"), FailureKind::Unreadable);
  const std::string header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: gzip\n\n";
  EXPECT_NO_THROW(ReadScan(write("a.nrrd", header + Gzipped("12345678"))));
  EXPECT_EQ(KindOfReading(write("a.nrrd", header + Gzipped("12345678" + tail)), "a.nrrd"), FailureKind::Unreadable);
}

TEST_F(VolumeFile, NIfTIWithoutOrientationIsNoted)
{
  const fs::path path = WritePatched(m_Folder, 252, std::int32_t(0)); // qform_code and sform_code
  const auto scan = ReadScan(path);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("left and right"), std::string::npos) << scan.notes[0];
}

TEST_F(VolumeFile, ScansSayWhetherTheyAreOriented)
{
  EXPECT_FALSE(ReadScan(WritePatched(m_Folder, 252, std::int32_t(0))).isOriented);
  Write(MakeVolume<std::int16_t>(3).GetPointer(), m_Folder / "a.nii");
  EXPECT_TRUE(ReadScan(m_Folder / "a.nii").isOriented);
}

TEST_F(VolumeFile, NIfTIWithTwoPositionsIsNotedAndTheSformUsed)
{
  const fs::path path = WritePatched(m_Folder, 268, 120.0f); // qoffset_x, right-positive
  Patch(path, 252, std::int16_t(1));
  Patch(path, 254, std::int16_t(1));
  const auto scan = ReadScan(path);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("100.0"), std::string::npos) << scan.notes[0];
  EXPECT_NEAR(rhombic::GeometryOf(scan.image).GetOrigin()[0], -20, 1e-5);
}

TEST_F(VolumeFile, NIfTIUnitsScaleSpacingAndOrigin)
{
  const fs::path path = WritePatched(m_Folder, 123, char(3)); // micrometres
  const auto scan = ReadScan(path);
  const auto & geometry = rhombic::GeometryOf(scan.image);
  EXPECT_NEAR(geometry.GetSpacing()[2], 2e-3, 1e-9);
  EXPECT_NEAR(geometry.GetOrigin()[1], 31e-3, 1e-8);
}

TEST_F(VolumeFile, NIfTIScalingGivesFloats)
{
  const fs::path path = WritePatched(m_Folder, 112, 0.5f);
  Patch(path, 116, 2.0f);
  const auto scan = ReadScan(path);
  EXPECT_EQ(ImageOf<float>(scan).GetPixel(Marked), -1.5f);
  EXPECT_EQ(ImageOf<float>(scan).GetPixel({ { 0, 0, 0 } }), 2.0f);
}

} // namespace
