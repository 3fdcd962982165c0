#include "rhombicTableRemoval.h"

#include "rhombicCoarseScan.h"
#include "rhombicImageAxes.h"
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

/** The three blocks next to a sample along one axis, and their weights: a quadratic B-spline, which smooths the steps
 * of distances to masks. */
struct Taps
{
  std::array<std::size_t, 3> blocks;
  std::array<float, 3> weights;
};

/** For each of the samples along one axis. */
std::vector<Taps>
MakeTaps(std::size_t samples, std::size_t samplesPerBlock, std::size_t blocks)
{
  std::vector<Taps> taps(samples);
  for (std::size_t sample = 0; sample < samples; ++sample)
  {
    const std::size_t block = sample / samplesPerBlock;
    const double place =
      (static_cast<double>(sample) + 0.5) / static_cast<double>(samplesPerBlock) - static_cast<double>(block) - 0.5;
    taps[sample].blocks = { block == 0 ? 0 : block - 1, block, std::min(block + 1, blocks - 1) };
    taps[sample].weights = { static_cast<float>(0.5 * (0.5 - place) * (0.5 - place)),
                             static_cast<float>(0.75 - place * place),
                             static_cast<float>(0.5 * (0.5 + place) * (0.5 + place)) };
  }
  return taps;
}

/** \class Cutter
 * \brief Lowers what is beyond the patient's border to air. The limit falls from high values to air within a ramp, so
 * that surfaces at any threshold close there, smoothly. */
class Cutter
{
public:
  Cutter(const CoarseScan & coarse, const DistanceImage & excess, const itk::ImageBase<3> & grid, double airValue)
    : m_Excess(excess)
    , m_Blocks(excess.GetBufferedRegion().GetSize())
    , m_Ramp(static_cast<float>(std::max(grid.GetSpacing()[0], grid.GetSpacing()[1])))
    , m_Air(static_cast<float>(airValue))
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Taps[axis] =
        MakeTaps(grid.GetLargestPossibleRegion().GetSize(axis), coarse.samplesPerBlock[axis], m_Blocks[axis]);
    }
  }

  template <typename TPixel>
  void
  CutSlice(itk::Image<TPixel, 3> & image, std::size_t slice) const
  {
    std::vector<float> excess(m_Blocks[0]);
    for (std::size_t row = 0; row < m_Taps[1].size(); ++row)
    {
      if (FindExcessOfRow(row, slice, excess) > -0.5f * m_Ramp)
      {
        CutRow(excess, image.GetBufferPointer() + m_Taps[0].size() * (row + m_Taps[1].size() * slice));
      }
    }
  }

private:
  /** Of the blocks along a row of samples; returns the greatest. */
  float
  FindExcessOfRow(std::size_t row, std::size_t slice, std::vector<float> & excess) const
  {
    std::fill(excess.begin(), excess.end(), 0.0f);
    const Taps & rows = m_Taps[1][row];
    const Taps & slices = m_Taps[2][slice];
    for (unsigned int k = 0; k < 3; ++k)
    {
      for (unsigned int j = 0; j < 3; ++j)
      {
        const float weight = slices.weights[k] * rows.weights[j];
        const float * const blocks =
          m_Excess.GetBufferPointer() + m_Blocks[0] * (rows.blocks[j] + m_Blocks[1] * slices.blocks[k]);
        for (std::size_t i = 0; i < excess.size(); ++i)
        {
          excess[i] += weight * blocks[i];
        }
      }
    }
    return *std::max_element(excess.begin(), excess.end());
  }

  template <typename TPixel>
  void
  CutRow(const std::vector<float> & excess, TPixel * samples) const
  {
    constexpr float height = 2000.0f; // HU, over the ramp
    for (std::size_t x = 0; x < m_Taps[0].size(); ++x)
    {
      const Taps & taps = m_Taps[0][x];
      const float beyond = taps.weights[0] * excess[taps.blocks[0]] + taps.weights[1] * excess[taps.blocks[1]] +
                           taps.weights[2] * excess[taps.blocks[2]];
      if (beyond > -0.5f * m_Ramp)
      {
        const float limit = m_Air + std::max(0.0f, 0.5f - beyond / m_Ramp) * height;
        samples[x] = static_cast<float>(samples[x]) > limit ? static_cast<TPixel>(limit) : samples[x];
      }
    }
  }

  const DistanceImage & m_Excess;
  itk::Size<3> m_Blocks;
  float m_Ramp; ///< in mm
  float m_Air;
  std::array<std::vector<Taps>, 3> m_Taps;
};

void
Cut(Scan & scan, const CoarseScan & coarse, const DistanceImage & excess, double airValue)
{
  std::visit(
    [&](const auto & image) {
      const Cutter cutter(coarse, excess, *image, airValue);
      itk::ForEachInBlocks(
        image->GetBufferedRegion().GetSize(2), 1, [&](std::size_t slice) { cutter.CutSlice(*image, slice); });
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
  const unsigned int longAxis = NearestAxis(GeometryOf(scan.image).GetDirection(), 2);
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

} // namespace rhombic
