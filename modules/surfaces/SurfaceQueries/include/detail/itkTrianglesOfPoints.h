#ifndef itkTrianglesOfPoints_h
#define itkTrianglesOfPoints_h

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurface.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <vector>

namespace itk
{

/** Sorts ids and removes repeated ids. */
template <typename TIds>
void
SortUnique(TIds & ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/** Calls \a work(begin, end, found) for blocks of [0, size), on several threads. Returns the ids that the calls append
 * to \a found, sorted, each of them once. */
template <typename TWork>
BulkVector<std::uint32_t>
CollectIds(std::size_t size, std::size_t blockSize, const TWork & work)
{
  BulkVector<std::uint32_t> ids;
  std::mutex mutex;
  rhombic::ForEachBlock(size, blockSize, [&](std::size_t begin, std::size_t end) {
    BulkVector<std::uint32_t> ofBlock;
    work(begin, end, ofBlock);
    const std::lock_guard<std::mutex> lock(mutex);
    ids.insert(ids.end(), ofBlock.begin(), ofBlock.end());
  });
  SortUnique(ids);
  return ids;
}

/** \class TrianglesOfPoints
 * \brief The ids of the triangles at each point of a surface, ascending. A change of the triangles invalidates it. */
class TrianglesOfPoints
{
public:
  explicit TrianglesOfPoints(const TriangleSurface & surface)
    : m_Triangles(surface.GetTriangles())
    , m_Begin(surface.GetNumberOfPoints() + 1, 0)
    , m_Ids(3 * surface.GetNumberOfTriangles())
  {
    const std::vector<PointRange> blocks = this->FindPointRanges();
    this->ForEachCorner(blocks, [&](std::size_t, std::uint32_t point) { ++m_Begin[point]; });
    // The sums are where each point's ids end; filling them in from the last id on moves them to where they begin.
    std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
    this->ForEachCorner(
      blocks, [&](std::size_t id, std::uint32_t point) { m_Ids[--m_Begin[point]] = static_cast<std::uint32_t>(id); });
  }

  std::size_t
  GetNumberOfTriangles(std::size_t point) const
  {
    return m_Begin[point + 1] - m_Begin[point];
  }

  /** Calls \a visit(id) for each triangle at a point. */
  template <typename TVisitor>
  void
  VisitTriangles(std::size_t point, const TVisitor & visit) const
  {
    for (std::size_t n = m_Begin[point]; n < m_Begin[point + 1]; ++n)
    {
      visit(m_Ids[n]);
    }
  }

  /** Calls \a visit(next, last) for each triangle {point, next, last}. */
  template <typename TVisitor>
  void
  VisitNeighbours(std::size_t point, const TVisitor & visit) const
  {
    this->VisitTriangles(point, [&](std::uint32_t id) {
      const auto & triangle = m_Triangles[id];
      const unsigned int corner = triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
      visit(triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
    });
  }

private:
  static constexpr std::size_t BlockOfTriangles = 16384;

  struct PointRange
  {
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t last = 0;
  };

  /** The points of each block of triangles, from the least to the greatest. */
  std::vector<PointRange>
  FindPointRanges() const
  {
    std::vector<PointRange> ranges((m_Triangles.size() + BlockOfTriangles - 1) / BlockOfTriangles);
    rhombic::ForEachBlock(m_Triangles.size(), BlockOfTriangles, [&](std::size_t begin, std::size_t end) {
      PointRange range;
      for (std::size_t id = begin; id < end; ++id)
      {
        const auto [first, last] = std::minmax({ m_Triangles[id][0], m_Triangles[id][1], m_Triangles[id][2] });
        range = { std::min(range.first, first), std::max(range.last, last) };
      }
      ranges[begin / BlockOfTriangles] = range;
    });
    return ranges;
  }

  /** Calls \a work(id, point) for each corner of each triangle, on several threads, but on one for each point: from the
   * last triangle at the point to the first. Each thread has one block of points, as it looks at all blocks of
   * triangles with points in it: all triangles, where these are in no order. */
  template <typename TWork>
  void
  ForEachCorner(const std::vector<PointRange> & blocks, const TWork & work) const
  {
    constexpr std::size_t fewestPoints = 65536;
    const std::size_t points = m_Begin.size() - 1;
    const std::size_t ofThread = points / MultiThreaderBase::GetGlobalDefaultNumberOfThreads() + 1;
    rhombic::ForEachBlock(points, std::max(fewestPoints, ofThread), [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = blocks.size(); block-- > 0;)
      {
        if (blocks[block].last < begin || blocks[block].first >= end)
        {
          continue;
        }
        const std::size_t first = block * BlockOfTriangles;
        for (std::size_t id = std::min(m_Triangles.size(), first + BlockOfTriangles); id-- > first;)
        {
          for (const std::uint32_t point : m_Triangles[id])
          {
            if (point >= begin && point < end)
            {
              work(id, point);
            }
          }
        }
      }
    });
  }

  const TriangleSurface::TrianglesContainer & m_Triangles;
  BulkVector<std::size_t> m_Begin; ///< index of each point's first id, and the end of the last
  BulkVector<std::uint32_t> m_Ids;
};

} // namespace itk

#endif
