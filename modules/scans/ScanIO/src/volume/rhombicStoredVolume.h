#ifndef rhombicStoredVolume_h
#define rhombicStoredVolume_h

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
  StoredType type = StoredType::UInt8;
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

} // namespace rhombic

#endif
