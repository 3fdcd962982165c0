#include "detail/itkTriangleCells.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace itk
{
namespace
{

constexpr std::size_t TrianglesOfCellBlock = 16384;
constexpr double CellOverLongest = 1.01; // length of a cell, at least, over that of the longest box of a triangle
constexpr double LongestOverMean = 8.0;  // at most, of triangles' boxes

/** The lengths of triangles' boxes along each axis. */
struct BoxLengths
{
  std::array<double, 3> longest{};
  std::array<double, 3> sum{};

  void
  Add(const PointBox & box)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double length = double{ box.highest[axis] } - box.lowest[axis];
      longest[axis] = std::max(longest[axis], length);
      sum[axis] += length;
    }
  }
};

} // namespace

std::optional<TriangleCells>
TriangleCells::Make(const TriangleSurface & surface, double cellOverMean)
{
  TriangleCells cells;
  if (surface.GetNumberOfTriangles() == 0 || !cells.FindSizes(surface, cellOverMean))
  {
    return std::nullopt;
  }
  return cells;
}

/** Finds the surface's box and the sizes of cells. Returns whether a grid is of use. */
bool
TriangleCells::FindSizes(const TriangleSurface & surface, double cellOverMean)
{
  const auto & points = surface.GetPoints();
  if (!std::all_of(points.begin(), points.end(), [](const PointType & point) { return IsFinite(point); }))
  {
    return false;
  }
  m_Box = { points.front(), points.front() };
  for (const PointType & point : points)
  {
    m_Box.Add(point);
  }
  const std::size_t count = surface.GetNumberOfTriangles();
  std::vector<BoxLengths> ofBlocks((count + TrianglesOfCellBlock - 1) / TrianglesOfCellBlock);
  rhombic::ForEachInBlocks(
    count, TrianglesOfCellBlock, [&](std::size_t n) { ofBlocks[n / TrianglesOfCellBlock].Add(BoxOf(surface, n)); });
  std::array<double, 3> length{};
  double longest = 0.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    double sum = 0.0, ofAxis = 0.0;
    for (const BoxLengths & ofBlock : ofBlocks)
    {
      sum += ofBlock.sum[axis];
      ofAxis = std::max(ofAxis, ofBlock.longest[axis]);
    }
    const double mean = sum / static_cast<double>(count);
    if (ofAxis > LongestOverMean * mean)
    {
      return false;
    }
    length[axis] = std::max(cellOverMean * mean, CellOverLongest * ofAxis);
    longest = std::max(longest, length[axis]);
  }
  constexpr double flat = 1e-3;       // of the longest, the least
  constexpr double mostExtent = 1e30; // in mm, so that nothing overflows
  double scale = 1.0, cells = 0.0;
  do
  {
    cells = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_CellsPerMillimetre[axis] = longest > 0.0 ? 1.0 / (scale * std::max(length[axis], flat * longest)) : 0.0;
      const double extent = double{ m_Box.highest[axis] } - m_Box.lowest[axis];
      if (extent > mostExtent)
      {
        return false;
      }
      const double size = 3.0 + std::floor(extent * m_CellsPerMillimetre[axis]);
      cells *= size;
      m_Sizes[axis] = static_cast<std::size_t>(size);
    }
    scale *= 1.25;
  } while (cells > 2.0 * static_cast<double>(count) + 4096.0);
  return true;
}

void
TriangleRegion::Add(const PointBox & box)
{
  m_Cells.AllOf(box, [this](std::size_t cell) {
    m_IsIn[cell] = 1;
    return true;
  });
}

std::vector<std::uint32_t>
TriangleRegion::FindTriangles(const TriangleSurface & surface) const
{
  std::vector<std::uint32_t> triangles;
  std::mutex mutex;
  rhombic::ForEachBlock(surface.GetNumberOfTriangles(), TrianglesOfCellBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> found;
    for (std::size_t n = begin; n < end; ++n)
    {
      if (!m_Cells.AllOf(TriangleCells::BoxOf(surface, n), [this](std::size_t cell) { return m_IsIn[cell] == 0; }))
      {
        found.push_back(static_cast<std::uint32_t>(n));
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    triangles.insert(triangles.end(), found.begin(), found.end());
  });
  return triangles;
}

} // namespace itk
