#include "itkTrianglePartition.h"

#include "rhombicForEachBlock.h"

#include <algorithm>

namespace itk
{
namespace
{

struct CentredTriangle
{
  TriangleSurface::PointType centre; ///< times 3
  TriangleSurface::TriangleType corners;
  std::uint32_t id;
};

using CentredTriangles = BulkVector<CentredTriangle>;

constexpr std::size_t BlockSize = 4096;

/** Moves the share \a cut of a range's triangles, with the least coordinates along its longest side, to the front.
 * Returns where the others begin. */
std::size_t
Split(CentredTriangles & triangles, const TriangleRange & range, double cut)
{
  PointBox box{ triangles[range.begin].centre, triangles[range.begin].centre };
  for (std::size_t id = range.begin; id < range.end; ++id)
  {
    box.Add(triangles[id].centre);
  }
  const unsigned int axis = box.FindLongestAxis();
  const std::size_t middle = range.begin + static_cast<std::size_t>(cut * static_cast<double>(range.Size()));
  std::nth_element(
    triangles.data() + range.begin,
    triangles.data() + middle,
    triangles.data() + range.end,
    [axis](const CentredTriangle & a, const CentredTriangle & b) { return a.centre[axis] < b.centre[axis]; });
  return middle;
}

} // namespace

std::vector<TriangleRange>
SortIntoRanges(const TriangleSurface::PointsContainer & points,
               TriangleSurface::TrianglesContainer & triangles,
               BulkVector<std::uint32_t> & ids,
               std::size_t mostTriangles,
               double cut)
{
  CentredTriangles centred(triangles.size());
  rhombic::ForEachInBlocks(triangles.size(), BlockSize, [&](std::size_t id) {
    centred[id].corners = triangles[id];
    centred[id].id = ids[id];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      centred[id].centre[axis] =
        points[triangles[id][0]][axis] + points[triangles[id][1]][axis] + points[triangles[id][2]][axis];
    }
  });

  std::vector<TriangleRange> ranges; // small enough
  std::vector<TriangleRange> large{ { 0, triangles.size() } };
  while (!large.empty())
  {
    std::vector<std::size_t> middles(large.size());
    rhombic::ForEachInBlocks(large.size(), 1, [&](std::size_t n) {
      middles[n] = large[n].Size() > mostTriangles ? Split(centred, large[n], cut) : large[n].end;
    });
    std::vector<TriangleRange> next;
    for (std::size_t n = 0; n < large.size(); ++n)
    {
      if (middles[n] == large[n].end)
      {
        ranges.push_back(large[n]);
        continue;
      }
      next.push_back({ large[n].begin, middles[n] });
      next.push_back({ middles[n], large[n].end });
    }
    large.swap(next);
  }
  rhombic::ForEachInBlocks(triangles.size(), BlockSize, [&](std::size_t id) {
    triangles[id] = centred[id].corners;
    ids[id] = centred[id].id;
  });
  return ranges;
}

} // namespace itk
