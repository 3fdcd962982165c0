#ifndef itkTriangleGrid_h
#define itkTriangleGrid_h

#include "detail/itkTriangleCells.h"

#include <atomic>

namespace itk
{

/** \class TriangleGrid
 * \brief The triangles of a surface in the cells of a grid, each in the cell of its box's centre. Triangles are no
 * longer than cells along any axis, so that those that meet lie in the same cell or in cells that touch.
 *
 * For surfaces whose triangles are of about the same size, as isosurfaces have them: a grid is made in a quarter of the
 * time of a TriangleTree. It keeps the surface alive; moving points invalidates it. Linear time, on several threads;
 * memory about 32 bytes per triangle. The order of a cell's triangles depends on the threads. */
class TriangleGrid
{
public:
  /** The box of a triangle in steps of 1/65000 of the surface's, which keep the order of coordinates. */
  struct Entry
  {
    std::array<std::int16_t, 6> box; ///< least x, y, z, greatest x, y, z
    std::uint32_t triangle;
    TriangleSurface::TriangleType unfoldedCorners; ///< the largest number in place of folded ones
  };

  /** \param areUnfolded see FindUnfoldedPoints() */
  TriangleGrid(const TriangleSurface & surface,
               const TriangleSizes & sizes,
               const BulkVector<std::uint8_t> & areUnfolded);

  const TriangleSurface &
  GetSurface() const
  {
    return *m_Surface;
  }

  /** Rows of cells along x. */
  std::size_t
  GetNumberOfRows() const
  {
    return m_Cells.GetSize(1) * m_Cells.GetSize(2);
  }

  /** For each cell of a row that holds triangles: calls \a visit(first, last) for its entries, \a visitNext(first,
   * last) several times for entries of the cells behind it that touch it, and \a end(). */
  template <typename TBegin, typename TNext, typename TEnd>
  void
  VisitCells(std::size_t row, const TBegin & visit, const TNext & visitNext, const TEnd & end) const
  {
    const std::size_t y = row % m_Cells.GetSize(1), z = row / m_Cells.GetSize(1);
    if (y == 0 || y + 1 == m_Cells.GetSize(1) || z == 0 || z + 1 == m_Cells.GetSize(2))
    {
      return; // the outermost cells are empty
    }
    const std::size_t above = m_Cells.GetSize(0), behind = m_Cells.GetSize(0) * m_Cells.GetSize(1);
    for (std::size_t cell = row * m_Cells.GetSize(0) + 1; cell + 1 < (row + 1) * m_Cells.GetSize(0); ++cell)
    {
      if (m_Begins[cell] == m_Begins[cell + 1])
      {
        continue;
      }
      visit(this->EntriesFrom(cell), this->EntriesFrom(cell + 1));
      visitNext(this->EntriesFrom(cell + 1), this->EntriesFrom(cell + 2));
      for (const std::size_t middle : { cell + above, cell + behind - above, cell + behind, cell + behind + above })
      {
        visitNext(this->EntriesFrom(middle - 1), this->EntriesFrom(middle + 2));
      }
      end();
    }
  }

private:
  const Entry *
  EntriesFrom(std::size_t cell) const
  {
    return m_Entries.data() + m_Begins[cell];
  }

  TriangleSurface::ConstPointer m_Surface;
  TriangleCells m_Cells;
  std::vector<std::atomic<std::uint32_t>> m_Begins; ///< of each cell's entries, and the end of the last
  std::vector<Entry, BulkAllocator<Entry>> m_Entries;
};

} // namespace itk

#endif
