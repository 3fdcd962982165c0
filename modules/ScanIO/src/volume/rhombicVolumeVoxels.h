#ifndef rhombicVolumeVoxels_h
#define rhombicVolumeVoxels_h

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Unpacks the voxels of a NRRD or MetaImage file by ITK, in this machine's byte order, into \a size bytes, which have
 * to be all. Damaged files may end the process. Throws Failure(Unreadable), and std::bad_alloc. */
void
DecodeVolumeFile(const std::filesystem::path & path, void * voxels, std::size_t size);

} // namespace rhombic

#endif
