#ifndef rhombicBenchReading_h
#define rhombicBenchReading_h

#include "rhombicBenchSections.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Reading a DICOM folder, from its path to rescaled values, as the command line does, beside itk::ImageSeriesReader
 * that has been given the sorted names. Nothing for other paths. */
std::vector<BenchResult>
MeasureReading(const std::string & path, const BenchSettings & settings);

} // namespace rhombic

#endif
