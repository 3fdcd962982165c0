#ifndef rhombicDicomStack_h
#define rhombicDicomStack_h

#include "rhombicDicomSlice.h"
#include "rhombicVolumeGeometry.h"

#include <vector>

namespace rhombic
{

/** Sorts slices of one orientation along their normal and says where the volume is that they make. The step between
 * slices comes from their positions alone.
 *
 * Throws Failure(Geometry), naming files, when a slice has no plane, there is only one, two are at one place, the steps
 * differ by more than max(0.01 mm, a thousandth) (a slice is missing, say), a slice lies off the line of the others by
 * more than that, or the line is tilted against the normal by more than 0.001 rad (gantry tilt). */
VolumeGeometry
StackSlices(std::vector<DicomSlice> & slices);

} // namespace rhombic

#endif
