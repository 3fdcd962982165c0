#ifndef itkFCCCellCases_h
#define itkFCCCellCases_h

#include "itkFCCCells.h"

#include "detail/itkLatticeCellCases.h"

namespace itk
{

/** \file
 * The kinds of whole cells that the modes of FCCIsosurfaceFilter march. */

/** Mode `octahedra` marches the Delaunay cells of the lattice: an octahedron around each odd point, and a regular
 * tetrahedron in each unit cube. Each site is the anchor of one octahedron, that of the odd point after it in its row,
 * and of two tetrahedra, those of the unit cubes after and before it in x, which lie after it in y and z. All faces are
 * triangles, so the surface between the cells is unique. Within an octahedron, two opposite corners that are inside
 * alone, or outside alone, have a cap each. */
struct FCCOctahedron
{
  static constexpr LatticeCell::SiteType Corners[6] = { { 0, 0, 0 }, { 2, 0, 0 },  { 1, -1, 0 },
                                                        { 1, 1, 0 }, { 1, 0, -1 }, { 1, 0, 1 } };
  static constexpr LatticeCell Cell = LatticeCell::FromCorners(FCCLattice::OwnedEdges, Corners);
  static constexpr LatticeCellCases<6> Cases = LatticeCellCases<6>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

struct FCCTetrahedronAfter
{
  static constexpr LatticeCell Cell =
    LatticeCell::FromCorners(FCCLattice::OwnedEdges, FCCCells::Simplices[FCCCells::FirstTetrahedron].steps);
  static constexpr LatticeCellCases<4> Cases = LatticeCellCases<4>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

struct FCCTetrahedronBefore
{
  static constexpr LatticeCell Cell =
    LatticeCell::FromCorners(FCCLattice::OwnedEdges, FCCCells::Simplices[FCCCells::FirstTetrahedron + 1].steps);
  static constexpr LatticeCellCases<4> Cases = LatticeCellCases<4>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

/** The primitive parallelepipeds of the lattice, rhombohedra with the edges (0, 1, 1), (1, 0, 1) and (1, 1, 0): mode
 * `parallelepipeds`.
 *
 * Each is an octahedron and the two regular tetrahedra on its faces that look along (1, 1, 1) and against it, and each
 * site is the anchor of the parallelepiped whose octahedron is that of the odd point after the site in its row. Only
 * three edges a site carry points. It is the scheme that fits the triangle counts of Y. Sahillioglu, "A marching
 * algorithm for isosurface extraction from face-centered cubic lattices", Turk J Elec Eng & Comp Sci 25 (2017). Sites
 * that are connected across a face's short diagonal are nearest neighbours. */
struct FCCParallelepiped
{
  static constexpr LatticeCell::SiteType Corners[8] = { { 0, 0, 0 },  { 2, 0, 0 }, { 1, -1, 0 },  { 1, 1, 0 },
                                                        { 1, 0, -1 }, { 1, 0, 1 }, { 0, -1, -1 }, { 2, 1, 1 } };
  static constexpr LatticeCell Cell = LatticeCell::FromCorners(FCCLattice::OwnedEdges, Corners);
  static constexpr LatticeCellCases<8> Cases = LatticeCellCases<8>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

} // namespace itk

#endif
