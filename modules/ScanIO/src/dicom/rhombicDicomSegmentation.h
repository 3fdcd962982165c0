#ifndef rhombicDicomSegmentation_h
#define rhombicDicomSegmentation_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"

#include <vector>

namespace rhombic
{

/** Reads the frames of a DICOM segmentation (PS3.3, A.51 and A.91: of type BINARY or LABELMAP) into one label map: its
 * image, its labels, and notes go to \a scan. Voxels of no segment are 0; where segments overlap, that of the later
 * frame wins. Slices without any frame are empty, as the standard has it. Throws Failure. */
void
ReadDicomSegmentation(const std::vector<DicomSlice> & frames, Scan & scan);

} // namespace rhombic

#endif
