#ifndef rhombicBenchReading_h
#define rhombicBenchReading_h

#include "rhombicBenchSections.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Compares itk::ScanFileReader of a DICOM folder with itk::ImageSeriesReader, which gets the sorted names of the
 * files. No results for paths that are not folders. */
std::vector<BenchResult>
MeasureReading(const std::string & path, const BenchSettings & settings);

} // namespace rhombic

#endif
