#include "rhombicDicomStack.h"
#include "rhombicDicomTestFile.h"
#include "rhombicMappedVoxels.h"
#include "rhombicNobody.h"
#include "rhombicScanTest.h"
#include "rhombicStoredBytes.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>

namespace fs = std::filesystem;

namespace
{

using rhombic::FailureKind;
using rhombic::ReadScan;
using Vector = itk::Vector<double, 3>;

class DicomFolder : public ScanTest
{};

constexpr std::uint16_t Columns = 6;
constexpr std::uint16_t Rows = 5;
constexpr std::size_t Slices = 4;

std::string
Join(std::initializer_list<double> numbers)
{
  std::string text;
  for (const double number : numbers)
  {
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%.9g", number);
    text += (text.empty() ? "" : "\\") + std::string(digits);
  }
  return text;
}

/** Three perpendicular unit vectors that are not along the coordinate axes. */
struct Frame
{
  Vector row, column, normal;

  Frame()
  {
    const double rowValues[3] = { 2 / 3.0, 2 / 3.0, 1 / 3.0 };
    const double columnValues[3] = { -2 / 3.0, 1 / 3.0, 2 / 3.0 };
    row = Vector(rowValues);
    column = Vector(columnValues);
    normal = itk::CrossProduct(row, column);
  }
};

/** The stored value of a pixel, different for each. */
std::int16_t
ValueAt(std::size_t i, std::size_t j, std::size_t k)
{
  return static_cast<std::int16_t>(100 * k + 10 * j + i);
}

DicomTestFile
MakeSlice(std::size_t k)
{
  DicomTestFile file(Columns, Rows);
  std::vector<std::int16_t> pixels;
  for (std::size_t j = 0; j < Rows; ++j)
  {
    for (std::size_t i = 0; i < Columns; ++i)
    {
      pixels.push_back(ValueAt(i, j, k));
    }
  }
  file.SetPixels(pixels);
  file.SetPosition(Join({ 0, 0, 2.5 * static_cast<double>(k) }));
  return file;
}

/** Writes a plain stack of slices 2.5 mm apart, whose file names are not in the order of the slices. */
void
WriteStack(const fs::path & folder, std::size_t slices = Slices)
{
  fs::create_directories(folder);
  for (std::size_t k = 0; k < slices; ++k)
  {
    MakeSlice(k).Write(folder / ("image" + std::to_string(k * 3 % 7) + ".dcm"));
  }
}

TEST_F(DicomFolder, ObliqueSeriesLiesWhereItsHeadersSay)
{
  const Frame frame;
  const double rowSpacing = 0.75, columnSpacing = 0.5, pitch = 2.25;
  const double corner[3] = { -12.5, 30, 7 };
  for (std::size_t k = 0; k < Slices; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    const Vector position = Vector(corner) + frame.normal * (pitch * static_cast<double>(k));
    file.SetPosition(Join({ position[0], position[1], position[2] }));
    file.SetOrientation(
      Join({ frame.row[0], frame.row[1], frame.row[2], frame.column[0], frame.column[1], frame.column[2] }));
    file.SetText(0x00280030, "DS", Join({ rowSpacing, columnSpacing }));
    file.SetText(0x00180050, "DS", "99"); // slice thickness and spacing tags say nothing about positions
    file.SetText(0x00180088, "DS", "-77");
    file.Write(m_Folder / (std::to_string((k * 5 + 2) % 11) + "-shuffled"));
  }
  std::ofstream(m_Folder / "notes.txt") << "no image";
  std::ofstream(m_Folder / "fake.dcm") << "no image either";

  const auto scan = ReadScan(m_Folder);
  const auto & image = ImageOf<std::int16_t>(scan);
  EXPECT_EQ(image.GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { Columns, Rows, Slices } }));
  const itk::Index<3> index{ { 4, 1, 3 } };
  itk::Point<double, 3> point;
  image.TransformIndexToPhysicalPoint(index, point);
  const Vector expected =
    Vector(corner) + frame.row * (columnSpacing * 4) + frame.column * (rowSpacing * 1) + frame.normal * (pitch * 3);
  ExpectNear(point, itk::Point<double, 3>(expected.GetDataPointer()), 1e-6);
  EXPECT_EQ(image.GetPixel(index), ValueAt(4, 1, 3) - 1024);
  EXPECT_NEAR(image.GetSpacing()[2], pitch, 1e-7);

  EXPECT_EQ(scan.format, "DICOM");
  EXPECT_EQ(scan.modality, "CT");
  EXPECT_EQ(scan.filesSkipped.at("not DICOM"), 2u);
  EXPECT_TRUE(image.GetMetaDataDictionary().GetKeys().empty());
  ASSERT_EQ(scan.series.size(), 1u);
  EXPECT_TRUE(scan.series[0].chosen);
  EXPECT_EQ(scan.series[0].size, (std::array<std::size_t, 3>{ Columns, Rows, Slices }));
  EXPECT_EQ(scan.series[0].seriesNumber, "7");
}

TEST_F(DicomFolder, PixelTypesFollowWhatIsStored)
{
  const auto read = [this](std::uint16_t bits, bool isSigned, const char * slope, const char * intercept) {
    for (std::size_t k = 0; k < 2; ++k)
    {
      DicomTestFile file(2, 2);
      file.SetPosition(Join({ 0, 0, static_cast<double>(k) }));
      file.SetShort(0x00280100, bits);
      file.SetShort(0x00280101, bits);
      file.SetShort(0x00280102, static_cast<std::uint16_t>(bits - 1));
      file.SetShort(0x00280103, isSigned ? 1 : 0);
      file.SetText(0x00281052, "DS", intercept);
      file.SetText(0x00281053, "DS", slope);
      if (bits == 8)
      {
        file.SetPixels(std::vector<std::uint8_t>{ 0, 1, 2, 200 });
      }
      else
      {
        file.SetPixels(std::vector<std::uint16_t>{ 0, 1, 2, isSigned ? std::uint16_t(0xffff) : std::uint16_t(60000) });
      }
      file.Write(m_Folder / std::to_string(k));
    }
    const auto scan = ReadScan(m_Folder);
    const auto [lowest, highest] = rhombictest::IntensityRange(scan.image);
    return std::string(rhombic::PixelTypeName(scan.image)) + " " + Join({ lowest, highest });
  };
  EXPECT_EQ(read(8, false, "1", "0"), "uint8 0\\200");
  EXPECT_EQ(read(16, false, "1", "0"), "uint16 0\\60000");
  EXPECT_EQ(read(16, true, "1", "0"), "int16 -1\\2");
  EXPECT_EQ(read(16, true, "2", "-1024"), "int16 -1026\\-1020");
  EXPECT_EQ(read(16, false, "1", "5"), "uint16 5\\60005");
  EXPECT_EQ(read(16, false, "1", "-1024"), "int32 -1024\\58976");
  EXPECT_EQ(read(16, true, "0.5", "0"), "float -0.5\\1");
}

TEST_F(DicomFolder, LargestSeriesByFarIsReadUnlessAnotherIsChosen)
{
  WriteStack(m_Folder / "a", 4);
  for (std::size_t k = 0; k < 2; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    file.SetSeries("9.8.7", "20");
    file.SetText(0x00080060, "CS", "MR");
    file.Write(m_Folder / "a" / ("other" + std::to_string(k)));
  }
  const auto scan = ReadScan(m_Folder);
  ASSERT_EQ(scan.series.size(), 2u);
  EXPECT_TRUE(scan.series[0].chosen);
  EXPECT_EQ(scan.modality, "CT");
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("Series 2 (MR, 2 files"), std::string::npos) << scan.notes[0];
  EXPECT_EQ(scan.notes[0].find("9.8.7"), std::string::npos) << "UIDs can lead to the patient";

  for (const std::string & name : { std::string("2"), std::string("20"), std::string("9.8.7"), scan.series[1].id })
  {
    rhombic::ScanReadOptions options;
    options.series = name;
    EXPECT_EQ(ReadScan(m_Folder, options).modality, "MR") << name;
  }
  EXPECT_EQ(KindOfReading(m_Folder, scan.series[0].id, Series("3")), FailureKind::Usage);

  DicomTestFile third = MakeSlice(2);
  third.SetSeries("9.8.7", "20");
  third.SetText(0x00080060, "CS", "MR");
  third.Write(m_Folder / "a" / "other2");
  EXPECT_EQ(KindOfReading(m_Folder, "3 slices, id " + scan.series[1].id), FailureKind::Usage) << "4 are not twice 3";
}

TEST_F(DicomFolder, EachSeriesIsListedWithItsSpacingOrProblem)
{
  WriteStack(m_Folder / "a", 4);
  const auto writeOther = [this](const char * uid, const char * number, std::size_t k) {
    DicomTestFile file = MakeSlice(k);
    file.SetSeries(uid, number);
    file.Write(m_Folder / (std::string(uid) + "-" + std::to_string(k)));
  };
  for (const std::size_t k : { 0u, 1u, 3u, 4u })
  {
    writeOther("9.8.7", "20", k);
  }
  writeOther("9.8.6", "30", 0);
  std::ofstream(m_Folder / "notes.txt") << "no image";

  const rhombic::SeriesList list = rhombic::ListSeries(m_Folder);
  ASSERT_EQ(list.series.size(), 3u);
  EXPECT_EQ(list.filesConsidered, 10u);
  EXPECT_EQ(list.filesSkipped.at("not DICOM"), 1u);
  for (const auto & series : list.series)
  {
    EXPECT_FALSE(series.chosen) << "two have as many slices";
  }
  EXPECT_EQ(list.series[0].size, (std::array<std::size_t, 3>{ Columns, Rows, 4 }));
  EXPECT_NEAR(list.series[0].spacing[2], 2.5, 1e-9);
  EXPECT_EQ(list.series[0].problem, "");
  EXPECT_NE(list.series[1].problem.find("1 slice is missing at 5 mm"), std::string::npos) << list.series[1].problem;
  EXPECT_EQ(list.series[1].spacing[2], 0.0);
  EXPECT_NE(list.series[2].problem.find("only one slice"), std::string::npos) << list.series[2].problem;

  EXPECT_TRUE(rhombic::ListSeries(m_Folder, Series("20")).series[1].chosen);
  EXPECT_EQ(KindOfReading(m_Folder, "1 slice is missing", Series("20")), FailureKind::Geometry) << "as listed";
  EXPECT_THROW(rhombic::ListSeries(m_Folder, Series("40")), rhombic::Failure);
  fs::remove(m_Folder / "9.8.7-4");
  fs::remove(m_Folder / "9.8.7-3");
  const auto chosen = rhombic::ListSeries(m_Folder);
  EXPECT_TRUE(chosen.series[0].chosen) << "4 are twice 2";
  EXPECT_TRUE(ReadScan(m_Folder).series[0].chosen);
  EXPECT_THROW(rhombic::ListSeries(m_Folder / "missing"), rhombic::Failure);
}

TEST_F(DicomFolder, AmbiguousSeriesNumberIsRefused)
{
  WriteStack(m_Folder);
  for (std::size_t k = 0; k < 2; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    file.SetSeries("9.8.7", "1"); // listed first; the other one is listed second
    file.Write(m_Folder / ("other" + std::to_string(k)));
  }
  EXPECT_EQ(ReadScan(m_Folder, Series("1")).series[0].numberOfFiles, 2u) << "both its place and its number";
  for (std::size_t k = 0; k < 2; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    file.SetSeries("9.8.7", "2");
    file.Write(m_Folder / ("other" + std::to_string(k)));
    file.SetSeries("9.8.6", "1");
    file.Write(m_Folder / ("another" + std::to_string(k)));
  }
  EXPECT_NO_THROW(ReadScan(m_Folder, Series("2")));
  EXPECT_EQ(KindOfReading(m_Folder, "id", Series("8")), FailureKind::Usage);
}

TEST_F(DicomFolder, MissingSliceIsRefused)
{
  WriteStack(m_Folder, 6);
  fs::remove(m_Folder / "image2.dcm"); // k = 3
  EXPECT_EQ(KindOfReading(m_Folder, "1 slice is missing at 7.5 mm, between image6.dcm and image5.dcm"),
            FailureKind::Geometry);
}

TEST_F(DicomFolder, GapIsAcceptedWithTheOtherSlicesInTheirPlaces)
{
  WriteStack(m_Folder, 6);
  fs::remove(m_Folder / "image2.dcm"); // k = 3
  rhombic::ScanReadOptions options = rhombic::AcceptUneven();
  options.onGap = rhombic::ScanReadOptions::Policy::Accept;
  const auto scan = ReadScan(m_Folder, options);
  ASSERT_EQ(scan.sliceOrigins.size(), 5u);
  EXPECT_EQ(scan.sliceOrigins[2][2], 5.0);
  EXPECT_EQ(scan.sliceOrigins[3][2], 10.0);
  ASSERT_EQ(scan.stack->gaps.size(), 1u);
  EXPECT_EQ(scan.stack->gaps[0].position, 5.0);
  EXPECT_EQ(scan.stack->gaps[0].numberOfMissing, 1u);
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 3 } }), ValueAt(0, 0, 4) - 1024);
}

/** Slices that follow each other with these steps. */
std::vector<rhombic::DicomSlice>
StackWithSteps(const std::vector<double> & steps)
{
  const auto file = std::make_shared<rhombic::DicomImageFile>();
  file->path = "folder/file";
  file->format.columns = file->format.rows = 2;
  std::vector<rhombic::DicomSlice> slices(steps.size() + 1);
  double z = -33.3;
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    slices[k].file = file;
    slices[k].plane = rhombic::MakeSlicePlane({ 0, 0, z }, { 1, 0, 0, 0, 1, 0 }, { 1, 1 }, slices[k].planeProblem);
    z += k < steps.size() ? steps[k] : 0;
  }
  return slices;
}

std::vector<double>
Steps(std::initializer_list<std::pair<std::size_t, double>> blocks)
{
  std::vector<double> steps;
  for (const auto & [count, step] : blocks)
  {
    steps.insert(steps.end(), count, step);
  }
  return steps;
}

TEST(DicomStack, GapsAreJudgedByTheStepsAround)
{
  const auto missing = [](std::initializer_list<std::pair<std::size_t, double>> blocks) {
    auto slices = StackWithSteps(Steps(blocks));
    rhombic::ScanReadOptions options = rhombic::AcceptUneven();
    options.onGap = rhombic::ScanReadOptions::Policy::Accept;
    const auto stack = StackSlices(slices, options);
    std::vector<std::size_t> counts;
    for (const rhombic::SliceGap & gap : stack.report.gaps)
    {
      counts.push_back(gap.numberOfMissing);
    }
    EXPECT_EQ(counts.empty(), stack.notes.empty() || stack.notes[0].find("missing") == std::string::npos);
    return counts;
  };
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(missing({ { 19, 2 }, { 1, 50.9 }, { 19, 2 } }), Counts{ 24 }) << "no whole multiple";
  EXPECT_EQ(missing({ { 14, 4 }, { 5, 7 }, { 1, 14 }, { 4, 7 } }), Counts{ 1 }) << "in the second of two blocks";
  EXPECT_EQ(missing({ { 3, 4 }, { 1, 8 }, { 3, 4 }, { 19, 7 } }), Counts{ 1 }) << "in the shorter of two blocks";
  EXPECT_EQ(missing({ { 1, 44 }, { 1, 16 } }), Counts{ 2 });
  EXPECT_EQ(missing({ { 1, 5 }, { 6, 2.5 } }), Counts{ 1 }) << "the second slice";
  EXPECT_EQ(missing({ { 6, 2.5 }, { 1, 5 } }), Counts{ 1 }) << "the last but one";
  EXPECT_EQ(missing({ { 9, 2 }, { 1, 4 }, { 1, 6 }, { 9, 2 } }), (Counts{ 1, 2 })) << "one after the other";
  EXPECT_EQ(missing({ { 20, 2 }, { 7, 4 }, { 20, 2 } }), Counts(7, 1)) << "every second slice for a while";
  EXPECT_EQ(missing({ { 14, 4 }, { 14, 7 } }), Counts());
  EXPECT_EQ(missing({ { 14, 4.002 }, { 1, 1.081 }, { 14, 6.999 } }), Counts());
  EXPECT_EQ(missing({ { 20, 5 }, { 8, 10 } }), Counts()) << "the step changes and stays";
  EXPECT_EQ(missing({ { 8, 10 }, { 20, 5 } }), Counts());
  EXPECT_EQ(missing({ { 9, 1 }, { 9, 3 }, { 9, 10 } }), Counts());
}

TEST(DicomStack, AHoleMakesNoDuplicates)
{
  EXPECT_FALSE(HaveDuplicates(StackWithSteps(Steps({ { 20, 0.5 }, { 1, 90 }, { 20, 0.5 } }))));
  EXPECT_TRUE(HaveDuplicates(StackWithSteps(Steps({ { 20, 0.5 }, { 1, 0.004 }, { 20, 0.5 } }))));
  EXPECT_TRUE(HaveDuplicates(StackWithSteps(Steps({ { 20, 0 }, { 19, 0.5 } }))));
}

TEST_F(DicomFolder, DamagedSliceIsAGap)
{
  WriteStack(m_Folder, 6);
  fs::resize_file(m_Folder / "image2.dcm", fs::file_size(m_Folder / "image2.dcm") - 10); // k = 3
  EXPECT_EQ(KindOfReading(m_Folder, "image2.dcm"), FailureKind::Unreadable);
  rhombic::ScanReadOptions options = rhombic::AcceptUneven();
  options.onGap = rhombic::ScanReadOptions::Policy::Accept;
  const auto scan = ReadScan(m_Folder, options);
  EXPECT_EQ(scan.sliceOrigins.size(), 5u);
  EXPECT_NE(scan.fileNotes.at(0).find("image2.dcm"), std::string::npos) << scan.fileNotes[0];
}

TEST_F(DicomFolder, DoubledSliceIsRefused)
{
  WriteStack(m_Folder);
  fs::copy(m_Folder / "image3.dcm", m_Folder / "image3-copy.dcm");
  EXPECT_EQ(KindOfReading(m_Folder, "image3-copy.dcm and image3.dcm are at the same place"), FailureKind::Geometry);
}

rhombic::ScanReadOptions
RefuseIrregular()
{
  rhombic::ScanReadOptions options;
  options.onTilted = rhombic::ScanReadOptions::Policy::Refuse;
  options.onUneven = rhombic::ScanReadOptions::Policy::Refuse;
  return options;
}

TEST_F(DicomFolder, TiltedSlicesStayWhereTheyAre)
{
  const double shift = std::tan(0.2);
  for (std::size_t k = 0; k < Slices; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    const double z = 2.5 * static_cast<double>(k);
    file.SetPosition(Join({ 0, z * shift, z }));
    file.Write(m_Folder / std::to_string(k));
  }
  const auto scan = ReadScan(m_Folder);
  EXPECT_TRUE(scan.sliceOrigins.empty()) << "their steps are even";
  EXPECT_NEAR(scan.stack->tiltDegrees, 11.459, 1e-3);
  itk::Point<double, 3> point;
  rhombic::GeometryOf(scan.image).TransformIndexToPhysicalPoint(itk::Index<3>{ { 1, 2, 3 } }, point);
  const double expected[3] = { 1, 2 + 7.5 * shift, 7.5 };
  ExpectNear(point, itk::Point<double, 3>(expected), 1e-6);
  EXPECT_EQ(KindOfReading(m_Folder, "11.46 degrees", RefuseIrregular()), FailureKind::Geometry);
}

TEST_F(DicomFolder, UnevenSlicesStayWhereTheyAre)
{
  const double positions[Slices] = { 0, 2.5, 6.2, 7 };
  for (std::size_t k = 0; k < Slices; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    file.SetPosition(Join({ 0, k == 1 ? 0.5 : 0, positions[k] }));
    file.Write(m_Folder / std::to_string(k));
  }
  const auto scan = ReadScan(m_Folder);
  ASSERT_EQ(scan.sliceOrigins.size(), Slices);
  for (std::size_t k = 0; k < Slices; ++k)
  {
    EXPECT_EQ(scan.sliceOrigins[k][1], k == 1 ? 0.5 : 0);
    EXPECT_EQ(scan.sliceOrigins[k][2], positions[k]);
  }
  EXPECT_EQ(scan.stack->blocks.size(), 3u);
  EXPECT_EQ(KindOfReading(m_Folder, "uneven", RefuseIrregular()), FailureKind::Geometry);
}

TEST_F(DicomFolder, SlicesThatJumpSidewaysAreRefused)
{
  const auto write = [this](auto shift) {
    for (std::size_t k = 0; k < 20; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      file.SetPosition(Join({ shift(k), 0, static_cast<double>(k) }));
      file.Write(m_Folder / ("image" + std::to_string(10 + k)));
    }
  };
  write([](std::size_t k) { return k < 10 ? 0 : 200.0; });
  EXPECT_EQ(KindOfReading(m_Folder, "image19 and image20 are shifted sideways by 200 mm"), FailureKind::Geometry);
  write([](std::size_t k) { return k < 10 ? 0 : 1.5; });
  EXPECT_EQ(KindOfReading(m_Folder, "image19 and image20 are shifted sideways by 1.5 mm"), FailureKind::Geometry);
  write([](std::size_t k) { return k % 2 == 0 ? 0.3 * static_cast<double>(k) : 0.3 * static_cast<double>(k) - 0.4; });
  EXPECT_EQ(ReadScan(m_Folder).sliceOrigins.size(), 20u) << "less than a pixel beside a tilt";
  write([](std::size_t k) { return 1.8 * static_cast<double>(k); });
  EXPECT_EQ(KindOfReading(m_Folder, "more than a tilt"), FailureKind::Geometry);
}

TEST_F(DicomFolder, SlicesAtOnePlaceAreToldApartByTheirKind)
{
  for (std::size_t k = 0; k < Slices; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    file.SetText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\M");
    file.Write(m_Folder / ("magnitude" + std::to_string(k)));
    file.SetText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\P");
    file.Write(m_Folder / ("phase" + std::to_string(k)));
  }
  EXPECT_EQ(KindOfReading(m_Folder, "PRIMARY\\P"), FailureKind::Usage);
  const auto scan = ReadScan(m_Folder, Series("2"));
  EXPECT_EQ(scan.series[1].kind, "ORIGINAL\\PRIMARY\\P");
  EXPECT_EQ(scan.series[1].size[2], Slices);
}

TEST_F(DicomFolder, SeriesWithoutUIDAreToldApartByTheirFolder)
{
  for (const char * folder : { "a", "b" })
  {
    fs::create_directory(m_Folder / folder);
    for (std::size_t k = 0; k < Slices; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      file.Remove(0x0020000e);
      file.Write(m_Folder / folder / std::to_string(k));
    }
  }
  EXPECT_EQ(KindOfReading(m_Folder, "more than one volume"), FailureKind::Usage);
  EXPECT_EQ(ReadScan(m_Folder, Series("1")).series.size(), 2u);
}

TEST_F(DicomFolder, PaddingTakesTheLowestOtherValue)
{
  for (std::size_t k = 0; k < Slices; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    std::vector<std::int16_t> pixels(static_cast<std::size_t>(Columns) * Rows, 40);
    pixels[0] = -2000;
    pixels[1] = -1990;
    pixels[2] = 7;
    file.SetPixels(pixels);
    file.SetShort(0x00280120, static_cast<std::uint16_t>(-2000));
    file.SetShort(0x00280121, static_cast<std::uint16_t>(-1990));
    file.Write(m_Folder / std::to_string(k));
  }
  const auto scan = ReadScan(m_Folder);
  EXPECT_EQ(scan.paddingValue, -3024.0);
  EXPECT_EQ(scan.numberOfPaddingSamples, 2 * Slices);
  const auto & image = ImageOf<std::int16_t>(scan);
  EXPECT_EQ(image.GetPixel({ { 0, 0, 1 } }), 7 - 1024);
  EXPECT_EQ(image.GetPixel({ { 1, 0, 1 } }), 7 - 1024);
  EXPECT_EQ(image.GetPixel({ { 3, 0, 1 } }), 40 - 1024);
}

TEST_F(DicomFolder, BackgroundThatIsCalledPaddingStays)
{
  for (const std::vector<std::int16_t> & values : { std::vector<std::int16_t>{ 0, 255 }, { 0, 1, 2 } })
  {
    for (std::size_t k = 0; k < Slices; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      std::vector<std::int16_t> pixels(static_cast<std::size_t>(Columns) * Rows);
      std::copy(values.begin(), values.end(), pixels.begin());
      file.SetPixels(pixels);
      file.SetText(0x00281052, "DS", "0");
      file.SetShort(0x00280120, 0);
      file.Write(m_Folder / std::to_string(k));
    }
    const auto scan = ReadScan(m_Folder);
    EXPECT_FALSE(scan.paddingValue.has_value());
    EXPECT_EQ(scan.numberOfPaddingSamples, 0u);
    for (std::size_t n = 0; n < 5; ++n)
    {
      const std::int16_t expected = n < values.size() ? values[n] : std::int16_t{ 0 };
      EXPECT_EQ(ImageOf<std::int16_t>(scan).GetBufferPointer()[n], expected);
    }
  }
}

TEST_F(DicomFolder, BitsBesideTheValuesAreIgnored)
{
  for (std::size_t k = 0; k < 2; ++k)
  {
    DicomTestFile file = MakeSlice(k);
    std::vector<std::uint16_t> pixels(static_cast<std::size_t>(Columns) * Rows, 0x8000 | 100);
    pixels[0] = 0xfffe;
    file.SetPixels(pixels);
    file.SetShort(0x00280101, 12);
    file.SetShort(0x00280102, 11);
    file.Write(m_Folder / std::to_string(k));
  }
  const auto scan = ReadScan(m_Folder);
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 0, 0, 0 } }), -2 - 1024) << "12 bits, signed";
  EXPECT_EQ(ImageOf<std::int16_t>(scan).GetPixel({ { 1, 0, 0 } }), 100 - 1024) << "an overlay above them";
}

TEST_F(DicomFolder, WordsOfSmallPixelsAreSwappedInBigEndian)
{
  std::vector<std::uint8_t> pixels(2 * 15 + 1);
  std::iota(pixels.begin(), pixels.end(), std::uint8_t{ 7 });
  const auto write = [&](const char * name, const char * type, const char * transferSyntax) {
    fs::create_directory(m_Folder / name);
    for (std::size_t k = 0; k < 2; ++k)
    {
      DicomTestFile file(5, 3);
      file.SetPosition(Join({ 0, 0, static_cast<double>(k) }));
      for (const std::uint32_t tag : { 0x00280100u, 0x00280101u })
      {
        file.SetShort(tag, 8);
      }
      file.SetShort(0x00280102, 7);
      file.SetShort(0x00280103, 0);
      file.SetLongBytes(
        0x7fe00010, std::string(pixels.begin() + static_cast<long>(15 * k), pixels.end()).substr(0, 16), type);
      file.Write(m_Folder / name / std::to_string(k), transferSyntax);
    }
    const auto scan = ReadScan(m_Folder / name);
    const auto & image = ImageOf<std::int16_t>(scan);
    return std::vector<int>(image.GetBufferPointer(), image.GetBufferPointer() + 30);
  };
  std::vector<int> expected(30);
  std::iota(expected.begin(), expected.end(), 7 - 1024);
  EXPECT_EQ(write("bytes", "OB", "1.2.840.10008.1.2.2"), expected);
  EXPECT_EQ(write("words", "OW", "1.2.840.10008.1.2.2"), expected);
  EXPECT_EQ(write("little", "OW", "1.2.840.10008.1.2.1"), expected);

  rhombic::DicomImageFile file;
  file.path = m_Folder / "raw";
  file.format.swappedBytes = 2;
  std::ofstream(file.path) << "--badcfe";
  file.pixels.offset = 2;
  const auto text = [&file](std::uintmax_t offset, std::size_t size) {
    const auto bytes = rhombic::ReadStoredBytes(file, offset, size);
    return std::string(reinterpret_cast<const char *>(bytes.data()), bytes.size());
  };
  EXPECT_EQ(text(0, 3), "abc");
  EXPECT_EQ(text(3, 3), "def");
  EXPECT_EQ(text(1, 2), "bc");
  EXPECT_THROW(text(5, 2), rhombic::Failure);
}

TEST_F(DicomFolder, AProgressThatThrowsEndsTheReading)
{
  WriteStack(m_Folder);
  rhombic::ScanReadOptions options;
  struct Stop
  {};
  options.progress = [](double) { throw Stop(); };
  bool hasStopped = false;
  for (int n = 0; n < 100 && !hasStopped; ++n) // helpers may leave no slice to this thread
  {
    try
    {
      rhombic::ReadVoxels(rhombic::OpenScan(m_Folder, options));
    }
    catch (const Stop &)
    {
      hasStopped = true;
    }
  }
  EXPECT_TRUE(hasStopped) << "and the helpers were waited for";
}

TEST_F(DicomFolder, MemoryIsThatOfThePixelsThatAreMade)
{
  const auto bytesNeeded = [this](const char * slope, std::int16_t value, bool isPadded) {
    for (std::size_t k = 0; k < 2; ++k)
    {
      DicomTestFile file(64, 64);
      file.SetPosition(Join({ 0, 0, static_cast<double>(k) }));
      file.SetText(0x00281053, "DS", slope);
      file.SetPixels(std::vector<std::int16_t>(64 * 64, value));
      if (isPadded)
      {
        file.SetShort(0x00280120, 3);
      }
      file.Write(m_Folder / std::to_string(k));
    }
    rhombic::ScanReadOptions options;
    options.temporaryFolder = m_Folder / "missing"; // where voxels can't be put
    options.maximumMemory = 1;
    std::uintmax_t step = 1 << 20;
    for (; step > 0; step /= 2) // bisection
    {
      options.maximumMemory += step;
      try
      {
        EXPECT_FALSE(rhombic::IsMapped(ReadScan(m_Folder, options).image));
        options.maximumMemory -= step;
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), FailureKind::Memory);
      }
    }
    return options.maximumMemory + 1;
  };
  constexpr std::uintmax_t frame = 64 * 64;
  const std::uintmax_t read = 2 * frame * std::min(2u, itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads());
  EXPECT_EQ(bytesNeeded("1", 5, false), 2 * frame * 2 + read) << "int16, and a slice of each thread as it is read";
  EXPECT_EQ(bytesNeeded("20", 30000, false), 2 * frame * 4 + read) << "int32";
  EXPECT_EQ(bytesNeeded("1.5", 5, false), 2 * frame * 4 + read) << "float";
  EXPECT_EQ(bytesNeeded("1.5", 5, true), 2 * frame * 4 + 2 * frame / 8 + read) << "and bits for padding";
}

TEST_F(DicomFolder, MissingGeometryIsRefusedByName)
{
  const std::array<std::pair<std::uint32_t, const char *>, 3> fields{ { { 0x00200032, "ImagePositionPatient" },
                                                                        { 0x00200037, "ImageOrientationPatient" },
                                                                        { 0x00280030, "PixelSpacing" } } };
  for (const auto & [tag, name] : fields)
  {
    for (std::size_t k = 0; k < Slices; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      file.Remove(tag);
      file.Write(m_Folder / std::to_string(k));
    }
    EXPECT_EQ(KindOfReading(m_Folder, name), FailureKind::Geometry);
    EXPECT_EQ(KindOfReading(m_Folder, m_Folder.string()), FailureKind::Geometry);
  }
}

TEST_F(DicomFolder, UnusableGeometryIsRefused)
{
  const auto kindWith = [this](std::uint32_t tag, const char * text) {
    for (std::size_t k = 0; k < Slices; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      file.SetText(tag, "DS", text);
      file.Write(m_Folder / std::to_string(k));
    }
    return KindOfReading(m_Folder, m_Folder.string());
  };
  EXPECT_EQ(kindWith(0x00280030, "0\\1"), FailureKind::Geometry);
  EXPECT_EQ(kindWith(0x00280030, "-1\\1"), FailureKind::Geometry);
  EXPECT_EQ(kindWith(0x00200037, "1\\0\\0\\1\\0\\0"), FailureKind::Geometry);
  EXPECT_EQ(kindWith(0x00200037, "1\\0\\0\\0\\nan\\0"), FailureKind::Geometry);
  EXPECT_EQ(kindWith(0x00200032, "0\\0\\one"), FailureKind::Geometry);
  EXPECT_EQ(kindWith(0x00200032, "0\\0\\0"), FailureKind::Geometry) << "all at one place";
}

TEST_F(DicomFolder, UnsupportedKindsOfImagesAreNamed)
{
  const auto kindWith = [this](const std::string & named, auto change) {
    for (std::size_t k = 0; k < 2; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      change(file);
      file.Write(m_Folder / std::to_string(k));
    }
    EXPECT_EQ(KindOfReading(m_Folder / "0", named), FailureKind::Unreadable) << "as a file";
    return KindOfReading(m_Folder, named);
  };
  EXPECT_EQ(kindWith("colour", [](DicomTestFile & file) { file.SetShort(0x00280002, 3); }), FailureKind::Unreadable);
  EXPECT_EQ(kindWith("colour", [](DicomTestFile & file) { file.SetText(0x00280004, "CS", "PALETTE COLOR"); }),
            FailureKind::Unreadable);
  EXPECT_EQ(kindWith("MONOCHROME1", [](DicomTestFile & file) { file.SetText(0x00280004, "CS", "MONOCHROME1"); }),
            FailureKind::Unreadable);
  EXPECT_EQ(kindWith("multi-frame", [](DicomTestFile & file) { file.SetText(0x00280008, "IS", "12"); }),
            FailureKind::Unreadable);
  EXPECT_EQ(
    kindWith("SEG", [](DicomTestFile & file) { file.SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4"); }),
    FailureKind::Unreadable);
  EXPECT_EQ(kindWith("bits", [](DicomTestFile & file) { file.SetShort(0x00280100, 12); }), FailureKind::Unreadable);
  EXPECT_EQ(kindWith("RescaleSlope", [](DicomTestFile & file) { file.SetText(0x00281053, "DS", "nan"); }),
            FailureKind::Unreadable);
  EXPECT_EQ(kindWith("larger than", [](DicomTestFile & file) { file.SetText(0x00281053, "DS", "1e300"); }),
            FailureKind::Unreadable);
  EXPECT_EQ(kindWith("samples", [](DicomTestFile & file) { file.SetShort(0x00280002, 0); }), FailureKind::Unreadable);
  EXPECT_EQ(kindWith("sign", [](DicomTestFile & file) { file.SetShort(0x00280103, 2); }), FailureKind::Unreadable);
  EXPECT_EQ(kindWith("sign", [](DicomTestFile & file) { file.Remove(0x00280103); }), FailureKind::Unreadable);
}

TEST_F(DicomFolder, SlicesWithoutTheScalingOfOthersAreRefused)
{
  for (const std::size_t unscaled : { 0, 1, 3 })
  {
    for (const bool isEmpty : { false, true })
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        DicomTestFile file = MakeSlice(k);
        for (const std::uint32_t tag : { 0x00281052, 0x00281053 })
        {
          file.Remove(tag);
          if (k != unscaled || isEmpty)
          {
            file.SetText(tag, "DS", k == unscaled ? "" : tag == 0x00281053 ? "2" : "-1000");
          }
        }
        file.Write(m_Folder / std::to_string(k));
      }
      EXPECT_EQ(KindOfReading(m_Folder, "no RescaleSlope"), FailureKind::Unreadable) << unscaled;
    }
  }
}

TEST_F(DicomFolder, EnhancedImagesAreRescaled)
{
  const auto write = [this](bool isScaled, bool isOwn) {
    DicomTestFile file(2, 2);
    DicomTestDataSet orientation;
    orientation.SetText(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
    DicomTestDataSet measures;
    measures.SetText(0x00280030, "DS", "1\\1");
    DicomTestDataSet shared;
    shared.SetItems(0x00209116, { orientation });
    shared.SetItems(0x00289110, { measures });
    std::vector<DicomTestDataSet> groups(3);
    for (std::size_t k = 0; k < 3; ++k)
    {
      DicomTestDataSet place;
      place.SetText(0x00200032, "DS", Join({ 0, 0, static_cast<double>(k) }));
      groups[k].SetItems(0x00209113, { place });
      DicomTestDataSet scaling;
      scaling.SetText(0x00281052, "DS", "-7");
      scaling.SetText(0x00281053, "DS", "2");
      if (isOwn)
      {
        groups[k].SetItems(0x00289145, { scaling });
      }
    }
    file.SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
    file.SetText(0x00280008, "IS", "3");
    file.SetItems(0x52009229, { shared });
    file.SetItems(0x52009230, groups);
    file.SetPixels(std::vector<std::int16_t>(12, 50));
    if (!isScaled)
    {
      file.Remove(0x00281052);
      file.Remove(0x00281053);
    }
    file.Write(m_Folder / "enhanced.dcm");
    return m_Folder / "enhanced.dcm";
  };
  const auto firstValue = [](const fs::path & path) {
    return ImageOf<std::int16_t>(ReadScan(path)).GetPixel({ { 0, 0, 0 } });
  };
  EXPECT_EQ(firstValue(write(false, true)), 93);
  EXPECT_EQ(firstValue(write(true, true)), 93) << "the frame's own count";
  EXPECT_EQ(firstValue(write(true, false)), 50 - 1024) << "those of the file count for frames without";
  EXPECT_EQ(KindOfReading(write(false, false), "which HU"), FailureKind::Unreadable);
}

TEST_F(DicomFolder, MorePixelsThanAnnouncedAreRefused)
{
  const auto write = [this](std::size_t more) {
    for (std::size_t k = 0; k < 2; ++k)
    {
      DicomTestFile file = MakeSlice(k);
      file.SetPixels(std::vector<std::int16_t>(std::size_t{ Columns } * Rows + (k == 0 ? more : 0), 40));
      file.Write(m_Folder / std::to_string(k));
    }
    return m_Folder;
  };
  EXPECT_NO_THROW(ReadScan(write(8))) << "padding";
  EXPECT_EQ(KindOfReading(write(std::size_t{ Columns } * Rows), "its header says 60"), FailureKind::Unreadable);
}

TEST_F(DicomFolder, NamesOfFilesDoNotChangeTheNamesOfSeries)
{
  std::vector<std::string> ids;
  for (const bool isReversed : { false, true })
  {
    const fs::path folder = m_Folder / (isReversed ? "reversed" : "plain");
    fs::create_directory(folder);
    for (std::size_t k = 0; k < 2 * Slices; ++k)
    {
      const bool isSagittal = k >= Slices;
      DicomTestFile file = MakeSlice(k % Slices);
      const auto place = static_cast<double>(k % Slices);
      file.SetPosition(isSagittal ? Join({ place, 0, 0 }) : Join({ 0, 0, place }));
      file.SetOrientation(isSagittal ? "0\\1\\0\\0\\0\\-1" : "1\\0\\0\\0\\1\\0");
      file.Write(folder / std::to_string(10 + (isReversed ? 2 * Slices - k : k)));
    }
    std::vector<std::string> own;
    for (const char * const number : { "1", "2" })
    {
      const auto scan = ReadScan(folder, Series(number));
      const auto & chosen = scan.series[std::string(number) == "1" ? 0 : 1];
      own.push_back(chosen.id + " " + Join({ ImageOf<std::int16_t>(scan).GetDirection()[2][2] }));
    }
    EXPECT_NE(own[0], own[1]);
    EXPECT_TRUE(ids.empty() || ids == own) << own[0] << ", " << own[1];
    ids = own;
  }
}

TEST_F(DicomFolder, CutOffPixelsAreRefused)
{
  WriteStack(m_Folder);
  fs::resize_file(m_Folder / "image6.dcm", fs::file_size(m_Folder / "image6.dcm") - 10);
  EXPECT_EQ(KindOfReading(m_Folder, "image6.dcm"), FailureKind::Unreadable);
}

TEST_F(DicomFolder, DamagedFilesBesideAGoodSeriesAreSkipped)
{
  WriteStack(m_Folder);
  std::ofstream(m_Folder / "empty.dcm");
  std::ofstream(m_Folder / "magic.dcm") << std::string(128, '\0') << "DICM";
  std::ofstream(m_Folder / "odd.dcm") << std::string(128, '\0') << "DICM" << std::string("\2\0\0\0??\4\0\1\0\0\0", 12);
  DicomTestFile report(1, 1);
  report.Remove(0x00280010);
  report.Remove(0x7fe00010);
  report.Write(m_Folder / "report.dcm");
  fs::create_symlink(m_Folder, m_Folder / "loop");
  const auto scan = ReadScan(m_Folder);
  EXPECT_EQ(scan.filesSkipped.at("not DICOM"), 1u) << "empty.dcm";
  EXPECT_EQ(scan.filesSkipped.at("damaged"), 2u) << "magic.dcm, odd.dcm";
  EXPECT_EQ(scan.filesSkipped.at("DICOM without image (reports, plans, DICOMDIR)"), 1u);
  EXPECT_EQ(scan.filesSkipped.at("symbolic links"), 1u);
  EXPECT_EQ(rhombic::GeometryOf(scan.image).GetLargestPossibleRegion().GetSize()[2], Slices);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("Slices may be missing"), std::string::npos) << scan.notes[0];
  EXPECT_NE(scan.fileNotes.at(0).find("odd.dcm"), std::string::npos) << scan.fileNotes[0];
  EXPECT_EQ(scan.fileNotes.at(0).find("empty.dcm"), std::string::npos) << scan.fileNotes[0];
}

TEST_F(DicomFolder, SingleFilesAreNoVolumes)
{
  WriteStack(m_Folder);
  EXPECT_EQ(KindOfReading(m_Folder / "image0.dcm", "image0.dcm"), FailureKind::Geometry);
  std::ofstream(m_Folder / "text.dcm") << "To whom it may concern";
  EXPECT_EQ(KindOfReading(m_Folder / "text.dcm", "text.dcm"), FailureKind::Unreadable);
}

TEST_F(DicomFolder, ClosedFoldersAreNotToldAsMissing)
{
  std::ofstream(m_Folder / "scan.nii") << "scan";
  fs::permissions(m_Folder, fs::perms(0444));
  std::optional<FailureKind> kind;
  {
    const rhombictest::Nobody nobody;
    if (nobody.IsBound())
    {
      kind = KindOfReading(m_Folder / "scan.nii", "Permission denied");
    }
  }
  fs::permissions(m_Folder, fs::perms::owner_all);
  if (!kind)
  {
    GTEST_SKIP() << "this user can't be another one";
  }
  EXPECT_EQ(*kind, FailureKind::Unreadable);
}

TEST_F(DicomFolder, FoldersWithoutDicom)
{
  EXPECT_EQ(KindOfReading(m_Folder / "nowhere", "nowhere"), FailureKind::NotFound);
  EXPECT_EQ(KindOfReading(m_Folder, m_Folder.string()), FailureKind::NotFound);
  std::ofstream(m_Folder / "readme.txt") << "text";
  EXPECT_EQ(KindOfReading(m_Folder, m_Folder.string()), FailureKind::NotFound);
  std::ofstream(m_Folder / "head.nii.gz") << "whatever";
  EXPECT_EQ(KindOfReading(m_Folder, (m_Folder / "head.nii.gz").string()), FailureKind::Unreadable); // for a mask
}

} // namespace
