#ifndef itkFCCParallelepipedCases_h
#define itkFCCParallelepipedCases_h

#include "itkFCCCellCases.h"

namespace itk
{

/** \class FCCParallelepipedCases
 * \brief The primitive parallelepipeds of the lattice, rhombohedra with the edges (0, 1, 1), (1, 0, 1) and (1, 1, 0).
 *
 * Each is an octahedron and the two regular tetrahedra on its faces that look along (1, 1, 1) and against it, and each
 * site is the anchor of the one whose octahedron is that of the odd point after it in its row. Only three edges a site
 * carry points. It is the scheme that fits the triangle counts of Y. Sahillioglu, "A marching algorithm for isosurface
 * extraction from face-centered cubic lattices", Turk J Elec Eng & Comp Sci 25 (2017).
 *
 * Sites that are connected across a face's short diagonal are nearest neighbours.
 */
struct FCCParallelepipedCases
{
  struct Parallelepiped
  {
    static constexpr FCCCell::SiteType Corners[8] = { { 0, 0, 0 },  { 2, 0, 0 }, { 1, -1, 0 },  { 1, 1, 0 },
                                                      { 1, 0, -1 }, { 1, 0, 1 }, { 0, -1, -1 }, { 2, 1, 1 } };
    static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
    static constexpr FCCCellCases<8> Cases = FCCCellCases<8>::Of(Cell);
  };

  static_assert(!Parallelepiped::Cases.hasDiagonalOnFace);
};

} // namespace itk

#endif
