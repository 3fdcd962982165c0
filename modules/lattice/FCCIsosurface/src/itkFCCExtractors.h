#ifndef itkFCCExtractors_h
#define itkFCCExtractors_h

#include "itkFCCSurfaceExtractor.h"

namespace itk
{

/** Extracts the surface through the lattice's tetrahedra, column by column (see FCCMarchingCases).
 * \param cubic see FCCEdgePoints */
std::unique_ptr<FCCSurfaceExtractor>
MakeFCCTetrahedraExtractor(const FCCSigns & signs, const FCCScalarField & field, bool cubic);

/** The ways to fill space with whole cells of the lattice: see itkFCCCellCases.h. */
enum class FCCCellScheme : unsigned char
{
  Octahedra,
  Parallelepipeds
};

/** Extracts the surface through whole cells of the lattice, layer by layer: *layer* k is the cells whose anchors are in
 * plane k.
 *
 * When the surface is closed, sites beyond the box of the signs are outside and every cell that holds a site of the box
 * is marched; the first and last sites of the box along each axis must be outside. When it is open, only cells whose
 * corners are all in the box are. */
std::unique_ptr<FCCSurfaceExtractor>
MakeFCCCellExtractor(const FCCSigns & signs, const FCCScalarField & field, FCCCellScheme scheme);

/** Extracts a surface with few, well-shaped triangles: that of the tetrahedra, whose points gather at sites.
 *
 * Every point of the tetrahedra's surface moves to the nearer end of its edge. All points of one site become one
 * vertex, which is moved onto the reconstructed surface, and triangles that lose a side vanish (G. Treece, R. Prager,
 * A. Gee, "Regularised marching tetrahedra", 1999), but where the surface would not stay a manifold of the same
 * topology (see FCCSplitSites).
 *
 * Count() reads the values and keeps the nearer ends of the crossings, less than a byte for each crossing. Resolve()
 * splits sites. Finish() removes triangles that close a surface that is to stay open. */
std::unique_ptr<FCCSurfaceExtractor>
MakeFCCLeanExtractor(const FCCSigns & signs, const FCCScalarField & field);

} // namespace itk

#endif
