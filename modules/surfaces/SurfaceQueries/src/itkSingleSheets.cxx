// Why each pair of triangles that cross is found. Take a cell, an axis, and the lines along the axis through the cell.
// Cells of this column that follow each other are linked if a triangle whose box meets the column reaches from one to
// the next. The cell and all linked to it are its run: within the column, no triangle leaves the run.
// * The surface is closed: each edge bounds as many triangles in one direction as in the other. Where a line moves
//   across an edge, the triangles at that place of the edge are all in the run, and the crossings gained and lost
//   cancel, if each counts with the side from which the line comes. So all lines cross the run equally often.
// * All triangles of the run face the same way along the axis, so that all crossings count the same. Each line crosses
//   as many triangles as the one through the middle, for which they are counted: at most one. (Lines through edges and
//   corners are left aside.)
// * If two triangles crossed in the cell, a point of one would lie inside the other, and as neither is parallel to the
//   axis, many lines near that point would cross both.
// A pair that crosses does so in some cell, and the boxes of both triangles meet that cell.
#include "detail/itkPositionArithmetic.h"
#include "detail/itkSingleSheets.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

namespace itk
{
namespace
{

constexpr std::size_t TrianglesOfSheetBlock = 16384;
constexpr double SheetCellOverMean = 2.5;
constexpr std::size_t LeastForSheets = 100'000; // triangles; below, the search of all takes no time
constexpr double LeastShare = 0.75;             // of cells that are single sheets, for the proof to pay
constexpr double RoundingOfProducts = 1e-14;    // of a product of two lengths, over these; generous

/** What is known of the triangles that meet a cell. */
namespace Mark
{
constexpr unsigned int
OfBit(unsigned int bit)
{
  return 1U << bit;
}
constexpr unsigned int Met = OfBit(0);
/** A triangle does not certainly face up along the axis. */
constexpr unsigned int
NotUp(unsigned int axis)
{
  return OfBit(1 + axis);
}
constexpr unsigned int
NotDown(unsigned int axis)
{
  return OfBit(4 + axis);
}
/** A triangle reaches to the next cell along the axis. */
constexpr unsigned int
Linked(unsigned int axis)
{
  return OfBit(7 + axis);
}
/** The line through the cell's middle crosses a triangle that begins here. */
constexpr unsigned int
Once(unsigned int axis)
{
  return OfBit(10 + axis);
}
/** It crosses several, or may do so. */
constexpr unsigned int
Twice(unsigned int axis)
{
  return OfBit(13 + axis);
}
} // namespace Mark

using PointType = TriangleSurface::PointType;
using Corners = std::array<PointType, 3>;

double
LengthOf(double u, double v)
{
  return std::abs(u) + std::abs(v);
}

/** The marks of a triangle for its directions: which way it certainly faces. */
unsigned int
MarkFacing(const Corners & corners)
{
  const PositionType u = Subtract(ToPosition(corners[1]), ToPosition(corners[0]));
  const PositionType v = Subtract(ToPosition(corners[2]), ToPosition(corners[0]));
  const PositionType normal = Cross(u, v);
  const double bound =
    RoundingOfProducts * (LengthOf(u[0], u[1]) + std::abs(u[2])) * (LengthOf(v[0], v[1]) + std::abs(v[2]));
  unsigned int marks = Mark::Met;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    marks |= normal[axis] > bound ? 0 : Mark::NotUp(axis);
    marks |= normal[axis] < -bound ? 0 : Mark::NotDown(axis);
  }
  return marks;
}

enum class Meeting
{
  No,
  Yes,
  Unsure
};

/** Whether a line along an axis crosses a triangle. \param middle the line's coordinates along the axes u and v */
Meeting
MeetsLine(const Corners & corners, unsigned int u, unsigned int v, const std::array<double, 2> & middle)
{
  bool isLeft = true, isRight = true, isSomeLeft = false, isSomeRight = false;
  for (unsigned int n = 0; n < 3; ++n)
  {
    const PointType & from = corners[n];
    const PointType & to = corners[(n + 1) % 3];
    const double du = double{ to[u] } - from[u], dv = double{ to[v] } - from[v];
    const double pu = middle[0] - from[u], pv = middle[1] - from[v];
    const double turn = du * pv - dv * pu;
    const double bound = RoundingOfProducts * LengthOf(du, dv) * LengthOf(pu, pv);
    isSomeLeft |= turn > bound;
    isSomeRight |= turn < -bound;
    isLeft &= turn > bound;
    isRight &= turn < -bound;
  }
  return isLeft || isRight ? Meeting::Yes : isSomeLeft && isSomeRight ? Meeting::No : Meeting::Unsure;
}

/** A number for the edge between two points, the same with the other sign for the way back. The sum over the edges of a
 * closed surface is 0; that of an open one is 0 by a chance of 2^-64. */
std::uint64_t
NumberOfEdge(std::uint32_t from, std::uint32_t to)
{
  std::uint64_t number = std::uint64_t{ std::min(from, to) } << 32 | std::max(from, to);
  number = (number ^ number >> 33) * 0xff51afd7ed558ccdU;
  number = (number ^ number >> 33) * 0xc4ceb9fe1a85ec53U;
  number ^= number >> 33;
  return from < to ? number : ~number + 1;
}

/** \class SheetCells
 * \brief Cells with marks of the triangles that meet them. */
class SheetCells
{
public:
  SheetCells(const TriangleSurface & surface, const TriangleCells & cells)
    : m_Surface(surface)
    , m_Cells(cells)
    , m_Marks(cells.GetNumberOfCells())
    , m_AreSingle(cells.GetNumberOfCells(), 0)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      for (std::size_t cell = 0; cell < cells.GetSize(axis); ++cell)
      {
        const float middle = cells.GetMiddle(cell, axis);
        m_AreMiddlesInCells &= cell == 0 || cell + 1 == cells.GetSize(axis) || cells.Find(middle, axis) == cell;
        m_Middles[axis].push_back(middle);
      }
    }
  }

  /** Marks the cells that triangles [begin, end) meet. Returns the sum of the numbers of their edges. */
  std::uint64_t
  MarkTriangles(std::size_t begin, std::size_t end)
  {
    std::atomic<std::uint64_t> edges{ 0 };
    rhombic::ForEachBlock(end - begin, TrianglesOfSheetBlock, [&](std::size_t first, std::size_t last) {
      std::uint64_t ofBlock = 0;
      for (std::size_t n = begin + first; n < begin + last; ++n)
      {
        const auto & [a, b, c] = m_Surface.GetTriangles()[n];
        ofBlock += NumberOfEdge(a, b) + NumberOfEdge(b, c) + NumberOfEdge(c, a);
        this->MarkTriangle({ m_Surface.GetPoints()[a], m_Surface.GetPoints()[b], m_Surface.GetPoints()[c] });
      }
      edges += ofBlock;
    });
    return edges;
  }

  /** Finds the cells in which no two triangles cross. Returns their share. */
  double
  FindSingle()
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const unsigned int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2; // columns that follow each other are neighbours
      rhombic::ForEachInBlocks(m_Cells.GetSize(u) * m_Cells.GetSize(v), 256, [&](std::size_t column) {
        const std::size_t first =
          column % m_Cells.GetSize(u) * m_Cells.GetStride(u) + column / m_Cells.GetSize(u) * m_Cells.GetStride(v);
        this->FindSingleOfColumn(axis, first);
      });
    }
    std::size_t met = 0, single = 0;
    for (std::size_t cell = 0; cell < m_Marks.size(); ++cell)
    {
      met += (m_Marks[cell].load(std::memory_order_relaxed) & Mark::Met) != 0 ? 1 : 0;
      single += m_AreSingle[cell];
    }
    return m_AreMiddlesInCells && met > 0 ? static_cast<double>(single) / static_cast<double>(met) : 0.0;
  }

  /** The triangles that meet other cells. */
  BulkVector<std::uint32_t>
  FindOthers() const
  {
    BulkVector<std::uint32_t> others;
    std::mutex mutex;
    rhombic::ForEachBlock(
      m_Surface.GetNumberOfTriangles(), TrianglesOfSheetBlock, [&](std::size_t begin, std::size_t end) {
        BulkVector<std::uint32_t> found;
        for (std::size_t n = begin; n < end; ++n)
        {
          if (!m_Cells.AllOf(TriangleCells::BoxOf(m_Surface, n),
                             [this](std::size_t cell) { return m_AreSingle[cell] != 0; }))
          {
            found.push_back(static_cast<std::uint32_t>(n));
          }
        }
        const std::lock_guard<std::mutex> lock(mutex);
        others.insert(others.end(), found.begin(), found.end());
      });
    return others;
  }

private:
  /** Returns the cell's marks before. */
  unsigned int
  Set(std::size_t cell, unsigned int marks)
  {
    const unsigned int before = m_Marks[cell].load(std::memory_order_relaxed);
    return (before & marks) == marks
             ? before
             : m_Marks[cell].fetch_or(static_cast<std::uint16_t>(marks), std::memory_order_relaxed);
  }

  void
  MarkTriangle(const Corners & corners)
  {
    PointBox box{ corners[0], corners[0] };
    box.Add(corners[1]);
    box.Add(corners[2]);
    const auto [first, last] = m_Cells.FindEnds(box);
    const unsigned int facing = MarkFacing(corners);
    for (std::size_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::size_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::size_t x = first[0]; x <= last[0]; ++x)
        {
          const unsigned int links = (x < last[0] ? Mark::Linked(0) : 0) | (y < last[1] ? Mark::Linked(1) : 0) |
                                     (z < last[2] ? Mark::Linked(2) : 0);
          this->Set(x + y * m_Cells.GetStride(1) + z * m_Cells.GetStride(2), facing | links);
        }
      }
    }
    auto middles = std::array<std::array<std::size_t, 3>, 2>{ first, last }; // those within the box
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      middles[0][axis] += m_Middles[axis][first[axis]] < box.lowest[axis] ? 1 : 0;
      middles[1][axis] += m_Middles[axis][last[axis]] > box.highest[axis] ? 0 : 1;
    }
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      this->MarkLines(corners, middles, axis, first[axis]);
    }
  }

  /** Marks where lines along an axis through the middles of cells cross a triangle: in its first cell along the axis.
   */
  void
  MarkLines(const Corners & corners,
            const std::array<std::array<std::size_t, 3>, 2> & middles,
            unsigned int axis,
            std::size_t first)
  {
    const unsigned int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t atV = middles[0][v]; atV < middles[1][v]; ++atV)
    {
      for (std::size_t atU = middles[0][u]; atU < middles[1][u]; ++atU)
      {
        const Meeting meeting = MeetsLine(corners, u, v, { m_Middles[u][atU], m_Middles[v][atV] });
        if (meeting != Meeting::No)
        {
          const std::size_t cell =
            atU * m_Cells.GetStride(u) + atV * m_Cells.GetStride(v) + first * m_Cells.GetStride(axis);
          const bool isFirst = meeting == Meeting::Yes && (this->Set(cell, Mark::Once(axis)) & Mark::Once(axis)) == 0;
          isFirst ? 0 : this->Set(cell, Mark::Twice(axis));
        }
      }
    }
  }

  void
  FindSingleOfColumn(unsigned int axis, std::size_t column)
  {
    const std::size_t stride = m_Cells.GetStride(axis);
    for (std::size_t begin = 0, end = 0; begin < m_Cells.GetSize(axis); begin = end)
    {
      unsigned int marks = 0, crossings = 0;
      bool isLinked = true;
      for (end = begin; isLinked && end < m_Cells.GetSize(axis); ++end)
      {
        const unsigned int ofCell = m_Marks[column + end * stride].load(std::memory_order_relaxed);
        marks |= ofCell;
        crossings += (ofCell & Mark::Once(axis)) != 0 ? 1 : 0;
        isLinked = (ofCell & Mark::Linked(axis)) != 0;
      }
      const bool faceOneWay = (marks & Mark::NotUp(axis)) == 0 || (marks & Mark::NotDown(axis)) == 0;
      if ((marks & Mark::Met) != 0 && faceOneWay && crossings <= 1 && (marks & Mark::Twice(axis)) == 0)
      {
        for (std::size_t cell = begin; cell < end; ++cell)
        {
          m_AreSingle[column + cell * stride] = 1;
        }
      }
    }
  }

  const TriangleSurface & m_Surface;
  const TriangleCells & m_Cells;
  std::vector<std::atomic<std::uint16_t>> m_Marks;
  BulkVector<std::uint8_t> m_AreSingle;
  std::array<std::vector<float>, 3> m_Middles; ///< of the cells along each axis
  bool m_AreMiddlesInCells = true;
};

/** Whether most cells that some of the surface's triangles meet are single sheets, as far as these triangles show. */
bool
IsSmooth(const TriangleSurface & surface)
{
  const std::size_t middle = surface.GetNumberOfTriangles() / 2, few = surface.GetNumberOfTriangles() / 64;
  const auto sizes = TriangleSizes::Find(surface, middle - few, middle + few);
  if (!sizes)
  {
    return false;
  }
  const TriangleCells cells(*sizes, SheetCellOverMean);
  SheetCells sheets(surface, cells);
  sheets.MarkTriangles(middle - few, middle + few);
  return sheets.FindSingle() >= LeastShare;
}

} // namespace

std::optional<BulkVector<std::uint32_t>>
FindTrianglesOutsideSingleSheets(const TriangleSurface & surface, const TriangleSizes & sizes)
{
  if (sizes.count < LeastForSheets || !IsSmooth(surface))
  {
    return std::nullopt;
  }
  const TriangleCells cells(sizes, SheetCellOverMean);
  SheetCells sheets(surface, cells);
  const std::uint64_t edges = sheets.MarkTriangles(0, sizes.count);
  return edges == 0 && sheets.FindSingle() >= LeastShare ? std::optional<BulkVector<std::uint32_t>>(sheets.FindOthers())
                                                         : std::nullopt;
}

} // namespace itk
