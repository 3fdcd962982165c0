#ifndef rhombicPatientAxes_h
#define rhombicPatientAxes_h

#include "rhombicScan.h"

namespace rhombic
{

/** The scan with its axes in the order of the patient's: the first runs nearest to right-left, the second to
 * anterior-posterior, the third to inferior-superior, each towards +LPS. Samples keep their positions, so that the same
 * volume gives the same lattice whatever the order of its axes in the file. The voxels are copied only if axes change.
 * Slanted scans keep the order of their slices. */
Scan
OrderAlongPatient(const Scan & scan);

} // namespace rhombic

#endif
