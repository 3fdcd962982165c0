#ifndef rhombicNIfTIFile_h
#define rhombicNIfTIFile_h

#include "rhombicScan.h"
#include "rhombicScanReader.h"

#include <filesystem>

namespace rhombic
{

/** Opens a NIfTI-1 or NIfTI-2 file, or a pair of .hdr and .img by the name of either, and fills \a scan. The voxels are
 * read in one pass and without niftilib. Throws Failure: Unreadable, naming the defect of its header or voxels,
 * Geometry, Usage (no such frame), Memory. */
UnreadScan
OpenNIfTIFile(const std::filesystem::path & path, const ScanReadOptions & options, Scan scan);

} // namespace rhombic

#endif
