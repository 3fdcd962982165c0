#include "rhombicDicomTestFile.h"
#include "rhombicLabelMap.h"
#include "rhombicScanTest.h"

#include <algorithm>
#include <cstdio>

namespace
{

using rhombic::FailureKind;
using rhombic::ReadScan;
using rhombic::SummarizeLabels;

constexpr std::uint16_t Columns = 5;
constexpr std::uint16_t Rows = 3;
constexpr std::size_t Pixels = Columns * Rows;

/** A frame of a binary segmentation, with its first pixels in its segment. */
struct SegmentFrame
{
  std::string z; ///< empty: the frame has no place
  std::uint16_t segment = 1;
  std::size_t pixels = Pixels;
};

std::string
Text(const char * format, double number)
{
  char text[32];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

/** A DICOM SEG of three segments; \a spacing is its SpacingBetweenSlices, \a thickness its
 * SliceThickness, if any. */
DicomTestFile
MakeSegmentation(const std::vector<SegmentFrame> & frames,
                 const std::string & spacing = "",
                 const std::string & thickness = "")
{
  DicomTestFile file(Columns, Rows);
  std::vector<DicomTestDataSet> segments(3);
  for (std::uint16_t n = 0; n < 3; ++n)
  {
    segments[n].SetShort(0x00620004, static_cast<std::uint16_t>(n + 1));
    segments[n].SetText(0x00620005, "LO", n == 0 ? "Liver" : n == 1 ? "Spleen" : "Tumour");
  }
  std::vector<DicomTestDataSet> groups;
  std::vector<bool> bits;
  for (const SegmentFrame & frame : frames)
  {
    DicomTestDataSet place;
    place.SetText(0x00200032, "DS", "0\\0\\" + frame.z);
    DicomTestDataSet segment;
    segment.SetShort(0x0062000b, frame.segment);
    DicomTestDataSet & group = groups.emplace_back();
    group.SetItems(0x0062000a, { segment });
    if (!frame.z.empty())
    {
      group.SetItems(0x00209113, { place });
    }
    bits.insert(bits.end(), frame.pixels, true);
    bits.insert(bits.end(), Pixels - frame.pixels, false);
  }
  DicomTestDataSet orientation;
  orientation.SetText(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
  DicomTestDataSet measures;
  measures.SetText(0x00280030, "DS", "1\\1");
  if (!spacing.empty())
  {
    measures.SetText(0x00180088, "DS", spacing);
  }
  if (!thickness.empty())
  {
    measures.SetText(0x00180050, "DS", thickness);
  }
  DicomTestDataSet shared;
  shared.SetItems(0x00209116, { orientation });
  shared.SetItems(0x00289110, { measures });
  file.SetText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4");
  file.SetText(0x00080060, "CS", "SEG");
  file.SetText(0x00280008, "IS", std::to_string(frames.size()));
  file.SetShort(0x00280100, 1);
  file.SetShort(0x00280101, 1);
  file.SetShort(0x00280102, 0);
  file.SetShort(0x00280103, 0);
  file.SetText(0x00620001, "CS", "BINARY");
  file.SetItems(0x00620002, segments);
  file.SetItems(0x52009229, { shared });
  file.SetItems(0x52009230, groups);
  std::string bytes((bits.size() + 15) / 16 * 2, '\0');
  for (std::size_t n = 0; n < bits.size(); ++n)
  {
    bytes[n / 8] = static_cast<char>(bytes[n / 8] | (bits[n] ? 1 << n % 8 : 0));
  }
  file.SetLongBytes(0x7fe00010, bytes);
  return file;
}

class DicomSegmentation : public ScanTest
{
protected:
  const std::filesystem::path m_Path = m_Folder / "seg.dcm";
};

TEST_F(DicomSegmentation, EmptySlicesThatWereLeftOutAreThere)
{
  for (const char * const spacing : { "", "0.6998", "0.70", "0.7" })
  {
    std::vector<SegmentFrame> frames;
    for (int k = 0; k <= 150; ++k)
    {
      if (k <= 20 || k >= 130)
      {
        frames.push_back({ Text("%.3f", -81.2 + 0.6998 * k) });
      }
    }
    MakeSegmentation(frames, spacing).Write(m_Path);
    const auto scan = ReadScan(m_Path);
    EXPECT_TRUE(scan.sliceOrigins.empty());
    EXPECT_EQ(ImageOf<std::uint8_t>(scan).GetLargestPossibleRegion().GetSize()[2], 151u) << spacing;
    EXPECT_NEAR(ImageOf<std::uint8_t>(scan).GetSpacing()[2], 0.6998, 1e-5) << spacing;
    EXPECT_NEAR(SummarizeLabels(scan, scan.labels)[0].millilitres, 42 * Pixels * 0.6998 / 1000, 1e-5) << spacing;
  }
}

TEST_F(DicomSegmentation, FramesWithoutCommonStepAreRefused)
{
  MakeSegmentation({ { "0" }, { "2" }, { "5.1" }, { "9" } }).Write(m_Path);
  EXPECT_EQ(KindOfReading(m_Path, "no common distance"), FailureKind::Geometry);
  MakeSegmentation({ { "0" }, { "2" }, { "5" } }, "1").Write(m_Path);
  EXPECT_EQ(ImageOf<std::uint8_t>(ReadScan(m_Path)).GetLargestPossibleRegion().GetSize()[2], 6u)
    << "every third slice, then every second";
}

TEST_F(DicomSegmentation, PlacesCountMoreThanTheSpacingTag)
{
  std::vector<SegmentFrame> frames;
  for (int k = 0; k < 10; ++k)
  {
    frames.push_back({ Text("%g", 2.5 * k) });
  }
  MakeSegmentation(frames, "1.25").Write(m_Path);
  const auto scan = ReadScan(m_Path);
  EXPECT_EQ(ImageOf<std::uint8_t>(scan).GetLargestPossibleRegion().GetSize()[2], 10u);
  EXPECT_NEAR(SummarizeLabels(scan, scan.labels)[0].millilitres, 10 * Pixels * 2.5 / 1000, 1e-9);
  ASSERT_EQ(scan.notes.size(), 1u);
  EXPECT_NE(scan.notes[0].find("1.25"), std::string::npos) << scan.notes[0];

  // As dcmqi writes labels in every second slice.
  MakeSegmentation(frames, "1.25", "1.25").Write(m_Path);
  const auto sparse = ReadScan(m_Path);
  EXPECT_EQ(ImageOf<std::uint8_t>(sparse).GetLargestPossibleRegion().GetSize()[2], 19u);
  EXPECT_TRUE(sparse.notes.empty());

  MakeSegmentation({ { "7" } }, "1.25").Write(m_Path);
  EXPECT_EQ(ImageOf<std::uint8_t>(ReadScan(m_Path)).GetSpacing()[2], 1.25) << "nothing else says";
}

TEST_F(DicomSegmentation, EachFrameKeepsItsSegmentAndPlace)
{
  MakeSegmentation({ { "0", 1, 4 }, { "1", 2, 7 }, { "2", 1, 11 } }).Write(m_Path);
  const auto scan = ReadScan(m_Path);
  const auto & image = ImageOf<std::uint8_t>(scan);
  const std::size_t counts[] = { 4, 7, 11 };
  for (std::size_t n = 0; n < 3 * Pixels; ++n)
  {
    const std::size_t k = n / Pixels;
    EXPECT_EQ(image.GetBufferPointer()[n], n % Pixels >= counts[k] ? 0 : k == 1 ? 2 : 1) << n;
  }
}

/** The values of a voxel in all layers, without 0. */
std::vector<int>
ValuesAt(const rhombic::Scan & scan, std::size_t voxel)
{
  std::vector<int> values;
  for (const auto & layer : rhombic::LayersOf(scan))
  {
    const auto & image = *std::get<itk::Image<std::uint8_t, 3>::Pointer>(layer);
    if (image.GetBufferPointer()[voxel] != 0)
    {
      values.push_back(image.GetBufferPointer()[voxel]);
    }
  }
  std::sort(values.begin(), values.end());
  return values;
}

TEST_F(DicomSegmentation, SegmentsThatOverlapAreWhole)
{
  struct Case
  {
    std::vector<SegmentFrame> frames;
    std::vector<std::size_t> voxels; ///< by segment
    std::size_t layers;
    std::string note;
  };
  const Case cases[] = {
    { { { "0", 1, 15 }, { "1", 1, 12 }, { "1", 2, 5 }, { "2", 1, 9 } }, { 36, 5 }, 2, "5 voxels belong" },
    { { { "0", 2, 5 }, { "0", 1, 15 }, { "1", 1, 2 } }, { 17, 5 }, 2, "5 voxels belong" },
    { { { "0", 1, 7 }, { "0", 2, 7 }, { "1", 1, 1 }, { "1", 2, 1 } }, { 8, 8 }, 2, "8 voxels belong" },
    { { { "0", 1, 7 }, { "0", 2, 5 }, { "0", 3, 3 }, { "1", 1, 0 } }, { 7, 5, 3 }, 3, "5 voxels belong" },
    { { { "0", 1, 7 }, { "0", 2, 5 }, { "1", 3, 3 } }, { 7, 5, 3 }, 2, "5 voxels belong" },
    { { { "0", 1, 7 }, { "1", 2, 5 }, { "2", 3, 3 } }, { 7, 5, 3 }, 1, "" },
  };
  for (const Case & one : cases)
  {
    MakeSegmentation(one.frames, "1").Write(m_Path);
    const auto scan = ReadScan(m_Path);
    EXPECT_EQ(scan.furtherLayers.size() + 1, one.layers);
    ASSERT_EQ(scan.notes.size(), one.note.empty() ? 0u : 1u);
    EXPECT_TRUE(one.note.empty() || scan.notes[0].find(one.note) == 0) << scan.notes[0];
    const auto labels = SummarizeLabels(scan, scan.labels);
    ASSERT_EQ(labels.size(), one.voxels.size());
    for (std::size_t n = 0; n < labels.size(); ++n)
    {
      EXPECT_EQ(labels[n].label.value, static_cast<int>(n + 1));
      EXPECT_EQ(labels[n].numberOfVoxels, one.voxels[n]) << n;
    }
    for (std::size_t voxel = 0; voxel < Pixels; ++voxel) // of the first slice
    {
      std::vector<int> expected;
      for (const SegmentFrame & frame : one.frames)
      {
        if (frame.z == "0" && voxel < frame.pixels)
        {
          expected.push_back(frame.segment);
        }
      }
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(ValuesAt(scan, voxel), expected) << voxel;
    }
  }
}

TEST_F(DicomSegmentation, LayersNeedMemory)
{
  MakeSegmentation({ { "0", 1 }, { "0", 2 }, { "1", 1 }, { "900", 1 } }).Write(m_Path);
  rhombic::ScanReadOptions options;
  options.maximumMemory = 901 * Pixels + 1000;
  EXPECT_EQ(KindOfReading(m_Path, "Layer 2 of labels that overlap", options), FailureKind::Memory);
  options.maximumMemory = 2 * 901 * Pixels;
  EXPECT_NO_THROW(ReadScan(m_Path, options));
}

TEST_F(DicomSegmentation, FramesWithoutPlaceAreRefused)
{
  for (const std::size_t lost : { 0u, 1u, 2u })
  {
    std::vector<SegmentFrame> frames{ { "0", 1, 4 }, { "1", 2, 7 }, { "2", 1, 11 } };
    frames[lost].z.clear();
    MakeSegmentation(frames).Write(m_Path);
    EXPECT_EQ(KindOfReading(m_Path, "the place of a frame is not known"), FailureKind::Geometry) << lost;
  }
}

TEST_F(DicomSegmentation, MemoryIsAskedFor)
{
  MakeSegmentation({ { "0" }, { "1" }, { "900" } }).Write(m_Path);
  rhombic::ScanReadOptions options;
  options.maximumMemory = 901 * Pixels;
  EXPECT_EQ(KindOfReading(m_Path, "maximumMemory", options), FailureKind::Memory);
  options.maximumMemory += 1000;
  EXPECT_NO_THROW(ReadScan(m_Path, options));
  MakeSegmentation({ { "0" }, { "1" }, { "90000" } }).Write(m_Path);
  EXPECT_EQ(KindOfReading(m_Path, "90001 slices"), FailureKind::Geometry);
}

} // namespace
