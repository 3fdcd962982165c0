#include "rhombicUnpackDicom.h"
#include "rhombicLabelMap.h"
#include "rhombicScanTable.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Expected;
using rhombictest::Reading;

constexpr auto NotFound = rhombic::FailureKind::NotFound;
constexpr auto Unreadable = rhombic::FailureKind::Unreadable;
constexpr auto Geometry = rhombic::FailureKind::Geometry;
constexpr auto Usage = rhombic::FailureKind::Usage;

constexpr Expected singleSlice{ Geometry, "single slice" };
constexpr Expected noImages{ NotFound, "no DICOM images" };
constexpr Expected notDicom{ Unreadable, "neither DICOM nor" };
constexpr Expected noImage{ Unreadable, "holds no image" };
constexpr Expected framesWithoutPlaces{ Unreadable, "does not say where its frames are" };
constexpr Expected dose{ Unreadable, "radiotherapy dose" };
constexpr Expected smallMR{ {}, "MR int16 64x64x2" };
constexpr Expected deflated{ Unreadable, "1.2.840.10008.1.2.1.99 (deflated explicit little endian) is not supported" };
constexpr Expected deflatedFrames{ Unreadable, "1.2.840.10008.1.2.8.1 (deflated frames) is not supported" };

struct SingleFile
{
  const char * name;
  Expected alone;              ///< as a file
  Expected pair;               ///< with a copy that is moved along an axis, in a folder
  int axis = 2;                ///< the axis
  const char * like = nullptr; ///< the file that it has the voxels of
};

// From pydicom.
constexpr SingleFile singleFiles[] = {
  { "693_J2KR.dcm",
    singleSlice,
    { {}, "CT int16 512x512x2 of 0.47852x0.47852x1 mm from -122.5,-112.4,47, -1024..1468" } },
  { "CT_small.dcm",
    singleSlice,
    { {}, "CT int16 128x128x2 of 0.66147x0.66147x1 mm from -158.14,-179.04,-76.7, -896..1167" } },
  { "J2K_pixelrep_mismatch.dcm",
    singleSlice,
    { {}, "CT int16 512x512x2 of 0.431x0.431x1 mm from -110.22,-98.19,72.145, -2000..1896" } },
  { "JPEG2000-embedded-sequence-delimiter.dcm", singleSlice, { Geometry, "no usable ImagePositionPatient" } },
  { "MR2_J2KI.dcm",
    singleSlice,
    { {}, "MR float 1024x1024x2 of 0.19531x0.19531x1 mm from -180.06,-98.148,112.83" },
    1 },
  { "MR_small.dcm", singleSlice, smallMR },
  { "MR_small_RLE.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_small_bigendian.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_small_implicit.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_small_jp2klossless.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_small_jpeg_ls_lossless.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_small_padded.dcm", singleSlice, smallMR, 2, "MR_small.dcm" },
  { "MR_truncated.dcm", { Unreadable, "8130 of 8192 bytes" }, { Unreadable, "8130 of 8192 bytes" } },
  { "RG1_J2KI.dcm", { Unreadable, "MONOCHROME1" }, { Unreadable, "MONOCHROME1" } },
  { "UN_sequence.dcm", noImage, noImages },
  { "badVR.dcm", dose, dose },
  { "bad_sequence.dcm",
    singleSlice,
    { {}, "CT int16 512x512x2 of 0.28711x0.28711x1 mm from -65.356,-154.36,1687.5, -1011..1243" } },
  { "eCT_Supplemental.dcm",
    { {}, "CT int16 512x512x2 of 0.38867x0.38867x10 mm from 99.5,-301.5,-149, -1024..172" },
    {} },
  { "emri_small.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "emri_small_RLE.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "emri_small_big_endian.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "emri_small_jpeg_2k_lossless.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "emri_small_jpeg_2k_lossless_too_short.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "emri_small_jpeg_ls_lossless.dcm", framesWithoutPlaces, framesWithoutPlaces },
  { "explicit_VR-UN.dcm",
    singleSlice,
    { {}, "CT int16 512x512x2 of 0.85938x0.85938x1 mm from 0,0,-121, -1024..1186" } },
  { "image_dfl.dcm", deflated, deflated },
  { "liver.dcm", { {}, "SEG uint8 512x512x3 of 0.81055x0.81055x1 mm from -235.2,-226.8,-128.69, 0..1" }, {} },
  { "liver_deflate.dcm", deflatedFrames, deflatedFrames },
  { "meta_missing_tsyntax.dcm", noImage, noImages },
  { "nested_priv_SQ.dcm", noImage, noImages },
  { "no_meta.dcm", notDicom, noImages },
  { "no_meta_group_length.dcm", noImage, noImages },
  { "parametric_map_float.dcm", noImage, noImages },
  { "reportsi.dcm", noImage, noImages },
  { "rtdose.dcm", dose, dose },
  { "rtstruct.dcm", noImage, noImages },
  { "zipMR.gz", notDicom, noImages },
};

struct Folder
{
  const char * path;
  Expected expected;
  bool hasTruth = false; ///< beside it, as NIfTI
};

// From dicom2nifti.
constexpr Folder folders[] = {
  { "failing/gantrytilting/001", { {}, "CT int16 512x512x4 of 0.41797x0.41797x5 mm from -106.79,-256.62,-61.952" } },
  { "failing/notavolume/001", { Geometry, "only one slice" } },
  { "failing/slicecount/001", { {}, "MR uint16 256x256x2 of 1x1x1 mm from -102.79,-161.07,130.05, 0..254" }, true },
  { "failing/sliceincrement/001", { Geometry, "1 slice is missing at 33.11 mm" } },
  { "failing/sliceincrement/002", { Geometry, "1 slice is missing at -133 mm" } },
  { "failing/sliceorientation/001", { Usage, "more than one volume" } },
  { "ge/anatomical/001_single_slice", { Geometry, "only one slice" } },
  { "ge/dti/001", { Geometry, "are at the same place" } },
  { "generic/anatomical/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm from -100.79,-161.07,130.05, 0..254" }, true },
  { "generic/anatomical/001_implicit", { {}, "MR uint16 256x256x4 of 1x1x1 mm" }, true },
  { "generic/anatomical/002_non_isotropic",
    { {}, "MR float 64x28x4 of 6.4x4x0.5 mm from -83.43,-132.13,-143.93" },
    true },
  { "generic/compressed/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm from -100.79,-161.07,130.05, 0..254" }, true },
  { "generic/compressed_j2k/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm" }, true },
  { "generic/compressed_jpeg/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm" }, true },
  { "generic/compressed_jpegls/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm" }, true },
  { "generic/compressed_rle/001", { {}, "MR uint16 256x256x4 of 1x1x1 mm" }, true },
  { "generic/rgb/001", { Unreadable, "colour image" } },
  { "hitachi/anatomical/001", { {}, "x4 mm from -136.27,-50.123,36.644, 0..1537" } },
  { "hyperfine/anatomical/001", { {}, "MR uint16 112x138x8 of 1.59x1.61x5 mm from 0,0,-175, 0..254" } },
  { "philips/anatomical/002", { Usage, "SW_P_FFE" } },
  { "siemens_multiframe/anatomical/001", { {}, "MR uint16 256x256x8 of 0.9375x0.9375x0.89998 mm" } },
};

struct Segmentation
{
  const char * path;
  std::vector<const char *> masks; ///< the same as volumes; several where segments overlap
  std::string labels;
  double padding = 0; ///< of the mask, for voxels that no label is for
};

// From dcmqi.
const Segmentation segmentations[] = {
  { "liver.dcm", { "liver_seg.nrrd" }, "1 Liver" },
  { "23x38x3/seg/label.seg", { "23x38x3/nrrd/label.nrrd" }, "1 Liver" },
  { "24x38x3/seg/label.seg", { "24x38x3/nrrd/label.nrrd" }, "1 Liver" },
  { "sparse-labelmap-noppv.dcm", { "sparse_labelmap_noppv_seg.nrrd" }, "0 Background, 1 Liver" },
  { "sparse-labelmap-ppv5.dcm", { "sparse_labelmap_ppv5_seg.nrrd" }, "0 Background, 1 Liver", 5 },
  { "partial_overlaps.dcm",
    { "partial_overlaps-1.nrrd", "partial_overlaps-2.nrrd", "partial_overlaps-3.nrrd" },
    "1 GREEN, 2 ORANGE, 3 PURPLE, 4 LIGHT_BLUE, 5 DARK_BLUE" },
};

/** How one volume's voxels relate to those of another where they are in the patient. */
struct Comparison
{
  std::size_t outside = 0;   ///< not in the other
  std::size_t different = 0; ///< of another value there
  double farthest = 0;       ///< from the middle of the other's voxel, in voxels
  std::size_t compared = 0;
};

/** Compares each voxel with the one of \a other that lies nearest, if not farther than some voxels;
 * `isSame(value, otherValue)`. */
template <typename TIsSame>
Comparison
CompareInSpace(const rhombic::Scan & scan, const rhombic::Scan & other, TIsSame isSame, double reach = 1.0)
{
  const auto & grid = rhombic::GeometryOf(scan.image);
  const auto & otherGrid = rhombic::GeometryOf(other.image);
  const std::vector<double> values = rhombictest::VoxelsOf(scan);
  const std::vector<double> otherValues = rhombictest::VoxelsOf(other);
  Comparison comparison;
  for (std::size_t n = 0; n < values.size(); ++n)
  {
    const itk::Index<3> index = grid.ComputeIndex(static_cast<itk::OffsetValueType>(n));
    itk::Point<double, 3> point;
    grid.TransformIndexToPhysicalPoint(index, point);
    if (!scan.sliceOrigins.empty())
    {
      itk::Point<double, 3> first;
      grid.TransformIndexToPhysicalPoint({ { 0, 0, index[2] } }, first);
      point += scan.sliceOrigins[static_cast<std::size_t>(index[2])] - first;
    }
    itk::ContinuousIndex<double, 3> place;
    otherGrid.TransformPhysicalPointToContinuousIndex(point, place);
    itk::Index<3> nearest;
    double distance = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      nearest[axis] = std::lround(place[axis]);
      distance = std::max(distance, std::abs(place[axis] - static_cast<double>(nearest[axis])));
    }
    if (distance > reach)
    {
      continue;
    }
    if (!otherGrid.GetLargestPossibleRegion().IsInside(nearest))
    {
      ++comparison.outside;
      continue;
    }
    ++comparison.compared;
    comparison.farthest = std::max(comparison.farthest, distance);
    const double otherValue = otherValues[static_cast<std::size_t>(otherGrid.ComputeOffset(nearest))];
    comparison.different += isSame(values[n], otherValue) ? 0 : 1;
  }
  return comparison;
}

class AwkwardDicom : public ScanTable
{
protected:
  void
  SetUp() override
  {
    ScanTable::SetUp();
    m_Files = m_Scans / "dicom_awkward_pydicom";
    m_Folders = m_Scans / "dicom_awkward_dicom2nifti";
    m_Segmentations = m_Scans / "dicom_seg_dcmqi/segmentations";
  }

  Reading
  ReadPair(const SingleFile & file)
  {
    return rhombictest::Read(rhombictest::MakePair(m_Files / file.name, m_Folder / file.name, file.axis), m_Options);
  }

  rhombic::ScanReadOptions m_Options = rhombic::AcceptUneven();
  fs::path m_Files;
  fs::path m_Folders;
  fs::path m_Segmentations;
};

TEST_F(AwkwardDicom, SingleFiles)
{
  for (const SingleFile & file : singleFiles)
  {
    SCOPED_TRACE(file.name);
    if (IsThere(m_Files / file.name))
    {
      rhombictest::ExpectReading(rhombictest::Read(m_Files / file.name, m_Options), file.alone);
    }
  }
}

TEST_F(AwkwardDicom, SingleFilesInPairs)
{
  for (const SingleFile & file : singleFiles)
  {
    SCOPED_TRACE(file.name);
    if (IsThere(m_Files / file.name) && file.pair.says != nullptr)
    {
      rhombictest::ExpectReading(this->ReadPair(file), file.pair);
    }
  }
}

TEST_F(AwkwardDicom, EncodingsOfASliceHaveTheSameVoxels)
{
  for (const SingleFile & file : singleFiles)
  {
    if (file.like == nullptr || !IsThere(m_Files / file.name))
    {
      continue;
    }
    SCOPED_TRACE(file.name);
    const Reading one = this->ReadPair(file);
    const auto other = std::find_if(std::begin(singleFiles), std::end(singleFiles), [&file](const SingleFile & any) {
      return std::string(any.name) == file.like;
    });
    const Reading sibling = this->ReadPair(*other);
    ASSERT_TRUE(one.scan && sibling.scan) << one.text << sibling.text;
    EXPECT_TRUE(rhombictest::VoxelsOf(*one.scan) == rhombictest::VoxelsOf(*sibling.scan));
  }
}

// Its header says that values are signed, its JPEG 2000 stream that they are not. The numbers are those of pydicom's
// own test of this file.
TEST_F(AwkwardDicom, TheHeaderSaysWhetherValuesAreSigned)
{
  const fs::path file = m_Files / "J2K_pixelrep_mismatch.dcm";
  if (!IsThere(file))
  {
    GTEST_SKIP() << file << " is not there";
  }
  const auto scan = rhombic::ReadScan(rhombictest::MakePair(file, m_Folder / "pair", 2), m_Options);
  const auto & image = ImageOf<std::int16_t>(scan);
  EXPECT_EQ(image.GetPixel({ { 0, 0, 0 } }), -2000);
  const std::int16_t expected[] = { 621, 412, 138, -193, -520, -767, -907, -966, -988, -995 };
  for (long n = 0; n < 10; ++n)
  {
    EXPECT_EQ(image.GetPixel({ { 279, 47 + n, 0 } }), expected[n]);
  }
}

// The bytes of a sequence's end were written over the width in its JPEG 2000 stream.
TEST_F(AwkwardDicom, AStreamIsNotSearchedForItsEnd)
{
  const fs::path file = m_Files / "JPEG2000-embedded-sequence-delimiter.dcm";
  if (!IsThere(file))
  {
    GTEST_SKIP() << file << " is not there";
  }
  try
  {
    rhombictest::UnpackFirstFrame(file);
    ADD_FAILURE() << "it was decoded";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), Unreadable);
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find("are 3722445056x1024, its header says 256x1024"), std::string::npos) << sentence;
  }
}

TEST_F(AwkwardDicom, Folders)
{
  for (const Folder & folder : folders)
  {
    SCOPED_TRACE(folder.path);
    if (IsThere(m_Folders / folder.path))
    {
      rhombictest::ExpectReading(rhombictest::Read(m_Folders / folder.path, m_Options), folder.expected);
    }
  }
}

TEST_F(AwkwardDicom, VoxelsAreWhereDicom2niftiHasThem)
{
  for (const Folder & folder : folders)
  {
    const fs::path truth = m_Folders / (std::string(folder.path) + "_ground_truth.nii.gz");
    if (!folder.hasTruth || !IsThere(truth))
    {
      continue;
    }
    SCOPED_TRACE(folder.path);
    const auto isSame = [](double value, double other) { return std::abs(value - other) <= 1e-5 * std::abs(value); };
    const Comparison comparison =
      CompareInSpace(rhombic::ReadScan(m_Folders / folder.path, m_Options), rhombic::ReadScan(truth), isSame);
    EXPECT_EQ(comparison.outside, 0u);
    EXPECT_EQ(comparison.different, 0u);
    EXPECT_LT(comparison.farthest, 1e-4);
  }
}

// dicom2nifti closes the gap and turns the tilted slices upright by interpolation, and has 0 where there is nothing to
// interpolate from. The last slice lies on its grid as it is.
TEST_F(AwkwardDicom, TiltedSlicesAreWhereDicom2niftiHasThem)
{
  const fs::path folder = m_Folders / "failing/sliceincrement";
  if (!IsThere(folder))
  {
    GTEST_SKIP() << folder << " is not there";
  }
  m_Options.onGap = rhombic::ScanReadOptions::Policy::Accept;
  const auto isSame = [](double value, double other) { return other == 0 || value == other; };
  const Comparison comparison = CompareInSpace(
    rhombic::ReadScan(folder / "002", m_Options), rhombic::ReadScan(folder / "002_ground_truth.nii.gz"), isSame, 1e-3);
  EXPECT_EQ(comparison.compared, 512u * 512u);
  EXPECT_EQ(comparison.outside, 0u);
  EXPECT_EQ(comparison.different, 0u);
}

std::string
ListLabels(const rhombic::LabelTable & labels)
{
  std::string list;
  for (const rhombic::Label & label : labels)
  {
    list += (list.empty() ? "" : ", ") + std::to_string(label.value) + " " + label.name;
  }
  return list;
}

TEST_F(AwkwardDicom, SegmentationsAreTheMasksTheyWereMadeFrom)
{
  for (const Segmentation & segmentation : segmentations)
  {
    SCOPED_TRACE(segmentation.path);
    if (!IsThere(m_Segmentations / segmentation.path))
    {
      continue;
    }
    const rhombic::Scan scan = rhombic::ReadScan(m_Segmentations / segmentation.path, m_Options);
    std::map<int, std::size_t> voxels; // by label
    for (const char * const name : segmentation.masks)
    {
      for (const double value : rhombictest::VoxelsOf(rhombic::ReadScan(m_Segmentations / name)))
      {
        voxels[static_cast<int>(value)] += value != segmentation.padding ? 1 : 0;
      }
    }
    voxels.erase(0);
    for (const auto & summary : rhombic::SummarizeLabels(scan, scan.labels))
    {
      EXPECT_EQ(summary.numberOfVoxels, voxels[summary.label.value]) << summary.label.name;
      voxels.erase(summary.label.value);
    }
    EXPECT_TRUE(std::all_of(voxels.begin(), voxels.end(), [](const auto & one) { return one.second == 0; }));
    for (const rhombic::ScanImage & layer : scan.furtherLayers) // the highest label counts below
    {
      const auto & highest = std::get<itk::Image<std::uint8_t, 3>::Pointer>(scan.image);
      const auto & other = std::get<itk::Image<std::uint8_t, 3>::Pointer>(layer);
      for (std::size_t n = 0; n < other->GetBufferedRegion().GetNumberOfPixels(); ++n)
      {
        highest->GetBufferPointer()[n] = std::max(highest->GetBufferPointer()[n], other->GetBufferPointer()[n]);
      }
    }
    EXPECT_EQ(ListLabels(scan.labels), segmentation.labels);
    rhombic::Scan mask = rhombic::ReadScan(m_Segmentations / segmentation.masks.front());
    auto * const labels = std::get<itk::Image<std::int16_t, 3>::Pointer>(mask.image)->GetBufferPointer();
    const std::size_t count = rhombictest::VoxelsOf(mask).size();
    std::vector<bool> isShared(count);
    for (std::size_t m = 1; m < segmentation.masks.size(); ++m) // the highest label counts where they overlap
    {
      const auto values = rhombictest::VoxelsOf(rhombic::ReadScan(m_Segmentations / segmentation.masks[m]));
      ASSERT_EQ(values.size(), count);
      for (std::size_t n = 0; n < count; ++n)
      {
        isShared[n] = isShared[n] || (labels[n] != 0 && values[n] != 0);
        labels[n] = std::max(labels[n], static_cast<std::int16_t>(values[n]));
      }
    }
    std::replace(labels, labels + count, static_cast<std::int16_t>(segmentation.padding), std::int16_t{ 0 });
    const auto isSame = [](double value, double other) { return value == other; };
    const Comparison comparison = CompareInSpace(scan, mask, isSame);
    EXPECT_EQ(comparison.outside, 0u);
    EXPECT_EQ(comparison.different, 0u);
    EXPECT_LT(comparison.farthest, 1e-4);
    const auto nonzero = [](const rhombic::Scan & one) {
      const auto values = rhombictest::VoxelsOf(one);
      return std::count_if(values.begin(), values.end(), [](double value) { return value != 0; });
    };
    EXPECT_EQ(nonzero(scan), nonzero(mask)) << "labels beyond the segmentation's slices";
    const auto overlaps = std::count(isShared.begin(), isShared.end(), true);
    EXPECT_EQ(scan.notes.empty(), overlaps == 0);
    if (overlaps > 0)
    {
      EXPECT_EQ(scan.notes.at(0).rfind(std::to_string(overlaps) + " voxels belong to more", 0), 0u) << scan.notes[0];
    }
  }
}

TEST_F(AwkwardDicom, MultiframeCopiesAreTheirSlices)
{
  for (const char * name : { "23x38x3", "24x38x3" })
  {
    SCOPED_TRACE(name);
    if (!IsThere(m_Segmentations / name))
    {
      continue;
    }
    const auto slices = rhombic::ReadScan(m_Segmentations / name / "image", m_Options);
    const auto frames = rhombic::ReadScan(m_Segmentations / name / "multiframe", m_Options);
    EXPECT_TRUE(rhombictest::VoxelsOf(slices) == rhombictest::VoxelsOf(frames));
    EXPECT_EQ(rhombictest::Describe(slices), rhombictest::Describe(frames));
  }
}

} // namespace
