#include "itkScanImageIO.h"
#include "itkScanImageIOFactory.h"

#include "itkNativeScanFileReader.h"
#include "itkRefusal.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicStackTest.h"

#include "itkGDCMImageIO.h"
#include "itkGDCMImageIOFactory.h"
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkImageRegionConstIteratorWithIndex.h"
#include "itkImageSeriesReader.h"
#include "itkMetaDataObject.h"
#include "itkMetaImageIOFactory.h"
#include "itkNiftiImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"

#include <cstring>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

/** itk::ImageFileReader with ScanImageIO among ITK's own classes. */
namespace
{

namespace fs = std::filesystem;
using ImageType = itk::Image<std::int16_t, 3>;
using itk::ObjectFactoryBase;

/** A program with ITK's factories, in which RegisterOneFactory() was called after them. */
class ScanImageIO : public StackTest
{
protected:
  void
  SetUp() override
  {
    m_Factories = { itk::GDCMImageIOFactory::New().GetPointer(),
                    itk::NiftiImageIOFactory::New().GetPointer(),
                    itk::NrrdImageIOFactory::New().GetPointer(),
                    itk::MetaImageIOFactory::New().GetPointer() };
    for (const auto & factory : m_Factories)
    {
      ObjectFactoryBase::RegisterFactory(factory);
    }
    itk::ScanImageIOFactory::RegisterOneFactory();
  }

  void
  TearDown() override
  {
    for (ObjectFactoryBase * const factory : ObjectFactoryBase::GetRegisteredFactories())
    {
      const bool isOurs = std::strcmp(factory->GetNameOfClass(), "ScanImageIOFactory") == 0;
      if (isOurs || std::count(m_Factories.begin(), m_Factories.end(), factory) > 0)
      {
        ObjectFactoryBase::UnRegisterFactory(factory);
      }
    }
  }

  std::vector<ObjectFactoryBase::Pointer> m_Factories;
};

template <typename TImage = ImageType>
typename itk::ImageFileReader<TImage>::Pointer
MakeReader(const fs::path & path)
{
  const auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetFileName(path.string());
  return reader;
}

/** The class that ImageFileReader reads a file with. */
std::string
ClassFor(const fs::path & path)
{
  const auto reader = MakeReader(path);
  reader->UpdateOutputInformation();
  return reader->GetImageIO()->GetNameOfClass();
}

template <typename TImage = ImageType>
typename TImage::Pointer
Read(const fs::path & path)
{
  const auto reader = MakeReader<TImage>(path);
  reader->Update();
  EXPECT_STREQ(reader->GetImageIO()->GetNameOfClass(), "ScanImageIO") << path;
  return reader->GetOutput();
}

void
ExpectSameGeometry(const itk::ImageBase<3> & actual, const itk::ImageBase<3> & expected)
{
  EXPECT_EQ(actual.GetLargestPossibleRegion(), expected.GetLargestPossibleRegion());
  EXPECT_EQ(actual.GetOrigin(), expected.GetOrigin());
  EXPECT_EQ(actual.GetSpacing(), expected.GetSpacing());
  EXPECT_EQ(actual.GetDirection(), expected.GetDirection());
}

/** Geometry, and the values as doubles, which hold those of all types here. */
template <typename TImage>
void
ExpectSame(const TImage & actual, const TImage & expected)
{
  ExpectSameGeometry(actual, expected);
  ASSERT_EQ(actual.GetBufferedRegion(), expected.GetBufferedRegion());
  const auto * const values = actual.GetBufferPointer();
  EXPECT_TRUE(std::equal(values, values + actual.GetBufferedRegion().GetNumberOfPixels(), expected.GetBufferPointer()));
}

/** What ScanFileReader reads. */
template <typename TImage = ImageType>
typename TImage::Pointer
ReadScanFile(const fs::path & path)
{
  const auto reader = itk::ScanFileReader<TImage>::New();
  reader->SetFileName(path.string());
  reader->Update();
  return reader->GetOutput();
}

/** The part of an image that is asked for, read alone. */
template <typename TImage>
typename TImage::Pointer
ReadRegion(const fs::path & path, const itk::ImageRegion<3> & region)
{
  const auto reader = MakeReader<TImage>(path);
  reader->UpdateOutputInformation();
  reader->GetOutput()->SetRequestedRegion(region);
  reader->GetOutput()->Update();
  EXPECT_EQ(reader->GetOutput()->GetBufferedRegion(), region) << path;
  return reader->GetOutput();
}

template <typename TImage>
void
ExpectParts(const fs::path & path)
{
  const auto whole = Read<TImage>(path);
  const itk::Size<3> size = whole->GetLargestPossibleRegion().GetSize();
  const auto last = [&size](unsigned int axis) { return static_cast<itk::IndexValueType>(size[axis] - 1); };
  for (const itk::ImageRegion<3> & region :
       { itk::ImageRegion<3>({ { 1, 1, 1 } }, { { size[0] - 1, size[1] - 1, size[2] - 1 } }),
         itk::ImageRegion<3>({ { 0, 0, 1 } }, { { size[0], size[1], size[2] - 1 } }),
         itk::ImageRegion<3>({ { 0, 1, 0 } }, { { size[0], 1, size[2] } }),
         itk::ImageRegion<3>({ { last(0), last(1), last(2) } }, { { 1, 1, 1 } }) })
  {
    const auto part = ReadRegion<TImage>(path, region);
    itk::ImageRegionConstIteratorWithIndex<TImage> voxel(part, region);
    for (; !voxel.IsAtEnd(); ++voxel)
    {
      ASSERT_EQ(voxel.Get(), whole->GetPixel(voxel.GetIndex())) << path << voxel.GetIndex();
    }
  }
}

TEST_F(ScanImageIO, IsABasicObjectOfITKThatWritesNothing)
{
  const auto io = itk::ScanImageIO::New();
  EXPECT_STREQ(io->GetNameOfClass(), "ScanImageIO");
  EXPECT_NE(dynamic_cast<itk::ScanImageIO *>(io->CreateAnother().GetPointer()), nullptr);
  std::ostringstream text;
  io->Print(text);
  EXPECT_NE(text.str().find("ReadsInPart: 0"), std::string::npos);
  for (const char * const name : { "a.nii", "a.nii.gz", "a.nrrd", "a.mha", "a.dcm", "" })
  {
    EXPECT_FALSE(io->CanWriteFile(name)) << name;
  }
  EXPECT_NE(Refusal([&] { io->WriteImageInformation(); }), "");
  EXPECT_NE(Refusal([&] { io->Write(nullptr); }), "");
  EXPECT_NE(Refusal([&] { io->Read(nullptr); }).find("ReadImageInformation()"), std::string::npos);
}

TEST_F(ScanImageIO, ReadsEachFormatAsScanFileReaderDoes)
{
  std::vector<fs::path> paths = this->WriteAll();
  NIfTITestFile second;
  second.version = 2;
  paths.push_back(WriteBytes(m_Folder / "second.nii", second.Bytes()));
  NIfTITestFile pair;
  pair.magic = std::string("ni1\0", 4);
  pair.offset = 0;
  WriteBytes(m_Folder / "pair.img", pair.Voxels());
  paths.push_back(WriteBytes(m_Folder / "pair.hdr", pair.Header()));
  paths.push_back(m_Folder / "pair.img");
  for (const fs::path & path : paths)
  {
    EXPECT_EQ(ClassFor(path), "ScanImageIO") << path;
    ExpectSame(*Read(path), *ReadScanFile(path));
    ExpectSame(*Read<itk::Image<double, 3>>(path), *ReadScanFile<itk::Image<double, 3>>(path));
  }
}

TEST_F(ScanImageIO, IsFirstWheneverItIsRegistered)
{
  const fs::path path = this->WriteAll()[2];
  const auto other = itk::NiftiImageIOFactory::New();
  ObjectFactoryBase::RegisterFactory(other, ObjectFactoryBase::InsertionPositionEnum::INSERT_AT_FRONT);
  EXPECT_EQ(ClassFor(path), "NiftiImageIO");
  itk::ScanImageIOFactory::RegisterOneFactory();
  EXPECT_EQ(ClassFor(path), "ScanImageIO");
  const auto factories = ObjectFactoryBase::GetRegisteredFactories();
  EXPECT_STREQ(factories.front()->GetNameOfClass(), "ScanImageIOFactory");
  EXPECT_EQ(std::count_if(
              factories.begin(),
              factories.end(),
              [](const auto * factory) { return std::strcmp(factory->GetNameOfClass(), "ScanImageIOFactory") == 0; }),
            1);
  ObjectFactoryBase::UnRegisterFactory(other);
}

/** Writes a NIfTI file of some values, and reads them in their own type. */
template <typename TValue>
void
ExpectStored(const fs::path & folder, int datatype, itk::IOComponentEnum type)
{
  using Limits = std::numeric_limits<TValue>;
  for (const bool isBigEndian : { false, true })
  {
    NIfTITestFile file;
    file.isBigEndian = isBigEndian;
    file.datatype = datatype;
    file.bits = 8 * sizeof(TValue);
    std::vector<TValue> values(12, static_cast<TValue>(3));
    values[0] = Limits::lowest();
    values[11] = Limits::max();
    file.voxels = file.Values(values);
    const fs::path path = WriteBytes(folder / (std::to_string(datatype) + ".nii"), file.Bytes());
    const auto reader = MakeReader<itk::Image<TValue, 3>>(path);
    reader->Update();
    EXPECT_STREQ(reader->GetImageIO()->GetNameOfClass(), "ScanImageIO");
    EXPECT_EQ(reader->GetImageIO()->GetComponentType(), type) << datatype;
    EXPECT_EQ(reader->GetImageIO()->GetPixelType(), itk::IOPixelEnum::SCALAR);
    EXPECT_EQ(reader->GetImageIO()->GetNumberOfComponents(), 1u);
    EXPECT_TRUE(std::equal(values.begin(), values.end(), reader->GetOutput()->GetBufferPointer())) << datatype;
    ExpectParts<itk::Image<TValue, 3>>(path);
  }
}

TEST_F(ScanImageIO, GivesEachStoredTypeAsItIs)
{
  using Component = itk::IOComponentEnum;
  ExpectStored<std::uint8_t>(m_Folder, 2, Component::UCHAR);
  ExpectStored<std::int8_t>(m_Folder, 256, Component::CHAR);
  ExpectStored<std::uint16_t>(m_Folder, 512, Component::USHORT);
  ExpectStored<std::int16_t>(m_Folder, 4, Component::SHORT);
  ExpectStored<std::uint32_t>(m_Folder, 768, Component::UINT);
  ExpectStored<std::int32_t>(m_Folder, 8, Component::INT);
  ExpectStored<std::uint64_t>(m_Folder, 1280, Component::ULONG);
  ExpectStored<std::int64_t>(m_Folder, 1024, Component::LONG);
  ExpectStored<float>(m_Folder, 16, Component::FLOAT);
  ExpectStored<double>(m_Folder, 64, Component::DOUBLE);
}

TEST_F(ScanImageIO, ScalesValuesAsScanFileReaderDoes)
{
  using FloatImage = itk::Image<float, 3>;
  NIfTITestFile file;
  file.slope = 0.5;
  file.intercept = -3;
  const fs::path path = WriteBytes(m_Folder / "scaled.nii", file.Bytes());
  const auto reader = MakeReader<FloatImage>(path);
  reader->Update();
  EXPECT_EQ(reader->GetImageIO()->GetComponentType(), itk::IOComponentEnum::FLOAT);
  EXPECT_EQ(reader->GetOutput()->GetPixel({ { 2, 1, 1 } }), 2.5f);
  ExpectSame(*reader->GetOutput(), *ReadScanFile<FloatImage>(path));
  ExpectParts<FloatImage>(path);
}

TEST_F(ScanImageIO, ReplacesValuesThatAreNotFiniteAlikeInAllParts)
{
  using FloatImage = itk::Image<float, 3>;
  NIfTITestFile file;
  file.datatype = 16;
  file.bits = 32;
  std::vector<float> values{ -7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
  values[3] = std::numeric_limits<float>::quiet_NaN();
  values[11] = std::numeric_limits<float>::infinity();
  file.voxels = file.Values(values);
  const fs::path path = WriteBytes(m_Folder / "nan.nii", file.Bytes());
  ExpectSame(*Read<FloatImage>(path), *ReadScanFile<FloatImage>(path));
  EXPECT_EQ(Read<FloatImage>(path)->GetPixel({ { 2, 1, 1 } }), -7);
  ExpectParts<FloatImage>(path); // of which some lack the lowest value
  file.voxels = file.Values(std::vector<float>(12, values[3]));
  WriteBytes(path, file.Bytes());
  EXPECT_NE(Refusal([&] { Read<FloatImage>(path); }).find("none of its values is a finite number"), std::string::npos);
}

TEST_F(ScanImageIO, ReadsInPartWhereFilesAreNotCompressed)
{
  const std::set<std::string> streamed{ ".nii", ".nrrd", ".mha" };
  for (const fs::path & path : this->WriteAll())
  {
    const auto reader = MakeReader(path);
    reader->UpdateOutputInformation();
    const bool isStreamed = streamed.count(path.extension().string()) > 0;
    EXPECT_EQ(reader->GetImageIO()->CanStreamRead(), isStreamed) << path;
    const itk::ImageRegion<3> part({ { 1, 2, 3 } }, { { 2, 3, 4 } });
    reader->GetOutput()->SetRequestedRegion(part);
    reader->GetOutput()->Update();
    const auto whole = ReadScanFile(path);
    EXPECT_EQ(reader->GetOutput()->GetBufferedRegion(), isStreamed ? part : whole->GetLargestPossibleRegion()) << path;
    EXPECT_EQ(reader->GetOutput()->GetPixel({ { 2, 4, 6 } }), whole->GetPixel({ { 2, 4, 6 } })) << path;
    reader->SetUseStreaming(false);
    reader->Update();
    ExpectSame(*reader->GetOutput(), *whole);
  }
}

TEST_F(ScanImageIO, ReadsAPartOfAFileThatIsLargerThanTheMemory)
{
  NIfTITestFile file;
  file.version = 2;
  constexpr std::int64_t side = 20000;
  file.dimensions = { 3, side, side, side, 1, 1, 1, 1 }; // 16 TB of int16
  file.voxels = "--";
  const fs::path path = WriteBytes(m_Folder / "large.nii", file.Bytes());
  const std::uintmax_t header = fs::file_size(path) - file.voxels.size();
  std::error_code error;
  fs::resize_file(path, header + std::uintmax_t{ 2 } * side * side * side, error);
  if (error)
  {
    GTEST_SKIP() << "no file system for files of 16 TB with holes";
  }
  const auto part = ReadRegion<ImageType>(path, { { { 0, 0, 0 } }, { { 2, 2, 2 } } });
  EXPECT_EQ(part->GetPixel({ { 0, 0, 0 } }), 0x2d2d);
  EXPECT_EQ(part->GetPixel({ { 1, 1, 1 } }), 0);
  const std::string sentence = Refusal([&] { Read(path); });
  EXPECT_NE(sentence.find("would need"), std::string::npos) << sentence;
}

TEST_F(ScanImageIO, RefusesRegionsOutsideOfTheImage)
{
  const auto io = itk::ScanImageIO::New();
  const std::string name = this->WriteAll()[1].string();
  io->SetFileName(name);
  io->ReadImageInformation();
  itk::ImageIORegion region(3);
  region.SetSize({ Columns, Rows, Slices + 1 });
  io->SetIORegion(region);
  std::vector<std::int16_t> buffer(1000);
  EXPECT_NE(Refusal([&] { io->Read(buffer.data()); }).find("not inside"), std::string::npos);
}

TEST_F(ScanImageIO, ReadsHeadersAloneUnlessTheyLeaveTheTypeOpen)
{
  // A stack of 12 bits with an intercept of -1024 holds no values beyond int16.
  const auto write = [this](unsigned short bits, std::uint16_t value) {
    for (int k = 0; k < 3; ++k)
    {
      DicomTestFile file(2, 2);
      file.SetShort(0x00280101, bits);
      file.SetShort(0x00280102, static_cast<std::uint16_t>(bits - 1));
      file.SetShort(0x00280103, 0);
      file.SetPixels(std::vector<std::uint16_t>(4, value));
      file.SetPosition("0\\0\\" + std::to_string(k));
      fs::create_directories(m_Folder / "stack");
      file.Write(m_Folder / "stack" / (std::to_string(k) + ".dcm"));
    }
  };
  using IntImage = itk::Image<int, 3>;
  const auto expect = [this](itk::IOComponentEnum type, int value, const std::function<void()> & change) {
    const auto reader = MakeReader<IntImage>(m_Folder / "stack");
    reader->UpdateOutputInformation();
    EXPECT_EQ(reader->GetImageIO()->GetComponentType(), type) << value;
    change();
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetPixel({ { 1, 1, 1 } }), value);
  };
  write(12, 1000);
  expect(itk::IOComponentEnum::SHORT, 2000 - 1024, [&] { write(12, 2000); }); // read from the files in Update()
  write(16, 1000);
  expect(itk::IOComponentEnum::SHORT, 1000 - 1024, [&] { fs::remove_all(m_Folder / "stack"); }); // read once, before
  write(16, 60000);
  expect(itk::IOComponentEnum::USHORT, 60000 - 1024, [] {});
  write(16, 33000);
  expect(itk::IOComponentEnum::SHORT, 33000 - 1024, [] {});
}

TEST_F(ScanImageIO, LeavesToITKWhatItDoesNotRead)
{
  const auto io = itk::ScanImageIO::New();
  const auto expect = [&](const std::string & name, const std::string & bytes, const std::string & classOfITK) {
    const fs::path path = WriteBytes(m_Folder / name, bytes);
    EXPECT_FALSE(io->CanReadFile(path.c_str())) << path;
    EXPECT_EQ(ClassFor(path), classOfITK) << path;
  };
  NIfTITestFile flat;
  flat.dimensions = { 2, 3, 2, 1, 1, 1, 1, 1 };
  expect("flat.nii", flat.Bytes(), "NiftiImageIO");
  NIfTITestFile series;
  series.dimensions = { 4, 3, 2, 2, 2, 1, 1, 1 };
  expect("series.nii", series.Bytes(), "NiftiImageIO");
  expect("series.nii.gz", Gzipped(series.Bytes()), "NiftiImageIO");
  NIfTITestFile colour;
  colour.datatype = 128;
  colour.bits = 24;
  colour.voxels = std::string(36, '\1');
  expect("colour.nii", colour.Bytes(), "NiftiImageIO");
  NIfTITestFile complex;
  complex.datatype = 32;
  complex.bits = 64;
  complex.voxels = std::string(96, '\0');
  expect("complex.nii", complex.Bytes(), "NiftiImageIO");
  NIfTITestFile vectors;
  vectors.dimensions = { 5, 3, 2, 2, 1, 2, 1, 1 };
  vectors.intent = 1007;
  expect("vectors.nii", vectors.Bytes(), "NiftiImageIO");
  const std::string meta = "ObjectType = Image\nBinaryData = True\nBinaryDataByteOrderMSB = False\n";
  const std::string voxels(64, '\0');
  expect("flat.mha",
         meta + "NDims = 2\nDimSize = 4 4\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + voxels,
         "MetaImageIO");
  expect("series.mha",
         meta + "NDims = 4\nDimSize = 2 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + voxels,
         "MetaImageIO");
  expect("vectors.mha",
         meta +
           "NDims = 3\nDimSize = 2 2 2\nElementNumberOfChannels = 3\nElementType = MET_UCHAR\n"
           "ElementDataFile = LOCAL\n" +
           voxels,
         "MetaImageIO");
  const std::string nrrd = "NRRD0004\ntype: uchar\nencoding: raw\n";
  expect("flat.nrrd", nrrd + "dimension: 2\nsizes: 4 4\n\n" + voxels, "NrrdImageIO");
  expect("vectors.nrrd",
         nrrd + "dimension: 4\nsizes: 3 2 2 2\nkinds: vector domain domain domain\n\n" + voxels,
         "NrrdImageIO");
  expect("volumes.nrrd",
         nrrd + "dimension: 4\nsizes: 3 2 2 2\nkinds: list domain domain domain\n\n" + voxels,
         "NrrdImageIO");
  for (const char * const name : { "flat.nii", "series.nii", "vectors.mha", "volumes.nrrd" })
  {
    io->SetFileName((m_Folder / name).string());
    EXPECT_NE(Refusal([&] { io->ReadImageInformation(); }), "") << "whoever takes this class by himself";
  }
}

TEST_F(ScanImageIO, LeavesOtherFilesAndFoldersAlone)
{
  const auto io = itk::ScanImageIO::New();
  WriteBytes(m_Folder / "notes.txt", "no image");
  WriteBytes(m_Folder / "empty", "");
  fs::create_directories(m_Folder / "store.zarr");
  WriteBytes(m_Folder / "store.zarr" / ".zattrs", "{}");
  for (const char * const name : { "notes.txt", "empty", "store.zarr", "missing.nii" })
  {
    EXPECT_FALSE(io->CanReadFile((m_Folder / name).c_str())) << name;
  }
  EXPECT_FALSE(io->CanReadFile(""));
  DicomTestFile colour(2, 2);
  colour.SetShort(0x00280002, 3);
  colour.SetText(0x00280004, "CS", "RGB");
  colour.SetPixels(std::vector<std::uint16_t>(12));
  colour.Write(m_Folder / "colour.dcm");
  EXPECT_EQ(ClassFor(m_Folder / "colour.dcm"), "GDCMImageIO");
  DicomTestFile picture(2, 2); // one without a place in a patient
  picture.Remove(0x00200032);
  picture.Remove(0x00200037);
  picture.Write(m_Folder / "picture.dcm");
  EXPECT_EQ(ClassFor(m_Folder / "picture.dcm"), "GDCMImageIO");
}

TEST_F(ScanImageIO, RefusesWhatIsDamagedAndLeavesItNotToITK)
{
  const auto expect = [](const fs::path & path, const std::string & why) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const auto reader = MakeReader(path);
    const std::string sentence = Refusal([&] { reader->Update(); });
    EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
    EXPECT_NE(sentence.find(why), std::string::npos) << sentence;
    EXPECT_STREQ(reader->GetImageIO()->GetNameOfClass(), "ScanImageIO");
  };
  const std::vector<fs::path> paths = this->WriteAll();
  for (const std::size_t n : { 1, 2, 3, 4 })
  {
    fs::resize_file(paths[n], fs::file_size(paths[n]) * 3 / 4);
    expect(paths[n], "cut off");
  }
  expect(WriteBytes(m_Folder / "nonsense.nii", "nonsense"), "not NIfTI");
  fs::resize_file(paths[0] / "0.dcm", fs::file_size(paths[0] / "0.dcm") - 10);
  expect(paths[0] / "0.dcm", "bytes of pixels");
  expect(paths[0], "bytes of pixels");
  DicomTestFile slope(2, 2);
  slope.SetText(0x00281053, "DS", "nan");
  slope.Write(m_Folder / "slope.dcm");
  expect(m_Folder / "slope.dcm", "RescaleSlope"); // ends a process that reads it with GDCMImageIO
  DicomTestFile nowhere(2, 2);
  nowhere.Remove(0x00200032);
  nowhere.Write(m_Folder / "nowhere.dcm");
  expect(m_Folder / "nowhere.dcm", "ImagePositionPatient");
}

TEST_F(ScanImageIO, NamesTheReaderOfUnevenStacks)
{
  const fs::path uneven = this->WriteStack("uneven", true);
  const auto reader = MakeReader(uneven);
  const std::string sentence = Refusal([&] { reader->UpdateOutputInformation(); });
  EXPECT_NE(sentence.find("uneven"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("itk::ScanFileReader"), std::string::npos) << sentence;
  EXPECT_STREQ(reader->GetImageIO()->GetNameOfClass(), "ScanImageIO");
  fs::remove(this->WriteStack("gap") / "1.dcm");
  EXPECT_NE(Refusal([&] { MakeReader(m_Folder / "gap")->Update(); }).find("itk::ScanFileReader"), std::string::npos);
}

TEST_F(ScanImageIO, KeepsTheShearOfTiltedSlices)
{
  for (int k = 0; k < 4; ++k)
  {
    DicomTestFile file(3, 3);
    file.SetPosition("0\\" + std::to_string(0.5 * k) + "\\" + std::to_string(2 * k));
    fs::create_directories(m_Folder / "tilted");
    file.Write(m_Folder / "tilted" / (std::to_string(k) + ".dcm"));
  }
  const auto image = Read(m_Folder / "tilted");
  ExpectSame(*image, *ReadScanFile(m_Folder / "tilted"));
  itk::Point<double, 3> last;
  image->TransformIndexToPhysicalPoint(itk::Index<3>{ { 0, 0, 3 } }, last);
  EXPECT_NEAR(last[1], 1.5, 1e-9);
  EXPECT_NEAR(last[2], 6, 1e-9);
  NIfTITestFile sheared;
  sheared.sform = { 1, 0, 0.2, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  const fs::path path = WriteBytes(m_Folder / "sheared.nii", sheared.Bytes());
  ExpectSame(*Read(path), *ReadScanFile(path));
}

TEST_F(ScanImageIO, TellsNothingAboutThePatient)
{
  for (const fs::path & path : this->WriteAll())
  {
    const auto image = Read(path);
    const itk::MetaDataDictionary & dictionary = image->GetMetaDataDictionary();
    std::string text;
    std::set<std::string> keys;
    for (const std::string & key : dictionary.GetKeys())
    {
      itk::ExposeMetaData<std::string>(dictionary, key, text);
      EXPECT_EQ(text.find("Secret"), std::string::npos) << key;
      keys.insert(key);
    }
    EXPECT_EQ(keys,
              (std::set<std::string>{ "ITK_original_direction",
                                      "ITK_original_spacing",
                                      "ScanEncoding",
                                      "ScanFormat",
                                      "ScanFrame",
                                      "ScanIsOriented",
                                      "ScanModality",
                                      "ScanScaling",
                                      "ScanSeries",
                                      "ScanTiltDegrees" }));
  }
  const auto image = Read(m_Folder / "dicom");
  std::string modality;
  EXPECT_TRUE(itk::ExposeMetaData<std::string>(image->GetMetaDataDictionary(), "ScanModality", modality));
  EXPECT_EQ(modality, "CT");
}

TEST_F(ScanImageIO, BehavesAsClassesOfITKDo)
{
  const fs::path path = this->WriteAll()[1];
  const auto whole = ReadScanFile(path);

  const std::string missing = Refusal([&] { MakeReader(m_Folder / "missing.nii")->Update(); });
  EXPECT_NE(missing.find("doesn't exist"), std::string::npos) << missing;

  const auto slice = MakeReader<itk::Image<std::int16_t, 2>>(path); // the first one
  slice->Update();
  EXPECT_EQ(slice->GetOutput()->GetLargestPossibleRegion().GetSize(), (itk::Size<2>{ { Columns, Rows } }));
  EXPECT_EQ(slice->GetOutput()->GetPixel({ { 2, 3 } }), whole->GetPixel({ { 2, 3, 0 } }));
  const auto series = MakeReader<itk::Image<std::int16_t, 4>>(path);
  series->Update();
  EXPECT_EQ(series->GetOutput()->GetLargestPossibleRegion().GetSize(), (itk::Size<4>{ { Columns, Rows, Slices, 1 } }));
  EXPECT_EQ(series->GetOutput()->GetPixel({ { 2, 3, 4, 0 } }), whole->GetPixel({ { 2, 3, 4 } }));
  const auto vectors = MakeReader<itk::VectorImage<float, 3>>(path);
  vectors->Update();
  EXPECT_EQ(vectors->GetOutput()->GetNumberOfComponentsPerPixel(), 1u);

  const auto bytes = MakeReader<itk::Image<std::uint8_t, 3>>(path); // converted as ITK does
  bytes->Update();
  EXPECT_EQ(bytes->GetOutput()->GetPixel({ { 2, 3, 4 } }), static_cast<std::uint8_t>(whole->GetPixel({ { 2, 3, 4 } })));

  const auto reader = MakeReader(path); // one reader for several files
  reader->Update();
  reader->SetFileName((m_Folder / "dicom").string());
  reader->Update();
  ExpectSame(*reader->GetOutput(), *ReadScanFile(m_Folder / "dicom"));
  reader->SetImageIO(itk::ScanImageIO::New()); // one that was not asked whether it can
  reader->Update();
  ExpectSame(*reader->GetOutput(), *whole);
}

TEST_F(ScanImageIO, LeavesWritingToITK)
{
  const auto image = Read(this->WriteStack("dicom"));
  for (const auto & [name, expected] : { std::pair("out.nii.gz", "NiftiImageIO"),
                                         std::pair("out.nrrd", "NrrdImageIO"),
                                         std::pair("out.mha", "MetaImageIO") })
  {
    const auto writer = itk::ImageFileWriter<ImageType>::New();
    writer->SetFileName((m_Folder / name).string());
    writer->SetInput(image);
    writer->Update();
    EXPECT_STREQ(writer->GetImageIO()->GetNameOfClass(), expected);
    const auto again = Read(m_Folder / name);
    EXPECT_TRUE(std::equal(image->GetBufferPointer(),
                           image->GetBufferPointer() + image->GetBufferedRegion().GetNumberOfPixels(),
                           again->GetBufferPointer()));
  }
}

/** What ImageSeriesReader makes of files, by a class of one's choice or by the first that can. */
template <typename TImage>
typename TImage::Pointer
ReadSeries(const std::vector<std::string> & files, itk::ImageIOBase * io)
{
  const auto reader = itk::ImageSeriesReader<TImage>::New();
  if (io != nullptr)
  {
    reader->SetImageIO(io);
  }
  reader->SetFileNames(files);
  reader->Update();
  return reader->GetOutput();
}

TEST_F(ScanImageIO, GivesImageSeriesReaderWhatGDCMGivesIt)
{
  std::vector<std::string> files;
  for (int k = 0; k < 5; ++k)
  {
    DicomTestFile file(4, 3);
    file.SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.4");
    file.SetText(0x00080060, "CS", "MR");
    file.SetText(0x00180050, "DS", "1.5");
    file.SetText(0x00180088, "DS", "2.25");
    file.SetShort(0x00280120, 0x8000); // padding
    file.SetText(0x00281053, "DS", std::to_string(k + 1));
    std::vector<std::int16_t> pixels(12, static_cast<std::int16_t>(100 * k));
    pixels[5] = std::numeric_limits<std::int16_t>::lowest();
    file.SetPixels(pixels);
    file.SetText(0x00280030, "DS", "0.5\\0.75");
    file.SetOrientation("0\\1\\0\\0\\0\\-1");
    file.SetPosition(std::to_string(3 * k) + "\\10\\20");
    files.push_back((m_Folder / (std::to_string(k) + ".dcm")).string());
    file.Write(files.back());
    EXPECT_EQ(ClassFor(files.back()), "ScanImageIO");
  }
  using FloatImage = itk::Image<float, 3>;
  const auto gdcm = itk::GDCMImageIO::New();
  ExpectSame(*ReadSeries<FloatImage>(files, nullptr), *ReadSeries<FloatImage>(files, gdcm));
  ExpectSame(*ReadSeries<FloatImage>({ files[2] }, nullptr), *ReadSeries<FloatImage>({ files[2] }, gdcm));
  EXPECT_EQ(Read<FloatImage>(files[2])->GetSpacing()[2], 2.25);
  EXPECT_EQ(Read<FloatImage>(files[2])->GetPixel({ { 1, 1, 0 } }), -3 * 32768 - 1024) << "padding, as it is";
}

} // namespace
