#ifndef rhombicMetaImageHeader_h
#define rhombicMetaImageHeader_h

#include "rhombicStoredVolume.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a MetaImage file (.mha, or .mhd with its data file). Checks its numbers and the length of the
 * data, but does not unpack compressed data. A fourth axis is taken as several volumes. Throws Failure: Unreadable,
 * naming what is wrong or not supported, Geometry. */
StoredVolume
ReadMetaImageVolume(const std::filesystem::path & path);

} // namespace rhombic

#endif
