#ifndef rhombicNRRDVolume_h
#define rhombicNRRDVolume_h

#include "rhombicStoredVolume.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a NRRD file (.nrrd, or .nhdr with its data file). Checks its numbers and the length of the data,
 * but does not unpack compressed data. A fourth axis, first or last, is taken as several volumes. Throws Failure:
 * Unreadable, naming what is wrong or not supported, Geometry. */
StoredVolume
ReadNRRDVolume(const std::filesystem::path & path);

} // namespace rhombic

#endif
