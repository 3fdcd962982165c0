#ifndef itkFCCScanBorder_h
#define itkFCCScanBorder_h

#include "itkFCCImage.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** The outer corner of a lattice's extent (see FCCImage), at its low or its high end, in LPS mm. */
template <typename TPixel>
Point<double, 3>
FindFCCOuterCorner(const FCCImage<TPixel> & lattice, bool isHigh)
{
  const FCCExtent extent(lattice.GetLargestPossibleRegion());
  return lattice.template TransformLatticeToPhysicalPoint<double>(isHigh ? extent.GetHighest() : extent.GetLowest());
}

/** Moves the walls that close a surface to the outer faces of the scan's outermost voxels. A lattice ends a little
 * beyond or inside of these faces, by less than one of its spacings, and so would the volume of a structure that the
 * scan cuts.
 *
 * Beyond the outermost samples the field is constant along each axis, so the surface there is stretched or compressed
 * along the axis; between samples it stays.
 *
 * \param surface extracted from a lattice with these outer corners
 * \param scan the grid that the lattice was resampled from, with perpendicular axes */
void
MoveFCCWallsToBorder(TriangleSurface & surface,
                     const ImageBase<3> & scan,
                     const Point<double, 3> & lowCorner,
                     const Point<double, 3> & highCorner);

/** The ids, ascending, of the triangles with a point beyond the scan's outermost samples, where MoveFCCWallsToBorder()
 * moves points, or less than \a margin mm inside of them. */
std::vector<std::uint32_t>
FindTrianglesNearFCCWalls(const TriangleSurface & surface, const ImageBase<3> & scan, double margin);

} // namespace itk

#endif
