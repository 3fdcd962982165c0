#ifndef rhombicDicomSegmentation_h
#define rhombicDicomSegmentation_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Reads the frames of a DICOM segmentation (PS3.3, A.51 and A.91: of type BINARY or LABELMAP) into one label map: its
 * image, its labels, and notes go to \a scan. Voxels of no segment are 0; where segments overlap, that of the later
 * frame wins. Slices without any frame are empty, as the standard has it: all
 * frames must be whole multiples apart of the smallest distance, or of the one that two tags agree on. Throws Failure,
 * Memory when the label map would take more than \a maximumMemory bytes (see ScanReadOptions). */
void
ReadDicomSegmentation(const std::vector<DicomSlice> & frames, std::uintmax_t maximumMemory, Scan & scan);

/** Where the label map of a segmentation lies, as ReadDicomSegmentation() finds it. Throws the same. */
VolumeGeometry
PlaceDicomSegmentation(const std::vector<DicomSlice> & frames, Scan & scan);

} // namespace rhombic

#endif
