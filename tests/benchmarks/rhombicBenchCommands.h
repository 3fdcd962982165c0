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

/** Compares `rhombic render SCAN -o page.html` with the commands that make its parts: `rhombic mesh` with the page's
 * simplification, `rhombic render` for four views and for a turntable of 24 pictures, of the page's sizes; 1.5 s are
 * added for the rest. In `details` the median time of each part, the size of the page, and the peak memory of the page
 * and of `rhombic render --sheet` in MiB. Throws Failure if a command fails.
 * \param source options that say what is drawn, as --preset and a name */
std::vector<BenchResult>
MeasurePage(const std::string & scan, const std::vector<std::string> & source, const BenchSettings & settings);

/** Balls on a cubic grid, in a volume of uint16. */
struct ScaleVolume
{
  unsigned int size = 512;  ///< voxels along each axis, a multiple of pitch
  unsigned int pitch = 128; ///< voxels from ball to ball
  double radius = 40.0;     ///< in voxels, at most 0.45 of pitch
};

/** Compares `rhombic mesh` of a raw volume of balls within a limit of memory, in slabs where it does not fit, with the
 * same in memory. In `details` the peak memory of both in MiB, without pages of the volume's file, the error of the
 * volume that the mesh encloses, and the size of its file. Throws Failure if the files differ, or a command fails. The
 * volume and the meshes are written to the folder of temporary files.
 * Where the work in memory would not fit, the time is compared with that of reading the volume once.
 * \param limit as --max-memory takes it */
std::vector<BenchResult>
MeasureScale(const ScaleVolume & balls, const std::string & limit, const BenchSettings & settings);

} // namespace rhombic

#endif
