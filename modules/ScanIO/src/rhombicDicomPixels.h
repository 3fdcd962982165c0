#ifndef rhombicDicomPixels_h
#define rhombicDicomPixels_h

#include "rhombicDicomSlice.h"
#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include <vector>

namespace rhombic
{

/** Decodes slices, in their order, into one volume of rescaled values. Throws Failure(Unreadable), naming the file, for
 * pixels that are missing, cut off, or not as the header says. */
ScanImage
ReadDicomPixels(const std::vector<DicomSlice> & slices, const VolumeGeometry & geometry);

} // namespace rhombic

#endif
