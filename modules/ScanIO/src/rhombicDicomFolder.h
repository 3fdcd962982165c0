#ifndef rhombicDicomFolder_h
#define rhombicDicomFolder_h

#include "rhombicScan.h"

#include <filesystem>
#include <string>

namespace rhombic
{

/** Reads a series (see ScanReadOptions::series) of the DICOM slices in a folder and its subfolders. Throws Failure and
 * GDCM's exceptions. */
Scan
ReadDicomFolder(const std::filesystem::path & folder, const std::string & series);

/** Says why a single file that is not named like a volume can't be read: what kind of DICOM it is, or that it is none.
 */
[[noreturn]] void
RefuseSingleDicomFile(const std::filesystem::path & path);

} // namespace rhombic

#endif
