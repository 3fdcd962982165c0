#include "rhombicDicomSlice.h"

#include "rhombicDicomPreamble.h"

#include <gdcmReader.h>
#include <gdcmTag.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

namespace rhombic
{
namespace
{

const gdcm::Tag ClassUIDTag(0x0008, 0x0016);
const gdcm::Tag ModalityTag(0x0008, 0x0060);
const gdcm::Tag SeriesUIDTag(0x0020, 0x000e);
const gdcm::Tag SeriesNumberTag(0x0020, 0x0011);
const gdcm::Tag PositionTag(0x0020, 0x0032);
const gdcm::Tag OrientationTag(0x0020, 0x0037);
const gdcm::Tag SamplesTag(0x0028, 0x0002);
const gdcm::Tag PhotometricTag(0x0028, 0x0004);
const gdcm::Tag FramesTag(0x0028, 0x0008);
const gdcm::Tag RowsTag(0x0028, 0x0010);
const gdcm::Tag ColumnsTag(0x0028, 0x0011);
const gdcm::Tag PixelSpacingTag(0x0028, 0x0030);
const gdcm::Tag BitsAllocatedTag(0x0028, 0x0100);
const gdcm::Tag BitsStoredTag(0x0028, 0x0101);
const gdcm::Tag PixelRepresentationTag(0x0028, 0x0103);
const gdcm::Tag InterceptTag(0x0028, 0x1052);
const gdcm::Tag SlopeTag(0x0028, 0x1053);

const std::set<gdcm::Tag> Tags{ ClassUIDTag,
                                ModalityTag,
                                SeriesUIDTag,
                                SeriesNumberTag,
                                PositionTag,
                                OrientationTag,
                                SamplesTag,
                                PhotometricTag,
                                FramesTag,
                                RowsTag,
                                ColumnsTag,
                                PixelSpacingTag,
                                BitsAllocatedTag,
                                BitsStoredTag,
                                InterceptTag,
                                SlopeTag,
                                PixelRepresentationTag };

std::string
TextOf(const gdcm::DataSet & dataSet, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const value =
    dataSet.FindDataElement(tag) ? dataSet.GetDataElement(tag).GetByteValue() : nullptr;
  std::string text = value ? std::string(value->GetPointer(), value->GetLength()) : std::string();
  const std::string padding(" \0", 2);
  text.erase(text.find_last_not_of(padding) + 1);
  text.erase(0, text.find_first_not_of(padding));
  return text;
}

unsigned int
ShortOf(const gdcm::DataSet & dataSet, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const value =
    dataSet.FindDataElement(tag) ? dataSet.GetDataElement(tag).GetByteValue() : nullptr;
  std::uint16_t number = 0;
  if (value != nullptr && value->GetLength() >= sizeof(number))
  {
    std::memcpy(&number, value->GetPointer(), sizeof(number)); // GDCM has put it into this machine's byte order
  }
  return number;
}

/** Finite decimal numbers separated by backslashes; nothing when there is anything else among them. */
std::vector<double>
ParseNumbers(const std::string & text)
{
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    std::string part = text.substr(begin, end - begin);
    part.erase(part.find_last_not_of(' ') + 1);
    part.erase(0, part.find_first_not_of(" +"));
    double number = 0;
    const auto result = std::from_chars(part.data(), part.data() + part.size(), number);
    if (result.ec != std::errc() || result.ptr != part.data() + part.size() || !std::isfinite(number))
    {
      return {};
    }
    numbers.push_back(number);
    begin = end + 1;
  }
  return numbers;
}

/** Fills in the plane, or says why there is none. */
void
ReadPlane(const gdcm::DataSet & dataSet, DicomSlice & slice)
{
  const auto position = ParseNumbers(TextOf(dataSet, PositionTag));
  const auto orientation = ParseNumbers(TextOf(dataSet, OrientationTag));
  const auto spacing = ParseNumbers(TextOf(dataSet, PixelSpacingTag));
  if (position.size() != 3)
  {
    slice.planeProblem = "it has no usable ImagePositionPatient";
    return;
  }
  if (orientation.size() != 6)
  {
    slice.planeProblem = "it has no usable ImageOrientationPatient";
    return;
  }
  if (spacing.size() != 2 || spacing[0] <= 0 || spacing[1] <= 0)
  {
    slice.planeProblem = "it has no usable PixelSpacing";
    return;
  }
  SlicePlane plane;
  itk::Vector<double, 3> alongRow(orientation.data());
  itk::Vector<double, 3> alongColumn(orientation.data() + 3);
  constexpr double tolerance = 1e-3;
  if (std::abs(alongRow.GetNorm() - 1) > tolerance || std::abs(alongColumn.GetNorm() - 1) > tolerance ||
      std::abs(alongRow * alongColumn) > tolerance)
  {
    slice.planeProblem = "the two axes of its ImageOrientationPatient are not perpendicular unit vectors";
    return;
  }
  alongRow.Normalize();
  alongColumn.Normalize();
  plane.position = itk::Point<double, 3>(position.data());
  plane.columnStep = alongRow * spacing[1]; // DICOM gives the distance between rows first
  plane.rowStep = alongColumn * spacing[0];
  slice.plane = plane;
}

/** What kind of object a file is that is no plain slice, by its SOP class; empty for the others. */
std::string
SpecialClass(const std::string & uid)
{
  static const std::array<std::pair<const char *, const char *>, 9> classes{ {
    { "1.2.840.10008.5.1.4.1.1.66.4", "a DICOM segmentation (SEG)" },
    { "1.2.840.10008.5.1.4.1.1.30", "a parametric map" },
    { "1.2.840.10008.5.1.4.1.1.481.2", "a radiotherapy dose (RTDOSE)" },
    { "1.2.840.10008.5.1.4.1.1.2.1", "an enhanced multi-frame CT" },
    { "1.2.840.10008.5.1.4.1.1.2.2", "an enhanced multi-frame CT" },
    { "1.2.840.10008.5.1.4.1.1.4.1", "an enhanced multi-frame MR" },
    { "1.2.840.10008.5.1.4.1.1.4.4", "an enhanced multi-frame MR" },
    { "1.2.840.10008.5.1.4.1.1.130", "an enhanced multi-frame PET" },
    { "1.2.840.10008.5.1.4.1.1.128.1", "an enhanced multi-frame PET" },
  } };
  for (const auto & [classUID, name] : classes)
  {
    if (uid == classUID)
    {
      return name;
    }
  }
  return "";
}

/** Why the file can't be a slice of a volume, as "it ...". */
std::string
FindRefusal(const gdcm::DataSet & dataSet, const DicomSlice & slice)
{
  const std::string special = SpecialClass(TextOf(dataSet, ClassUIDTag));
  const auto frames = ParseNumbers(TextOf(dataSet, FramesTag));
  const std::string photometric = TextOf(dataSet, PhotometricTag);
  if (!special.empty())
  {
    return "it is " + special;
  }
  if (!slice.isImage)
  {
    return "it holds no image (a report, plan or the like)";
  }
  if (!frames.empty() && frames[0] > 1)
  {
    return "it is a multi-frame image";
  }
  if (photometric == "MONOCHROME1")
  {
    return "its grey values are inverted (MONOCHROME1)";
  }
  if (photometric == "PALETTE COLOR" || ShortOf(dataSet, SamplesTag) > 1)
  {
    return "it is a colour image";
  }
  if (photometric != "MONOCHROME2" || ShortOf(dataSet, SamplesTag) != 1)
  {
    return "its kind of pixels (photometric interpretation, samples per pixel) is not supported";
  }
  if ((slice.bitsAllocated != 8 && slice.bitsAllocated != 16 && slice.bitsAllocated != 32) || slice.bitsStored == 0 ||
      slice.bitsStored > slice.bitsAllocated)
  {
    return "its pixels have " + std::to_string(slice.bitsStored) + " of " + std::to_string(slice.bitsAllocated) +
           " bits, which is not supported";
  }
  if (!std::isfinite(slice.slope) || slice.slope == 0 || !std::isfinite(slice.intercept))
  {
    return "its RescaleSlope or RescaleIntercept is no usable number";
  }
  return "";
}

double
ReadScaling(const gdcm::DataSet & dataSet, const gdcm::Tag & tag, double absent)
{
  const std::string text = TextOf(dataSet, tag);
  const auto numbers = ParseNumbers(text);
  return text.empty() ? absent : numbers.size() == 1 ? numbers[0] : std::nan("");
}

/** Keeps what a code may hold, so that no other text travels on. */
std::string
CodeOf(std::string text)
{
  text.erase(std::remove_if(text.begin(),
                            text.end(),
                            [](char letter) {
                              return !((letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
                                       letter == '-');
                            }),
             text.end());
  return text.substr(0, 16);
}

void
ReadHeader(const gdcm::DataSet & dataSet, DicomSlice & slice)
{
  slice.seriesUID = TextOf(dataSet, SeriesUIDTag);
  slice.seriesNumber = CodeOf(TextOf(dataSet, SeriesNumberTag));
  slice.modality = CodeOf(TextOf(dataSet, ModalityTag));
  slice.rows = ShortOf(dataSet, RowsTag);
  slice.columns = ShortOf(dataSet, ColumnsTag);
  slice.isImage = slice.rows > 0 && slice.columns > 0;
  slice.bitsAllocated = ShortOf(dataSet, BitsAllocatedTag);
  slice.bitsStored = ShortOf(dataSet, BitsStoredTag);
  slice.isSigned = ShortOf(dataSet, PixelRepresentationTag) == 1;
  slice.slope = ReadScaling(dataSet, SlopeTag, 1);
  slice.intercept = ReadScaling(dataSet, InterceptTag, 0);
  ReadPlane(dataSet, slice);
  slice.refusal = FindRefusal(dataSet, slice);
}

} // namespace

std::optional<DicomSlice>
ReadDicomSlice(const std::filesystem::path & path)
{
  const DicomPreamble preamble = ReadDicomPreamble(path);
  if (!preamble.isDicom)
  {
    return {};
  }
  DicomSlice slice;
  slice.path = path;
  if (preamble.transferSyntax == "1.2.840.10008.1.2.1.99")
  {
    slice.refusal = "it is deflated as a whole, which is not supported";
    return slice;
  }
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  if (!reader.ReadSelectedTags(Tags))
  {
    slice.isImage = false;
    slice.refusal = "its DICOM header is damaged or of a transfer syntax that is not supported";
    return slice;
  }
  ReadHeader(reader.GetFile().GetDataSet(), slice);
  return slice;
}

} // namespace rhombic
