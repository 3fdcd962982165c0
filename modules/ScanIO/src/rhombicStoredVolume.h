#ifndef rhombicStoredVolume_h
#define rhombicStoredVolume_h

#include "rhombicVolumeGeometry.h"
#include "rhombicVolumePixels.h"

#include <cstdint>
#include <optional>
#include <string>

namespace rhombic
{

/** What a NRRD or MetaImage header says about its voxels, as ITK unpacks them. */
struct StoredVolume
{
  StoredType type = StoredType::UInt8;
  VolumeGeometry geometry;
  std::string matrix; ///< the header's field that the geometry's axes come from
  std::uintmax_t numberOfFrames = 1;
  bool areFramesInterleaved = false; ///< whether the frames' values of a voxel lie side by side
  std::optional<ValueScaling> scaling;
  std::string encoding; ///< "raw", "gzip", "zlib", "text" or "hex"
  bool isOriented = true;
  std::string note; ///< what had to be assumed, as the end of a sentence that begins with the path; may be empty
};

} // namespace rhombic

#endif
