#ifndef rhombicNRRDVolume_h
#define rhombicNRRDVolume_h

#include "rhombicStoredVolume.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a NRRD file (.nrrd, or .nhdr with its data file) and checks that the voxels are there: the
 * header's numbers, the length of the data, compressed data by unpacking it once. A fourth axis, first or last, counts
 * as several volumes. Throws Failure: Unreadable, naming what is wrong or not supported, Geometry. */
StoredVolume
ReadNRRDVolume(const std::filesystem::path & path);

} // namespace rhombic

#endif
