#ifndef rhombicScanFormats_h
#define rhombicScanFormats_h

#include "rhombicScanReader.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace rhombic
{

/** \file
 * The formats between which OpenScan() chooses. */

/** Opens a NIfTI, NRRD or MetaImage file, or one of bare voxels (see ScanReadOptions::raw). Throws Failure, ITK's
 * exceptions and std::bad_alloc. */
UnreadScan
OpenVolumeFile(const std::filesystem::path & path, const ScanReadOptions & options);

/** Opens a folder of OME-Zarr. Throws Failure, ITK's exceptions and std::bad_alloc. */
UnreadScan
OpenOMEZarr(const std::filesystem::path & folder, const ScanReadOptions & options);

/** Sets Scan::frame, the volume of a file to read, and Scan::numberOfFrames. Throws Failure: Unreadable when there are
 * several volumes without a choice, unless the options accept the first; Usage when there is no such volume. */
void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan);

/** Opens a series (see ScanReadOptions::series) of the DICOM slices in a folder and its subfolders. Throws Failure and
 * the exceptions of libraries. */
UnreadScan
OpenDicomFolder(const std::filesystem::path & folder, const ScanReadOptions & options);

/** Opens a single DICOM file that holds a volume: an enhanced multi-frame object or a segmentation. Throws Failure,
 * also for other files, which the message describes. */
UnreadScan
OpenDicomFile(const std::filesystem::path & path, const ScanReadOptions & options);

/** The series of a folder or a file (see ListSeries()). Throws Failure and the exceptions of libraries. */
SeriesList
ListDicomSeries(const std::filesystem::path & path, bool isFolder, const ScanReadOptions & options);

/** The volume files in a folder that holds any, and no DICOM files, neither itself nor in its subfolders; sorted,
 * without hidden files, and without symbolic links unless \a followsLinks. Empty for other folders. */
std::vector<std::filesystem::path>
FindMasks(const std::filesystem::path & folder, bool followsLinks);

/** Whether a path has the extension of a picture (TIFF, PNG, JPEG 2000, BMP). */
bool
IsPicture(const std::filesystem::path & path);

/** The pictures (TIFF, PNG, JPEG 2000, BMP) in a folder that holds any, and no DICOM files, in the order of the numbers
 * in their names; without hidden files, and without symbolic links unless \a followsLinks. Empty for other folders. */
std::vector<std::filesystem::path>
FindPictures(const std::filesystem::path & folder, bool followsLinks);

/** Opens grey pictures of one size and type, or the pages of one TIFF file, as the slices of a volume, whose voxels
 * have ScanReadOptions::voxelSize, or the size that OME-XML in the ImageDescription of the first tells. Values are
 * unpacked by child processes. Throws Failure as OpenScan() does: Unreadable, naming both files, for pictures that
 * differ, and for pages that are no slices of one volume. \param path the folder, or the only picture */
UnreadScan
OpenPictureStack(const std::vector<std::filesystem::path> & pictures,
                 const std::filesystem::path & path,
                 const ScanReadOptions & options);

/** Opens masks and label maps of one grid as one label map (see LabelUnion). They are read one after the other; labels
 * of masks without a name are called as their files. Masks without any voxel are noted. Throws Failure as OpenScan()
 * does, and: Geometry, naming both files, for voxels in other places than those of the first; Unreadable for files
 * whose values look like intensities. */
UnreadScan
OpenLabelFiles(const std::vector<std::filesystem::path> & files, const ScanReadOptions & options);

} // namespace rhombic

#endif
