#include "rhombicDicomStack.h"

#include "rhombicColour.h"
#include "rhombicDicomHeader.h"
#include "rhombicLabelLayers.h"
#include "rhombicMemoryBudget.h"
#include "rhombicStoredBytes.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

namespace rhombic
{
namespace
{

using Frames = std::vector<DicomSlice>;
using Bytes = std::vector<std::byte>;
using Vector = itk::Vector<double, 3>;

void
RefuseIf(bool isRefused, const DicomImageFile & file, FailureKind kind, const std::string & why)
{
  FailIf(isRefused, kind, "Cannot read " + file.path.string() + ": " + why + "; export the segmentation again.");
}

/** The inverse of the function f of CIE L*a*b*, which gives a component of CIE XYZ relative to white. */
double
FromLab(double f)
{
  constexpr double delta = 6.0 / 29.0;
  return f > delta ? f * f * f : 3 * delta * delta * (f - 4.0 / 29.0);
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
  return ToBytes({ LinearToSRGB(3.1338561 * x - 1.6168667 * y - 0.4906146 * z),
                   LinearToSRGB(-0.9787684 * x + 1.9161415 * y + 0.0334540 * z),
                   LinearToSRGB(0.0719453 * x - 0.2289914 * y + 1.4052427 * z) });
}

LabelTable
ReadLabels(const DicomDataSet & dataSet, const DicomImageFile & file)
{
  LabelTable labels;
  for (const DicomDataSet & segment : dataSet.GetItems(DicomTags::SegmentSequence))
  {
    Label label =
      NamedLabel(segment.GetShort(DicomTags::SegmentNumber).value_or(0), segment.GetText(DicomTags::SegmentLabel));
    const auto lab = segment.GetShorts(DicomTags::RecommendedDisplayCIELabValue);
    label.colour = lab.size() == 3 ? ColourOf(lab) : label.colour;
    labels.push_back(label);
  }
  const auto isBefore = [](const Label & first, const Label & second) { return first.value < second.value; };
  const auto isSame = [](const Label & first, const Label & second) { return first.value == second.value; };
  std::sort(labels.begin(), labels.end(), isBefore);
  RefuseIf(labels.empty() || std::adjacent_find(labels.begin(), labels.end(), isSame) != labels.end(),
           file,
           FailureKind::Unreadable,
           "it is a DICOM segmentation (SEG) whose list of segments is damaged");
  return labels;
}

/** Slices at equal distances along the normal, and the slice of each frame. */
struct EvenSlices
{
  double first = 0; ///< distance of the first slice from the first frame, in mm
  double step = 0;
  std::size_t count = 1;
  std::vector<std::size_t> sliceOfFrame;
};

/** The distances of frames along the normal without repetitions, ascending. */
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

/** Whether two steps are the same within the rounding of numbers in headers. */
bool
IsSameStep(double first, double second)
{
  return std::abs(first - second) <= 0.02 * std::min(first, second);
}

/** Refines a guess of the distance between slices, of which all steps between frames are multiples. The smallest steps
 * come first, so that the distance is accurate enough to count the slices of a large step. */
double
RefineStep(const std::vector<double> & places, double guess)
{
  std::vector<double> steps = StepsOf(places);
  std::sort(steps.begin(), steps.end());
  double step = guess;
  double length = 0;
  double count = 0;
  for (const double distance : steps)
  {
    length += distance;
    count += std::max(1.0, std::round(distance / step));
    step = length / count;
  }
  return step;
}

/** Fits slices of equal distance, about \a guess, to the positions of frames (\a places): the least-squares line of
 * position over slice number. Nothing when a position is off that line by more than 2 % of a step and rounding, or two
 * frames would be in one slice. More is tolerated than EvenSliceTolerance(): programs that write segmentations round
 * the positions of a scan anew, and a label map has no places for uneven frames. */
std::optional<EvenSlices>
FitSlices(const std::vector<double> & places, double guess)
{
  const double step = RefineStep(places, guess);
  std::vector<double> numbers{ 0 };
  for (std::size_t n = 1; n < places.size(); ++n)
  {
    numbers.push_back(numbers.back() + std::round((places[n] - places[n - 1]) / step));
  }
  const auto size = static_cast<double>(places.size());
  const double meanPlace = std::accumulate(places.begin(), places.end(), 0.0) / size;
  const double meanNumber = std::accumulate(numbers.begin(), numbers.end(), 0.0) / size;
  double covariance = 0;
  double variance = 0;
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    covariance += (numbers[n] - meanNumber) * (places[n] - meanPlace);
    variance += (numbers[n] - meanNumber) * (numbers[n] - meanNumber);
  }
  EvenSlices slices;
  slices.step = covariance / variance;
  slices.first = meanPlace - slices.step * meanNumber;
  slices.count = static_cast<std::size_t>(numbers.back()) + 1;
  const double tolerance = std::max(0.02 * step, std::min(0.02, 0.1 * step));
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    const bool isNew = n == 0 || numbers[n] > numbers[n - 1];
    if (!isNew || !(std::abs(slices.first + slices.step * numbers[n] - places[n]) <= tolerance))
    {
      return {};
    }
  }
  return slices;
}

/** Distance and thickness of slices in the header, in mm; 0 when absent. */
struct SliceTags
{
  double spacing = 0;
  double thickness = 0;
};

/** The slices of frames at the positions \a places, in mm along the normal. The step is SpacingBetweenSlices if
 * SliceThickness agrees with it and it fits; it may be smaller than all distances of frames, when no two adjacent
 * slices have frames. Otherwise the step is the smallest distance of two frames, or SpacingBetweenSlices if that does
 * not fit. For a single position, it is SpacingBetweenSlices. */
EvenSlices
FindSlices(const std::vector<double> & places, const SliceTags & tags, const DicomImageFile & file, Scan & scan)
{
  if (places.size() == 1)
  {
    RefuseIf(
      !(tags.spacing > 0), file, FailureKind::Geometry, "it has frames in one plane only, and no SpacingBetweenSlices");
    return { places.front(), tags.spacing, 1, {} };
  }
  const std::vector<double> steps = StepsOf(places);
  const double smallest = *std::min_element(steps.begin(), steps.end());
  const auto fit = [&places](double step) { return step > 0 ? FitSlices(places, step) : std::nullopt; };
  const bool doTagsAgree = tags.spacing > 0 && IsSameStep(tags.spacing, tags.thickness);
  auto slices = fit(doTagsAgree ? tags.spacing : smallest);
  if (!slices)
  {
    slices = fit(doTagsAgree ? smallest : tags.spacing);
  }
  RefuseIf(!slices, file, FailureKind::Geometry, "the places of its frames have no common distance");
  if (tags.spacing > 0 && !IsSameStep(slices.value().step, tags.spacing))
  {
    scan.notes.push_back("Slices are " + FormatNumber(slices.value().step, 4) +
                         " mm apart by the positions of their frames; " + "SpacingBetweenSlices is " +
                         FormatNumber(tags.spacing, 4) + " mm.");
  }
  return slices.value();
}

SliceTags
ReadSliceTags(const DicomDataSet & dataSet)
{
  const DicomDataSet & measures =
    dataSet.GetItem(DicomTags::SharedFunctionalGroupsSequence).GetItem(DicomTags::PixelMeasuresSequence);
  const auto read = [&measures](DicomTag tag) {
    const auto numbers = measures.GetDecimals(tag);
    return numbers.size() == 1 ? numbers[0] : 0;
  };
  return { read(DicomTags::SpacingBetweenSlices), read(DicomTags::SliceThickness) };
}

/** The distances of frames from the first along the normal, in mm. */
std::vector<double>
DistancesOf(const Frames & frames)
{
  const DicomImageFile & file = *frames.front().file;
  for (const DicomSlice & frame : frames)
  {
    RefuseIf(
      !frame.plane, file, FailureKind::Geometry, "the place of a frame is not known, because " + frame.planeProblem);
  }
  const SlicePlane & plane = *frames.front().plane;
  const Vector normal = NormalOf(plane);
  std::vector<double> distances;
  for (const DicomSlice & frame : frames)
  {
    distances.push_back((frame.plane->position - plane.position) * normal);
    const Vector sideways = frame.plane->position - plane.position - normal * distances.back();
    RefuseIf(sideways.GetNorm() > 0.01 || (frame.plane->columnStep - plane.columnStep).GetNorm() > 1e-4 ||
               (frame.plane->rowStep - plane.rowStep).GetNorm() > 1e-4,
             file,
             FailureKind::Geometry,
             "its frames do not lie behind each other");
  }
  return distances;
}

/** All slices from the first frame to the last one; slices in between may have no frame. */
EvenSlices
PlaceFrames(const Frames & frames, const SliceTags & tags, Scan & scan)
{
  const DicomImageFile & file = *frames.front().file;
  const std::vector<double> distances = DistancesOf(frames);
  const std::vector<double> places = DistinctDistances(distances);
  EvenSlices slices = FindSlices(places, tags, file, scan);
  // Bounds the memory that a small file with distant frames can request.
  const std::size_t mostSlices = std::max<std::size_t>(1024, 64 * places.size());
  RefuseIf(slices.count > mostSlices,
           file,
           FailureKind::Geometry,
           "it has frames in " + std::to_string(places.size()) + " of " + Count(slices.count, "slice") +
             " only, which is too few to be true");
  for (const double distance : distances)
  {
    slices.sliceOfFrame.push_back(
      static_cast<std::size_t>(std::max(0L, std::lround((distance - slices.first) / slices.step))));
  }
  return slices;
}

VolumeGeometry
GeometryOfFrames(const EvenSlices & slices, const DicomSlice & frame)
{
  const SlicePlane & plane = *frame.plane;
  const Vector normal = NormalOf(plane);
  const DicomPixelFormat & format = frame.file->format;
  const itk::Size<3> size{ { format.columns, format.rows, slices.count } };
  const Vector axes[3] = { plane.columnStep, plane.rowStep, normal * slices.step };
  return MakeGeometry(size, plane.position + normal * slices.first, axes);
}

/** A stored pixel. Bits are packed from the lowest to the highest, across frames (PS3.5, 8.1.1). */
std::uint32_t
StoredPixel(const Bytes & bytes, const DicomPixelFormat & format, std::size_t n)
{
  const auto byte = [&bytes](std::size_t offset) { return std::to_integer<std::uint32_t>(bytes[offset]); };
  switch (format.bitsAllocated)
  {
    case 1:
      return byte(n / 8) >> n % 8 & 1u;
    case 8:
      return byte(n);
    default:
      return byte(2 * n + 1) << 8 | byte(2 * n);
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
    RefuseIf(std::none_of(labels.begin(), labels.end(), isIt),
             file,
             FailureKind::Unreadable,
             "a frame belongs to segment " + std::to_string(segment) + ", which it lacks");
    segments.push_back(segment);
  }
  return segments;
}

/** The stored voxels of a segmentation, the segment of each frame of a binary one, and the slice of each frame. */
struct SegmentationVoxels
{
  const Bytes & bytes;
  const DicomPixelFormat & format;
  const std::vector<std::uint32_t> & segments;
  const Frames & frames;
  const std::vector<std::size_t> & sliceOfFrame;
};

/** Calls \a add with each voxel of a label, and the label; of label 0, with those of all labels. */
template <typename TPixel, typename TAdd>
void
VisitLabel(const SegmentationVoxels & voxels, TPixel wanted, const TAdd & add)
{
  const DicomPixelFormat & format = voxels.format;
  const std::size_t sliceSize = std::size_t{ format.columns } * format.rows;
  for (std::size_t index = 0; index < voxels.frames.size(); ++index)
  {
    const std::size_t frame = voxels.frames[index].frame;
    const bool isOther = !voxels.segments.empty() && wanted != 0 && voxels.segments[frame] != wanted;
    for (std::size_t n = 0; n < sliceSize && !isOther; ++n)
    {
      const std::uint32_t stored = StoredPixel(voxels.bytes, format, frame * sliceSize + n);
      const bool isPadding = format.padding && stored == format.padding->first;
      const auto label = static_cast<TPixel>(voxels.segments.empty() ? stored : voxels.segments[frame]);
      if (stored != 0 && !isPadding && (wanted == 0 || wanted == label))
      {
        add(voxels.sliceOfFrame[index] * sliceSize + n, label);
      }
    }
  }
}

/** Fills the layers of labels. */
template <typename TPixel>
void
Fill(const SegmentationVoxels & voxels, std::uintmax_t maximumMemory, Scan & scan)
{
  LabelLayers<TPixel> layers(rhombic::GeometryOf(scan.image), maximumMemory);
  std::set<TPixel> labels{ 0 };
  const std::set<std::size_t> slices(voxels.sliceOfFrame.begin(), voxels.sliceOfFrame.end());
  if (slices.size() < voxels.frames.size()) // so that labels may overlap
  {
    labels = { voxels.segments.begin(), voxels.segments.end() };
    if (labels.empty())
    {
      VisitLabel<TPixel>(voxels, 0, [&labels](std::size_t, TPixel label) { labels.insert(label); });
    }
  }
  for (const TPixel label : labels)
  {
    layers.Add([&](const auto & add) { VisitLabel(voxels, label, add); });
  }
  layers.Take(scan);
}

/** Whether a segmentation has a frame for each segment and slice; otherwise its pixels are labels. Throws Failure for
 * other types and damaged pixels. */
bool
IsBinary(const DicomDataSet & dataSet, const DicomImageFile & file)
{
  const std::string type = dataSet.GetText(DicomTags::SegmentationType);
  const bool isBinary = type == "BINARY" && file.format.bitsAllocated == 1;
  const bool isLabelMap = type == "LABELMAP" && (file.format.bitsAllocated == 8 || file.format.bitsAllocated == 16);
  RefuseIf(
    (!isBinary && !isLabelMap) || file.format.isEncapsulated,
    file,
    FailureKind::Unreadable,
    "it is a DICOM segmentation (SEG) of a type that is not supported; BINARY and LABELMAP without compression are");
  RefuseIf(!file.pixelDamage.empty(), file, FailureKind::Unreadable, file.pixelDamage);
  return isBinary;
}

} // namespace

UnreadScan
OpenDicomSegmentation(const std::vector<DicomSlice> & frames, std::uintmax_t maximumMemory, Scan scan)
{
  const DicomImageFile & file = *frames.front().file;
  const DicomDataSet & dataSet = *file.segmentation;
  const bool isBinary = IsBinary(dataSet, file);
  const EvenSlices slices = PlaceFrames(frames, ReadSliceTags(dataSet), scan);
  scan.labels = ReadLabels(dataSet, file);
  const bool fitsByte = scan.labels.back().value <= std::numeric_limits<std::uint8_t>::max();
  const bool takesByte = isBinary ? fitsByte : file.format.bitsAllocated == 8;
  const auto segments = isBinary ? SegmentsOfFrames(dataSet, scan.labels, file) : std::vector<std::uint32_t>();
  const VolumeGeometry geometry = GeometryOfFrames(slices, frames.front());
  scan.image = takesByte ? ScanImage(NewFrame<std::uint8_t>(geometry)) : ScanImage(NewFrame<std::uint16_t>(geometry));

  return { scan, [=](Scan & read) {
            const DicomImageFile & stored = *frames.front().file;
            const DicomPixelFormat & format = stored.format;
            const std::uintmax_t pixels = std::uintmax_t{ format.columns } * format.rows;
            RequireMemory(stored.pixels.size + pixels * slices.count * (takesByte ? 1 : 2),
                          maximumMemory,
                          "Reading " + stored.path.string());
            const Bytes bytes = ReadStoredBytes(stored, 0, (pixels * format.frames * format.bitsAllocated + 7) / 8);
            const SegmentationVoxels voxels{ bytes, format, segments, frames, slices.sliceOfFrame };
            const auto fill = takesByte ? Fill<std::uint8_t> : Fill<std::uint16_t>;
            fill(voxels, maximumMemory, read);
          } };
}

} // namespace rhombic
