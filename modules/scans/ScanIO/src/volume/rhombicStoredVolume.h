#ifndef rhombicStoredVolume_h
#define rhombicStoredVolume_h

#include "rhombicScanReader.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVolumePixels.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Where the voxels of a file are. */
struct StoredVoxels
{
  std::filesystem::path path;
  std::uintmax_t offset = 0; ///< of the first voxel, or of the compressed stream
  std::uintmax_t skip = 0;   ///< bytes before the first voxel in the unpacked stream
  bool isDeflated = false;   ///< a zlib or gzip stream
  bool isSwapped = false;    ///< not in this machine's byte order
};

/** The content of a NIfTI, NRRD or MetaImage header. */
struct StoredVolume
{
  StoredType type;
  VolumeGeometry geometry;
  std::string matrix; ///< the header's field of the geometry's axes
  std::uintmax_t numberOfFrames = 1;
  bool areFramesInterleaved = false; ///< whether the values of a voxel in all frames are adjacent
  std::optional<ValueScaling> scaling;
  std::string encoding; ///< "raw", "gzip" or "zlib"
  StoredVoxels voxels;
  bool isOriented = true;
  std::string note; ///< assumptions, as the end of a sentence that begins with the path; may be empty
};

/** Throws Failure(Unreadable), naming \a header, when the file of the voxels can't hold as many as \a sizes say, the
 * volumes included. With \a areAtEnd, the voxels are the last bytes of their file: sets their offset. */
void
RequireVoxels(const std::vector<std::uintmax_t> & sizes,
              bool areAtEnd,
              const std::filesystem::path & header,
              StoredVolume & volume);

/** The product of sizes; nothing when it exceeds 2^60. */
std::optional<std::uintmax_t>
ProductOf(const std::vector<std::uintmax_t> & sizes);

/** Sets Scan::frame, the volume of a file to read, and Scan::numberOfFrames. Throws Failure: Unreadable when there are
 * several volumes without a choice, unless the options accept the first; Usage when there is no such volume. */
void
ChooseFrame(std::uintmax_t numberOfFrames,
            const ScanReadOptions & options,
            const std::filesystem::path & path,
            Scan & scan);

/** \name Headers of files
 * Check the header's numbers and the length of the voxels, but do not unpack compressed voxels. A fourth axis is taken
 * as several volumes. Throw Failure: Unreadable, naming what is wrong or not supported, Geometry. */
///@{

/** A NIfTI-1 or NIfTI-2 file, or a pair of .hdr and .img by the name of either. Also checks the geometry, and describes
 * it in \a scan. */
StoredVolume
ReadNIfTIVolume(const std::filesystem::path & path, const ScanReadOptions & options, Scan & scan);

/** A NRRD file: .nrrd, or .nhdr with its data file. The fourth axis is the first or the last one. */
StoredVolume
ReadNRRDVolume(const std::filesystem::path & path);

/** A MetaImage file: .mha, or .mhd with its data file. */
StoredVolume
ReadMetaImageVolume(const std::filesystem::path & path);

///@}

} // namespace rhombic

#endif
