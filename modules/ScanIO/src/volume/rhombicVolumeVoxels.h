#ifndef rhombicVolumeVoxels_h
#define rhombicVolumeVoxels_h

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Unpacks all voxels of a NRRD or MetaImage file by ITK into \a size bytes, in this machine's byte order. Damaged
 * files may end the process. Throws Failure(Unreadable), also for another size, and std::bad_alloc. */
void
DecodeVolumeFile(const std::filesystem::path & path, void * voxels, std::size_t size);

} // namespace rhombic

#endif
