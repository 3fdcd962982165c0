#ifndef rhombicDicomFolder_h
#define rhombicDicomFolder_h

#include "rhombicScanReader.h"

#include <filesystem>

namespace rhombic
{

/** Reads a series (see ScanReadOptions::series) of the DICOM slices in a folder and its subfolders. Throws Failure and
 * the exceptions of libraries. */
Scan
ReadDicomFolder(const std::filesystem::path & folder, const ScanReadOptions & options);

/** Reads a single DICOM file that holds a volume: an enhanced multi-frame object or a segmentation. Throws Failure,
 * also for other files, which the message describes. */
Scan
ReadDicomFile(const std::filesystem::path & path, const ScanReadOptions & options);

/** The series of a folder or a file (see ListSeries()). Throws Failure and the exceptions of libraries. */
SeriesList
ListDicomSeries(const std::filesystem::path & path, bool isFolder, const ScanReadOptions & options);

} // namespace rhombic

#endif
