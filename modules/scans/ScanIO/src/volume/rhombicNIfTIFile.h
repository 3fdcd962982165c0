#ifndef rhombicNIfTIFile_h
#define rhombicNIfTIFile_h

#include "rhombicScanReader.h"
#include "rhombicStoredVolume.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a NIfTI-1 or NIfTI-2 file, or of a pair of .hdr and .img by the name of either. Checks its
 * numbers and its geometry, which it describes in \a scan, and the length of the voxels, but does not unpack them.
 * Throws Failure: Unreadable, naming what is wrong or not supported, Geometry. */
StoredVolume
ReadNIfTIVolume(const std::filesystem::path & path, const ScanReadOptions & options, Scan & scan);

} // namespace rhombic

#endif
