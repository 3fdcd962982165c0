#ifndef rhombicStoredVolume_h
#define rhombicStoredVolume_h

#include "rhombicVolumeGeometry.h"
#include "rhombicVolumePixels.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace rhombic
{

/** Voxels as a zlib stream in a file. */
struct DeflatedVoxels
{
  std::filesystem::path path;
  std::uintmax_t offset = 0;
  bool isSwapped = false; ///< not in this machine's byte order
};

/** What a NRRD or MetaImage header says about its voxels, as ITK unpacks them. */
struct StoredVolume
{
  StoredType type = StoredType::UInt8;
  VolumeGeometry geometry;
  std::string matrix; ///< the header's field that the geometry's axes come from
  std::uintmax_t numberOfFrames = 1;
  bool areFramesInterleaved = false; ///< whether the frames' values of a voxel lie side by side
  std::optional<ValueScaling> scaling;
  std::string encoding;                   ///< "raw", "gzip", "zlib", "text" or "hex"
  std::optional<DeflatedVoxels> deflated; ///< voxels that ITK is not to unpack
  bool isOriented = true;
  std::string note; ///< what had to be assumed, as the end of a sentence that begins with the path; may be empty
};

} // namespace rhombic

#endif
