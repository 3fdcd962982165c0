#ifndef rhombicLabelFiles_h
#define rhombicLabelFiles_h

#include "rhombicScanReader.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** The volume files in a folder that holds any, and no DICOM files, neither itself nor in its subfolders; sorted,
 * without hidden files, and without symbolic links unless \a followsLinks. Empty for other folders. */
std::vector<std::filesystem::path>
FindMasks(const std::filesystem::path & folder, bool followsLinks);

/** Opens masks and label maps of one grid as one label map (see LabelUnion). They are read one after the other; labels
 * of masks without a name are called as their files. Masks without any voxel are noted. Throws Failure as OpenScan()
 * does, and: Geometry, naming both files, for voxels in other places than those of the first; Unreadable for files
 * whose values look like intensities. */
UnreadScan
OpenLabelFiles(const std::vector<std::filesystem::path> & files, const ScanReadOptions & options);

} // namespace rhombic

#endif
