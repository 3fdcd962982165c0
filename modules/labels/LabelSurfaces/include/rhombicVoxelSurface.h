#ifndef rhombicVoxelSurface_h
#define rhombicVoxelSurface_h

#include "rhombicScan.h"

#include "itkTriangleSurface.h"

#include <cstdint>

namespace rhombic
{

/** The faces between the voxels of a label and all other voxels, and those at the border of the map: the surface that
 * encloses exactly the volume of the voxels, with all their steps. Closed; where voxels touch by an edge only, four
 * triangles meet there. Slices may be tilted or unevenly spaced. Without triangles if no voxel has the label.
 *
 * \param region holds all voxels of the label */
itk::TriangleSurface::Pointer
ExtractVoxelSurface(const Scan & map, std::int32_t label, const itk::ImageRegion<3> & region);

} // namespace rhombic

#endif
