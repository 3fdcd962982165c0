#include "rhombicTableRemoval.h"

#include "rhombicPatientMask.h"
#include "rhombicWording.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

namespace rhombic
{
namespace
{

constexpr double blockWidth = 3.0;        // mm
constexpr float tissueThreshold = -300;   // HU: half way between air and fat or skin
constexpr float usualAir = -1000.0f;      // HU
constexpr float fat = -100.0f;            // HU
constexpr std::uint8_t half = 128;        // half of a block's samples, out of 255
constexpr double smallestObject = 1.0;    // ml
constexpr double reachOfCut = 30.0;       // mm: how far from objects the skin is drawn anew,
constexpr double reachAtThinParts = 10.0; // and at thin parts of the patient
constexpr double depthPerShare = 2.4;    // of a block's width: as shares of the blocks that a plane cuts rise, smoothed
constexpr double thickestSmoothed = 5.0; // mm: the skin is not smoothed across thicker slices
constexpr float thicknessOfSkin = 3.0f;  // mm
constexpr float widthOfEdge = 6.0f;      // mm: in this width the drawn skin gives way to the measured one
constexpr float risePerMillimetre = 2000.0f; // HU: rise of the highest value under the skin

/** The grid of blocks of a scan. */
CoarseScan
MakeBlocks(const Scan & scan)
{
  const auto & geometry = GeometryOf(scan.image);
  CoarseScan coarse;
  coarse.longAxis = NearestAxis(geometry.GetDirection(), 2);
  auto spacing = geometry.GetSpacing();
  itk::Size<3> blocks;
  itk::ContinuousIndex<double, 3> first;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isWhole = axis == 2 && !scan.sliceOrigins.empty(); // blocks of uneven stacks have one slice
    const auto samples = isWhole ? 1l : std::max(1l, std::lround(blockWidth / spacing[axis]));
    coarse.shape[axis] = static_cast<std::size_t>(samples);
    first[axis] = 0.5 * static_cast<double>(samples - 1);
    blocks[axis] = (geometry.GetLargestPossibleRegion().GetSize(axis) + coarse.shape[axis] - 1) / coarse.shape[axis];
    spacing[axis] *= static_cast<double>(samples);
  }
  coarse.occupancy = MaskImage::New();
  coarse.occupancy->SetOrigin(geometry.TransformContinuousIndexToPhysicalPoint<double>(first));
  coarse.occupancy->SetSpacing(spacing);
  coarse.occupancy->SetDirection(geometry.GetDirection());
  coarse.occupancy->SetRegions(blocks);
  coarse.occupancy->Allocate();
  coarse.share = MakeLike<MaskImage>(*coarse.occupancy);
  coarse.mean = MakeLike<itk::Image<std::int16_t, 3>>(*coarse.occupancy);
  for (std::size_t slice = 0; slice < scan.sliceOrigins.size(); ++slice)
  {
    const itk::Index<3> firstOfSlice{ { 0, 0, static_cast<itk::IndexValueType>(slice) } };
    coarse.sliceOffsets.push_back(scan.sliceOrigins[slice] -
                                  geometry.TransformIndexToPhysicalPoint<double>(firstOfSlice));
  }
  return coarse;
}

/** How much of a sample is tissue: 0 in air, one half at the threshold, 1 in fat and above. */
inline float
ShareOfTissue(float value)
{
  const float below = 0.5f * (value - usualAir) / (tissueThreshold - usualAir);
  const float above = 0.5f + 0.5f * (value - tissueThreshold) / (fat - tissueThreshold);
  return std::min(std::max(0.0f, std::max(below, above)), 1.0f);
}

template <typename TPixel>
void
FillBlocks(const itk::Image<TPixel, 3> & image, CoarseScan & coarse)
{
  struct Sums
  {
    std::uint32_t tissue = 0;
    float share = 0.0f;
    std::conditional_t<std::is_integral_v<TPixel>, std::int64_t, double> values = 0;
  };
  const auto add = [](Sums & sums, TPixel sample) {
    const auto value = static_cast<float>(sample);
    sums.tissue += value >= tissueThreshold ? 1 : 0;
    sums.share += ShareOfTissue(value);
    sums.values += std::isfinite(value) ? sample : TPixel{ 0 };
  };
  const auto store = [&](std::size_t block, const Sums & sums, std::size_t samples) {
    const double mean = static_cast<double>(sums.values) / static_cast<double>(samples);
    // Rounded up, so that one sample is more than none.
    coarse.occupancy->GetBufferPointer()[block] =
      static_cast<std::uint8_t>((sums.tissue * 255 + samples - 1) / samples);
    coarse.share->GetBufferPointer()[block] =
      static_cast<std::uint8_t>(255.0f * sums.share / static_cast<float>(samples) + 0.5f);
    coarse.mean->GetBufferPointer()[block] =
      static_cast<std::int16_t>(std::lround(std::clamp(mean, -32768.0, 32767.0)));
  };
  SumBlocks<Sums>(image, coarse.shape, coarse.occupancy->GetBufferedRegion().GetSize(), add, store);
}

/** The median of a component's blocks without tissue, in HU; infinite when there are none. */
double
MedianOfAir(const CoarseScan & coarse, const Components & components, std::size_t label)
{
  std::vector<std::int16_t> values;
  for (std::size_t offset = 0; offset < components.labels->GetBufferedRegion().GetNumberOfPixels(); ++offset)
  {
    if (components.labels->GetBufferPointer()[offset] == label && coarse.occupancy->GetBufferPointer()[offset] == 0)
    {
      values.push_back(coarse.mean->GetBufferPointer()[offset]);
    }
  }
  if (values.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** The blocks around the patient. */
struct Surroundings
{
  MaskImage::Pointer outside; ///< null when there is no air around the patient
  double airValue = 0.0;      ///< median of the air
};

/** Finds the blocks that balls of radius ballRadius cover which have room outside the patient, come from a side of the
 * scan along the patient, and are in air. */
Surroundings
FindSurroundings(const CoarseScan & coarse, const MaskImage & patient)
{
  const auto toPatient = DistanceTo(patient, 2.0 * ballRadius);
  const auto centres = MakeMask(patient, [distances = toPatient->GetBufferPointer()](std::size_t offset) {
    return static_cast<double>(distances[offset]) > ballRadius;
  });
  const Components components = FindMaskComponents(*centres, false);
  const auto & size = patient.GetBufferedRegion().GetSize();
  Surroundings found;
  std::size_t largest = 0;
  const auto air = MaskOfParts(components, [&](std::size_t label) {
    const Component & part = components.parts[label];
    bool reaches = false;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto end = static_cast<itk::IndexValueType>(size[axis]);
      reaches = reaches || (axis != coarse.longAxis && (part.lowest[axis] == 0 || part.highest[axis] + 1 == end));
    }
    const double median = reaches ? MedianOfAir(coarse, components, label) : 0.0;
    const bool isAir = reaches && median <= highestAir;
    if (isAir && part.count > largest)
    {
      largest = part.count;
      found.airValue = median;
    }
    return isAir;
  });
  if (largest > 0)
  {
    const auto toCentres = DistanceTo(*air, 2.0 * ballRadius);
    found.outside = MakeMask(patient, [&, distances = toCentres->GetBufferPointer()](std::size_t offset) {
      return patient.GetBufferPointer()[offset] == 0 && static_cast<double>(distances[offset]) <= ballRadius;
    });
  }
  return found;
}

/** Measures each connected object: volumes and centroids count the blocks' shares of tissue. */
std::vector<ScanObject>
MeasureObjects(const CoarseScan & coarse, const MaskImage & objects)
{
  const Components components = FindMaskComponents(objects, true);
  ScanObject empty;
  empty.centroid.Fill(0.0);
  empty.lowest.Fill(std::numeric_limits<double>::infinity());
  empty.highest.Fill(-std::numeric_limits<double>::infinity());
  std::vector<ScanObject> measured(components.parts.size(), empty); // centroids are sums until the last loop
  ForEachIndex(objects.GetBufferedRegion().GetSize(), [&](const itk::Index<3> & index, std::size_t offset) {
    if (const std::uint32_t label = components.labels->GetBufferPointer()[offset])
    {
      ScanObject & object = measured[label];
      const auto point = coarse.PointOf(index);
      const double weight = coarse.occupancy->GetBufferPointer()[offset];
      object.millilitres += weight;
      object.centroid += point.GetVectorFromOrigin() * weight;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        object.lowest[axis] = std::min(object.lowest[axis], point[axis]);
        object.highest[axis] = std::max(object.highest[axis], point[axis]);
      }
    }
  });
  measured.erase(measured.begin()); // the outside
  const auto & spacing = objects.GetSpacing();
  for (ScanObject & object : measured)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      object.centroid[axis] /= object.millilitres;
    }
    object.millilitres *= spacing[0] * spacing[1] * spacing[2] / 1000.0 / 255.0;
  }
  return measured;
}

void
SortByVolume(std::vector<ScanObject> & objects)
{
  std::stable_sort(
    objects.begin(), objects.end(), [](const auto & a, const auto & b) { return a.millilitres > b.millilitres; });
}

/** Sorts objects by volume, and adds up those below smallestObject. */
void
ListObjects(const std::vector<ScanObject> & objects, TableRemoval & removal)
{
  for (const ScanObject & object : objects)
  {
    if (object.millilitres >= smallestObject)
    {
      removal.objects.push_back(object);
    }
    else
    {
      ++removal.numberOfSpecks;
      removal.millilitresOfSpecks += object.millilitres;
    }
  }
  SortByVolume(removal.objects);
}

/** Where the skin is, and where it is drawn anew, by block. */
struct Cut
{
  DistanceImage::Pointer depth; ///< distance from the skin in mm, positive in the patient; right near to the skin
  DistanceImage::Pointer reach; ///< distance in mm from the end of the space around objects, positive in it
};

/** Replaces each value by the mean of it and its neighbours along an axis, with weights of 1, 2 and 1. */
void
Smooth(DistanceImage & image, unsigned int axis)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto step = static_cast<std::size_t>(image.GetOffsetTable()[axis]);
  const std::vector<float> before(image.GetBufferPointer(),
                                  image.GetBufferPointer() + image.GetBufferedRegion().GetNumberOfPixels());
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    const std::size_t previous = index[axis] == 0 ? offset : offset - step;
    const std::size_t next = index[axis] + 1 == static_cast<itk::IndexValueType>(size[axis]) ? offset : offset + step;
    image.GetBufferPointer()[offset] = 0.25f * before[previous] + 0.5f * before[offset] + 0.25f * before[next];
  });
}

/** Finds the skin from the blocks' shares of tissue: blocks within ballRadius of the outside that are beside a border
 * of the patient count as measured, but objects as air. */
Cut
FindCut(const CoarseScan & coarse, const PatientMask & patient, const MaskImage & outside, const MaskImage & objects)
{
  const auto & spacing = objects.GetSpacing();
  const double diagonal = spacing.GetNorm();
  const auto toPatient = DistanceTo(*patient.all, 1.1 * diagonal);
  const auto toOthers = DistanceTo(*Complement(*patient.all), 1.1 * diagonal);
  const auto toOutside = DistanceTo(outside, 2.0 * ballRadius);
  const auto toHanging = DistanceTo(*patient.hanging, reachOfCut);
  const auto toObjects = DistanceTo(objects, reachOfCut + diagonal);
  const double rise = depthPerShare * std::max(spacing[0], spacing[1]);
  Cut cut{ MakeLike<DistanceImage>(objects), MakeLike<DistanceImage>(objects) };
  for (std::size_t offset = 0; offset < objects.GetBufferedRegion().GetNumberOfPixels(); ++offset)
  {
    const double apart = std::max(toPatient->GetBufferPointer()[offset], toOthers->GetBufferPointer()[offset]);
    const bool isSkin = apart < 1.05 * diagonal && toOutside->GetBufferPointer()[offset] <= ballRadius;
    const bool isObject = objects.GetBufferPointer()[offset] != 0;
    const double measured = isObject ? 0.0 : coarse.share->GetBufferPointer()[offset] / 255.0;
    const double share = isSkin ? measured : outside.GetBufferPointer()[offset] != 0 ? 0.0 : 1.0; // of the patient
    cut.depth->GetBufferPointer()[offset] = static_cast<float>((share - 0.5) * rise);
    const double reach = std::min(reachOfCut, reachAtThinParts + toHanging->GetBufferPointer()[offset]);
    cut.reach->GetBufferPointer()[offset] = static_cast<float>(reach - toObjects->GetBufferPointer()[offset]);
  }
  for (const unsigned int axis : { 0u, 1u, 2u })
  {
    if (spacing[axis] <= thickestSmoothed)
    {
      Smooth(*cut.depth, axis);
    }
  }
  return cut;
}

/** The limits of a sample's value near to objects. */
struct Limits
{
  float lowest;
  float highest;
};

/** The limits at a depth under the skin, at \a reach mm from the end of the space around objects. Both rise from air to
 * fat within some two samples, and pass the threshold of tissue at the skin. */
Limits
FindLimits(float depth, float reach, float air, float sampleWidth)
{
  const auto valueAt = [=](float millimetres) {
    return std::clamp(tissueThreshold - air * 0.5f * millimetres / sampleWidth, air, fat);
  };
  const float share = std::clamp(thicknessOfSkin - depth, 0.0f, 1.0f) * std::min(reach / widthOfEdge, 1.0f);
  const float within = std::max(depth, widthOfEdge - reach);
  return { air + share * (valueAt(depth) - air), valueAt(within) + std::max(within, 0.0f) * risePerMillimetre };
}

/** Sets what lies outside the skin around objects to air, and fills gaps in the skin. */
template <typename TPixel>
void
DrawSkin(itk::Image<TPixel, 3> & image, const BlockShape & shape, const Cut & cut, double airValue)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto sampleWidth = static_cast<float>(std::max(image.GetSpacing()[0], image.GetSpacing()[1])); // mm
  const auto air = static_cast<float>(airValue);
  std::array<std::vector<Taps<3>>, 3> taps;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t sample = 0; sample < size[axis]; ++sample)
    {
      taps[axis].push_back(QuadraticTaps(sample, shape[axis], cut.depth->GetBufferedRegion().GetSize(axis)));
    }
  }
  ForEachInBlocks(size[2], 1, [&](std::size_t slice) {
    for (std::size_t row = 0; row < size[1]; ++row)
    {
      const std::vector<float> reachOfRow = InterpolateRow(*cut.reach, taps[1][row], taps[2][slice]);
      if (*std::max_element(reachOfRow.begin(), reachOfRow.end()) <= 0.0f)
      {
        continue;
      }
      const std::vector<float> depthOfRow = InterpolateRow(*cut.depth, taps[1][row], taps[2][slice]);
      TPixel * const samples = image.GetBufferPointer() + size[0] * (row + size[1] * slice);
      for (std::size_t column = 0; column < size[0]; ++column)
      {
        const float reach = InterpolateInRow(reachOfRow, taps[0][column]);
        if (reach <= 0.0f)
        {
          continue;
        }
        const float depth = InterpolateInRow(depthOfRow, taps[0][column]);
        const auto [lowest, highest] = FindLimits(depth, reach, air, sampleWidth);
        const auto value = static_cast<float>(samples[column]);
        if (value < lowest || value > highest)
        {
          samples[column] = static_cast<TPixel>(value < lowest ? lowest : highest);
        }
      }
    }
  });
}

/** The parts of the tissue that belong to the patient and do not touch the largest part, largest first. */
std::vector<ScanObject>
FindSeparateParts(const CoarseScan & coarse, const MaskImage & tissue, const MaskImage & patient)
{
  const auto mask = MakeMask(tissue, [&](std::size_t offset) {
    return tissue.GetBufferPointer()[offset] != 0 && patient.GetBufferPointer()[offset] != 0;
  });
  std::vector<ScanObject> parts = MeasureObjects(coarse, *mask);
  SortByVolume(parts);
  const auto isSmall = [](const ScanObject & part) { return part.millilitres < smallestObject; };
  parts.erase(std::find_if(parts.begin(), parts.end(), isSmall), parts.end());
  parts.erase(parts.begin(), parts.begin() + (parts.empty() ? 0 : 1));
  return parts;
}

double
SumOfVolumes(const std::vector<ScanObject> & objects)
{
  return std::accumulate(objects.begin(), objects.end(), 0.0, [](double sum, const ScanObject & object) {
    return sum + object.millilitres;
  });
}

/** The end of a sentence; empty if there are no such parts. */
std::string
DescribeKept(const TableRemoval & removal)
{
  return removal.kept.empty()
           ? ""
           : "; kept as the patient's: " + Count(removal.kept.size(), "part") + " apart from the largest, of " +
               DescribeVolume(SumOfVolumes(removal.kept)) + " in all";
}

void
NoteRemoval(const TableRemoval & removal, const Events & events)
{
  const double total = SumOfVolumes(removal.objects) + removal.millilitresOfSpecks;
  events.Note("removed " + std::to_string(std::lround(total)) +
              " ml around the patient: " + Count(removal.objects.size(), "object") + " (table, holder, sheets) and " +
              Count(removal.numberOfSpecks, "speck") + "; leave out RemoveTable() to keep them" +
              DescribeKept(removal));
}

} // namespace

TableRemoval
RemoveTable(Scan & scan, const Events & events)
{
  const std::string step = "removing the table";
  events.Progress(step, 0.0);
  TableRemoval removal;
  CoarseScan coarse = MakeBlocks(scan);
  std::visit([&](const auto & image) { FillBlocks(*image, coarse); }, scan.image);
  const std::uint8_t * const occupancy = coarse.occupancy->GetBufferPointer();
  const auto tissue = MakeMask(*coarse.occupancy, [=](std::size_t offset) { return occupancy[offset] >= half; });
  events.Progress(step, 0.2);
  const PatientMask patient = FindPatient(coarse, *tissue);
  events.Progress(step, 0.6);
  const auto [outside, airValue] = patient.all ? FindSurroundings(coarse, *patient.all) : Surroundings();
  if (!outside)
  {
    removal.notes.push_back("nothing was removed around the patient: no body was found in air");
    events.Note(removal.notes.back());
    return removal;
  }
  const auto objects = MakeMask(*outside, [&, isOutside = outside->GetBufferPointer()](std::size_t offset) {
    return isOutside[offset] != 0 &&
           (tissue->GetBufferPointer()[offset] != 0 || (occupancy[offset] != 0 && !IsNear(*patient.all, offset)));
  });
  ListObjects(MeasureObjects(coarse, *objects), removal);
  removal.kept = FindSeparateParts(coarse, *tissue, *patient.all);
  events.Progress(step, 0.8);
  if (!removal.objects.empty())
  {
    const Cut cut = FindCut(coarse, patient, *outside, *objects);
    removal.airValue = airValue;
    std::visit([&](const auto & image) { DrawSkin(*image, coarse.shape, cut, removal.airValue); }, scan.image);
    NoteRemoval(removal, events);
  }
  else
  {
    removal.numberOfSpecks = 0;
    removal.millilitresOfSpecks = 0.0;
    removal.notes.push_back("nothing was removed: no object of 1 ml or more was told from the patient" +
                            DescribeKept(removal));
    events.Note(removal.notes.back());
  }
  events.Progress(step, 1.0);
  return removal;
}

} // namespace rhombic
