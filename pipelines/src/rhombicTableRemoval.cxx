#include "rhombicTableRemoval.h"

#include "rhombicCoarseScan.h"
#include "rhombicEnclosedParts.h"
#include "rhombicPatientMask.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
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
constexpr double highestAir = -940.0;      // HU: the median of air; lungs that reach the scan's sides are higher
constexpr double smallestObject = 1.0;     // ml

/** The blocks around the patient, and what is there. */
struct Surroundings
{
  MaskImage::Pointer outside;
  MaskImage::Pointer objects;
  double airValue = 0.0;
};

/** The median of a component's blocks without tissue, in HU. */
double
MedianOfAir(const CoarseScan & coarse, const Components & components, std::uint32_t label)
{
  std::vector<std::int16_t> values;
  for (std::size_t n = 0; n < coarse.NumberOfBlocks(); ++n)
  {
    if (components.labels->GetBufferPointer()[n] == label && coarse.occupancy->GetBufferPointer()[n] == 0)
    {
      values.push_back(coarse.mean->GetBufferPointer()[n]);
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

/** What is not the patient, nor in it or in its clefts, and is connected with the scan's sides. None when there is no
 * air. */
std::optional<Surroundings>
FindSurroundings(const CoarseScan & coarse,
                 const PatientMask & mask,
                 const DistanceImage & distance,
                 unsigned int longAxis)
{
  const OpenSpace space = FindOpenSpace(distance, closedGap, longAxis);
  std::vector<bool> isOutside(space.balls.parts.size(), false);
  Surroundings found;
  std::size_t largest = 0;
  for (std::uint32_t label = 1; label < isOutside.size(); ++label)
  {
    if (!space.reachesSides[label])
    {
      continue;
    }
    const double air = MedianOfAir(coarse, space.balls, label);
    isOutside[label] = air <= highestAir;
    if (isOutside[label] && space.balls.parts[label].count > largest)
    {
      largest = space.balls.parts[label].count;
      found.airValue = air;
    }
  }
  const auto reached = FillOpenSpace(space, isOutside, closedGap);
  if (!reached)
  {
    return {};
  }
  const auto & spacing = coarse.occupancy->GetSpacing();
  const double diagonal = spacing.GetNorm();
  const float * const distances = distance.GetBufferPointer();
  const std::uint8_t * const patient = mask.patient->GetBufferPointer();
  const std::uint8_t * const tissue = mask.tissue->GetBufferPointer();
  const std::uint8_t * const occupancy = coarse.occupancy->GetBufferPointer();
  found.outside =
    MakeMask(distance, [&](std::size_t n) { return patient[n] == 0 && reached->GetBufferPointer()[n] != 0; });
  found.objects = MakeMask(distance, [&](std::size_t n) {
    return found.outside->GetBufferPointer()[n] != 0 &&
           (tissue[n] != 0 || (occupancy[n] != 0 && static_cast<double>(distances[n]) > diagonal));
  });
  return found;
}

RemovedObject
Measure(const CoarseScan & coarse, const Components & components, std::uint32_t label)
{
  const auto & spacing = coarse.occupancy->GetSpacing();
  const double millilitres = spacing[0] * spacing[1] * spacing[2] / 1000.0 / 255.0;
  RemovedObject object;
  object.lowest.Fill(std::numeric_limits<double>::infinity());
  object.highest.Fill(-std::numeric_limits<double>::infinity());
  itk::Vector<double, 3> sum;
  sum.Fill(0.0);
  double weights = 0.0;
  const Component & part = components.parts[label];
  itk::Index<3> index;
  for (index[2] = part.lowest[2]; index[2] <= part.highest[2]; ++index[2])
  {
    for (index[1] = part.lowest[1]; index[1] <= part.highest[1]; ++index[1])
    {
      for (index[0] = part.lowest[0]; index[0] <= part.highest[0]; ++index[0])
      {
        if (components.labels->GetPixel(index) != label)
        {
          continue;
        }
        const auto point = coarse.PointOf(index);
        const double weight = coarse.occupancy->GetPixel(index);
        sum += point.GetVectorFromOrigin() * weight;
        weights += weight;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          object.lowest[axis] = std::min(object.lowest[axis], point[axis]);
          object.highest[axis] = std::max(object.highest[axis], point[axis]);
        }
      }
    }
  }
  object.millilitres = weights * millilitres;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    object.centroid[axis] = sum[axis] / weights;
  }
  return object;
}

void
MeasureObjects(const CoarseScan & coarse, const MaskImage & objects, TableRemoval & removal)
{
  const Components components = FindComponents(objects, true);
  for (std::uint32_t label = 1; label < components.parts.size(); ++label)
  {
    const RemovedObject object = Measure(coarse, components, label);
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

/** For each block, how far beyond the patient's border it is in mm, as far as that decides what becomes air; negative
 * where samples stay. */
DistanceImage::Pointer
FindExcess(const CoarseScan & coarse, const Surroundings & surroundings, const DistanceImage & toPatient)
{
  const auto toObjects = DistanceTo(*surroundings.objects);
  const double diagonal = coarse.occupancy->GetSpacing().GetNorm();
  const double margin = 2.0 * diagonal;
  const auto excess = MakeLike<DistanceImage>(toPatient);
  for (std::size_t n = 0; n < coarse.NumberOfBlocks(); ++n)
  {
    const double patient = toPatient.GetBufferPointer()[n];
    const double object = toObjects->GetBufferPointer()[n];
    const bool isOutside = surroundings.outside->GetBufferPointer()[n] != 0 || object <= diagonal;
    const double beyond = std::max(patient - margin, patient - object);
    excess->GetBufferPointer()[n] = static_cast<float>(isOutside ? std::clamp(beyond, -diagonal, diagonal) : -diagonal);
  }
  return excess;
}

/** The block before a sample, and how far from there to the next one the sample is. */
struct Place
{
  std::size_t block;
  std::size_t next;
  float fraction;
};

Place
PlaceOf(std::size_t sample, std::size_t samplesPerBlock, std::size_t blocks)
{
  const double position = (static_cast<double>(sample) + 0.5) / static_cast<double>(samplesPerBlock) - 0.5;
  const double clamped = std::clamp(position, 0.0, static_cast<double>(blocks - 1));
  const auto block = static_cast<std::size_t>(clamped);
  return { block, std::min(block + 1, blocks - 1), static_cast<float>(clamped - std::floor(clamped)) };
}

/** Lowers what is beyond the border to air. The limit falls from high values to air within the ramp, so that surfaces
 * at any threshold close there, smoothly. */
template <typename TPixel>
void
CutSlice(itk::Image<TPixel, 3> & image,
         const CoarseScan & coarse,
         const DistanceImage & excess,
         double airValue,
         std::size_t slice)
{
  const auto size = image.GetBufferedRegion().GetSize();
  const auto blocks = excess.GetBufferedRegion().GetSize();
  const float ramp = static_cast<float>(std::max(image.GetSpacing()[0], image.GetSpacing()[1]));
  constexpr float height = 2000.0f; // HU, over the ramp
  const auto air = static_cast<float>(airValue);
  const Place k = PlaceOf(slice, coarse.samplesPerBlock[2], blocks[2]);
  std::vector<float> row(blocks[0]);
  for (std::size_t y = 0; y < size[1]; ++y)
  {
    const Place j = PlaceOf(y, coarse.samplesPerBlock[1], blocks[1]);
    const auto rowAt = [&](std::size_t blockRow, std::size_t blockSlice) {
      return excess.GetBufferPointer() + blocks[0] * (blockRow + blocks[1] * blockSlice);
    };
    const float * const rows[4] = {
      rowAt(j.block, k.block), rowAt(j.next, k.block), rowAt(j.block, k.next), rowAt(j.next, k.next)
    };
    const float weights[4] = { (1.0f - j.fraction) * (1.0f - k.fraction),
                               j.fraction * (1.0f - k.fraction),
                               (1.0f - j.fraction) * k.fraction,
                               j.fraction * k.fraction };
    float farthest = -ramp;
    for (std::size_t i = 0; i < blocks[0]; ++i)
    {
      row[i] = weights[0] * rows[0][i] + weights[1] * rows[1][i] + weights[2] * rows[2][i] + weights[3] * rows[3][i];
      farthest = std::max(farthest, row[i]);
    }
    if (farthest <= -0.5f * ramp)
    {
      continue;
    }
    TPixel * const samples = image.GetBufferPointer() + size[0] * (y + size[1] * slice);
    for (std::size_t x = 0; x < size[0]; ++x)
    {
      const Place i = PlaceOf(x, coarse.samplesPerBlock[0], blocks[0]);
      const float beyond = row[i.block] + i.fraction * (row[i.next] - row[i.block]);
      if (beyond > -0.5f * ramp)
      {
        const float limit = air + std::max(0.0f, 0.5f - beyond / ramp) * height;
        if (static_cast<float>(samples[x]) > limit)
        {
          samples[x] = static_cast<TPixel>(limit);
        }
      }
    }
  }
}

void
Cut(Scan & scan, const CoarseScan & coarse, const DistanceImage & excess, double airValue)
{
  std::visit(
    [&](const auto & image) {
      itk::MultiThreaderBase::New()->ParallelizeArray(
        0,
        image->GetBufferedRegion().GetSize(2),
        [&](itk::SizeValueType slice) { CutSlice(*image, coarse, excess, airValue, slice); },
        nullptr);
    },
    scan.image);
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
  text << "removed " << std::lround(total) << " ml around the patient: " << removal.objects.size()
       << (removal.objects.size() == 1 ? " object" : " objects") << " (table, holder, sheets) and "
       << removal.numberOfSpecks << " specks; --keep-table keeps them";
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
  const unsigned int longAxis = LongAxisOf(GeometryOf(scan.image).GetDirection());
  const CoarseScan coarse = MakeCoarseScan(scan, tissueThreshold, hardThreshold);
  events.Progress(step, 0.2);
  PatientMask mask = FindPatient(coarse, longAxis);
  removal.notes = mask.notes;
  events.Progress(step, 0.6);
  if (!mask.patient)
  {
    removal.notes.push_back("nothing was removed around the patient: no body was found in air");
    events.Note(removal.notes.back());
    return removal;
  }
  const auto toPatient = DistanceTo(*mask.patient);
  const auto surroundings = FindSurroundings(coarse, mask, *toPatient, longAxis);
  if (surroundings)
  {
    removal.airValue = surroundings->airValue;
    MeasureObjects(coarse, *surroundings->objects, removal);
  }
  events.Progress(step, 0.8);
  if (!removal.objects.empty())
  {
    Cut(scan, coarse, *FindExcess(coarse, *surroundings, *toPatient), removal.airValue);
    NoteRemoval(removal, events);
  }
  events.Progress(step, 1.0);
  return removal;
}

Report
ReportTableRemoval(const TableRemoval & removal)
{
  Report report;
  report["objects"] = Report::array();
  const auto toArray = [](const itk::Point<double, 3> & point) { return Report{ point[0], point[1], point[2] }; };
  for (const RemovedObject & object : removal.objects)
  {
    report["objects"].push_back({ { "millilitres", object.millilitres },
                                  { "centroid", toArray(object.centroid) },
                                  { "lowest", toArray(object.lowest) },
                                  { "highest", toArray(object.highest) } });
  }
  report["specks"] = { { "count", removal.numberOfSpecks }, { "millilitres", removal.millilitresOfSpecks } };
  report["airValue"] = removal.airValue;
  report["notes"] = removal.notes;
  return report;
}

} // namespace rhombic
