#include "detail/itkTriangleCells.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace itk
{
namespace
{

constexpr std::size_t TrianglesOfCellBlock = 16384;
constexpr double CellOverLongest = 1.01; // length of a cell, at least, over that of the longest box of a triangle
constexpr double LongestOverMean = 8.0;  // at most, of triangles' boxes

} // namespace

std::optional<TriangleSizes>
TriangleSizes::Find(const TriangleSurface & surface, std::size_t begin, std::size_t end)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr PointBox empty{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  TriangleSizes sizes;
  sizes.box = empty;
  bool areFinite = true;
  std::mutex mutex;
  std::vector<std::array<double, 3>> sums((end - begin + TrianglesOfCellBlock - 1) / TrianglesOfCellBlock);
  rhombic::ForEachBlock(end - begin, TrianglesOfCellBlock, [&](std::size_t first, std::size_t last) {
    TriangleSizes ofBlock;
    ofBlock.box = empty;
    bool isFinite = true;
    for (std::size_t n = begin + first; n < begin + last; ++n)
    {
      const PointBox box = TriangleCells::BoxOf(surface, n);
      for (const std::uint32_t corner : surface.GetTriangles()[n])
      {
        isFinite &= IsFinite(surface.GetPoints()[corner]);
      }
      ofBlock.box.Add(box);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const double length = double{ box.highest[axis] } - box.lowest[axis];
        ofBlock.longest[axis] = std::max(ofBlock.longest[axis], length);
        ofBlock.mean[axis] += length;
      }
    }
    sums[first / TrianglesOfCellBlock] = ofBlock.mean;
    const std::lock_guard<std::mutex> lock(mutex);
    sizes.box.Add(ofBlock.box);
    areFinite &= isFinite;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sizes.longest[axis] = std::max(sizes.longest[axis], ofBlock.longest[axis]);
    }
  });
  sizes.count = end - begin;
  bool areEven = areFinite && sizes.count > 0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (const auto & sum : sums)
    {
      sizes.mean[axis] += sum[axis] / static_cast<double>(sizes.count);
    }
    constexpr double mostExtent = 1e30; // in mm, so that nothing overflows
    areEven = areEven && sizes.longest[axis] <= LongestOverMean * sizes.mean[axis] &&
              double{ sizes.box.highest[axis] } - sizes.box.lowest[axis] < mostExtent;
  }
  return areEven ? std::optional<TriangleSizes>(sizes) : std::nullopt;
}

TriangleCells::TriangleCells(const TriangleSizes & sizes, double cellOverMean)
  : m_Box(sizes.box)
{
  std::array<double, 3> length;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    length[axis] = std::max(cellOverMean * sizes.mean[axis], CellOverLongest * sizes.longest[axis]);
  }
  constexpr double flat = 1e-3; // of the longest, the least
  const double least = std::max(flat * *std::max_element(length.begin(), length.end()), 1e-30);
  double scale = 1.0, cells = 0.0;
  do
  {
    cells = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_CellsPerMillimetre[axis] = static_cast<float>(1.0 / (scale * std::max(length[axis], least)));
      const double extent = double{ m_Box.highest[axis] } - m_Box.lowest[axis];
      const double size = 3.0 + std::floor(extent * m_CellsPerMillimetre[axis]);
      cells *= size;
      m_Sizes[axis] = static_cast<std::size_t>(std::min(size, 1e9));
    }
    scale *= 1.25;
  } while (cells > 2.0 * static_cast<double>(sizes.count) + 4096.0);
}

void
TriangleRegion::Add(const PointBox & box)
{
  m_Cells.AllOf(box, [this](std::size_t cell) {
    m_IsIn[cell] = 1;
    return true;
  });
}

BulkVector<std::uint32_t>
TriangleRegion::FindTriangles(const TriangleSurface & surface) const
{
  // The first corners of these triangles are in the region or in cells that touch it.
  BulkVector<std::uint8_t> isNear = m_IsIn;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const std::size_t stride = m_Cells.GetStride(axis);
    const BulkVector<std::uint8_t> copy = isNear;
    const std::uint8_t * const before = copy.data(); // pointers, so that compilers use vector instructions
    std::uint8_t * const after = isNear.data();
    const std::size_t end = copy.size() - std::min(copy.size(), stride);
    for (std::size_t cell = stride; cell < end; ++cell)
    {
      after[cell] |= before[cell - stride] | before[cell + stride]; // and some at the other end of the row
    }
  }
  BulkVector<std::uint32_t> triangles;
  std::mutex mutex;
  rhombic::ForEachBlock(surface.GetNumberOfTriangles(), TrianglesOfCellBlock, [&](std::size_t begin, std::size_t end) {
    BulkVector<std::uint32_t> found;
    for (std::size_t n = begin; n < end; ++n)
    {
      if (isNear[m_Cells.Find(surface.GetPoints()[surface.GetTriangles()[n][0]])] != 0 &&
          !m_Cells.AllOf(TriangleCells::BoxOf(surface, n), [this](std::size_t cell) { return m_IsIn[cell] == 0; }))
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
