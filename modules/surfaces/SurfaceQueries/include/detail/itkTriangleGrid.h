#ifndef itkTriangleGrid_h
#define itkTriangleGrid_h

#include "detail/itkTriangleCells.h"

namespace itk
{

/** \class TriangleGrid
 * \brief The triangles of a surface in the cells of a grid, each in the cell of its box's centre. Triangles are no
 * longer than cells along any axis, so that those that meet lie in the same cell or in cells that touch.
 *
 * Cells are sorted block by block, while they are visited: the triangles of a block stay in a processor's cache. For
 * surfaces whose triangles are of about the same size, as isosurfaces have them; less work than a TriangleTree. It
 * keeps the surface alive; moving points invalidates it. Linear time, on several threads; memory about 6 bytes per
 * triangle. The order of triangles depends on the threads. */
class TriangleGrid
{
public:
  using Flags = BulkVector<std::uint8_t>; ///< of points

  /** The box of a triangle in steps of 1/65000 of the surface's, which keep the order of coordinates. */
  struct Entry
  {
    std::array<std::int16_t, 6> box; ///< least x, y, z, greatest x, y, z
    std::uint32_t triangle;
    TriangleSurface::TriangleType unfoldedCorners; ///< the largest number in place of folded ones
  };

  /** \class Block
   * \brief The sorted triangles of some rows of cells, and of those rows beside and behind them that touch them.
   * The grid must be alive. */
  class Block
  {
  public:
    explicit Block(const TriangleGrid & grid)
      : m_Grid(grid)
    {}

    /** Takes the place of the block before. */
    void
    Load(std::size_t block);

    /** For each cell of the block that holds triangles: calls \a visit(first, last) for its entries, \a
     * visitNext(first, last) several times for entries of the cells behind it that touch it, and \a end(). */
    template <typename TBegin, typename TNext, typename TEnd>
    void
    VisitCells(const TBegin & visit, const TNext & visitNext, const TEnd & end) const
    {
      const std::size_t length = m_Grid.m_RowLength, behind = length * LocalWidth;
      for (std::size_t row = 0; row < RowsAcross * RowsDeep; ++row)
      {
        const std::size_t begin = (row / RowsAcross * LocalWidth + row % RowsAcross + 1) * length;
        for (std::size_t cell = begin + 1; cell + 1 < begin + length; ++cell) // the outermost cells are empty
        {
          if (m_Begins[cell] == m_Begins[cell + 1])
          {
            continue;
          }
          visit(this->EntriesFrom(cell), this->EntriesFrom(cell + 1));
          visitNext(this->EntriesFrom(cell + 1), this->EntriesFrom(cell + 2));
          for (const std::size_t middle :
               { cell + length, cell + behind - length, cell + behind, cell + behind + length })
          {
            visitNext(this->EntriesFrom(middle - 1), this->EntriesFrom(middle + 2));
          }
          end();
        }
      }
    }

  private:
    const Entry *
    EntriesFrom(std::size_t cell) const
    {
      return m_Entries.data() + m_Begins[cell];
    }

    const TriangleGrid & m_Grid;
    std::vector<std::uint32_t> m_Begins; ///< of each cell's entries, and the end of the last
    std::vector<Entry> m_Entries;
    std::vector<std::pair<std::uint32_t, Entry>> m_Unsorted; ///< with cells
  };

  /** \param areUnfolded see FindUnfoldedPoints() */
  TriangleGrid(const TriangleSurface & surface, const TriangleSizes & sizes, Flags areUnfolded);

  const TriangleSurface &
  GetSurface() const
  {
    return *m_Surface;
  }

  std::size_t
  GetNumberOfBlocks() const
  {
    return m_Ends.size();
  }

private:
  static constexpr std::size_t RowsAcross = 16; ///< of a block
  static constexpr std::size_t RowsDeep = 8;
  static constexpr std::size_t LocalWidth = RowsAcross + 2; ///< with a row on both sides

  /** A row of cells, by its numbers across and deep. */
  using Row = std::array<std::size_t, 2>;

  Row
  RowOf(const PointBox & box) const
  {
    return { m_Cells.FindCentre(box, m_Axes[1]), m_Cells.FindCentre(box, m_Axes[2]) };
  }

  /** Calls \a visit(block) for the blocks that hold a row, or touch it. */
  template <typename TVisitor>
  void
  VisitBlocks(const Row & row, const TVisitor & visit) const
  {
    const auto [across, deep] = row;
    const std::size_t last = std::min(m_BlocksAcross - 1, (across + 1) / RowsAcross);
    for (std::size_t y = deep > 0 ? (deep - 1) / RowsDeep : 0; y <= deep / RowsDeep; ++y)
    {
      for (std::size_t x = across > 0 ? (across - 1) / RowsAcross : 0; x <= last; ++x)
      {
        visit(y * m_BlocksAcross + x);
      }
    }
  }

  TriangleSurface::ConstPointer m_Surface;
  TriangleCells m_Cells;
  Flags m_AreUnfolded;
  std::array<unsigned int, 3> m_Axes{ 0, 1, 2 }; ///< along rows, across, deep
  std::size_t m_RowLength = 0;                   ///< in cells
  std::size_t m_BlocksAcross = 0;
  std::array<float, 3> m_StepsPerMillimetre{};
  std::vector<std::size_t> m_Ends; ///< of each block's triangles
  BulkVector<std::uint32_t> m_Triangles;
};

} // namespace itk

#endif
