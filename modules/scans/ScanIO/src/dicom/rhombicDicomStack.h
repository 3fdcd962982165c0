#ifndef rhombicDicomStack_h
#define rhombicDicomStack_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <vector>

namespace rhombic
{

/** The geometry of a stack of slices. */
struct DicomStack
{
  VolumeGeometry geometry;                         ///< sheared when the gantry was tilted
  std::vector<itk::Point<double, 3>> sliceOrigins; ///< see Scan::sliceOrigins
  StackReport report;
  std::vector<std::string> notes;
};

/** Sorts slices of one orientation along their normal and finds the geometry of their volume. The steps between slices
 * are computed from their positions alone.
 *
 * The slices of an even stack are within 0.01 mm (or a tenth of a step) of a line with equal steps; the line need not
 * be the normal. A gap is a step of at least 1.9 times the usual step on both its sides (so that a change from one
 * block of slices to the next is no gap), or a whole multiple of the median step with median steps on both its sides.
 * All other stacks are uneven, and their slices keep their own positions.
 *
 * Throws Failure(Geometry), naming files: when a slice has no plane, there is only one slice, two are at the same
 * position, one is shifted sideways against the next by a pixel more than the median shift, or the tilt is more than 60
 * degrees; and, unless the options accept them, for gaps, for tilts of more than 0.001 rad and for uneven steps. */
DicomStack
StackSlices(std::vector<DicomSlice> & slices, const ScanReadOptions & options);

/** Whether two slices are at the same position along their normal, within a hundredth of the median step or 1e-6 mm. */
bool
HaveDuplicates(const std::vector<DicomSlice> & slices);

} // namespace rhombic

#endif
