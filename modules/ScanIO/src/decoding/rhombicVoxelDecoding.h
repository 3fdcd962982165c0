#ifndef rhombicVoxelDecoding_h
#define rhombicVoxelDecoding_h

#include "rhombicVoxelDecoder.h"

namespace rhombic
{

/** Unpacks the voxels of a request in this process, into VoxelRequest::size bytes. Damaged files may end the process.
 * Throws Failure and the libraries' exceptions. */
void
DecodeVoxels(const VoxelRequest & request, std::byte * voxels);

} // namespace rhombic

#endif
