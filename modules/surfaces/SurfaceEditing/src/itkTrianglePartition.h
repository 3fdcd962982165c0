#ifndef itkTrianglePartition_h
#define itkTrianglePartition_h

#include "itkTriangleSurface.h"

namespace itk
{

/** Triangles [begin, end) of an array. */
struct TriangleRange
{
  std::size_t begin;
  std::size_t end;

  std::size_t
  Size() const
  {
    return end - begin;
  }
};

/** Sorts triangles into compact ranges of at most \a mostTriangles. Larger ranges are cut in two across their longest
 * side; the first part has the share \a cut of the triangles. \a ids are sorted as the triangles are. Time O(n log n),
 * on several threads with the same result for any number of them; memory 28 bytes per triangle while it runs. */
std::vector<TriangleRange>
SortIntoRanges(const TriangleSurface::PointsContainer & points,
               TriangleSurface::TrianglesContainer & triangles,
               BulkVector<std::uint32_t> & ids,
               std::size_t mostTriangles,
               double cut);

} // namespace itk

#endif
