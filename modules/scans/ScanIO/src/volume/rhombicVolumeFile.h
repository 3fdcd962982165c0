#ifndef rhombicVolumeFile_h
#define rhombicVolumeFile_h

#include "rhombicScan.h"
#include "rhombicScanReader.h"

#include <filesystem>

namespace rhombic
{

/** Whether the extension is one of NIfTI, NRRD or MetaImage. */
bool
IsVolumeFileName(const std::filesystem::path & path);

/** Opens a NIfTI, NRRD or MetaImage file. Throws Failure, ITK's exceptions and std::bad_alloc. */
UnreadScan
OpenVolumeFile(const std::filesystem::path & path, const ScanReadOptions & options);

} // namespace rhombic

#endif
