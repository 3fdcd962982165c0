#include "detail/itkTriangleGrid.h"

#include "rhombicForEachBlock.h"

#include <algorithm>
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

/** Sorts the triangles into the cells: counts, sums, and entries filled in from the end of each cell. */
TriangleGrid::TriangleGrid(const TriangleSurface & surface,
                           const TriangleSizes & sizes,
                           const BulkVector<std::uint8_t> & areUnfolded)
  : m_Surface(&surface)
  , m_Cells(sizes, GridCellOverMean)
{
  const std::size_t count = surface.GetNumberOfTriangles();
  m_Begins = std::vector<std::atomic<std::uint32_t>>(m_Cells.GetNumberOfCells() + 1);
  m_Entries.resize(count);
  std::array<float, 3> stepsPerMillimetre;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const float extent = m_Cells.GetBox().highest[axis] - m_Cells.GetBox().lowest[axis];
    stepsPerMillimetre[axis] = extent > 1e-30f ? StepsOfSurface / extent : 0.0f;
  }
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [&](std::size_t n) {
    m_Begins[m_Cells.FindCentre(TriangleCells::BoxOf(surface, n))].fetch_add(1, std::memory_order_relaxed);
  });
  std::uint32_t sum = 0;
  for (auto & begin : m_Begins)
  {
    sum += begin.load(std::memory_order_relaxed);
    begin.store(sum, std::memory_order_relaxed);
  }
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [&](std::size_t n) {
    const auto triangle = static_cast<std::uint32_t>(n);
    const PointBox box = TriangleCells::BoxOf(surface, n);
    Entry entry{ {}, triangle, surface.GetTriangles()[n] };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto stepOf = [&](float coordinate) {
        return static_cast<std::int16_t>(LeastStep +
                                         (coordinate - m_Cells.GetBox().lowest[axis]) * stepsPerMillimetre[axis]);
      };
      entry.box[axis] = stepOf(box.lowest[axis]);
      entry.box[axis + 3] = stepOf(box.highest[axis]);
    }
    for (std::uint32_t & corner : entry.unfoldedCorners)
    {
      corner = areUnfolded[corner] != 0 ? corner : std::numeric_limits<std::uint32_t>::max();
    }
    m_Entries[m_Begins[m_Cells.FindCentre(box)].fetch_sub(1, std::memory_order_relaxed) - 1] = entry;
  });
}

} // namespace itk
