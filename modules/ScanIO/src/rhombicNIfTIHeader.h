#ifndef rhombicNIfTIHeader_h
#define rhombicNIfTIHeader_h

#include "rhombicScan.h"
#include "rhombicVolumeGeometry.h"

#include <filesystem>

namespace rhombic
{

/** Reads the header of a NIfTI-1 file (or of the .hdr beside an .img) and says where its voxels are: by the sform if
 * there is one, else the qform, else along LPS axes from the origin. What had to be assumed goes to the
 * notes of \a scan, and to its isOriented.
 *
 * Refuses, as Failure(Unreadable), all that ITK 5.2.1 reads wrongly or can't survive: NIfTI-2, Analyze, more than
 * one volume, vector and colour pixels, numbers that are not finite, and pixels that are missing, cut off or
 * damaged: compressed pixels are unpacked once to find out. */
VolumeGeometry
ReadNIfTIGeometry(const std::filesystem::path & path, Scan & scan);

} // namespace rhombic

#endif
