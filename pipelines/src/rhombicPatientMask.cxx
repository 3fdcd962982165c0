#include "rhombicPatientMask.h"

#include "rhombicImageAxes.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

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

constexpr double widestContact = 120.0; // of a patient's back with a table's wall
constexpr int blocksBeside = 6;         // a contact, in which the wall's thickness is measured

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
    , m_Width(std::max(
        { coarse.occupancy->GetSpacing()[0], coarse.occupancy->GetSpacing()[1], coarse.occupancy->GetSpacing()[2] }))
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
    if (!HasBorder(*m_Solid) || !FindThickParts())
    {
      return m_Found;
    }
    FillBetweenFrontAndBack();
    FindThickParts();
    Grow();
    AddWhatHangsOn();
    CutWhereTableTouches();
    return m_Found;
  }

private:
  /** The cores that are the patient's. Returns whether there is a body. */
  bool
  FindThickParts()
  {
    m_Depth = DistanceTo(*m_Solid);
    const float * const depths = m_Depth->GetBufferPointer();
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    const auto core = MakeMask(*m_Depth, [=](std::size_t n) {
      return solid[n] != 0 && 0.5 * m_Narrow - static_cast<double>(depths[n]) >= coreDepth;
    });
    const Components cores = FindComponents(*core, false);
    const std::uint32_t * const labels = cores.labels->GetBufferPointer();
    std::vector<PartMeasures> measures(cores.parts.size());
    for (std::size_t n = 0; n < m_Count; ++n)
    {
      PartMeasures & part = measures[labels[n]];
      part.greatestDepth = std::max(part.greatestDepth, static_cast<double>(-depths[n]));
      part.sum += m_Coarse.mean->GetBufferPointer()[n];
    }
    std::vector<bool> isPatient(cores.parts.size(), false);
    std::uint32_t largest = none;
    for (std::uint32_t label = 1; label < cores.parts.size(); ++label)
    {
      isPatient[label] = measures[label].greatestDepth >= bodyDepth;
      if (isPatient[label] && (largest == none || cores.parts[label].count > cores.parts[largest].count))
      {
        largest = label;
      }
    }
    if (largest == none)
    {
      return false;
    }
    for (std::uint32_t label = 1; label < cores.parts.size(); ++label)
    {
      isPatient[label] = isPatient[label] || IsThinPart(cores.parts[label], measures[label]);
    }
    m_Core = MakeMask(*core, [&](std::size_t n) { return isPatient[labels[n]]; });
    return true;
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
    const unsigned int axis = NearestAxis(direction, 1);
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
        for (; first < end && core[n + first * step] == 0;)
        {
          ++first;
        }
        for (; end > first && core[n + (end - 1) * step] == 0;)
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
      AddComponents([](double millilitres, double reach) {
        return millilitres <= largestHangingVolume && reach <= longestHangingReach;
      });
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

  /** A run of blocks along the axis from front to back; the back has the higher number. */
  struct Run
  {
    std::ptrdiff_t front;
    std::ptrdiff_t back;
  };

  /** Where the patient lies on a table's wall, both are one thick body. Across the patient, the wall goes in there and
   * comes out again, and behind the body it has no step: in between it is as thick as on both sides. */
  void
  CutWhereTableTouches()
  {
    const auto & direction = m_Coarse.occupancy->GetDirection();
    const unsigned int depthAxis = NearestAxis(direction, 1);
    const unsigned int acrossAxis = 3 - depthAxis - m_LongAxis;
    const bool isBackAtEnd = direction[1][depthAxis] > 0.0;
    const auto across = static_cast<std::ptrdiff_t>(m_Size[acrossAxis]);
    const auto depth = static_cast<std::ptrdiff_t>(m_Size[depthAxis]);
    for (std::size_t level = 0; level < m_Size[m_LongAxis]; ++level)
    {
      const auto place = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
        itk::Index<3> index;
        index[m_LongAxis] = static_cast<itk::IndexValueType>(level);
        index[acrossAxis] = column;
        index[depthAxis] = isBackAtEnd ? row : depth - 1 - row;
        return static_cast<std::size_t>(m_Solid->ComputeOffset(index));
      };
      CutLevel(across, depth, place);
    }
  }

  template <typename TPlace>
  void
  CutLevel(std::ptrdiff_t across, std::ptrdiff_t depth, const TPlace & place)
  {
    const std::uint8_t * const solid = m_Solid->GetBufferPointer();
    std::uint8_t * const patient = m_Found.patient->GetBufferPointer();
    // Of each column, the body's end at the back, or none, and the walls.
    std::vector<std::ptrdiff_t> ends(static_cast<std::size_t>(across), -1);
    std::vector<std::vector<Run>> walls(static_cast<std::size_t>(across));
    for (std::ptrdiff_t column = 0; column < across; ++column)
    {
      const auto n = static_cast<std::size_t>(column);
      for (std::ptrdiff_t row = 0; row < depth; ++row)
      {
        const std::size_t block = place(column, row);
        if (patient[block] != 0)
        {
          ends[n] = row;
        }
        else if (solid[block] != 0)
        {
          if (walls[n].empty() || walls[n].back().back + 1 != row)
          {
            walls[n].push_back({ row, row });
          }
          walls[n].back().back = row;
        }
      }
    }
    const auto wallAt = [&](std::ptrdiff_t column, std::ptrdiff_t back) -> const Run * {
      for (const Run & wall : walls[static_cast<std::size_t>(column)])
      {
        if (std::abs(wall.back - back) <= 1)
        {
          return &wall;
        }
      }
      return nullptr;
    };
    /* The wall's thickness outside of the contact, where it is the thickest: near it, the body has grown into it. */
    const auto thicknessFrom = [&](std::ptrdiff_t column, std::ptrdiff_t step) {
      std::ptrdiff_t thickness = 0;
      const Run * wall = walls[static_cast<std::size_t>(column)].empty()
                           ? nullptr
                           : wallAt(column, ends[static_cast<std::size_t>(column - step)]);
      for (int n = 0; wall != nullptr && n < blocksBeside; ++n)
      {
        thickness = std::max(thickness, wall->back - wall->front + 1);
        column += step;
        wall = column >= 0 && column < across ? wallAt(column, wall->back) : nullptr;
      }
      return thickness;
    };
    const auto longest = static_cast<std::ptrdiff_t>(widestContact / m_Narrow);
    for (std::ptrdiff_t first = 1; first < across; ++first)
    {
      const auto isBody = [&](std::ptrdiff_t column) {
        const std::ptrdiff_t end = ends[static_cast<std::size_t>(column)];
        return end >= 0 && wallAt(column, end) == nullptr;
      };
      if (!isBody(first) || wallAt(first - 1, ends[static_cast<std::size_t>(first)]) == nullptr)
      {
        continue;
      }
      std::ptrdiff_t last = first;
      while (last + 1 < across && isBody(last + 1) && last - first < longest &&
             std::abs(ends[static_cast<std::size_t>(last + 1)] - ends[static_cast<std::size_t>(last)]) <= 1 &&
             wallAt(last + 1, ends[static_cast<std::size_t>(last)]) == nullptr)
      {
        ++last;
      }
      if (last + 1 >= across || wallAt(last + 1, ends[static_cast<std::size_t>(last)]) == nullptr)
      {
        continue;
      }
      const std::ptrdiff_t thickness = std::min(thicknessFrom(first - 1, -1), thicknessFrom(last + 1, 1));
      if (thickness == 0 || static_cast<double>(thickness) * m_Narrow > 2.0 * coreDepth)
      {
        continue;
      }
      const auto cut = [&](std::ptrdiff_t column, std::ptrdiff_t back) {
        for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(back - thickness + 1, 0); row <= back; ++row)
        {
          patient[place(column, row)] = 0;
        }
      };
      for (std::ptrdiff_t column = first; column <= last; ++column)
      {
        cut(column, ends[static_cast<std::size_t>(column)]);
      }
      const auto cutBeside = [&](std::ptrdiff_t column, std::ptrdiff_t step) {
        const Run * wall = wallAt(column, ends[static_cast<std::size_t>(column - step)]);
        for (int n = 0; wall != nullptr && n < blocksBeside; ++n)
        {
          cut(column, wall->back);
          column += step;
          wall = column >= 0 && column < across ? wallAt(column, wall->back) : nullptr;
        }
      };
      cutBeside(first - 1, -1);
      cutBeside(last + 1, 1);
    }
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
  double m_Width;
  double m_Narrow = 0.0;
  double m_Millilitres = 0.0;
  PatientMask m_Found;
  MaskImage::Pointer m_Solid; ///< tissue, and from the second pass on what the patient encloses
  MaskImage::Pointer m_Core;
  MaskImage::Pointer m_Table;
  DistanceImage::Pointer m_Depth; ///< in tissue; negative inside
  DistanceImage::Pointer m_Reach; ///< from the cores
};

} // namespace

PatientMask
FindPatient(const CoarseScan & coarse, unsigned int longAxis)
{
  return PatientFinder(coarse, longAxis).Find();
}

} // namespace rhombic
