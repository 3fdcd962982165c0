#include "rhombicPatientMask.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace rhombic
{
namespace
{

// Lengths are in mm. Tables and holders are hollow, with thin walls; limbs are thick.
constexpr double coreDepth = 4.5;      // blocks deeper than this are a core, which is more than 9 mm thick
constexpr double bodyDepth = 12.0;     // a core that is this deep somewhere belongs to the body
constexpr double longestHand = 200.0;  // a separate part of soft tissue up to this length may be a hand
constexpr double lowestSoft = -150.0;  // HU: lowest mean of soft tissue, fat
constexpr double highestSoft = 300.0;  // HU: highest mean of soft tissue with bone in it
constexpr double shortReach = 40.0;    // thin parts that end this near to the body are the patient's: ears
constexpr double longReach = 60.0;     // the same for thin parts without what may be a table: noses
constexpr double smallestEar = 3000.0; // mm^3: smaller thin parts are not told from the skin (PatientMask::hanging)
constexpr double tableShare = 0.5;     // share of the levels along the patient in which a table is at the same place

void
Add(const MaskImage & mask, MaskImage & sum)
{
  const std::uint8_t * const begin = mask.GetBufferPointer();
  const std::uint8_t * const end = begin + mask.GetBufferedRegion().GetNumberOfPixels();
  std::transform(begin, end, sum.GetBufferPointer(), sum.GetBufferPointer(), std::bit_or<>());
}

/** Separate parts of the tissue with a core that may be a hand or another thin limb: short ones of soft tissue. */
MaskImage::Pointer
FindHands(const CoarseScan & coarse, const MaskImage & tissue, const MaskImage & cores)
{
  const Components components = FindMaskComponents(tissue, false);
  std::vector<double> sums(components.parts.size(), 0.0);
  std::vector<bool> hasCore(components.parts.size(), false);
  for (std::size_t offset = 0; offset < tissue.GetBufferedRegion().GetNumberOfPixels(); ++offset)
  {
    const std::uint32_t label = components.labels->GetBufferPointer()[offset];
    sums[label] += coarse.mean->GetBufferPointer()[offset];
    hasCore[label] = hasCore[label] || cores.GetBufferPointer()[offset] != 0;
  }
  return MaskOfParts(components, [&](std::size_t label) {
    const Component & part = components.parts[label];
    double length = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto blocks = static_cast<double>(part.highest[axis] - part.lowest[axis] + 1);
      length = std::max(length, blocks * tissue.GetSpacing()[axis]);
    }
    const double mean = sums[label] / static_cast<double>(part.count);
    return hasCore[label] && length <= longestHand && mean >= lowestSoft && mean <= highestSoft;
  });
}

/** Adds all blocks between the first and the last block of a mask on lines from front to back: lungs. */
void
FillBetweenFrontAndBack(unsigned int longAxis, MaskImage & mask)
{
  const unsigned int axis = NearestAxis(mask.GetDirection(), 1, longAxis);
  const auto & size = mask.GetBufferedRegion().GetSize();
  const auto step = static_cast<std::size_t>(mask.GetOffsetTable()[axis]);
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    if (index[axis] != 0)
    {
      return;
    }
    std::uint8_t * const line = mask.GetBufferPointer() + offset;
    std::size_t first = 0;
    std::size_t end = size[axis];
    for (; first < end && line[first * step] == 0; ++first)
    {}
    for (; end > first && line[(end - 1) * step] == 0; --end)
    {}
    for (std::size_t n = first; n < end; ++n)
    {
      line[n * step] = 1;
    }
  });
}

/** The cores of the tissue that belong to the body, the lungs between them, and hands. Null when nothing is thick. */
MaskImage::Pointer
FindBody(const CoarseScan & coarse, const MaskImage & tissue)
{
  const auto & spacing = tissue.GetSpacing();
  const double halfBlock = 0.5 * std::min({ spacing[0], spacing[1], spacing[2] });
  const auto depth = DistanceTo(*Complement(tissue), bodyDepth + 2.0 * halfBlock);
  const auto deeperThan = [&](double limit) {
    return MakeMask(tissue, [=, depths = depth->GetBufferPointer()](std::size_t offset) {
      return static_cast<double>(depths[offset]) >= limit + halfBlock;
    });
  };
  const auto cores = deeperThan(coreDepth);
  const auto deepest = deeperThan(bodyDepth);
  const auto body = MaskOfPartsWith(FindMaskComponents(*cores, false), [&](const itk::Index<3> &, std::size_t offset) {
    return deepest->GetBufferPointer()[offset] != 0;
  });
  if (!HasBorder(*body))
  {
    return nullptr;
  }
  FillBetweenFrontAndBack(coarse.longAxis, *body);
  Add(*FindHands(coarse, tissue, *cores), *body);
  return body;
}

/** The parts of the thin tissue that share a face with the patient and end within \a farthest mm of the body. */
MaskImage::Pointer
FindHangingParts(const MaskImage & thin, const MaskImage & patient, const DistanceImage & toBody, double farthest)
{
  const Components components = FindMaskComponents(thin, false);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  std::vector<double> reach(components.parts.size(), 0.0);
  std::vector<bool> touches(components.parts.size(), false);
  const auto & size = thin.GetBufferedRegion().GetSize();
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    if (const std::uint32_t label = labels[offset])
    {
      reach[label] = std::max(reach[label], static_cast<double>(toBody.GetBufferPointer()[offset]));
      ForEachFaceNeighbour(size, index, offset, [&](std::size_t neighbour) {
        touches[label] = touches[label] || patient.GetBufferPointer()[neighbour] != 0;
      });
    }
  });
  return MaskOfParts(components, [&](std::size_t label) { return touches[label] && reach[label] <= farthest; });
}

/** The thin tissue without what is at the same place across the patient at tableShare of the levels along it, as a
 * table and its holders are. */
MaskImage::Pointer
RemoveColumns(const CoarseScan & coarse, const MaskImage & thin)
{
  double width = 0.0; // of a column
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    width = axis != coarse.longAxis ? std::max(width, thin.GetSpacing()[axis]) : width;
  }
  const auto columnOf = [&](const itk::Index<3> & index) {
    const auto point = coarse.PointOf(index);
    return std::pair(std::lround(point[0] / width), std::lround(point[1] / width));
  };
  const auto & size = thin.GetBufferedRegion().GetSize();
  std::map<std::pair<long, long>, std::vector<bool>> levels;
  const auto forEachThin = [&](const auto & function) {
    ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
      if (thin.GetBufferPointer()[offset] != 0)
      {
        function(index, offset);
      }
    });
  };
  forEachThin([&](const itk::Index<3> & index, std::size_t) {
    auto & found = levels[columnOf(index)];
    found.resize(size[coarse.longAxis], false);
    found[static_cast<std::size_t>(index[coarse.longAxis])] = true;
  });
  const auto rest = MakeLike<MaskImage>(thin);
  forEachThin([&](const itk::Index<3> & index, std::size_t offset) {
    const auto & found = levels[columnOf(index)];
    const auto count = static_cast<double>(std::count(found.begin(), found.end(), true));
    rest->GetBufferPointer()[offset] = count < tableShare * static_cast<double>(found.size()) ? 1 : 0;
  });
  return rest;
}

} // namespace

itk::Point<double, 3>
CoarseScan::PointOf(const itk::Index<3> & index) const
{
  const auto point = occupancy->TransformIndexToPhysicalPoint<double>(index);
  return sliceOffsets.empty() ? point : point + sliceOffsets[static_cast<std::size_t>(index[2])];
}

PatientMask
FindPatient(const CoarseScan & coarse, const MaskImage & tissue)
{
  const MaskImage::Pointer body = FindBody(coarse, tissue);
  if (!body)
  {
    return {};
  }
  const auto toBody = DistanceTo(*body, longReach + 1.0);
  const auto & spacing = tissue.GetSpacing();
  const double skin = coreDepth + std::max({ spacing[0], spacing[1], spacing[2] });
  const std::uint8_t * const isTissue = tissue.GetBufferPointer();
  const auto patient = MakeMask(tissue, [=, distances = toBody->GetBufferPointer()](std::size_t offset) {
    const auto distance = static_cast<double>(distances[offset]);
    return distance == 0.0 || (isTissue[offset] != 0 && distance <= skin);
  });
  const auto thin = MakeMask(tissue, [=, isPatient = patient->GetBufferPointer()](std::size_t offset) {
    return isTissue[offset] != 0 && isPatient[offset] == 0;
  });
  const auto hanging = FindHangingParts(*thin, *patient, *toBody, shortReach);
  Add(*FindHangingParts(*RemoveColumns(coarse, *thin), *patient, *toBody, longReach), *hanging);
  Add(*hanging, *patient);
  const Components parts = FindMaskComponents(*hanging, true);
  const double blockVolume = spacing[0] * spacing[1] * spacing[2];
  return { patient, MaskOfParts(parts, [&](std::size_t label) {
             return static_cast<double>(parts.parts[label].count) * blockVolume >= smallestEar;
           }) };
}

} // namespace rhombic
