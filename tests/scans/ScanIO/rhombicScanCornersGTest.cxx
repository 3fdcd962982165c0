#include "rhombicScanTable.h"

#include "gdcmReader.h"
#include "gdcmSequenceOfItems.h"
#include "gdcmStringFilter.h"

#include <array>

namespace fs = std::filesystem;

namespace
{

using Point = itk::Point<double, 3>;
using Vector = itk::Vector<double, 3>;

const gdcm::Tag imagePosition(0x0020, 0x0032);
const gdcm::Tag imageOrientation(0x0020, 0x0037);
const gdcm::Tag pixelSpacing(0x0028, 0x0030);
const gdcm::Tag rowsTag(0x0028, 0x0010);
const gdcm::Tag columnsTag(0x0028, 0x0011);
const gdcm::Tag sharedGroups(0x5200, 0x9229);
const gdcm::Tag perFrameGroups(0x5200, 0x9230);
const gdcm::Tag planePositions(0x0020, 0x9113);
const gdcm::Tag planeOrientations(0x0020, 0x9116);
const gdcm::Tag pixelMeasures(0x0028, 0x9110);

/** The centres of a slice's four outermost pixels. */
using Corners = std::array<Point, 4>;

std::vector<double>
ParseNumbers(std::string text)
{
  std::replace(text.begin(), text.end(), '\\', ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0; stream >> number;)
  {
    numbers.push_back(number);
  }
  return numbers;
}

std::string
TextOf(const gdcm::DataSet & dataSet, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const value = dataSet.GetDataElement(tag).GetByteValue();
  return value == nullptr ? "" : std::string(value->GetPointer(), value->GetLength());
}

/** A data set inside a sequence of another, from 1; empty when there is none. */
gdcm::DataSet
ItemOf(const gdcm::DataSet & dataSet, const gdcm::Tag & sequence, std::size_t item = 1)
{
  const auto items = dataSet.GetDataElement(sequence).GetValueAsSQ();
  return items && items->GetNumberOfItems() >= item ? items->GetItem(item).GetNestedDataSet() : gdcm::DataSet();
}

/** By the definition of ImagePositionPatient, ImageOrientationPatient and PixelSpacing (PS3.3, C.7.6.2.1.1). */
Corners
CornersFrom(const std::vector<double> & position,
            const std::vector<double> & orientation,
            const std::vector<double> & spacing,
            double rows,
            double columns)
{
  const Point first(position.data());
  const Vector right = Vector(&orientation.at(0)) * (spacing.at(1) * (columns - 1));
  const Vector down = Vector(&orientation.at(3)) * (spacing.at(0) * (rows - 1));
  return { first, first + right, first + down, first + right + down };
}

/** The corners of all slices of a file, by GDCM. */
std::vector<Corners>
CornersOfFile(const fs::path & path)
{
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  if (!reader.Read() || !reader.GetFile().GetDataSet().FindDataElement(columnsTag))
  {
    return {};
  }
  gdcm::StringFilter filter;
  filter.SetFile(reader.GetFile());
  const auto numbersOf = [&filter](const gdcm::Tag & tag) { return ParseNumbers(filter.ToString(tag)); };
  const double rows = numbersOf(rowsTag).at(0);
  const double columns = numbersOf(columnsTag).at(0);
  const gdcm::DataSet & dataSet = reader.GetFile().GetDataSet();
  if (!dataSet.FindDataElement(perFrameGroups))
  {
    return { CornersFrom(
      numbersOf(imagePosition), numbersOf(imageOrientation), numbersOf(pixelSpacing), rows, columns) };
  }
  const gdcm::DataSet shared = ItemOf(dataSet, sharedGroups);
  std::vector<Corners> all;
  const std::size_t frames = dataSet.GetDataElement(perFrameGroups).GetValueAsSQ()->GetNumberOfItems();
  for (std::size_t n = 1; n <= frames; ++n)
  {
    const gdcm::DataSet own = ItemOf(dataSet, perFrameGroups, n);
    const auto find = [&](const gdcm::Tag & group, const gdcm::Tag & tag) {
      return ParseNumbers(TextOf(ItemOf(own.FindDataElement(group) ? own : shared, group), tag));
    };
    all.push_back(CornersFrom(find(planePositions, imagePosition),
                              find(planeOrientations, imageOrientation),
                              find(pixelMeasures, pixelSpacing),
                              rows,
                              columns));
  }
  return all;
}

double
Distance(const Corners & one, const Corners & other)
{
  double largest = 0;
  for (std::size_t n = 0; n < one.size(); ++n)
  {
    largest = std::max(largest, one[n].EuclideanDistanceTo(other[n]));
  }
  return largest;
}

/** The corners of all files, without repetitions. */
std::vector<Corners>
CornersOfFiles(const fs::path & path)
{
  constexpr double samePlace = 1e-4; // mm
  std::vector<Corners> all;
  std::vector<fs::path> files{ path };
  if (fs::is_directory(path))
  {
    files.assign(fs::directory_iterator(path), fs::directory_iterator());
  }
  for (const fs::path & file : files)
  {
    for (const Corners & corners : CornersOfFile(file))
    {
      const bool isNew = std::none_of(
        all.begin(), all.end(), [&corners](const Corners & other) { return Distance(corners, other) <= samePlace; });
      if (isNew)
      {
        all.push_back(corners);
      }
    }
  }
  return all;
}

/** The corners of each slice of a scan. */
std::vector<Corners>
CornersOfScan(const rhombic::Scan & scan)
{
  const auto & geometry = rhombic::GeometryOf(scan.image);
  const auto size = geometry.GetLargestPossibleRegion().GetSize();
  Vector right;
  Vector down;
  for (unsigned int row = 0; row < 3; ++row)
  {
    right[row] = geometry.GetDirection()[row][0] * geometry.GetSpacing()[0] * static_cast<double>(size[0] - 1);
    down[row] = geometry.GetDirection()[row][1] * geometry.GetSpacing()[1] * static_cast<double>(size[1] - 1);
  }
  std::vector<Corners> all;
  for (std::size_t k = 0; k < size[2]; ++k)
  {
    Point first;
    geometry.TransformIndexToPhysicalPoint(itk::Index<3>{ { 0, 0, static_cast<long>(k) } }, first);
    if (!scan.sliceOrigins.empty())
    {
      first = scan.sliceOrigins.at(k);
    }
    all.push_back({ first, first + right, first + down, first + right + down });
  }
  return all;
}

struct PlacedScan
{
  const char * path;
  std::size_t slices;
  const char * series = "";
};

constexpr PlacedScan placedScans[] = {
  { "ct_body_totalseg_dicom_j2k", 20 },
  { "ct_chest_lidc0314_dicom_jpegls", 138 },
  { "ct_head_ge8800_dicom", 93 },
  { "ct_head_tilt_varspacing_dicom_rle", 28 },
  { "mr_head_t1_defaced_dicom_j2k", 384 },
  { "dicom_awkward_dicom2nifti/failing/gantrytilting/001", 4 },
  { "dicom_awkward_dicom2nifti/failing/slicecount/001", 2 },
  { "dicom_awkward_dicom2nifti/failing/sliceincrement/001", 4 },
  { "dicom_awkward_dicom2nifti/failing/sliceincrement/002", 4 },
  { "dicom_awkward_dicom2nifti/generic/anatomical/001", 4 },
  { "dicom_awkward_dicom2nifti/generic/anatomical/001_implicit", 4 },
  { "dicom_awkward_dicom2nifti/generic/anatomical/002_non_isotropic", 4 },
  { "dicom_awkward_dicom2nifti/generic/compressed/001", 4 },
  { "dicom_awkward_dicom2nifti/generic/compressed_j2k/001", 4 },
  { "dicom_awkward_dicom2nifti/generic/compressed_jpeg/001", 4 },
  { "dicom_awkward_dicom2nifti/generic/compressed_jpegls/001", 4 },
  { "dicom_awkward_dicom2nifti/generic/compressed_rle/001", 4 },
  { "dicom_awkward_dicom2nifti/hitachi/anatomical/001", 4 },
  { "dicom_awkward_dicom2nifti/hyperfine/anatomical/001", 8 },
  { "dicom_awkward_dicom2nifti/philips/anatomical/002", 4, "1" },
  { "dicom_awkward_dicom2nifti/philips/anatomical/002", 4, "2" },
  { "dicom_awkward_dicom2nifti/siemens_multiframe/anatomical/001", 8 },
  { "dicom_awkward_pydicom/eCT_Supplemental.dcm", 2 },
  { "dicom_seg_dcmqi/segmentations/23x38x3/image", 3 },
  { "dicom_seg_dcmqi/segmentations/23x38x3/multiframe", 3 },
  { "dicom_seg_dcmqi/segmentations/24x38x3/image", 3 },
  { "dicom_seg_dcmqi/segmentations/24x38x3/multiframe", 3 },
  { "dicom_seg_dcmqi/segmentations/ct-3slice", 3 },
};

class ScanCorners : public ScanTable
{};

// Tilted, sheared, uneven and incomplete stacks among them: each slice must be where its own header says.
TEST_F(ScanCorners, AreThoseOfTheHeaders)
{
  constexpr double tolerance = 1e-3; // mm
  for (const PlacedScan & placed : placedScans)
  {
    SCOPED_TRACE(placed.path);
    if (!IsThere(m_Scans / placed.path))
    {
      continue;
    }
    rhombic::ScanReadOptions options = Series(placed.series);
    options.onGap = rhombic::ScanReadOptions::Policy::Accept;
    options.onUneven = rhombic::ScanReadOptions::Policy::Accept;
    const auto actual = CornersOfScan(rhombic::ReadScan(m_Scans / placed.path, options));
    auto expected = CornersOfFiles(m_Scans / placed.path);
    EXPECT_EQ(expected.size(), placed.slices);
    ASSERT_EQ(actual.size(), placed.slices);
    double largest = 0;
    for (const Corners & corners : actual)
    {
      const auto nearest =
        std::min_element(expected.begin(), expected.end(), [&](const auto & one, const auto & other) {
          return Distance(corners, one) < Distance(corners, other);
        });
      ASSERT_NE(nearest, expected.end());
      largest = std::max(largest, Distance(corners, *nearest));
      expected.erase(nearest); // each header is one slice's
    }
    EXPECT_LE(largest, tolerance);
    this->RecordProperty(placed.path, std::to_string(largest));
  }
}

} // namespace
