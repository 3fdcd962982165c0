#include "rhombicPatientMask.h"

#include "rhombicTableContact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace rhombic
{
namespace
{

// Lengths are in mm. Tables and holders are hollow, with thin walls; limbs are thick.
constexpr double coreDepth = 4.5;              // blocks deeper than this are a core, which is more than 9 mm thick
constexpr double bodyDepth = 12.0;             // a core that is this deep somewhere belongs to the body
constexpr double longestThinPart = 150.0;      // longest separate part, such as a finger or a thin wrist
constexpr double smallestThinPart = 1.0;       // ml: smallest core of such a part
constexpr double lowestTissue = -150.0;        // HU: lowest mean of such a part, fat
constexpr double highestTissue = 300.0;        // HU: highest mean of such a part, bone within skin
constexpr double smallHangingVolume = 20.0;    // ml: touching parts up to this volume
constexpr double smallHangingReach = 30.0;     // that end this near to the cores always belong to the patient
constexpr double largestHangingVolume = 100.0; // ml: touching parts above this volume,
constexpr double longestHangingReach = 100.0;  // or that reach farther from the cores than this, never do
constexpr double smallestHardVolume = 5.0;     // ml: smallest wall of carbon fibre
constexpr double bareShare = 0.7;              // share of such a wall that is next to open space
constexpr double tableShare = 0.4;             // share of levels in which a column of the table holds doubtful tissue
constexpr double tableShareOccupied = 0.8;     // share of levels in which it holds solid blocks
constexpr std::uint8_t half = 128;             // half of a block's samples, out of 255
constexpr std::uint8_t quarter = 64;

/** The thick parts of the solid blocks. */
struct Cores
{
  DistanceImage::Pointer depth; ///< distance to the border of the solid blocks in mm, negative inside
  Components components;
  std::vector<double> greatestDepth; ///< by component
  std::vector<double> meanValue;     ///< in HU, by component
  MaskImage::Pointer body;           ///< the components that belong to the body
};

Cores
FindCores(const CoarseScan & coarse, const MaskImage & solid)
{
  const auto & spacing = coarse.occupancy->GetSpacing();
  const double halfBlock = 0.5 * std::min({ spacing[0], spacing[1], spacing[2] });
  Cores cores;
  cores.depth = DistanceTo(solid);
  const float * const depths = cores.depth->GetBufferPointer();
  const std::uint8_t * const isSolid = solid.GetBufferPointer();
  const auto deep = MakeMask(solid, [=](std::size_t offset) {
    return isSolid[offset] != 0 && halfBlock - static_cast<double>(depths[offset]) >= coreDepth;
  });
  cores.components = FindComponents(*deep, false);
  const auto & parts = cores.components.parts;
  const std::uint32_t * const labels = cores.components.labels->GetBufferPointer();
  cores.greatestDepth.assign(parts.size(), 0.0);
  cores.meanValue.assign(parts.size(), 0.0);
  for (std::size_t offset = 0; offset < coarse.NumberOfBlocks(); ++offset)
  {
    double & depth = cores.greatestDepth[labels[offset]];
    depth = std::max(depth, static_cast<double>(-depths[offset]));
    cores.meanValue[labels[offset]] += coarse.mean->GetBufferPointer()[offset];
  }
  for (std::size_t label = 1; label < parts.size(); ++label)
  {
    cores.meanValue[label] /= static_cast<double>(parts[label].count);
  }
  cores.body =
    MaskOfParts(cores.components, [&](std::size_t label) { return cores.greatestDepth[label] >= bodyDepth; });
  return cores;
}

/** Adds all blocks between the first and the last block of the body's cores on lines from front to back: lungs, whose
 * walls may be thin at the sides. */
MaskImage::Pointer
FillBetweenFrontAndBack(const CoarseScan & coarse, const MaskImage & solid, const MaskImage & body)
{
  const unsigned int axis = NearestAxis(solid.GetDirection(), 1, coarse.longAxis);
  const auto & size = solid.GetBufferedRegion().GetSize();
  const auto step = static_cast<std::size_t>(solid.GetOffsetTable()[axis]);
  const auto filled = MakeLike<MaskImage>(solid);
  std::copy_n(solid.GetBufferPointer(), coarse.NumberOfBlocks(), filled->GetBufferPointer());
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    if (index[axis] != 0)
    {
      return;
    }
    const std::uint8_t * const line = body.GetBufferPointer() + offset;
    std::size_t first = 0;
    std::size_t end = size[axis];
    while (first < end && line[first * step] == 0)
    {
      ++first;
    }
    while (end > first && line[(end - 1) * step] == 0)
    {
      --end;
    }
    for (std::size_t n = first; n < end; ++n)
    {
      filled->GetBufferPointer()[offset + n * step] = 1;
    }
  });
  return filled;
}

void
NoteKept(double millilitres, const std::string & why, std::vector<std::string> & notes)
{
  if (millilitres >= 0.5)
  {
    notes.push_back("kept " + std::to_string(std::lround(millilitres)) + " ml that " + why);
  }
}

/** Adds cores to the body that may be a hand or another thin limb. */
void
AddThinCores(const CoarseScan & coarse, Cores & cores, std::vector<std::string> & notes)
{
  double kept = 0.0;
  const auto thin = MaskOfParts(cores.components, [&](std::size_t label) {
    const Component & part = cores.components.parts[label];
    const auto levels = part.highest[coarse.longAxis] - part.lowest[coarse.longAxis] + 1;
    const double length = static_cast<double>(levels) * coarse.occupancy->GetSpacing()[coarse.longAxis];
    const double mean = cores.meanValue[label];
    const bool isThinPart = cores.greatestDepth[label] < bodyDepth &&
                            coarse.Millilitres(part.count) >= smallestThinPart && length <= longestThinPart &&
                            mean >= lowestTissue && mean <= highestTissue;
    kept += isThinPart ? coarse.Millilitres(part.count) : 0.0;
    return isThinPart;
  });
  const std::uint8_t * const isThin = thin->GetBufferPointer();
  std::uint8_t * const isBody = cores.body->GetBufferPointer();
  std::transform(isBody, isBody + coarse.NumberOfBlocks(), isThin, isBody, std::bit_or<>());
  NoteKept(kept, "lie beside the patient's thick parts, as they may be a hand", notes);
}

/** The solid blocks within coreDepth of the body's cores, and their neighbours, because depths are known to one block.
 * \param reach distance from the body's cores, in mm */
MaskImage::Pointer
Grow(const MaskImage & solid, const DistanceImage & reach)
{
  const std::uint8_t * const isSolid = solid.GetBufferPointer();
  const float * const distances = reach.GetBufferPointer();
  const auto near = MakeMask(solid, [=](std::size_t offset) {
    return isSolid[offset] != 0 && static_cast<double>(distances[offset]) <= coreDepth;
  });
  return MakeMask(solid, [&](std::size_t offset) { return isSolid[offset] != 0 && IsNear(*near, offset); });
}

/** Adds components of \a others to the patient if they share a face with it and isPatient(volume in ml, greatest
 * distance from the cores in mm) is true. Returns the mask of the other components. */
template <typename TFunction>
MaskImage::Pointer
AddHangingParts(const CoarseScan & coarse,
                const MaskImage & others,
                const DistanceImage & reach,
                const TFunction & isPatient,
                MaskImage & patient)
{
  const Components components = FindComponents(others, false);
  const std::uint32_t * const labels = components.labels->GetBufferPointer();
  std::uint8_t * const isInPatient = patient.GetBufferPointer();
  std::vector<double> greatestReach(components.parts.size(), 0.0);
  std::vector<bool> hangsOn(components.parts.size(), false);
  const auto & size = others.GetBufferedRegion().GetSize();
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    const std::uint32_t label = labels[offset];
    if (label != 0)
    {
      greatestReach[label] = std::max(greatestReach[label], static_cast<double>(reach.GetBufferPointer()[offset]));
      ForEachFaceNeighbour(size, index, offset, [&](std::size_t neighbour) {
        hangsOn[label] = hangsOn[label] || isInPatient[neighbour] != 0;
      });
    }
  });
  const auto added = MaskOfParts(components, [&](std::size_t label) {
    return hangsOn[label] && isPatient(coarse.Millilitres(components.parts[label].count), greatestReach[label]);
  });
  const std::uint8_t * const isAdded = added->GetBufferPointer();
  std::transform(isInPatient, isInPatient + coarse.NumberOfBlocks(), isAdded, isInPatient, std::bit_or<>());
  return MakeMask(others, [&](std::size_t offset) { return labels[offset] != 0 && isAdded[offset] == 0; });
}

/** Finds large, bare walls harder than skin in doubtful tissue, and the hard blocks that touch them. A wall is bare if
 * most of its blocks are next to open space; bone is covered by skin. */
MaskImage::Pointer
FindHardWalls(const CoarseScan & coarse, const MaskImage & doubtful, const DistanceImage & depth)
{
  const std::uint8_t * const isDoubtful = doubtful.GetBufferPointer();
  const std::uint8_t * const hardness = coarse.hardness->GetBufferPointer();
  const auto hard =
    MakeMask(doubtful, [=](std::size_t offset) { return isDoubtful[offset] != 0 && hardness[offset] >= quarter; });
  const Components walls = FindComponents(*hard, true);
  const auto large = MaskOfParts(
    walls, [&](std::size_t label) { return coarse.Millilitres(walls.parts[label].count) >= smallestHardVolume; });
  if (!HasBorder(*large))
  {
    return large; // an empty mask
  }
  const OpenSpace space = FindOpenSpace(depth, coarse.longAxis);
  const auto open = FillOpenSpace(space, space.reachesSides);
  if (!open)
  {
    return MakeLike<MaskImage>(doubtful);
  }
  const std::uint32_t * const labels = walls.labels->GetBufferPointer();
  std::vector<std::size_t> bare(walls.parts.size(), 0);
  for (std::size_t offset = 0; offset < coarse.NumberOfBlocks(); ++offset)
  {
    bare[labels[offset]] += large->GetBufferPointer()[offset] != 0 && IsNear(*open, offset) ? 1 : 0;
  }
  const auto bareWalls = MaskOfParts(walls, [&](std::size_t label) {
    return static_cast<double>(bare[label]) >= bareShare * static_cast<double>(walls.parts[label].count);
  });
  return MakeMask(doubtful, [&](std::size_t offset) {
    return isDoubtful[offset] != 0 && hardness[offset] > 0 && IsNear(*bareWalls, offset);
  });
}

/** \class Columns
 * \brief Divides world space into columns along the patient, as wide as the scan's widest block across the patient. */
class Columns
{
public:
  explicit Columns(const CoarseScan & coarse)
    : m_Coarse(coarse)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 2> highest{ -infinity, -infinity };
    m_Lowest = { infinity, infinity };
    const auto & size = coarse.occupancy->GetBufferedRegion().GetSize();
    itk::Index<3> corner;
    for (corner[2] = 0; corner[2] < static_cast<itk::IndexValueType>(size[2]); ++corner[2]) // slices may be shifted
    {
      for (unsigned int n = 0; n < 4; ++n)
      {
        corner[0] = (n & 1) != 0 ? static_cast<itk::IndexValueType>(size[0]) - 1 : 0;
        corner[1] = (n & 2) != 0 ? static_cast<itk::IndexValueType>(size[1]) - 1 : 0;
        const auto point = coarse.PointOf(corner);
        for (unsigned int axis = 0; axis < 2; ++axis)
        {
          m_Lowest[axis] = std::min(m_Lowest[axis], point[axis]);
          highest[axis] = std::max(highest[axis], point[axis]);
        }
      }
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Width = axis != coarse.longAxis ? std::max(m_Width, coarse.occupancy->GetSpacing()[axis]) : m_Width;
    }
    m_CountAlongX = this->StepsTo(highest[0], 0) + 1;
    m_Count = m_CountAlongX * (this->StepsTo(highest[1], 1) + 1);
  }

  std::size_t
  Count() const
  {
    return m_Count;
  }

  /** The column that a block is in. */
  std::size_t
  ColumnOf(const itk::Index<3> & index) const
  {
    const auto point = m_Coarse.PointOf(index);
    return this->StepsTo(point[0], 0) + m_CountAlongX * this->StepsTo(point[1], 1);
  }

private:
  std::size_t
  StepsTo(double coordinate, unsigned int axis) const
  {
    return static_cast<std::size_t>((coordinate - m_Lowest[axis]) / m_Width + 0.5);
  }

  const CoarseScan & m_Coarse;
  double m_Width = 0.0;
  std::array<double, 2> m_Lowest{};
  std::size_t m_CountAlongX = 0;
  std::size_t m_Count = 0;
};

/** Finds the columns of the table: they hold doubtful tissue in at least tableShare of the levels, and solid blocks in
 * at least tableShareOccupied, as no thin part of a patient does. Moves their blocks, except for the body's cores, from
 * the patient to the table. */
void
TakeTablePlaces(const CoarseScan & coarse,
                const MaskImage & solid,
                const MaskImage & doubtful,
                const MaskImage & body,
                MaskImage & table,
                MaskImage & patient)
{
  constexpr std::uint8_t nothing = 0;
  constexpr std::uint8_t something = 1;
  constexpr std::uint8_t doubtfulTissue = 3;
  const auto & size = solid.GetBufferedRegion().GetSize();
  const std::uint8_t * const isSolid = solid.GetBufferPointer();
  const std::size_t levels = size[coarse.longAxis];
  const Columns columns(coarse);
  std::vector<std::uint8_t> contents(columns.Count() * levels, nothing); // by column and level
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    if (isSolid[offset] != 0)
    {
      const std::size_t place = columns.ColumnOf(index) * levels + static_cast<std::size_t>(index[coarse.longAxis]);
      contents[place] |= doubtful.GetBufferPointer()[offset] != 0 ? doubtfulTissue : something;
    }
  });
  std::vector<bool> isTable;
  for (auto level = contents.begin(); level != contents.end(); level += static_cast<std::ptrdiff_t>(levels))
  {
    const auto end = level + static_cast<std::ptrdiff_t>(levels);
    const auto doubtfulLevels = static_cast<double>(std::count(level, end, doubtfulTissue));
    const auto emptyLevels = static_cast<double>(std::count(level, end, nothing));
    const auto allLevels = static_cast<double>(levels);
    isTable.push_back(doubtfulLevels >= tableShare * allLevels &&
                      allLevels - emptyLevels >= tableShareOccupied * allLevels);
  }
  ForEachIndex(size, [&](const itk::Index<3> & index, std::size_t offset) {
    if (isSolid[offset] != 0 && body.GetBufferPointer()[offset] == 0 && isTable[columns.ColumnOf(index)])
    {
      table.GetBufferPointer()[offset] = 1;
      patient.GetBufferPointer()[offset] = 0;
    }
  });
}

/** Adds thin parts that touch the patient: small ones first, then larger ones without hard walls and columns of the
 * table. */
void
AddThinParts(const CoarseScan & coarse,
             const MaskImage & solid,
             const Cores & cores,
             const DistanceImage & reach,
             PatientMask & found)
{
  const std::uint8_t * const isSolid = solid.GetBufferPointer();
  const std::uint8_t * const isPatient = found.patient->GetBufferPointer();
  const auto others =
    MakeMask(solid, [=](std::size_t offset) { return isSolid[offset] != 0 && isPatient[offset] == 0; });
  const auto isSmall = [](double millilitres, double distance) {
    return millilitres <= smallHangingVolume && distance <= smallHangingReach;
  };
  const auto doubtful = AddHangingParts(coarse, *others, reach, isSmall, *found.patient);
  if (!HasBorder(*doubtful))
  {
    return;
  }
  const auto table = FindHardWalls(coarse, *doubtful, *cores.depth);
  TakeTablePlaces(coarse, solid, *doubtful, *cores.body, *table, *found.patient);
  const auto rest = MakeMask(solid, [&](std::size_t offset) {
    return isSolid[offset] != 0 && isPatient[offset] == 0 && table->GetBufferPointer()[offset] == 0;
  });
  double kept = 0.0;
  const auto mayBePatient = [&kept](double millilitres, double distance) {
    const bool isKept = millilitres <= largestHangingVolume && distance <= longestHangingReach;
    kept += isKept ? millilitres : 0.0;
    return isKept;
  };
  AddHangingParts(coarse, *rest, reach, mayBePatient, *found.patient);
  NoteKept(kept, "touch the patient, as they may be thin parts of it", found.notes);
}

} // namespace

PatientMask
FindPatient(const CoarseScan & coarse)
{
  const std::uint8_t * const occupancy = coarse.occupancy->GetBufferPointer();
  PatientMask found;
  found.tissue = MakeMask(*coarse.occupancy, [=](std::size_t offset) { return occupancy[offset] >= half; });
  if (!HasBorder(*found.tissue))
  {
    return found;
  }
  Cores cores = FindCores(coarse, *found.tissue);
  if (!HasBorder(*cores.body))
  {
    return found;
  }
  const auto solid = FillBetweenFrontAndBack(coarse, *found.tissue, *cores.body);
  if (!HasBorder(*solid))
  {
    return found;
  }
  cores = FindCores(coarse, *solid);
  AddThinCores(coarse, cores, found.notes);
  cores.components = {};
  const auto reach = DistanceTo(*cores.body);
  found.patient = Grow(*solid, *reach);
  AddThinParts(coarse, *solid, cores, *reach, found);
  CutTableContacts(*solid, coarse.longAxis, 2.0 * coreDepth, *found.patient);
  return found;
}

} // namespace rhombic
