#ifndef rhombicMappedVoxels_h
#define rhombicMappedVoxels_h

#include "rhombicScan.h"

namespace rhombic
{

/** Whether the voxels of a scan are pages of its file, which the system reads when they are used and drops when memory
 * is short, so that they take none of the memory that work may have. ReadVoxels() maps a file when its voxels would
 * take more than half of ScanReadOptions::maximumMemory and can be used as the file holds them: raw, not scaled, in
 * this machine's byte order, at a multiple of their size, and of a type that ScanImage has. Changed voxels are copies
 * in memory; the file stays as it is. Voxels of OME-Zarr that exceed ScanReadOptions::maximumMemory are
 * unpacked to a temporary file, and its pages are used. */
bool
IsMapped(const ScanImage & image);

} // namespace rhombic

#endif
