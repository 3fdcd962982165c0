#include "rhombicDicomSegmentation.h"

#include "rhombicAnatomicalColours.h"
#include "rhombicDicomTags.h"
#include "rhombicFailure.h"
#include "rhombicVolumeGeometry.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace rhombic
{
namespace
{

using Frames = std::vector<DicomSlice>;
using Vector = itk::Vector<double, 3>;

[[noreturn]] void
Refuse(const DicomImageFile & file, FailureKind kind, const std::string & why)
{
  throw Failure(kind, "Cannot read " + file.path.string() + ": " + why + "; export the segmentation again.");
}

/** A component of CIE XYZ from the function of CIE L*a*b* it is coded by. */
double
FromLab(double f)
{
  constexpr double delta = 6.0 / 29.0;
  return f > delta ? f * f * f : 3 * delta * delta * (f - 4.0 / 29.0);
}

std::uint8_t
EncodeSRGB(double linear)
{
  const double clamped = std::clamp(linear, 0.0, 1.0);
  const double encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

/** sRGB from DICOM's 16-bit CIE L*a*b* (PS3.3, C.10.7.1.1), whose white is D50. The matrix is XYZ to sRGB with the
 * Bradford adaptation from D50 (B. Lindbloom). */
std::array<std::uint8_t, 3>
ColourOf(const std::vector<std::uint16_t> & lab)
{
  const double lightness = 100.0 * lab[0] / 65535.0;
  const double a = 255.0 * lab[1] / 65535.0 - 128.0;
  const double b = 255.0 * lab[2] / 65535.0 - 128.0;
  const double middle = (lightness + 16) / 116;
  const double x = 0.96422 * FromLab(middle + a / 500);
  const double y = FromLab(middle);
  const double z = 0.82521 * FromLab(middle - b / 200);
  return { EncodeSRGB(3.1338561 * x - 1.6168667 * y - 0.4906146 * z),
           EncodeSRGB(-0.9787684 * x + 1.9161415 * y + 0.0334540 * z),
           EncodeSRGB(0.0719453 * x - 0.2289914 * y + 1.4052427 * z) };
}

LabelTable
ReadLabels(const DicomDataSet & dataSet, const DicomImageFile & file)
{
  LabelTable labels;
  for (const DicomDataSet & segment : dataSet.GetItems(DicomTags::SegmentSequence))
  {
    Label label;
    label.value = segment.GetShort(DicomTags::SegmentNumber).value_or(0);
    label.name = SanitizeLabelName(segment.GetText(DicomTags::SegmentLabel), label.value);
    const auto lab = segment.GetShorts(DicomTags::RecommendedDisplayCIELabValue);
    label.colour = lab.size() == 3 ? ColourOf(lab) : AnatomicalColour(label.name, label.value);
    labels.push_back(label);
  }
  const auto isBefore = [](const Label & first, const Label & second) { return first.value < second.value; };
  const auto isSame = [](const Label & first, const Label & second) { return first.value == second.value; };
  std::sort(labels.begin(), labels.end(), isBefore);
  if (labels.empty() || std::adjacent_find(labels.begin(), labels.end(), isSame) != labels.end())
  {
    Refuse(file, FailureKind::Unreadable, "it is a DICOM segmentation (SEG) whose list of segments is damaged");
  }
  return labels;
}

/** Where the slices of the label map are, and which of them each frame belongs to. */
struct SegmentationGrid
{
  VolumeGeometry geometry;
  std::vector<itk::Point<double, 3>> sliceOrigins;
  std::vector<std::size_t> sliceOfFrame;
};

Vector
NormalOf(const SlicePlane & plane)
{
  Vector normal = itk::CrossProduct(plane.columnStep, plane.rowStep);
  normal.Normalize();
  return normal;
}

/** The places of frames along the normal, each once, ascending. */
std::vector<double>
DistinctDistances(const std::vector<double> & distances)
{
  constexpr double tolerance = 0.01; // mm
  std::vector<double> sorted = distances;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(
    std::unique(sorted.begin(), sorted.end(), [](double first, double second) { return second - first <= tolerance; }),
    sorted.end());
  return sorted;
}

std::size_t
NearestOf(const std::vector<double> & places, double place)
{
  const auto nearest = std::min_element(places.begin(), places.end(), [place](double first, double second) {
    return std::abs(first - place) < std::abs(second - place);
  });
  return static_cast<std::size_t>(nearest - places.begin());
}

/** The step that all places are whole multiples of from the first: the smallest between two, or that which the file
 * gives; 0 when there is none. */
double
CommonStep(const std::vector<double> & places, double given)
{
  constexpr double tolerance = 0.02; // of a step
  constexpr double mostSlices = 100000;
  double step = given;
  for (std::size_t n = 1; n < places.size() && given <= 0; ++n)
  {
    step = n == 1 ? places[1] - places[0] : std::min(step, places[n] - places[n - 1]);
  }
  const bool isCommon = step > 0 && (places.back() - places.front()) / step < mostSlices &&
                        std::all_of(places.begin(), places.end(), [&](double place) {
                          const double count = (place - places.front()) / step;
                          return std::abs(count - std::round(count)) <= tolerance;
                        });
  return isCommon ? step : 0;
}

SegmentationGrid
MakeGrid(const Frames & frames, double givenStep)
{
  const DicomImageFile & file = *frames.front().file;
  for (const DicomSlice & frame : frames)
  {
    if (!frame.plane)
    {
      Refuse(file, FailureKind::Geometry, "the place of a frame is not known, because " + frame.planeProblem);
    }
  }
  const SlicePlane & plane = *frames.front().plane;
  const Vector normal = NormalOf(plane);
  std::vector<double> distances;
  for (const DicomSlice & frame : frames)
  {
    distances.push_back((frame.plane->position - plane.position) * normal);
    const Vector sideways = frame.plane->position - plane.position - normal * distances.back();
    if (sideways.GetNorm() > 0.01 || (frame.plane->columnStep - plane.columnStep).GetNorm() > 1e-4 ||
        (frame.plane->rowStep - plane.rowStep).GetNorm() > 1e-4)
    {
      Refuse(file, FailureKind::Geometry, "its frames do not lie behind each other");
    }
  }
  std::vector<double> places = DistinctDistances(distances);
  const double step = CommonStep(places, givenStep);
  if (places.size() == 1 && step == 0)
  {
    Refuse(file, FailureKind::Geometry, "it has frames in one plane only and does not say how thick this is");
  }
  SegmentationGrid grid;
  if (step > 0)
  {
    const auto count = static_cast<std::size_t>(std::lround((places.back() - places.front()) / step)) + 1;
    const double first = places.front();
    places.resize(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      places[k] = first + step * static_cast<double>(k);
    }
  }
  for (const double distance : distances)
  {
    grid.sliceOfFrame.push_back(NearestOf(places, distance));
  }
  for (std::size_t k = 0; k < places.size() && step == 0; ++k)
  {
    grid.sliceOrigins.push_back(plane.position + normal * places[k]);
  }
  const double meanStep = step > 0 ? step : (places.back() - places.front()) / static_cast<double>(places.size() - 1);
  const itk::Size<3> size{ { file.format.columns, file.format.rows, places.size() } };
  const Vector axes[3] = { plane.columnStep, plane.rowStep, normal * meanStep };
  grid.geometry = MakeGeometry(size, plane.position + normal * places.front(), axes);
  return grid;
}

std::string
ReadPixelBytes(const DicomImageFile & file)
{
  const std::uintmax_t bits =
    std::uintmax_t{ file.format.columns } * file.format.rows * file.format.frames * file.format.bitsAllocated;
  std::string bytes((bits + 7) / 8, '\0');
  std::ifstream stream(file.path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(file.pixels.offset));
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
  {
    Refuse(file, FailureKind::Unreadable, "its pixels are cut off");
  }
  return bytes;
}

/** A stored pixel; bits are packed from the lowest up, across frames (PS3.5, 8.1.1). */
std::uint32_t
StoredPixel(const std::string & bytes, const DicomPixelFormat & format, std::size_t n)
{
  const auto byte = [&bytes](std::size_t offset) { return std::uint32_t{ static_cast<unsigned char>(bytes[offset]) }; };
  switch (format.bitsAllocated)
  {
    case 1:
      return byte(n / 8) >> n % 8 & 1u;
    case 8:
      return byte(n);
    default:
      return format.isBigEndian ? byte(2 * n) << 8 | byte(2 * n + 1) : byte(2 * n + 1) << 8 | byte(2 * n);
  }
}

/** The segment of each frame of a binary segmentation. */
std::vector<std::uint32_t>
SegmentsOfFrames(const DicomDataSet & dataSet, const LabelTable & labels, const DicomImageFile & file)
{
  const auto & shared = dataSet.GetItem(DicomTags::SharedFunctionalGroupsSequence);
  std::vector<std::uint32_t> segments;
  for (const DicomDataSet & frame : dataSet.GetItems(DicomTags::PerFrameFunctionalGroupsSequence))
  {
    const auto & owner = frame.Has(DicomTags::SegmentIdentificationSequence) ? frame : shared;
    const std::uint32_t segment =
      owner.GetItem(DicomTags::SegmentIdentificationSequence).GetShort(DicomTags::ReferencedSegmentNumber).value_or(0);
    const auto isIt = [segment](const Label & label) { return label.value == static_cast<std::int32_t>(segment); };
    if (std::none_of(labels.begin(), labels.end(), isIt))
    {
      Refuse(
        file, FailureKind::Unreadable, "a frame belongs to segment " + std::to_string(segment) + ", which it lacks");
    }
    segments.push_back(segment);
  }
  return segments;
}

/** Returns how many voxels belong to more than one segment. */
template <typename TPixel>
std::size_t
Fill(const std::string & bytes,
     const DicomPixelFormat & format,
     const std::vector<std::uint32_t> & segments,
     const std::vector<std::size_t> & sliceOfFrame,
     TPixel * pixels)
{
  const std::size_t sliceSize = std::size_t{ format.columns } * format.rows;
  std::size_t shared = 0;
  for (std::size_t frame = 0; frame < sliceOfFrame.size(); ++frame)
  {
    TPixel * const slice = pixels + sliceOfFrame[frame] * sliceSize;
    for (std::size_t n = 0; n < sliceSize; ++n)
    {
      const std::uint32_t stored = StoredPixel(bytes, format, frame * sliceSize + n);
      const bool isPadding = format.padding && stored == format.padding->first;
      if (stored == 0 || isPadding)
      {
        continue;
      }
      const auto label = static_cast<TPixel>(segments.empty() ? stored : segments[frame]);
      shared += slice[n] != 0 && slice[n] != label ? 1 : 0;
      slice[n] = label;
    }
  }
  return shared;
}

} // namespace

void
ReadDicomSegmentation(const std::vector<DicomSlice> & frames, Scan & scan)
{
  const DicomImageFile & file = *frames.front().file;
  const auto header = ReadDicomHeader(file.path);
  const DicomDataSet & dataSet = header.value().dataSet;
  const std::string type = dataSet.GetText(DicomTags::SegmentationType);
  const bool isBinary = type == "BINARY" && file.format.bitsAllocated == 1;
  const bool isLabelMap = type == "LABELMAP" && (file.format.bitsAllocated == 8 || file.format.bitsAllocated == 16);
  if ((!isBinary && !isLabelMap) || file.format.isEncapsulated)
  {
    Refuse(
      file,
      FailureKind::Unreadable,
      "it is a DICOM segmentation (SEG) of a type that is not supported; BINARY and LABELMAP without compression are");
  }
  if (!file.pixelDamage.empty())
  {
    Refuse(file, FailureKind::Unreadable, file.pixelDamage);
  }
  const auto steps = dataSet.GetItem(DicomTags::SharedFunctionalGroupsSequence)
                       .GetItem(DicomTags::PixelMeasuresSequence)
                       .GetDecimals(DicomTags::SpacingBetweenSlices);
  const SegmentationGrid grid = MakeGrid(frames, steps.size() == 1 ? steps[0] : 0);
  scan.labels = ReadLabels(dataSet, file);
  scan.sliceOrigins = grid.sliceOrigins;
  const auto segments = isBinary ? SegmentsOfFrames(dataSet, scan.labels, file) : std::vector<std::uint32_t>();
  const std::string bytes = ReadPixelBytes(file);

  const auto read = [&](auto pixel) {
    const auto image = NewImage<decltype(pixel)>(grid.geometry);
    image->FillBuffer(0);
    const std::size_t shared = Fill(bytes, file.format, segments, grid.sliceOfFrame, image->GetBufferPointer());
    if (shared > 0)
    {
      scan.notes.push_back(std::to_string(shared) + " voxels belong to more than one segment; the last one counts.");
    }
    scan.image = image;
  };
  const bool fitsByte = scan.labels.back().value <= std::numeric_limits<std::uint8_t>::max();
  if (isBinary ? fitsByte : file.format.bitsAllocated == 8)
  {
    read(std::uint8_t{});
  }
  else
  {
    read(std::uint16_t{});
  }
}

} // namespace rhombic
