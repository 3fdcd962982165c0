#include "rhombicPatientMask.h"

#include "rhombicImageAxes.h"
#include "rhombicTableContact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rhombic
{
namespace
{

// Lengths are in mm. Tables and holders are hollow, with thin walls; limbs are thick.
constexpr double coreDepth = 4.5;              // what is deeper than this is a core: of more than 9 mm thickness
constexpr double bodyDepth = 12.0;             // a core that is somewhere as deep as this is the patient's
constexpr double longestThinPart = 150.0;      // of the patient, such as a finger or a thin wrist
constexpr double lowestTissue = -150.0;        // mean HU of a thin part: fat
constexpr double highestTissue = 300.0;        // to bone within skin
constexpr double smallHangingVolume = 20.0;    // ml of a thin part that hangs on to the patient,
constexpr double smallHangingReach = 30.0;     // and how far from the thick parts it ends: always the patient's
constexpr double largestHangingVolume = 100.0; // what is larger
constexpr double longestHangingReach = 100.0;  // or reaches further is no part of the patient
constexpr double smallestHardVolume = 5.0;     // ml of a wall of carbon fibre,
constexpr double bareShare = 0.7;              // and how much of it is next to open space
constexpr double tableShare = 0.4;             // of a table's place, this part of all slices shows it detached or thin,
constexpr double tableShareOccupied = 0.8;     // and this part something


constexpr std::uint32_t none = 0;

/** What a decision about a component takes, beside its size and place. */
struct PartMeasures
{
  double greatestDepth = 0.0;
  double greatestReach = 0.0; ///< from the thick parts
  double sum = 0.0;           ///< of the blocks' means
  bool hangsOn = false;       ///< to the patient
};

class PatientFinder
{
public:
  PatientFinder(const CoarseScan & coarse, unsigned int longAxis)
    : m_Coarse(coarse)
    , m_LongAxis(longAxis)
    , m_Size(coarse.occupancy->GetBufferedRegion().GetSize())
    , m_Count(coarse.NumberOfBlocks())
  {
    const auto & spacing = coarse.occupancy->GetSpacing();
    m_Millilitres = spacing[0] * spacing[1] * spacing[2] / 1000.0;
    m_Narrow = std::min({ spacing[0], spacing[1], spacing[2] });
  }

  PatientMask
  Find()
  {
    constexpr std::uint8_t half = 128;
    const std::uint8_t * const occupancy = m_Coarse.occupancy->GetBufferPointer();
    m_Found.tissue = MakeMask(*m_Coarse.occupancy, [=](std::size_t n) { return occupancy[n] >= half; });
    m_Solid = m_Found.tissue;
    if (!HasBorder(*m_Solid) || !FindCores())
    {
      return m_Found;
    }
    FillBetweenFrontAndBack();
    if (!HasBorder(*m_Solid))
    {
      return m_Found;
    }
    FindCores();
    AddThinCores();
    Grow();
    AddWhatHangsOn();
    CutTableContacts(*m_Solid, m_LongAxis, 2.0 * coreDepth, *m_Found.patient);
    return m_Found;
  }

private:
  /** The cores of what is solid, and those of them that are as thick as a body. Returns whether there is one. */
  bool
  FindCores()
  {
    m_Depth = DistanceTo(*m_Solid);
    const float * const depths = m_Depth->GetBufferPointer();
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    const auto core = MakeMask(*m_Depth, [=](std::size_t n) {
      return solid[n] != 0 && 0.5 * m_Narrow - static_cast<double>(depths[n]) >= coreDepth;
    });
    m_Cores = FindComponents(*core, false);
    const std::uint32_t * const labels = m_Cores.labels->GetBufferPointer();
    m_Measures.assign(m_Cores.parts.size(), {});
    for (std::size_t n = 0; n < m_Count; ++n)
    {
      PartMeasures & part = m_Measures[labels[n]];
      part.greatestDepth = std::max(part.greatestDepth, static_cast<double>(-depths[n]));
      part.sum += m_Coarse.mean->GetBufferPointer()[n];
    }
    std::vector<bool> isBody(m_Cores.parts.size(), false);
    for (std::uint32_t label = 1; label < isBody.size(); ++label)
    {
      isBody[label] = m_Measures[label].greatestDepth >= bodyDepth;
    }
    m_Core = MakeMask(*core, [&](std::size_t n) { return isBody[labels[n]]; });
    return HasBorder(*m_Core);
  }

  /** Those cores too that may be a thin limb. */
  void
  AddThinCores()
  {
    double millilitres = 0.0;
    std::vector<bool> isThinPart(m_Cores.parts.size(), false);
    for (std::uint32_t label = 1; label < isThinPart.size(); ++label)
    {
      isThinPart[label] =
        m_Measures[label].greatestDepth < bodyDepth && IsThinPart(m_Cores.parts[label], m_Measures[label]);
      millilitres += isThinPart[label] ? Millilitres(m_Cores.parts[label].count) : 0.0;
    }
    std::uint8_t * const core = m_Core->GetBufferPointer();
    for (std::size_t n = 0; n < m_Count; ++n)
    {
      core[n] = core[n] != 0 || isThinPart[m_Cores.labels->GetBufferPointer()[n]] ? 1 : 0;
    }
    m_Cores = {};
    NoteKept(millilitres, "lie beside the patient's thick parts, as they may be a hand");
  }

  bool
  IsThinPart(const Component & part, const PartMeasures & measures) const
  {
    constexpr double smallestVolume = 1.0; // ml of the core
    const double mean = measures.sum / static_cast<double>(part.count);
    return Millilitres(part.count) >= smallestVolume && Length(part) <= longestThinPart && mean >= lowestTissue &&
           mean <= highestTissue;
  }

  /** What has the patient's cores before it and behind it is in the patient: lungs, whose walls may be thin at the
   * sides. */
  void
  FillBetweenFrontAndBack()
  {
    const auto & direction = m_Coarse.occupancy->GetDirection();
    const unsigned int axis = NearestAxis(direction, 1, m_LongAxis);
    const std::uint8_t * const core = m_Core->GetBufferPointer();
    const auto filled = MakeLike<MaskImage>(*m_Solid);
    std::copy_n(m_Solid->GetBufferPointer(), m_Count, filled->GetBufferPointer());
    std::size_t step = 1;
    for (unsigned int lower = 0; lower < axis; ++lower)
    {
      step *= m_Size[lower];
    }
    ForEachIndex(m_Size, [&](const itk::Index<3> & index, std::size_t n) {
      if (index[axis] == 0)
      {
        std::size_t first = 0;
        std::size_t end = m_Size[axis];
        while (first < end && core[n + first * step] == 0)
        {
          ++first;
        }
        while (end > first && core[n + (end - 1) * step] == 0)
        {
          --end;
        }
        for (std::size_t place = first; place < end; ++place)
        {
          filled->GetBufferPointer()[n + place * step] = 1;
        }
      }
    });
    m_Solid = filled;
  }

  /** The tissue within the cores' depth of them, and one block more, because depths are known to a block. */
  void
  Grow()
  {
    m_Reach = DistanceTo(*m_Core);
    const float * const reach = m_Reach->GetBufferPointer();
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    const auto opened =
      MakeMask(*m_Reach, [&](std::size_t n) { return solid[n] != 0 && static_cast<double>(reach[n]) <= coreDepth; });
    m_Found.patient = MakeLike<MaskImage>(*opened);
    std::uint8_t * const patient = m_Found.patient->GetBufferPointer();
    ForEachIndex(m_Size, [&](const itk::Index<3> & index, std::size_t n) {
      patient[n] = solid[n] != 0 && HasNeighbour(*opened, index) ? 1 : 0;
    });
  }

  /** Whether one of a voxel's 27 neighbours, itself included, is in the mask. */
  bool
  HasNeighbour(const MaskImage & mask, const itk::Index<3> & index) const
  {
    itk::Index<3> begin;
    itk::Index<3> end;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      begin[axis] = std::max<itk::IndexValueType>(index[axis] - 1, 0);
      end[axis] = std::min<itk::IndexValueType>(index[axis] + 2, static_cast<itk::IndexValueType>(m_Size[axis]));
    }
    for (itk::IndexValueType k = begin[2]; k < end[2]; ++k)
    {
      for (itk::IndexValueType j = begin[1]; j < end[1]; ++j)
      {
        const std::uint8_t * const row = mask.GetBufferPointer() + mask.ComputeOffset({ { 0, j, k } });
        if (std::find(row + begin[0], row + end[0], 1) != row + end[0])
        {
          return true;
        }
      }
    }
    return false;
  }

  /** Sorts the thin tissue: first its components, then what is left of those in doubt without the table's places. */
  void
  AddWhatHangsOn()
  {
    MaskImage::Pointer doubtful = AddComponents(
      [](double millilitres, double reach) { return millilitres <= smallHangingVolume && reach <= smallHangingReach; });
    if (HasBorder(*doubtful))
    {
      m_Table = MakeLike<MaskImage>(*doubtful);
      FindHardWalls(*doubtful);
      FindTablePlaces(*doubtful);
      double kept = 0.0;
      AddComponents([&kept](double millilitres, double reach) {
        const bool isKept = millilitres <= largestHangingVolume && reach <= longestHangingReach;
        kept += isKept ? millilitres : 0.0;
        return isKept;
      });
      NoteKept(kept, "touch the patient, as they may be thin parts of it");
    }
  }

  void
  NoteKept(double millilitres, const std::string & why)
  {
    if (millilitres >= 0.5)
    {
      m_Found.notes.push_back("kept " + std::to_string(std::lround(millilitres)) + " ml that " + why);
    }
  }

  /** Makes those components of the other tissue the patient's that hang on to it and are as the function says, given
   * volume in ml and reach in mm. Returns the others, whether they hang on or not. */
  template <typename TFunction>
  MaskImage::Pointer
  AddComponents(const TFunction & isPatient)
  {
    std::uint8_t * const patient = m_Found.patient->GetBufferPointer();
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    const auto others =
      MakeMask(*m_Solid, [&](std::size_t n) { return solid[n] != 0 && patient[n] == 0 && !IsTable(n); });
    const Components components = FindComponents(*others, false);
    const std::uint32_t * const labels = components.labels->GetBufferPointer();
    std::vector<PartMeasures> measures(components.parts.size());
    ForEachIndex(m_Size, [&](const itk::Index<3> & index, std::size_t n) {
      if (labels[n] != none)
      {
        PartMeasures & part = measures[labels[n]];
        part.greatestReach = std::max(part.greatestReach, static_cast<double>(m_Reach->GetBufferPointer()[n]));
        part.hangsOn = part.hangsOn || TouchesPatient(index, n);
      }
    });
    std::vector<bool> isKept(components.parts.size(), false);
    for (std::uint32_t label = 1; label < components.parts.size(); ++label)
    {
      const PartMeasures & part = measures[label];
      isKept[label] = part.hangsOn && isPatient(Millilitres(components.parts[label].count), part.greatestReach);
    }
    for (std::size_t n = 0; n < m_Count; ++n)
    {
      patient[n] = patient[n] != 0 || isKept[labels[n]] ? 1 : 0;
    }
    return MakeMask(*others, [&](std::size_t n) { return labels[n] != none && !isKept[labels[n]]; });
  }

  bool
  TouchesPatient(const itk::Index<3> & index, std::size_t n) const
  {
    const std::uint8_t * const patient = m_Found.patient->GetBufferPointer() + n;
    std::ptrdiff_t step = 1;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto last = static_cast<itk::IndexValueType>(m_Size[axis]) - 1;
      if ((index[axis] > 0 && patient[-step] != 0) || (index[axis] < last && patient[step] != 0))
      {
        return true;
      }
      step *= static_cast<std::ptrdiff_t>(m_Size[axis]);
    }
    return false;
  }

  /** Takes connected bare walls that are harder than skin out of what is doubtful: bone is within skin, and within
   * cavities that are no open space. */
  void
  FindHardWalls(const MaskImage & doubtful)
  {
    constexpr std::uint8_t quarter = 64;
    const std::uint8_t * const hardness = m_Coarse.hardness->GetBufferPointer();
    const auto hard =
      MakeMask(doubtful, [&](std::size_t n) { return doubtful.GetBufferPointer()[n] != 0 && hardness[n] >= quarter; });
    const Components walls = FindComponents(*hard, true);
    const auto isLarge = [this](const Component & part) { return Millilitres(part.count) >= smallestHardVolume; };
    if (std::none_of(walls.parts.begin(), walls.parts.end(), isLarge))
    {
      return;
    }
    const OpenSpace space = FindOpenSpace(*m_Depth, closedGap, m_LongAxis);
    const auto open = FillOpenSpace(space, space.reachesSides, closedGap);
    if (!open)
    {
      return;
    }
    const std::uint32_t * const labels = walls.labels->GetBufferPointer();
    std::vector<std::size_t> bare(walls.parts.size(), 0);
    ForEachIndex(m_Size, [&](const itk::Index<3> & index, std::size_t n) {
      bare[labels[n]] += labels[n] != none && HasNeighbour(*open, index) ? 1 : 0;
    });
    const auto wall = MakeMask(*hard, [&](std::size_t n) {
      const Component & part = walls.parts[labels[n]];
      return labels[n] != none && isLarge(part) &&
             static_cast<double>(bare[labels[n]]) >= bareShare * static_cast<double>(part.count);
    });
    std::uint8_t * const table = m_Table->GetBufferPointer();
    ForEachIndex(m_Size, [&](const itk::Index<3> & index, std::size_t n) {
      table[n] = doubtful.GetBufferPointer()[n] != 0 && hardness[n] > 0 && HasNeighbour(*wall, index) ? 1 : 0;
    });
  }

  /** Finds the places, seen along the patient, where the doubtful tissue is in much of the scan and something in most
   * of it, as a table is and no thin part of a patient; takes them from the patient, but not from its cores. */
  void
  FindTablePlaces(const MaskImage & doubtful)
  {
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    const Columns columns(*this);
    std::vector<std::uint32_t> doubtfulLevels(columns.count, 0);
    std::vector<std::uint32_t> occupiedLevels(columns.count, 0);
    std::vector<std::uint32_t> lastDoubtful(columns.count, 0);
    std::vector<std::uint32_t> lastOccupied(columns.count, 0);
    std::array<unsigned int, 2> others{ (m_LongAxis + 1) % 3, (m_LongAxis + 2) % 3 };
    itk::Index<3> index;
    for (std::uint32_t level = 1; level <= m_Size[m_LongAxis]; ++level)
    {
      index[m_LongAxis] = static_cast<itk::IndexValueType>(level) - 1;
      for (std::size_t v = 0; v < m_Size[others[1]]; ++v)
      {
        index[others[1]] = static_cast<itk::IndexValueType>(v);
        for (std::size_t u = 0; u < m_Size[others[0]]; ++u)
        {
          index[others[0]] = static_cast<itk::IndexValueType>(u);
          const auto n = static_cast<std::size_t>(doubtful.ComputeOffset(index));
          if (solid[n] == 0)
          {
            continue;
          }
          const std::size_t column = columns.Of(index);
          occupiedLevels[column] += lastOccupied[column] != level ? 1 : 0;
          lastOccupied[column] = level;
          if (doubtful.GetBufferPointer()[n] != 0)
          {
            doubtfulLevels[column] += lastDoubtful[column] != level ? 1 : 0;
            lastDoubtful[column] = level;
          }
        }
      }
    }
    const auto levels = static_cast<double>(m_Size[m_LongAxis]);
    ForEachIndex(m_Size, [&](const itk::Index<3> & place, std::size_t n) {
      if (solid[n] != 0 && m_Core->GetBufferPointer()[n] == 0)
      {
        const std::size_t column = columns.Of(place);
        if (static_cast<double>(doubtfulLevels[column]) >= tableShare * levels &&
            static_cast<double>(occupiedLevels[column]) >= tableShareOccupied * levels)
        {
          m_Table->GetBufferPointer()[n] = 1;
          m_Found.patient->GetBufferPointer()[n] = 0;
        }
      }
    });
  }

  bool
  IsTable(std::size_t n) const
  {
    return m_Table && m_Table->GetBufferPointer()[n] != 0;
  }

  /** The world's columns along the patient, as wide as the scan's widest block across it. */
  struct Columns
  {
    explicit Columns(const PatientFinder & finder)
      : coarse(finder.m_Coarse)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        if (axis != finder.m_LongAxis)
        {
          width = std::max(width, coarse.occupancy->GetSpacing()[axis]);
        }
      }
      std::array<double, 2> highest{ -1e9, -1e9 };
      for (unsigned int corner = 0; corner < 8; ++corner)
      {
        itk::Index<3> index;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          index[axis] = (corner >> axis & 1u) != 0 ? static_cast<itk::IndexValueType>(finder.m_Size[axis]) - 1 : 0;
        }
        // The slices in between may lie anywhere on an uneven stack's axis.
        for (itk::IndexValueType k = 0; k < static_cast<itk::IndexValueType>(finder.m_Size[2]); ++k)
        {
          index[2] = k;
          const auto point = coarse.PointOf(index);
          for (unsigned int axis = 0; axis < 2; ++axis)
          {
            lowest[axis] = std::min(lowest[axis], point[axis]);
            highest[axis] = std::max(highest[axis], point[axis]);
          }
        }
      }
      across = static_cast<std::size_t>((highest[0] - lowest[0]) / width + 0.5) + 1;
      count = across * (static_cast<std::size_t>((highest[1] - lowest[1]) / width + 0.5) + 1);
    }

    std::size_t
    Of(const itk::Index<3> & index) const
    {
      const auto point = coarse.PointOf(index);
      const auto x = static_cast<std::size_t>((point[0] - lowest[0]) / width + 0.5);
      const auto y = static_cast<std::size_t>((point[1] - lowest[1]) / width + 0.5);
      return x + across * y;
    }

    const CoarseScan & coarse;
    double width = 0.0;
    std::array<double, 2> lowest{ 1e9, 1e9 };
    std::size_t across = 0;
    std::size_t count = 0;
  };

  double
  Millilitres(std::size_t count) const
  {
    return static_cast<double>(count) * m_Millilitres;
  }

  /** Of a component along the patient. */
  double
  Length(const Component & part) const
  {
    return static_cast<double>(part.highest[m_LongAxis] - part.lowest[m_LongAxis] + 1) *
           m_Coarse.occupancy->GetSpacing()[m_LongAxis];
  }

  const CoarseScan & m_Coarse;
  unsigned int m_LongAxis;
  itk::Size<3> m_Size;
  std::size_t m_Count;
  double m_Narrow = 0.0;
  double m_Millilitres = 0.0;
  PatientMask m_Found;
  MaskImage::Pointer m_Solid; ///< tissue, and from the second pass on what the patient encloses
  MaskImage::Pointer m_Core;
  MaskImage::Pointer m_Table;
  Components m_Cores;                   ///< of what is solid
  std::vector<PartMeasures> m_Measures; ///< of the cores, by label
  DistanceImage::Pointer m_Depth;       ///< in tissue; negative inside
  DistanceImage::Pointer m_Reach;       ///< from the cores
};

} // namespace

PatientMask
FindPatient(const CoarseScan & coarse, unsigned int longAxis)
{
  return PatientFinder(coarse, longAxis).Find();
}

} // namespace rhombic
