#include "rhombicTableContact.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

namespace rhombic
{
namespace
{

constexpr double widestContact = 120.0; // mm: widest contact of a back with a table's wall
constexpr int columnsBeside = 6;        // columns on either side of a contact, where the wall's thickness is measured

/** A wall in one column: its first and last row. */
struct Wall
{
  std::ptrdiff_t front;
  std::ptrdiff_t back;
};

/** \class LevelCutter
 * \brief One level of the scan along the patient: columns of blocks from left to right, rows from front to back. */
class LevelCutter
{
public:
  LevelCutter(const MaskImage & solid, MaskImage & patient, unsigned int longAxis, double thickestWall)
    : m_Solid(solid)
    , m_Patient(patient)
    , m_LongAxis(longAxis)
    , m_RowAxis(NearestAxis(solid.GetDirection(), 1, longAxis))
    , m_ColumnAxis(3 - m_RowAxis - longAxis)
    , m_Rows(static_cast<std::ptrdiff_t>(solid.GetBufferedRegion().GetSize(m_RowAxis)))
    , m_Columns(static_cast<std::ptrdiff_t>(solid.GetBufferedRegion().GetSize(m_ColumnAxis)))
    , m_LongestContact(static_cast<std::ptrdiff_t>(widestContact / solid.GetSpacing()[m_ColumnAxis]))
    , m_ThickestWall(static_cast<std::ptrdiff_t>(thickestWall / solid.GetSpacing()[m_RowAxis]))
  {}

  void
  Cut(std::size_t level)
  {
    m_Level = static_cast<itk::IndexValueType>(level);
    FindBacksAndWalls();
    for (std::ptrdiff_t first = 1; first + 1 < m_Columns; ++first)
    {
      if (IsContact(first) && WallAt(first - 1, Back(first)))
      {
        const std::ptrdiff_t last = FindLastOfContact(first);
        if (WallAt(last + 1, Back(last)))
        {
          CutContact(first, last);
        }
      }
    }
  }

private:
  std::size_t
  OffsetOf(std::ptrdiff_t column, std::ptrdiff_t row) const
  {
    itk::Index<3> index;
    index[m_LongAxis] = m_Level;
    index[m_ColumnAxis] = column;
    index[m_RowAxis] = m_Solid.GetDirection()[1][m_RowAxis] > 0.0 ? row : m_Rows - 1 - row;
    return static_cast<std::size_t>(m_Solid.ComputeOffset(index));
  }

  void
  FindBacksAndWalls()
  {
    m_Backs.assign(static_cast<std::size_t>(m_Columns), -1);
    m_Walls.assign(static_cast<std::size_t>(m_Columns), {});
    for (std::ptrdiff_t column = 0; column < m_Columns; ++column)
    {
      std::vector<Wall> & walls = m_Walls[static_cast<std::size_t>(column)];
      for (std::ptrdiff_t row = 0; row < m_Rows; ++row)
      {
        const std::size_t offset = OffsetOf(column, row);
        if (m_Patient.GetBufferPointer()[offset] != 0)
        {
          m_Backs[static_cast<std::size_t>(column)] = row;
        }
        else if (m_Solid.GetBufferPointer()[offset] != 0)
        {
          if (walls.empty() || walls.back().back + 1 != row)
          {
            walls.push_back({ row, row });
          }
          walls.back().back = row;
        }
      }
    }
  }

  std::ptrdiff_t
  Back(std::ptrdiff_t column) const
  {
    return m_Backs[static_cast<std::size_t>(column)];
  }

  /** The wall of a column that ends in row \a back or one row from it. */
  std::optional<Wall>
  WallAt(std::ptrdiff_t column, std::ptrdiff_t back) const
  {
    if (column < 0 || column >= m_Columns)
    {
      return {};
    }
    const std::vector<Wall> & walls = m_Walls[static_cast<std::size_t>(column)];
    const auto wall =
      std::find_if(walls.begin(), walls.end(), [=](const Wall & other) { return std::abs(other.back - back) <= 1; });
    return wall != walls.end() ? std::optional<Wall>(*wall) : std::nullopt;
  }

  /** Whether the column has a body, and no wall that ends where the body does. */
  bool
  IsContact(std::ptrdiff_t column) const
  {
    return Back(column) >= 0 && !WallAt(column, Back(column));
  }

  /** The last column of the contact: before the next wall, a step of the back, or the body's end, and within
   * widestContact. */
  std::ptrdiff_t
  FindLastOfContact(std::ptrdiff_t first) const
  {
    std::ptrdiff_t last = first;
    while (last + 1 < m_Columns && last - first < m_LongestContact && IsContact(last + 1) &&
           std::abs(Back(last + 1) - Back(last)) <= 1 && !WallAt(last + 1, Back(last)))
    {
      ++last;
    }
    return last;
  }

  /** Calls function(column, wall) for up to columnsBeside columns beside a contact, from \a column on, while the wall
   * continues. */
  template <typename TFunction>
  void
  FollowWall(std::ptrdiff_t column, std::ptrdiff_t step, const TFunction & function) const
  {
    std::optional<Wall> wall = WallAt(column, Back(column - step));
    for (int n = 0; wall && n < columnsBeside; ++n)
    {
      function(column, *wall);
      column += step;
      wall = WallAt(column, wall->back);
    }
  }

  /** The wall's greatest thickness beside a contact, in rows. In the columns next to the contact, part of the wall is
   * in the patient's mask. */
  std::ptrdiff_t
  ThicknessFrom(std::ptrdiff_t column, std::ptrdiff_t step) const
  {
    std::ptrdiff_t thickness = 0;
    FollowWall(column, step, [&](std::ptrdiff_t, const Wall & wall) {
      thickness = std::max(thickness, wall.back - wall.front + 1);
    });
    return thickness;
  }

  void
  CutContact(std::ptrdiff_t first, std::ptrdiff_t last)
  {
    const std::ptrdiff_t thickness = std::min(ThicknessFrom(first - 1, -1), ThicknessFrom(last + 1, 1));
    if (thickness > m_ThickestWall)
    {
      return;
    }
    const auto cut = [&](std::ptrdiff_t column, std::ptrdiff_t back) {
      for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(back - thickness + 1, 0); row <= back; ++row)
      {
        m_Patient.GetBufferPointer()[OffsetOf(column, row)] = 0;
      }
    };
    for (std::ptrdiff_t column = first; column <= last; ++column)
    {
      cut(column, Back(column));
    }
    const auto cutWall = [&](std::ptrdiff_t column, const Wall & wall) { cut(column, wall.back); };
    FollowWall(first - 1, -1, cutWall);
    FollowWall(last + 1, 1, cutWall);
  }

  const MaskImage & m_Solid;
  MaskImage & m_Patient;
  unsigned int m_LongAxis;
  unsigned int m_RowAxis;
  unsigned int m_ColumnAxis;
  std::ptrdiff_t m_Rows;
  std::ptrdiff_t m_Columns;
  std::ptrdiff_t m_LongestContact; ///< in columns
  std::ptrdiff_t m_ThickestWall;   ///< in rows
  itk::IndexValueType m_Level = 0;
  std::vector<std::ptrdiff_t> m_Backs;    ///< by column: the body's last row, -1 where there is none
  std::vector<std::vector<Wall>> m_Walls; ///< by column: solid blocks outside the patient
};

} // namespace

void
CutTableContacts(const MaskImage & solid, unsigned int longAxis, double thickestWall, MaskImage & patient)
{
  LevelCutter cutter(solid, patient, longAxis, thickestWall);
  for (std::size_t level = 0; level < solid.GetBufferedRegion().GetSize(longAxis); ++level)
  {
    cutter.Cut(level);
  }
}

} // namespace rhombic
