#ifndef itkSumInOrder_h
#define itkSumInOrder_h

#include "detail/itkPositionArithmetic.h"
#include "itkLabelWalls.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <vector>

namespace itk
{

/** Calls use(n, compute(n)) for n < size in their order, on this thread alone, so that sums are the same for any number
 * of threads; compute(n) on several threads, for some thousand n at a time. */
template <typename TCompute, typename TUse>
void
SumInOrder(std::size_t size, const TCompute & compute, const TUse & use)
{
  constexpr std::size_t portion = 131072;
  constexpr std::size_t block = 4096;
  std::vector<decltype(compute(std::size_t{}))> computed(std::min(portion, size));
  for (std::size_t begin = 0; begin < size; begin += portion)
  {
    const std::size_t count = std::min(portion, size - begin);
    rhombic::ForEachInBlocks(count, block, [&](std::size_t n) { computed[n] = compute(begin + n); });
    for (std::size_t n = 0; n < count; ++n)
    {
      use(begin + n, computed[n]);
    }
  }
}

/** A point near walls: positions relative to it keep their digits. */
inline PositionType
FindOrigin(const LabelWalls & walls)
{
  return walls.GetPoints().empty() ? PositionType{} : ToPosition(walls.GetPoints().front());
}

/** The volume between a triangle and a point, which adds to that of the label behind the triangle. */
inline double
FindVolumeOfTriangle(const LabelWalls & walls, std::size_t triangle, const PositionType & origin)
{
  CornersType corners = CornersOf(walls, walls.GetTriangles()[triangle]);
  for (PositionType & corner : corners)
  {
    corner = Subtract(corner, origin);
  }
  return Dot(corners[0], AreaVector(corners)) / 6.0;
}

} // namespace itk

#endif
