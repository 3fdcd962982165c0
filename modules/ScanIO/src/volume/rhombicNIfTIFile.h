#ifndef rhombicNIfTIFile_h
#define rhombicNIfTIFile_h

#include "rhombicScan.h"
#include "rhombicScanReader.h"

#include <filesystem>

namespace rhombic
{

/** Reads a NIfTI-1 or NIfTI-2 file, or a pair of .hdr and .img of which either is named, into \a scan, in one pass and
 * without niftilib. Throws Failure: Unreadable, naming what its header or its voxels have wrong, Geometry, Usage (no
 * such frame), Memory. */
void
ReadNIfTIFile(const std::filesystem::path & path, const ScanReadOptions & options, Scan & scan);

} // namespace rhombic

#endif
