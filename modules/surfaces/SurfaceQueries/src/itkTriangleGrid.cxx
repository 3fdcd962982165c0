#include "detail/itkTriangleGrid.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace itk
{
namespace
{

constexpr std::size_t TrianglesOfGridBlock = 16384;
constexpr double CellOverMean = 4.0;     // length of a cell, over that of the triangles' boxes
constexpr double CellOverLongest = 1.01; // at least, over that of the longest
constexpr double LongestOverMean = 8.0;  // at most
constexpr float StepsOfSurface = 65000.0f;
constexpr float LeastStep = -32500.0f;

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

std::optional<TriangleGrid>
TriangleGrid::Make(const TriangleSurface & surface, const std::vector<std::uint8_t> & areUnfolded)
{
  TriangleGrid grid(surface);
  if (surface.GetNumberOfTriangles() == 0 || !grid.FindSizes())
  {
    return std::nullopt;
  }
  grid.Fill(areUnfolded);
  return grid;
}

/** Finds the surface's box and the sizes of cells. Returns whether a grid is of use. */
bool
TriangleGrid::FindSizes()
{
  const auto & points = m_Surface->GetPoints();
  if (!std::all_of(points.begin(), points.end(), [](const PointType & point) { return IsFinite(point); }))
  {
    return false;
  }
  PointBox whole{ points.front(), points.front() };
  for (const PointType & point : points)
  {
    whole.Add(point);
  }
  m_Lowest = whole.lowest;
  const std::size_t count = m_Surface->GetNumberOfTriangles();
  std::vector<BoxLengths> ofBlocks((count + TrianglesOfGridBlock - 1) / TrianglesOfGridBlock);
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [&](std::size_t n) {
    ofBlocks[n / TrianglesOfGridBlock].Add(this->BoxOf(static_cast<std::uint32_t>(n)));
  });
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
    length[axis] = std::max(CellOverMean * mean, CellOverLongest * ofAxis);
    longest = std::max(longest, length[axis]);
  }
  constexpr double flat = 1e-3;                            // of the longest, the least
  constexpr double leastExtent = 1e-30, mostExtent = 1e30; // in mm, so that nothing overflows
  double scale = 1.0, cells = 0.0;
  do
  {
    cells = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_CellsPerMillimetre[axis] = longest > 0.0 ? 1.0 / (scale * std::max(length[axis], flat * longest)) : 0.0;
      const double extent = double{ whole.highest[axis] } - whole.lowest[axis];
      if (extent > mostExtent)
      {
        return false;
      }
      const double size = 3.0 + std::floor(extent * m_CellsPerMillimetre[axis]);
      cells *= size;
      m_Sizes[axis] = static_cast<std::size_t>(size);
      m_StepsPerMillimetre[axis] = extent > leastExtent ? StepsOfSurface / static_cast<float>(extent) : 0.0f;
    }
    scale *= 1.25;
  } while (cells > 2.0 * static_cast<double>(count) + 4096.0);
  return true;
}

/** Sorts the triangles into the cells: counts, sums, and entries filled in from the end of each cell. */
void
TriangleGrid::Fill(const std::vector<std::uint8_t> & areUnfolded)
{
  const std::size_t count = m_Surface->GetNumberOfTriangles();
  m_Begins = std::vector<std::atomic<std::uint32_t>>(m_Sizes[0] * m_Sizes[1] * m_Sizes[2] + 1);
  m_Entries.resize(count);
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [this](std::size_t n) {
    m_Begins[this->CellOf(this->BoxOf(static_cast<std::uint32_t>(n)))].fetch_add(1, std::memory_order_relaxed);
  });
  std::uint32_t sum = 0;
  for (auto & begin : m_Begins)
  {
    sum += begin.load(std::memory_order_relaxed);
    begin.store(sum, std::memory_order_relaxed);
  }
  rhombic::ForEachInBlocks(count, TrianglesOfGridBlock, [this, &areUnfolded](std::size_t n) {
    const auto triangle = static_cast<std::uint32_t>(n);
    const PointBox box = this->BoxOf(triangle);
    Entry entry{ {}, triangle, m_Surface->GetTriangles()[n] };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto stepOf = [&](float coordinate) {
        return static_cast<std::int16_t>(LeastStep + (coordinate - m_Lowest[axis]) * m_StepsPerMillimetre[axis]);
      };
      entry.box[axis] = stepOf(box.lowest[axis]);
      entry.box[axis + 3] = stepOf(box.highest[axis]);
    }
    for (std::uint32_t & corner : entry.unfoldedCorners)
    {
      corner = areUnfolded[corner] != 0 ? corner : std::numeric_limits<std::uint32_t>::max();
    }
    m_Entries[m_Begins[this->CellOf(box)].fetch_sub(1, std::memory_order_relaxed) - 1] = entry;
  });
}

/** Whether \a visit(cell) is true for all cells that the box meets. */
template <typename TVisitor>
bool
TriangleGridRegion::AllCells(const PointBox & box, const TVisitor & visit) const
{
  std::array<std::size_t, 3> low, high;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    low[axis] = m_Grid.CellOf(double{ box.lowest[axis] }, axis);
    high[axis] = m_Grid.CellOf(double{ box.highest[axis] }, axis);
  }
  for (std::size_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::size_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::size_t x = low[0]; x <= high[0]; ++x)
      {
        if (!visit((z * m_Grid.m_Sizes[1] + y) * m_Grid.m_Sizes[0] + x))
        {
          return false;
        }
      }
    }
  }
  return true;
}

void
TriangleGridRegion::Add(const PointBox & box)
{
  this->AllCells(box, [this](std::size_t cell) {
    m_IsIn[cell] = 1;
    return true;
  });
}

bool
TriangleGridRegion::Holds(const PointBox & box) const
{
  return this->AllCells(box, [this](std::size_t cell) { return m_IsIn[cell] != 0; });
}

std::vector<std::uint32_t>
TriangleGridRegion::FindTriangles() const
{
  constexpr std::size_t blockOfCells = 4096;
  const std::size_t row = m_Grid.m_Sizes[0], plane = row * m_Grid.m_Sizes[1];
  std::vector<std::uint32_t> triangles;
  std::mutex mutex;
  rhombic::ForEachBlock(m_IsIn.size(), blockOfCells, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> found;
    for (std::size_t cell = begin; cell < end; ++cell)
    {
      const TriangleGrid::Entry *first = m_Grid.EntriesFrom(cell), *last = m_Grid.EntriesFrom(cell + 1);
      // The outermost cells are empty, so that all cells with triangles have 26 around them.
      const auto isNear = [&] {
        for (const std::size_t inPlane : { cell - plane, cell, cell + plane })
        {
          for (const std::size_t inRow : { inPlane - row, inPlane, inPlane + row })
          {
            if (m_IsIn[inRow - 1] != 0 || m_IsIn[inRow] != 0 || m_IsIn[inRow + 1] != 0)
            {
              return true;
            }
          }
        }
        return false;
      };
      for (const TriangleGrid::Entry * entry = first != last && isNear() ? first : last; entry != last; ++entry)
      {
        if (m_IsIn[cell] != 0 ||
            !this->AllCells(m_Grid.BoxOf(entry->triangle), [this](std::size_t met) { return m_IsIn[met] == 0; }))
        {
          found.push_back(entry->triangle);
        }
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    triangles.insert(triangles.end(), found.begin(), found.end());
  });
  return triangles;
}

} // namespace itk
