#ifndef rhombicScanBorder_h
#define rhombicScanBorder_h

#include "rhombicFCCImageFile.h"

#include "itkTriangleSurface.h"

namespace rhombic
{

/** Moves the walls that close a surface to the scan's border, the outer faces of its outermost voxels. A lattice ends a
 * little beyond or inside it, by less than one of its spacings, and so would the volume of what the scan cuts.
 *
 * Beyond the outermost samples the field is constant along each axis, so what lies there is stretched or compressed
 * along it; what lies between samples stays. \param scan with perpendicular axes, from which the lattice was made */
void
MoveWallsToBorder(itk::TriangleSurface & surface, const itk::ImageBase<3> & scan, const FCCVolume & lattice);

} // namespace rhombic

#endif
