#ifndef rhombicDicomStack_h
#define rhombicDicomStack_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <vector>

namespace rhombic
{

/** Where the volume is that slices make. */
struct DicomStack
{
  VolumeGeometry geometry;                         ///< sheared when the gantry was tilted
  std::vector<itk::Point<double, 3>> sliceOrigins; ///< see Scan::sliceOrigins
  StackReport report;
  std::vector<std::string> notes;
};

/** Sorts slices of one orientation along their normal and says where the volume is that they make. The steps between
 * slices come from their positions alone.
 *
 * The slices of an even stack are within 0.01 mm (or a tenth of a step) of a line with equal steps; the line need not
 * be the normal. Gaps are steps of 1.9 times or more what is usual before and behind them, so that the change from one
 * block of slices to the next is none, and whole multiples of the step that is usual in the stack amid such steps.
 * Everything else is an uneven stack, whose slices keep their own places.
 *
 * Throws Failure(Geometry), naming files: when a slice has no plane, there is only one, two are at one place, one is
 * shifted sideways against the next by more than a pixel beyond what the tilt of most is, or all by more than 45
 * degrees are, for gaps and for tilted (by more than 0.001 rad) or uneven stacks as the options say. */
DicomStack
StackSlices(std::vector<DicomSlice> & slices, const ScanReadOptions & options);

/** Whether two slices are at one place along their normal, within a hundredth of the median step or 1e-6 mm. */
bool
HaveDuplicates(const std::vector<DicomSlice> & slices);

} // namespace rhombic

#endif
