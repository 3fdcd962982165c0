#ifndef rhombicBCCCells_h
#define rhombicBCCCells_h

#include "detail/itkLatticeCellCases.h"

namespace rhombic
{

/** \file
 * Cells of the BCC lattice, whose sites have coordinates that are all even or all odd: tetrahedra of its Delaunay
 * tessellation, clustered about one of their edges. The idea is that of the papers that clustered them into octahedra
 * or hexahedra to have fewer cells; which edges they took is our reading.
 *
 * The tetrahedra about an edge, the cluster's axis, are the joins of the edge with each side of the ring around it. So
 * the cases of the whole cell connect what the tetrahedra connect: if an end of the axis is inside, all corners inside
 * are connected in the cell, and the same is true outside; if both ends are outside, corners inside form stretches of
 * the ring, with a cap each, or the whole ring, about which there is a band. Ambiguous faces are cut along their short
 * diagonals, which are edges of tetrahedra. Surfaces have the connectivity of those of the tetrahedra, with fewer
 * triangles. */

/** The steps along the edges of the tetrahedra. Type n - 1 is the sum of those of the three steps (-1, 1, 1), (1, -1,
 * 1) and (1, 1, -1) whose bits are set in n. */
inline constexpr std::array<itk::FCCLattice::SiteType, 7> BCCEdges{
  { { -1, 1, 1 }, { 1, -1, 1 }, { 0, 0, 2 }, { 1, 1, -1 }, { 0, 2, 0 }, { 2, 0, 0 }, { 1, 1, 1 } }
};

/** The four tetrahedra about a long edge that lies along an axis: its ends are two neighbouring sites of one cubic
 * lattice, and the ring is a square of the other lattice. Each tetrahedron has a long edge of either lattice, so the
 * octahedra about those of even sites fill space, three for each even site; all their faces are triangles. */
template <unsigned int VAxis>
struct BCCOctahedron
{
  static constexpr bool OnEvenSitesOnly = true;

  static constexpr itk::LatticeCell
  Make()
  {
    constexpr int alongX[6][3]{ { 0, 0, 0 }, { 2, 0, 0 }, { 1, -1, -1 }, { 1, 1, -1 }, { 1, -1, 1 }, { 1, 1, 1 } };
    itk::LatticeCell::SiteType corners[6]{};
    for (unsigned int corner = 0; corner < 6; ++corner)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        corners[corner][(axis + VAxis) % 3] = alongX[corner][axis];
      }
    }
    return itk::LatticeCell::FromCorners(BCCEdges, corners);
  }

  static constexpr itk::LatticeCell Cell = Make();
  static constexpr itk::LatticeCellCases<6> Cases = itk::LatticeCellCases<6>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

/** The six tetrahedra about a short edge, (1, 1, 1): a rhombohedron whose edges are the other three short ones. One for
 * each site. Those about short edges of one direction fill space. */
struct BCCHexahedron
{
  static constexpr bool OnEvenSitesOnly = false;
  static constexpr itk::LatticeCell::SiteType Corners[8] = { { 0, 0, 0 },  { -1, 1, 1 }, { 1, -1, 1 }, { 0, 0, 2 },
                                                             { 1, 1, -1 }, { 0, 2, 0 },  { 2, 0, 0 },  { 1, 1, 1 } };
  static constexpr itk::LatticeCell Cell = itk::LatticeCell::FromCorners(BCCEdges, Corners);
  static constexpr itk::LatticeCellCases<8> Cases = itk::LatticeCellCases<8>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

} // namespace rhombic

#endif
