#ifndef rhombicMetaImageHeader_h
#define rhombicMetaImageHeader_h

#include "rhombicStoredVolume.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a MetaImage file (.mha, or .mhd with its data file) and checks that the voxels are there: the
 * header's numbers and the length of the data, but not what compressed data unpacks to. A fourth axis counts as several
 * volumes. Throws Failure: Unreadable, naming what is wrong or not supported, Geometry. */
StoredVolume
ReadMetaImageVolume(const std::filesystem::path & path);

} // namespace rhombic

#endif
