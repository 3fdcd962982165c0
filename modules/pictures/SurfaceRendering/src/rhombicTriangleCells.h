#ifndef rhombicTriangleCells_h
#define rhombicTriangleCells_h

#include "itkTriangleSurface.h"

#include <array>
#include <vector>

namespace rhombic
{

/** Consecutive triangles, and the box around them. */
struct TriangleCell
{
  std::array<float, 3> lowest;
  std::array<float, 3> highest;
  std::size_t firstTriangle;
  std::size_t numberOfTriangles;
};

/** The triangles of a surface, ordered by cells of a grid. */
struct TriangleCells
{
  std::vector<itk::TriangleSurface::TriangleType> triangles;
  std::vector<TriangleCell> cells; ///< none is empty
};

/** Orders triangles so that those near to each other follow each other, some hundreds in each cell. Then parts of the
 * surface can be drawn alone, and OpenGL uses points again that it has just transformed. */
TriangleCells
SortIntoCells(const itk::TriangleSurface * surface);

} // namespace rhombic

#endif
