#ifndef rhombicBenchCommands_h
#define rhombicBenchCommands_h

#include "rhombicBenchSections.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Compares `rhombic mesh` from a DICOM folder to STL, all checks on, with rhombic-bare-script (rhombicBareScript.cxx):
 * time of the whole process, and in `details` the peak memory of both with their child processes in MiB, from a run
 * each that is not timed. Both programs lie beside this one. No results for paths that are not folders.
 * Throws Failure if one of them fails. */
std::vector<BenchResult>
MeasureCommands(const std::string & scan, double isovalue, const BenchSettings & settings);

/** Compares `rhombic mesh` and `rhombic render` on a label map with rhombic-bare-label-script
 * (rhombicBareLabelScript.cxx), as MeasureCommands() does. An empty path stands for maps that this function makes: mesh
 * and slice of eleven structures on thick slices (MakeThickStructures()), page of three nested tissues, the inner two
 * with folds. Throws Failure if a program fails. */
std::vector<BenchResult>
MeasureLabelCommands(const std::string & map, const BenchSettings & settings);

} // namespace rhombic

#endif
