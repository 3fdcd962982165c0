#ifndef itkTrianglesOfPoints_h
#define itkTrianglesOfPoints_h

#include "itkTriangleSurface.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <mutex>
#include <numeric>

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
    for (const auto & triangle : m_Triangles)
    {
      for (const std::uint32_t point : triangle)
      {
        ++m_Begin[point];
      }
    }
    // The sums are where each point's ids end; filling them in from the last id on moves them to where they begin.
    std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
    for (std::size_t id = m_Triangles.size(); id-- > 0;)
    {
      for (const std::uint32_t point : m_Triangles[id])
      {
        m_Ids[--m_Begin[point]] = static_cast<std::uint32_t>(id);
      }
    }
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
  const TriangleSurface::TrianglesContainer & m_Triangles;
  BulkVector<std::size_t> m_Begin; ///< index of each point's first id, and the end of the last
  BulkVector<std::uint32_t> m_Ids;
};

} // namespace itk

#endif
