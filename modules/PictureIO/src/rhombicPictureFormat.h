#ifndef rhombicPictureFormat_h
#define rhombicPictureFormat_h

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string>

namespace rhombic
{

/** Properties of a file format. */
struct PictureFormat
{
  std::string name;         ///< in OpenImageIO
  OIIO::TypeDesc component; ///< type of the stored components
  std::string compression;
  bool isLinear;   ///< stores linear light instead of sRGB
  bool isLossless; ///< an 8-bit picture that is read back is the same
  bool needsFile;  ///< OpenImageIO can't encode the format in memory
};

/** The format of the path's extension, in upper or lower case. Throws Failure(Usage), listing the known extensions, for
 * others. */
PictureFormat
FormatOf(const std::filesystem::path & path);

} // namespace rhombic

#endif
