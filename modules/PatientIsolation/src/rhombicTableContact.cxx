#include "rhombicTableContact.h"

#include "rhombicImageAxes.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace rhombic
{
namespace
{

constexpr double widestContact = 120.0; // mm, of a patient's back with a table's wall
constexpr int columnsBeside = 6;        // a contact: the wall's thickness is measured there

/** A wall in one column: rows from front to back, both in it. */
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
    FindBodyAndWalls();
    for (std::ptrdiff_t first = 1; first + 1 < m_Columns; ++first)
    {
      if (IsContact(first) && WallAt(first - 1, m_Ends[Number(first)]))
      {
        const std::ptrdiff_t last = FindLastOfContact(first);
        if (last + 1 < m_Columns && WallAt(last + 1, m_Ends[Number(last)]))
        {
          CutContact(first, last);
        }
      }
    }
  }

private:
  static std::size_t
  Number(std::ptrdiff_t column)
  {
    return static_cast<std::size_t>(column);
  }

  std::size_t
  BlockAt(std::ptrdiff_t column, std::ptrdiff_t row) const
  {
    itk::Index<3> index;
    index[m_LongAxis] = m_Level;
    index[m_ColumnAxis] = column;
    index[m_RowAxis] = m_Solid.GetDirection()[1][m_RowAxis] > 0.0 ? row : m_Rows - 1 - row;
    return static_cast<std::size_t>(m_Solid.ComputeOffset(index));
  }

  /** Of each column, the body's last row, or -1, and the walls. */
  void
  FindBodyAndWalls()
  {
    m_Ends.assign(Number(m_Columns), -1);
    m_Walls.assign(Number(m_Columns), {});
    for (std::ptrdiff_t column = 0; column < m_Columns; ++column)
    {
      std::vector<Wall> & walls = m_Walls[Number(column)];
      for (std::ptrdiff_t row = 0; row < m_Rows; ++row)
      {
        const std::size_t block = BlockAt(column, row);
        if (m_Patient.GetBufferPointer()[block] != 0)
        {
          m_Ends[Number(column)] = row;
        }
        else if (m_Solid.GetBufferPointer()[block] != 0)
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

  /** The wall of a column whose back is at that row, or next to it. */
  std::optional<Wall>
  WallAt(std::ptrdiff_t column, std::ptrdiff_t back) const
  {
    if (column >= 0 && column < m_Columns)
    {
      for (const Wall & wall : m_Walls[Number(column)])
      {
        if (std::abs(wall.back - back) <= 1)
        {
          return wall;
        }
      }
    }
    return {};
  }

  /** Whether the body's last row has no wall behind it. */
  bool
  IsContact(std::ptrdiff_t column) const
  {
    const std::ptrdiff_t end = m_Ends[Number(column)];
    return end >= 0 && !WallAt(column, end);
  }

  /** The last column before a wall, a step, the body's end or the widest contact's. */
  std::ptrdiff_t
  FindLastOfContact(std::ptrdiff_t first) const
  {
    std::ptrdiff_t last = first;
    while (last + 1 < m_Columns && last - first < m_LongestContact && IsContact(last + 1) &&
           std::abs(m_Ends[Number(last + 1)] - m_Ends[Number(last)]) <= 1 && !WallAt(last + 1, m_Ends[Number(last)]))
    {
      ++last;
    }
    return last;
  }

  /** Calls the function with the columns beside a contact, from \a column on, and their wall, as far as it goes on. */
  template <typename TFunction>
  void
  FollowWall(std::ptrdiff_t column, std::ptrdiff_t step, const TFunction & function) const
  {
    std::optional<Wall> wall = WallAt(column, m_Ends[Number(column - step)]);
    for (int n = 0; wall && n < columnsBeside; ++n)
    {
      function(column, *wall);
      column += step;
      wall = WallAt(column, wall->back);
    }
  }

  /** The greatest thickness beside a contact: next to it, the body has grown into the wall. */
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
        m_Patient.GetBufferPointer()[BlockAt(column, row)] = 0;
      }
    };
    for (std::ptrdiff_t column = first; column <= last; ++column)
    {
      cut(column, m_Ends[Number(column)]);
    }
    const auto cutBeside = [&](std::ptrdiff_t column, const Wall & wall) { cut(column, wall.back); };
    FollowWall(first - 1, -1, cutBeside);
    FollowWall(last + 1, 1, cutBeside);
  }

  const MaskImage & m_Solid;
  MaskImage & m_Patient;
  unsigned int m_LongAxis;
  unsigned int m_RowAxis;
  unsigned int m_ColumnAxis;
  std::ptrdiff_t m_Rows;
  std::ptrdiff_t m_Columns;
  std::ptrdiff_t m_LongestContact;
  std::ptrdiff_t m_ThickestWall;
  itk::IndexValueType m_Level = 0;
  std::vector<std::ptrdiff_t> m_Ends;
  std::vector<std::vector<Wall>> m_Walls;
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
