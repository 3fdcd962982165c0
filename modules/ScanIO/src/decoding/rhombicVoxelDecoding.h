#ifndef rhombicVoxelDecoding_h
#define rhombicVoxelDecoding_h

#include "rhombicVoxelDecoder.h"

namespace rhombic
{

/** Does what a request asks for, in this process: what VoxelDecoder protects from. \a voxels has room for
 * VoxelRequest::size bytes. Throws Failure, and the libraries' exceptions. */
void
DecodeVoxels(const VoxelRequest & request, std::byte * voxels);

} // namespace rhombic

#endif
