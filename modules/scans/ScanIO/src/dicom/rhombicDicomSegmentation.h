#ifndef rhombicDicomSegmentation_h
#define rhombicDicomSegmentation_h

#include "rhombicDicomSlice.h"
#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Opens the frames of a DICOM segmentation of type BINARY or LABELMAP (PS3.3, A.51 and A.91) as one label map: fills
 * image, labels and notes of \a scan. Voxels of no segment are 0; where segments overlap, the later frame counts.
 * Slices without a frame are empty, as in the standard: the distances of frames must be whole multiples of the smallest
 * one, or of the step that SpacingBetweenSlices and SliceThickness agree on. Throws Failure: Unreadable, Geometry, and
 * Memory when the label map takes more than \a maximumMemory bytes (see ScanReadOptions). */
UnreadScan
OpenDicomSegmentation(const std::vector<DicomSlice> & frames, std::uintmax_t maximumMemory, Scan scan);

} // namespace rhombic

#endif
