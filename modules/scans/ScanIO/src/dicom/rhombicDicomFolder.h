#ifndef rhombicDicomFolder_h
#define rhombicDicomFolder_h

#include "rhombicScanReader.h"

#include <filesystem>

namespace rhombic
{

/** Opens a series (see ScanReadOptions::series) of the DICOM slices in a folder and its subfolders. Throws Failure and
 * the exceptions of libraries. */
UnreadScan
OpenDicomFolder(const std::filesystem::path & folder, const ScanReadOptions & options);

/** Opens a single DICOM file that holds a volume: an enhanced multi-frame object or a segmentation. Throws Failure,
 * also for other files, which the message describes. */
UnreadScan
OpenDicomFile(const std::filesystem::path & path, const ScanReadOptions & options);

/** The series of a folder or a file (see ListSeries()). Throws Failure and the exceptions of libraries. */
SeriesList
ListDicomSeries(const std::filesystem::path & path, bool isFolder, const ScanReadOptions & options);

} // namespace rhombic

#endif
