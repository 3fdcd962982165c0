#ifndef itkCurveOrder_h
#define itkCurveOrder_h

#include "itkTriangleSurface.h"

namespace itk
{

/** A triangle, and the number along a curve through space of the grid cell with the centre of its box. */
struct CurvePlace
{
  std::uint64_t cell;
  std::uint32_t triangle;

  bool
  operator<(const CurvePlace & other) const
  {
    return cell != other.cell ? cell < other.cell : triangle < other.triangle;
  }
};
using CurvePlaces = std::vector<CurvePlace, BulkAllocator<CurvePlace>>;

/** Sorts triangles along a Z-order curve (G. Morton, 1966) through the cells of a grid, 2^21 along the longest side of
 * the box around the triangles: two triangles whose cells have their highest n bits in common lie in one of 2^n boxes
 * of about the same size. Positions must be finite.
 *
 * Nearly linear time, on several threads with the same result for any number of them; memory 16 bytes per triangle more
 * than the result. */
CurvePlaces
SortAlongCurve(const TriangleSurface & surface, const std::vector<std::uint32_t> & triangles);

} // namespace itk

#endif
