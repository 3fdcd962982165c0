#include "itkCartesianToFCCImageFilter.h"
#include "itkLabelMapFileReader.h"
#include "itkNativeScanFileReader.h"
#include "itkRefusal.h"
#include "itkScanFileReader.h"
#include "itkSlicePlacement.h"
#include "rhombicNIfTITestFile.h"
#include "rhombicStackTest.h"

#include "itkCommand.h"
#include "itkMetaDataObject.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <sstream>
#include <thread>

/** The readers as ITK's process objects. What they read is tested beside them, through the same readers. */
namespace
{

namespace fs = std::filesystem;
using ImageType = itk::Image<std::int16_t, 3>;
using ReaderType = itk::ScanFileReader<ImageType>;

class ScanFileReader : public StackTest
{};

template <typename TReader = ReaderType>
typename TReader::Pointer
MakeReader(const fs::path & path)
{
  const auto reader = TReader::New();
  reader->SetFileName(path.string());
  return reader;
}

template <typename TImage>
std::string
BytesOf(const TImage & image)
{
  return std::string(reinterpret_cast<const char *>(image.GetBufferPointer()),
                     image.GetBufferedRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType));
}

std::string
Printed(const itk::Object & object)
{
  std::ostringstream text;
  object.Print(text);
  return text.str();
}

template <typename TReader>
void
ExpectBasicObject(const char * name)
{
  const auto reader = TReader::New();
  EXPECT_STREQ(reader->GetNameOfClass(), name);
  const itk::LightObject::Pointer another = reader->CreateAnother();
  EXPECT_NE(dynamic_cast<TReader *>(another.GetPointer()), nullptr);
  for (const char * const line : { "FileName: ", "Series: ", "AcceptGaps: 0", "AcceptTilted: 1", "AcceptUneven: 0" })
  {
    EXPECT_NE(Printed(*reader).find(line), std::string::npos) << line;
  }
  EXPECT_NE(Refusal([&] { reader->Update(); }), "") << "there is no file name";
  EXPECT_EQ(reader->GetComponentType(), itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE);
}

TEST_F(ScanFileReader, IsABasicObjectOfITK)
{
  ExpectBasicObject<ReaderType>("ScanFileReader");
  ExpectBasicObject<itk::ScanFileReader<itk::Image<double, 3>>>("ScanFileReader");
  ExpectBasicObject<itk::NativeScanFileReader>("NativeScanFileReader");
  ExpectBasicObject<itk::LabelMapFileReader<itk::Image<std::uint8_t, 3>>>("LabelMapFileReader");
  EXPECT_NE(dynamic_cast<itk::ImageSource<ImageType> *>(ReaderType::New().GetPointer()), nullptr);
}

TEST_F(ScanFileReader, IsModifiedByChangesOnly)
{
  const auto reader = itk::LabelMapFileReader<ImageType>::New();
  const std::vector<std::function<void()>> changes{ [&] { reader->SetFileName("scan"); },
                                                    [&] { reader->SetSeries("2"); },
                                                    [&] { reader->SetFrame(3); },
                                                    [&] { reader->AcceptGapsOn(); },
                                                    [&] { reader->AcceptTiltedOff(); },
                                                    [&] { reader->AcceptUnevenOn(); },
                                                    [&] { reader->SetLabelTableFileName("table"); } };
  for (const auto & change : changes)
  {
    const auto before = reader->GetMTime();
    change();
    const auto changed = reader->GetMTime();
    EXPECT_GT(changed, before);
    change();
    EXPECT_EQ(reader->GetMTime(), changed);
  }
  EXPECT_STREQ(reader->GetFileName(), "scan");
  EXPECT_EQ(reader->GetSeries(), "2");
  EXPECT_EQ(reader->GetFrame(), 3u);
  EXPECT_TRUE(reader->GetAcceptGaps());
  EXPECT_FALSE(reader->GetAcceptTilted());
  EXPECT_TRUE(reader->GetAcceptUneven());
  EXPECT_STREQ(reader->GetLabelTableFileName(), "table");
}

TEST_F(ScanFileReader, KnowsGeometryAndTypeFromHeadersAlone)
{
  for (const fs::path & path : this->WriteAll())
  {
    const auto reader = MakeReader(path);
    unsigned int starts = 0;
    reader->AddObserver(itk::StartEvent(), [&starts](const itk::EventObject &) { ++starts; });
    reader->UpdateOutputInformation();
    const ImageType & output = *reader->GetOutput();
    EXPECT_EQ(output.GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { Columns, Rows, Slices } })) << path;
    EXPECT_EQ(output.GetSpacing()[2], 2.5);
    EXPECT_EQ(output.GetOrigin()[0], 5);
    EXPECT_EQ(output.GetBufferedRegion().GetNumberOfPixels(), 0u) << path;
    EXPECT_EQ(starts, 0u);
    EXPECT_EQ(reader->GetComponentType(), itk::IOComponentEnum::SHORT) << path;
  }
  // Values that can't be unpacked are nobody's business before Update().
  const fs::path path = m_Folder / "cut.nii.gz";
  fs::copy(m_Folder / "scan.nii.gz", path);
  fs::resize_file(path, fs::file_size(path) * 3 / 4);
  const auto reader = MakeReader(path);
  EXPECT_NO_THROW(reader->UpdateOutputInformation());
  EXPECT_NE(Refusal([&] { reader->Update(); }).find("cut off"), std::string::npos);
}

TEST_F(ScanFileReader, RunsOnlyWhenSomethingChanged)
{
  for (const fs::path & path : this->WriteAll())
  {
    const auto reader = MakeReader(path);
    unsigned int runs = 0;
    reader->AddObserver(itk::StartEvent(), [&runs](const itk::EventObject &) { ++runs; });
    reader->Update();
    const std::string expected = BytesOf(*reader->GetOutput());
    reader->UpdateLargestPossibleRegion();
    reader->Update();
    EXPECT_EQ(runs, 1u) << path;
    reader->Modified();
    reader->Update();
    EXPECT_EQ(runs, 2u);
    EXPECT_TRUE(BytesOf(*reader->GetOutput()) == expected);
    reader->GetOutput()->ReleaseData();
    reader->Update();
    EXPECT_EQ(runs, 3u);
    EXPECT_TRUE(BytesOf(*reader->GetOutput()) == expected);
  }
}

TEST_F(ScanFileReader, IsTheSameInEachFormatAndForAnyNumberOfThreads)
{
  std::set<std::string> bytes;
  for (const fs::path & path : this->WriteAll())
  {
    for (const unsigned int units : { 1u, 2u, 3u, 8u })
    {
      const auto reader = MakeReader(path);
      reader->SetNumberOfWorkUnits(units);
      reader->Update();
      bytes.insert(BytesOf(*reader->GetOutput()));
    }
    const auto native = MakeReader<itk::NativeScanFileReader>(path);
    EXPECT_EQ(native->GetOutput()->Get(), nullptr);
    native->Update();
    bytes.insert(BytesOf(ImageOf<std::int16_t>(*native->GetOutput()->Get())));
  }
  EXPECT_EQ(bytes.size(), 1u);
}

TEST_F(ScanFileReader, ProgressesFromZeroToOne)
{
  for (const fs::path & path : this->WriteAll())
  {
    const auto reader = MakeReader(path);
    std::vector<float> reports;
    reader->AddObserver(itk::ProgressEvent(), [&, caller = std::this_thread::get_id()](const itk::EventObject &) {
      reports.push_back(reader->GetProgress());
      EXPECT_EQ(std::this_thread::get_id(), caller);
    });
    reader->Update();
    ASSERT_GE(reports.size(), 2u) << path;
    EXPECT_EQ(reports.front(), 0.0f);
    EXPECT_EQ(reports.back(), 1.0f);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end())) << testing::PrintToString(reports);
  }
}

TEST_F(ScanFileReader, StopsWhenItIsAborted)
{
  for (const fs::path & path : this->WriteAll())
  {
    const std::string expected = [&path] {
      const auto reader = MakeReader(path);
      reader->Update();
      return BytesOf(*reader->GetOutput());
    }();
    const auto reader = MakeReader(path);
    bool isAborted = true;
    bool hasEvent = false;
    reader->AddObserver(itk::ProgressEvent(),
                        [&](const itk::EventObject &) { reader->SetAbortGenerateData(isAborted); });
    reader->AddObserver(itk::AbortEvent(), [&](const itk::EventObject &) { hasEvent = true; });
    EXPECT_THROW(reader->Update(), itk::ProcessAborted) << path;
    EXPECT_TRUE(hasEvent);
    isAborted = false;
    reader->Update();
    EXPECT_TRUE(BytesOf(*reader->GetOutput()) == expected) << "and begins anew";
  }
}

/** Writes four voxels of type double as NRRD. */
void
WriteValues(const fs::path & path, const std::vector<double> & values)
{
  std::ofstream file(path, std::ios::binary);
  file << "NRRD0004\ntype: double\ndimension: 3\nsizes: " << values.size()
       << " 1 1\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
          "encoding: raw\nendian: little\n\n";
  file.write(reinterpret_cast<const char *>(values.data()), static_cast<std::streamsize>(8 * values.size()));
}

/** What reading as a pixel type says, or the values. */
template <typename TPixel>
std::string
ReadAs(const fs::path & path, const std::vector<double> & values)
{
  const auto reader = MakeReader<itk::ScanFileReader<itk::Image<TPixel, 3>>>(path);
  const std::string refusal = Refusal([&] { reader->Update(); });
  if (refusal.empty())
  {
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      EXPECT_EQ(static_cast<double>(reader->GetOutput()->GetBufferPointer()[n]), values[n]);
    }
  }
  return refusal;
}

TEST_F(ScanFileReader, ConvertsValuesThatSurviveAndRefusesOthersByName)
{
  const fs::path path = m_Folder / "values.nrrd";
  const auto isRefusedAs = [&path](auto pixel, double value, const std::string & text) {
    const std::string refusal = ReadAs<decltype(pixel)>(path, { 1, value, 3, 4 });
    EXPECT_NE(refusal.find("holds " + text + ","), std::string::npos) << refusal << " for " << value;
    EXPECT_NE(refusal.find(path.string()), std::string::npos) << refusal;
  };
  WriteValues(path, { 1, 255, 3, 4 });
  EXPECT_EQ(ReadAs<std::uint8_t>(path, { 1, 255, 3, 4 }), "");
  isRefusedAs(std::int8_t(), 255, "255");
  WriteValues(path, { 1, -32768, 3, 4 });
  EXPECT_EQ(ReadAs<std::int16_t>(path, { 1, -32768, 3, 4 }), "");
  EXPECT_EQ(ReadAs<std::int64_t>(path, { 1, -32768, 3, 4 }), "");
  EXPECT_EQ(ReadAs<double>(path, { 1, -32768, 3, 4 }), "");
  isRefusedAs(std::uint16_t(), -32768, "-32768");
  isRefusedAs(std::uint64_t(), -32768, "-32768");
  WriteValues(path, { 1, 0.5, 3, 4 });
  EXPECT_EQ(ReadAs<float>(path, { 1, 0.5, 3, 4 }), "");
  isRefusedAs(std::int16_t(), 0.5, "0.5");
  WriteValues(path, { 1, std::ldexp(1.0, 63), 3, 4 });
  EXPECT_EQ(ReadAs<std::uint64_t>(path, { 1, std::ldexp(1.0, 63), 3, 4 }), "");
  EXPECT_NE(ReadAs<std::int64_t>(path, {}), "");

  NIfTITestFile integers;
  integers.datatype = 8;
  integers.bits = 32;
  integers.voxels = integers.Values(std::vector<std::int32_t>(12, (1 << 24) + 1));
  WriteBytes(m_Folder / "int32.nii", integers.Bytes());
  const auto reader = MakeReader<itk::ScanFileReader<itk::Image<float, 3>>>(m_Folder / "int32.nii");
  EXPECT_NE(Refusal([&] { reader->Update(); }).find("16777217"), std::string::npos);
  EXPECT_EQ(reader->GetComponentType(), itk::IOComponentEnum::INT);
}

TEST_F(ScanFileReader, TellsTheSmallestTypeOfWholeNumbersAfterReading)
{
  const fs::path folder = this->WriteStack("large");
  DicomTestFile file(Columns, Rows);
  file.SetShort(0x00280103, 0); // unsigned
  file.SetPixels(std::vector<std::int16_t>(std::size_t{ Columns } * Rows, -1));
  file.SetPosition("5\\-3\\-2.5");
  file.Write(folder / "last.dcm");
  const auto reader = MakeReader<itk::ScanFileReader<itk::Image<int, 3>>>(folder);
  reader->UpdateOutputInformation();
  EXPECT_EQ(reader->GetComponentType(), itk::IOComponentEnum::SHORT);
  reader->Update();
  EXPECT_EQ(reader->GetComponentType(), itk::IOComponentEnum::INT);
  EXPECT_EQ(reader->GetOutput()->GetPixel({ { 0, 0, 0 } }), 65535 - 1024);
  EXPECT_NE(Refusal([&] { MakeReader(folder)->Update(); }).find("holds 64511"), std::string::npos);
}

TEST_F(ScanFileReader, SliceOriginsTravelToTheLattice)
{
  using LatticeFilter = itk::CartesianToFCCImageFilter<ImageType>;
  const fs::path folder = this->WriteStack("uneven", true);
  const auto native = MakeReader<itk::NativeScanFileReader>(folder);
  native->AcceptUnevenOn();
  native->Update();
  const rhombic::Scan & scan = *native->GetOutput()->Get();
  ASSERT_EQ(scan.sliceOrigins.size(), Slices);
  const auto told = LatticeFilter::New();
  const auto copy = ImageType::New();
  copy->Graft(&ImageOf<std::int16_t>(scan));
  copy->SetMetaDataDictionary({});
  told->SetInput(copy);
  told->SetSliceOrigins(scan.sliceOrigins);
  told->SetOutsideValue(static_cast<std::int16_t>(rhombictest::IntensityRange(scan.image).first));
  told->Update();

  const auto reader = MakeReader(folder);
  reader->AcceptUnevenOn();
  for (const unsigned int units : { 1u, 2u, 3u, 8u })
  {
    const auto untold = LatticeFilter::New();
    untold->SetInput(reader->GetOutput());
    untold->SetNumberOfWorkUnits(units);
    untold->Update();
    EXPECT_EQ(untold->GetOutput()->GetOrigin(), told->GetOutput()->GetOrigin());
    EXPECT_EQ(untold->GetOutput()->GetSpacing(), told->GetOutput()->GetSpacing());
    EXPECT_TRUE(BytesOf(*untold->GetOutput()) == BytesOf(*told->GetOutput())) << units;
  }
  EXPECT_EQ(itk::GetSlicePlacement(*reader->GetOutput()).origins, scan.sliceOrigins);

  reader->SetFileName(this->WriteStack("even").string());
  reader->Update();
  EXPECT_TRUE(itk::GetSlicePlacement(*reader->GetOutput()).origins.empty()) << "those of the scan before are gone";
}

TEST_F(ScanFileReader, UnevenSlicesAreRefusedUnlessAskedFor)
{
  const auto isRefused = [](auto & reader) {
    return Refusal([&] { reader.UpdateOutputInformation(); }).find("lattice->SetScan(reader->GetScan())") !=
           std::string::npos;
  };
  const fs::path folder = this->WriteStack("uneven", true);
  const auto reader = MakeReader(folder);
  EXPECT_TRUE(isRefused(*reader));
  EXPECT_TRUE(isRefused(*MakeReader<itk::NativeScanFileReader>(folder)));
  EXPECT_TRUE(isRefused(*MakeReader<itk::LabelMapFileReader<ImageType>>(folder)));
  EXPECT_THROW(rhombic::OpenScan(folder), rhombic::Failure);
  reader->AcceptUnevenOn();
  reader->AcceptTiltedOff();
  EXPECT_EQ(Refusal([&] { reader->Update(); }), "") << "they are not tilted";
  EXPECT_EQ(reader->GetScan().sliceOrigins.size(), Slices);
}

TEST_F(ScanFileReader, DescribesTheScanWithoutThePatient)
{
  const auto reader = MakeReader(this->WriteStack("dicom"));
  reader->Update();
  const itk::MetaDataDictionary & dictionary = reader->GetOutput()->GetMetaDataDictionary();
  std::map<std::string, std::string> texts;
  for (const std::string & key : dictionary.GetKeys())
  {
    if (std::string text; itk::ExposeMetaData(dictionary, key, text))
    {
      texts[key] = text;
      EXPECT_EQ(text.find("Secret"), std::string::npos);
    }
  }
  EXPECT_EQ(texts["ScanFormat"], "DICOM");
  EXPECT_EQ(texts["ScanModality"], "CT");
  EXPECT_EQ(texts["ScanTiltDegrees"], "0");
  EXPECT_EQ(texts["ScanIsOriented"], "yes");
  EXPECT_EQ(texts["ScanSeries"], reader->GetScan().series.front().id);
  EXPECT_EQ(reader->GetScan().stack->blocks.size(), 1u);
  EXPECT_EQ(rhombic::GeometryOf(reader->GetScan().image).GetLargestPossibleRegion(),
            reader->GetOutput()->GetLargestPossibleRegion());
}

TEST_F(ScanFileReader, GapsAreRefusedOrAccepted)
{
  const fs::path folder = this->WriteStack("gap");
  fs::remove(folder / "1.dcm");
  const auto reader = MakeReader(folder);
  EXPECT_NE(Refusal([&] { reader->Update(); }), "");
  reader->AcceptGapsOn();
  EXPECT_NE(Refusal([&] { reader->Update(); }).find("AcceptUnevenOn()"), std::string::npos);
  reader->AcceptUnevenOn();
  reader->UpdateOutputInformation();
  EXPECT_EQ(reader->GetOutput()->GetLargestPossibleRegion().GetSize(2), Slices - 1);
  EXPECT_EQ(itk::GetSlicePlacement(*reader->GetOutput()).origins.size(), Slices - 1)
    << "before the voxels are asked for";
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetBufferedRegion().GetSize(2), Slices - 1);
  EXPECT_EQ(itk::GetSlicePlacement(*reader->GetOutput()).origins.size(), Slices - 1);

  // Headers that are sound, and compressed pixels that are not.
  DicomTestFile damaged(Columns, Rows);
  damaged.SetFragments({ std::string(100, 'x') });
  damaged.SetPosition("5\\-3\\17.5");
  for (const fs::directory_entry & entry : fs::directory_iterator(folder))
  {
    if (entry.path().filename() == "5.dcm") // the last one
    {
      damaged.Write(entry.path(), "1.2.840.10008.1.2.5");
    }
  }
  const auto again = MakeReader(folder);
  EXPECT_NE(Refusal([&] { again->Update(); }), "");
  again->AcceptGapsOn();
  again->AcceptUnevenOn();
  again->UpdateOutputInformation();
  EXPECT_EQ(again->GetOutput()->GetLargestPossibleRegion().GetSize(2), Slices - 2);
  again->Update();
  EXPECT_EQ(again->GetOutput()->GetBufferedRegion().GetSize(2), Slices - 2);
  EXPECT_EQ(again->GetScan().fileNotes.size(), 1u);
}

TEST_F(ScanFileReader, LabelMapsHaveNamesAndVolumes)
{
  using LabelReader = itk::LabelMapFileReader<itk::Image<std::uint8_t, 3>>;
  const std::string phantom = RHOMBIC_TESTDATA "/phantom/";
  const auto reader = MakeReader<LabelReader>(phantom + "phantom-labels.nii.gz");
  reader->Update();
  std::set<std::string> names;
  std::size_t voxels = 0;
  for (const rhombic::LabelSummary & summary : reader->GetLabels())
  {
    names.insert(summary.label.name);
    voxels += summary.numberOfVoxels;
  }
  EXPECT_EQ(names.count("liver"), 1u) << testing::PrintToString(names);
  const auto * const begin = reader->GetOutput()->GetBufferPointer();
  const auto * const end = begin + reader->GetOutput()->GetBufferedRegion().GetNumberOfPixels();
  EXPECT_EQ(voxels, std::count_if(begin, end, [](std::uint8_t label) { return label != 0; }));

  const auto intensities = MakeReader<itk::LabelMapFileReader<ImageType>>(phantom + "phantom.nii.gz");
  EXPECT_NE(Refusal([&] { intensities->Update(); }).find("look like intensities"), std::string::npos);
}

TEST_F(ScanFileReader, RealTiltedStackOfTwoBlocksLiesWhereItsSlicesSay)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  if (scans == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const auto reader = MakeReader(fs::path(scans) / "ct_head_tilt_varspacing_dicom_rle");
  reader->AcceptUnevenOn();
  const auto lattice = itk::CartesianToFCCImageFilter<ImageType>::New();
  lattice->SetInput(reader->GetOutput());
  lattice->UpdateOutputInformation();
  const auto & direction = lattice->GetOutput()->GetDirection();
  const auto origins = itk::GetSlicePlacement(*reader->GetOutput()).origins;
  ASSERT_EQ(origins.size(), 28u);
  const auto first = lattice->GetOutput()->TransformPhysicalPointToContinuousIndex<double>(origins.front());
  const auto last = lattice->GetOutput()->TransformPhysicalPointToContinuousIndex<double>(origins.back());
  const double height = (last[2] - first[2]) * lattice->GetOutput()->GetSpacing()[2];
  const auto along = origins.back() - origins.front();
  EXPECT_NEAR(height, along[0] * direction[0][2] + along[1] * direction[1][2] + along[2] * direction[2][2], 1e-6);
  EXPECT_NEAR(height, 13 * 4.002 + 13 * 6.999 + 1.081, 0.05) << "the slices' distances along their normal";
}

} // namespace
