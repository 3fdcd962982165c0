#include "detail/itkTriangleGrid.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace itk
{
namespace
{

constexpr std::size_t TrianglesOfGridBlock = 16384;
constexpr double GridCellOverMean = 4.0;
constexpr float StepsOfSurface = 65000.0f;
constexpr float LeastStep = -32500.0f;

} // namespace

/** Lists the triangles of each block: counts, sums, and numbers filled in from the end of each list. */
TriangleGrid::TriangleGrid(const TriangleSurface & surface, const TriangleSizes & sizes, Flags areUnfolded)
  : m_Surface(&surface)
  , m_Cells(sizes, GridCellOverMean)
  , m_AreUnfolded(std::move(areUnfolded))
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const float extent = m_Cells.GetBox().highest[axis] - m_Cells.GetBox().lowest[axis];
    m_StepsPerMillimetre[axis] = extent > 1e-30f ? StepsOfSurface / extent : 0.0f;
  }
  // Rows along the shortest axis, so that long and flat surfaces have many blocks, too.
  std::stable_sort(m_Axes.begin(), m_Axes.end(), [this](unsigned int a, unsigned int b) {
    return m_Cells.GetSize(a) < m_Cells.GetSize(b);
  });
  m_RowLength = m_Cells.GetSize(m_Axes[0]);
  m_BlocksAcross = (m_Cells.GetSize(m_Axes[1]) + RowsAcross - 1) / RowsAcross;
  const std::size_t blocksDeep = (m_Cells.GetSize(m_Axes[2]) + RowsDeep - 1) / RowsDeep;

  const std::size_t count = surface.GetNumberOfTriangles();
  std::vector<std::atomic<std::size_t>> ends(m_BlocksAcross * blocksDeep);
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [&](std::size_t n) {
    this->VisitBlocks(this->RowOf(TriangleCells::BoxOf(surface, n)),
                      [&](std::size_t block) { ends[block].fetch_add(1, std::memory_order_relaxed); });
  });
  std::size_t sum = 0;
  for (auto & end : ends)
  {
    sum += end.load(std::memory_order_relaxed);
    end.store(sum, std::memory_order_relaxed);
    m_Ends.push_back(sum);
  }
  m_Triangles.resize(sum);
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [&](std::size_t n) {
    this->VisitBlocks(this->RowOf(TriangleCells::BoxOf(surface, n)), [&](std::size_t block) {
      m_Triangles[ends[block].fetch_sub(1, std::memory_order_relaxed) - 1] = static_cast<std::uint32_t>(n);
    });
  });
}

/** Sorts the triangles into the cells: counts, sums, and entries filled in from the end of each cell. */
void
TriangleGrid::Block::Load(std::size_t block)
{
  const TriangleSurface & surface = *m_Grid.m_Surface;
  const std::size_t firstAcross = block % m_Grid.m_BlocksAcross * RowsAcross;
  const std::size_t firstDeep = block / m_Grid.m_BlocksAcross * RowsDeep;
  m_Begins.assign(LocalWidth * (RowsDeep + 1) * m_Grid.m_RowLength + 1, 0);
  m_Unsorted.clear();
  for (std::size_t n = block > 0 ? m_Grid.m_Ends[block - 1] : 0; n < m_Grid.m_Ends[block]; ++n)
  {
    const std::uint32_t triangle = m_Grid.m_Triangles[n];
    const PointBox box = TriangleCells::BoxOf(surface, triangle);
    const Row row = m_Grid.RowOf(box);
    const std::size_t localRow = (row[1] - firstDeep) * LocalWidth + (row[0] + 1 - firstAcross);
    const std::size_t cell = localRow * m_Grid.m_RowLength + m_Grid.m_Cells.FindCentre(box, m_Grid.m_Axes[0]);
    Entry entry{ {}, triangle, surface.GetTriangles()[triangle] };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto stepOf = [&](float coordinate) {
        return static_cast<std::int16_t>(LeastStep + (coordinate - m_Grid.m_Cells.GetBox().lowest[axis]) *
                                                       m_Grid.m_StepsPerMillimetre[axis]);
      };
      entry.box[axis] = stepOf(box.lowest[axis]);
      entry.box[axis + 3] = stepOf(box.highest[axis]);
    }
    for (std::uint32_t & corner : entry.unfoldedCorners)
    {
      corner = m_Grid.m_AreUnfolded[corner] != 0 ? corner : std::numeric_limits<std::uint32_t>::max();
    }
    ++m_Begins[cell];
    m_Unsorted.emplace_back(static_cast<std::uint32_t>(cell), entry);
  }
  std::uint32_t sum = 0;
  for (std::uint32_t & begin : m_Begins)
  {
    sum += begin;
    begin = sum;
  }
  m_Entries.resize(sum);
  for (const auto & [cell, entry] : m_Unsorted)
  {
    m_Entries[--m_Begins[cell]] = entry;
  }
}

} // namespace itk
