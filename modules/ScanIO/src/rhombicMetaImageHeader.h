#ifndef rhombicMetaImageHeader_h
#define rhombicMetaImageHeader_h

#include "rhombicStoredVolume.h"

#include <cstddef>
#include <filesystem>

namespace rhombic
{

/** Reads the header of a MetaImage file (.mha, or .mhd with its data file) and checks that the voxels are there: the
 * header's numbers, the length of the data, compressed data by unpacking it once. A fourth axis counts as several
 * volumes. Throws Failure: Unreadable, naming what is wrong or not supported, Geometry. */
StoredVolume
ReadMetaImageVolume(const std::filesystem::path & path);

/** Unpacks voxels that are a zlib stream, in this machine's byte order; false for files that have them otherwise. ITK
 * would end where the header's CompressedDataSize says, which may be too early. Throws Failure(Unreadable). */
bool
InflateMetaImage(const std::filesystem::path & path, std::byte * voxels, std::size_t size);

} // namespace rhombic

#endif
