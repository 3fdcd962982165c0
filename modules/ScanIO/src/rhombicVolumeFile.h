#ifndef rhombicVolumeFile_h
#define rhombicVolumeFile_h

#include "rhombicScan.h"

#include <filesystem>

namespace rhombic
{

/** Whether the extension is one of NIfTI, NRRD or MetaImage. */
bool
IsVolumeFileName(const std::filesystem::path & path);

/** Reads a NIfTI, NRRD or MetaImage file. Throws Failure and ITK's exceptions. */
Scan
ReadVolumeFile(const std::filesystem::path & path);

} // namespace rhombic

#endif
