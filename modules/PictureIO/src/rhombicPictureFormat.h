#ifndef rhombicPictureFormat_h
#define rhombicPictureFormat_h

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string>

namespace rhombic
{

/** What a file format does to a picture. */
struct PictureFormat
{
  std::string name;         ///< as OpenImageIO calls it
  OIIO::TypeDesc component; ///< as the file stores it
  std::string compression;
  bool isLinear;   ///< stores linear light instead of sRGB
  bool isLossless; ///< gives back the same 8-bit picture
  bool needsFile;  ///< OpenImageIO can't encode it in memory
};

/** The format of the path's extension, in any case of letters. Throws Failure(Usage), listing the known extensions. */
PictureFormat
FormatOf(const std::filesystem::path & path);

} // namespace rhombic

#endif
