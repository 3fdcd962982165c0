#include "rhombicTableRemoval.h"

#include "rhombicCoarseScan.h"
#include "rhombicPatientMask.h"
#include "rhombicWording.h"

#include "itkForEachBlock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>

namespace rhombic
{
namespace
{

constexpr double tissueThreshold = -300.0; // HU: half way between air and fat or skin
constexpr double hardThreshold = 150.0;    // HU: higher than skin, lower than bone, metal and carbon fibre
constexpr double smallestObject = 1.0;     // ml
constexpr float heightOfRamp = 2000.0f;    // HU: height from which the limit of values falls to air at the cut

/** The blocks around the patient. */
struct Surroundings
{
  MaskImage::Pointer outside;
  MaskImage::Pointer objects; ///< blocks around the patient with tissue samples
  double airValue = 0.0;
};

/** The median of a component's blocks without tissue, in HU; infinite when there are none. */
double
MedianOfAir(const CoarseScan & coarse, const Components & components, std::uint32_t label)
{
  std::vector<std::int16_t> values;
  for (std::size_t offset = 0; offset < coarse.NumberOfBlocks(); ++offset)
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

/** Finds the blocks that are neither the patient nor in its cavities and clefts, and are connected with the scan's
 * sides. Nothing when there is no air. */
std::optional<Surroundings>
FindSurroundings(const CoarseScan & coarse, const PatientMask & mask, const DistanceImage & toPatient)
{
  const OpenSpace space = FindOpenSpace(toPatient, coarse.longAxis);
  const auto & parts = space.centres.parts;
  std::vector<bool> isOutside(parts.size(), false);
  Surroundings found;
  std::size_t largest = 0;
  for (std::uint32_t label = 1; label < parts.size(); ++label)
  {
    if (!space.reachesSides[label])
    {
      continue;
    }
    const double air = MedianOfAir(coarse, space.centres, label);
    isOutside[label] = air <= highestAir;
    if (isOutside[label] && parts[label].count > largest)
    {
      largest = parts[label].count;
      found.airValue = air;
    }
  }
  const auto reached = FillOpenSpace(space, isOutside);
  if (!reached)
  {
    return {};
  }
  const double diagonal = coarse.occupancy->GetSpacing().GetNorm();
  const float * const distances = toPatient.GetBufferPointer();
  const std::uint8_t * const isPatient = mask.patient->GetBufferPointer();
  const std::uint8_t * const isTissue = mask.tissue->GetBufferPointer();
  const std::uint8_t * const occupancy = coarse.occupancy->GetBufferPointer();
  found.outside = MakeMask(
    toPatient, [&](std::size_t offset) { return isPatient[offset] == 0 && reached->GetBufferPointer()[offset] != 0; });
  found.objects = MakeMask(toPatient, [&](std::size_t offset) {
    const bool isApart = static_cast<double>(distances[offset]) > diagonal;
    return found.outside->GetBufferPointer()[offset] != 0 &&
           (isTissue[offset] != 0 || (occupancy[offset] != 0 && isApart));
  });
  return found;
}

/** Measures each connected object: volumes and centroids count the blocks' shares of tissue. */
std::vector<RemovedObject>
MeasureObjects(const CoarseScan & coarse, const MaskImage & objects)
{
  const Components components = FindComponents(objects, true);
  RemovedObject empty;
  empty.centroid.Fill(0.0);
  empty.lowest.Fill(std::numeric_limits<double>::infinity());
  empty.highest.Fill(-std::numeric_limits<double>::infinity());
  std::vector<RemovedObject> measured(components.parts.size(), empty); // centroids are sums until the last loop
  ForEachIndex(objects.GetBufferedRegion().GetSize(), [&](const itk::Index<3> & index, std::size_t offset) {
    if (const std::uint32_t label = components.labels->GetBufferPointer()[offset])
    {
      RemovedObject & object = measured[label];
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
  for (RemovedObject & object : measured)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      object.centroid[axis] /= object.millilitres;
    }
    object.millilitres *= coarse.Millilitres(1) / 255.0;
  }
  return measured;
}

/** Sorts objects by volume, and adds up those below smallestObject. */
void
ListObjects(const std::vector<RemovedObject> & objects, TableRemoval & removal)
{
  for (const RemovedObject & object : objects)
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
  std::stable_sort(removal.objects.begin(), removal.objects.end(), [](const auto & a, const auto & b) {
    return a.millilitres > b.millilitres;
  });
}

/** The distance of each block beyond the cut around the patient in mm, at most a block's diagonal; negative where
 * samples stay. */
DistanceImage::Pointer
FindExcess(const CoarseScan & coarse, const Surroundings & surroundings, const DistanceImage & toPatient)
{
  const auto toObjects = DistanceTo(*surroundings.objects);
  const double diagonal = coarse.occupancy->GetSpacing().GetNorm();
  const double margin = 2.0 * diagonal;
  const auto excess = MakeLike<DistanceImage>(toPatient);
  for (std::size_t offset = 0; offset < coarse.NumberOfBlocks(); ++offset)
  {
    const double patient = toPatient.GetBufferPointer()[offset];
    const double object = toObjects->GetBufferPointer()[offset];
    const bool isOutside = surroundings.outside->GetBufferPointer()[offset] != 0 || object <= diagonal;
    const double beyond = std::max(patient - margin, patient - object);
    excess->GetBufferPointer()[offset] =
      static_cast<float>(isOutside ? std::clamp(beyond, -diagonal, diagonal) : -diagonal);
  }
  return excess;
}

/** Lowers the values beyond the cut to air. The limit falls from high values to air within a ramp as wide as a sample,
 * so that surfaces at any threshold close there, smoothly. */
template <typename TPixel>
void
LowerToAir(itk::Image<TPixel, 3> & image, const BlockShape & shape, const DistanceImage & excess, double airValue)
{
  const auto & size = image.GetBufferedRegion().GetSize();
  const auto ramp = static_cast<float>(std::max(image.GetSpacing()[0], image.GetSpacing()[1])); // mm
  const auto air = static_cast<float>(airValue);
  std::array<std::vector<Taps<3>>, 3> taps;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t sample = 0; sample < size[axis]; ++sample)
    {
      taps[axis].push_back(QuadraticTaps(sample, shape[axis], excess.GetBufferedRegion().GetSize(axis)));
    }
  }
  itk::ForEachInBlocks(size[2], 1, [&](std::size_t slice) {
    for (std::size_t row = 0; row < size[1]; ++row)
    {
      const std::vector<float> excessOfRow = InterpolateRow(excess, taps[1][row], taps[2][slice]);
      if (*std::max_element(excessOfRow.begin(), excessOfRow.end()) <= -0.5f * ramp)
      {
        continue;
      }
      TPixel * const samples = image.GetBufferPointer() + size[0] * (row + size[1] * slice);
      for (std::size_t column = 0; column < size[0]; ++column)
      {
        const float beyond = InterpolateInRow(excessOfRow, taps[0][column]);
        const float limit = air + std::max(0.0f, 0.5f - beyond / ramp) * heightOfRamp;
        if (beyond > -0.5f * ramp && static_cast<float>(samples[column]) > limit)
        {
          samples[column] = static_cast<TPixel>(limit);
        }
      }
    }
  });
}

void
NoteRemoval(const TableRemoval & removal, const Events & events)
{
  const double total =
    std::accumulate(removal.objects.begin(),
                    removal.objects.end(),
                    removal.millilitresOfSpecks,
                    [](double sum, const RemovedObject & object) { return sum + object.millilitres; });
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "removed " << std::lround(total) << " ml around the patient: " << Count(removal.objects.size(), "object")
       << " (table, holder, sheets) and " << Count(removal.numberOfSpecks, "speck") << "; --keep-table keeps them";
  events.Note(text.str());
  for (const std::string & note : removal.notes)
  {
    events.Note(note);
  }
}

} // namespace

bool
IsTableRemoved(TableRule rule, const Scan & scan)
{
  return rule != TableRule::Keep && (scan.modality == "CT" || (rule == TableRule::Remove && scan.modality.empty()));
}

TableRemoval
RemoveTable(Scan & scan, const Events & events)
{
  const std::string step = "removing the table";
  events.Progress(step, 0.0);
  TableRemoval removal;
  const CoarseScan coarse = MakeCoarseScan(scan, tissueThreshold, hardThreshold);
  events.Progress(step, 0.2);
  const PatientMask mask = FindPatient(coarse);
  removal.notes = mask.notes;
  events.Progress(step, 0.6);
  if (!mask.patient)
  {
    removal.notes.push_back("nothing was removed around the patient: no body was found in air");
    events.Note(removal.notes.back());
    return removal;
  }
  const auto toPatient = DistanceTo(*mask.patient);
  const auto surroundings = FindSurroundings(coarse, mask, *toPatient);
  if (surroundings)
  {
    removal.airValue = surroundings->airValue;
    ListObjects(MeasureObjects(coarse, *surroundings->objects), removal);
  }
  events.Progress(step, 0.8);
  if (!removal.objects.empty())
  {
    const auto excess = FindExcess(coarse, *surroundings, *toPatient);
    std::visit([&](const auto & image) { LowerToAir(*image, coarse.shape, *excess, removal.airValue); }, scan.image);
    NoteRemoval(removal, events);
  }
  events.Progress(step, 1.0);
  return removal;
}

} // namespace rhombic
