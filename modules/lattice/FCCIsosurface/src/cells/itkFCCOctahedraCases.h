#ifndef itkFCCOctahedraCases_h
#define itkFCCOctahedraCases_h

#include "itkFCCCellCases.h"

namespace itk
{

/** \class FCCOctahedraCases
 * \brief The Delaunay cells of the lattice, whole: an octahedron around each odd point, and a regular tetrahedron in
 * each unit cube.
 *
 * Each site is the anchor of one octahedron, that of the odd point after it in its row, and of two tetrahedra, those of
 * the unit cubes after and before it in x, which lie after it in y and z.
 *
 * All faces are triangles, so the surface between the cells is unique. Within an octahedron, two opposite corners that
 * are inside alone, or outside alone, have a cap each.
 */
struct FCCOctahedraCases
{
  struct Octahedron
  {
    static constexpr FCCCell::SiteType Corners[6] = { { 0, 0, 0 }, { 2, 0, 0 },  { 1, -1, 0 },
                                                      { 1, 1, 0 }, { 1, 0, -1 }, { 1, 0, 1 } };
    static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
    static constexpr FCCCellCases<6> Cases = FCCCellCases<6>::Of(Cell);
  };

  struct TetrahedronAfter
  {
    static constexpr FCCCell::SiteType Corners[4] = { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } };
    static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
    static constexpr FCCCellCases<4> Cases = FCCCellCases<4>::Of(Cell);
  };

  struct TetrahedronBefore
  {
    static constexpr FCCCell::SiteType Corners[4] = { { 0, 0, 0 }, { -1, 1, 0 }, { -1, 0, 1 }, { 0, 1, 1 } };
    static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
    static constexpr FCCCellCases<4> Cases = FCCCellCases<4>::Of(Cell);
  };

  static_assert(!Octahedron::Cases.hasDiagonalOnFace && !TetrahedronAfter::Cases.hasDiagonalOnFace &&
                !TetrahedronBefore::Cases.hasDiagonalOnFace);
};

} // namespace itk

#endif
