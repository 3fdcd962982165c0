#ifndef rhombicPictureFormat_h
#define rhombicPictureFormat_h

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** What a file holds. */
enum class PictureUse
{
  Single,   ///< one picture
  Pages,    ///< pictures of any sizes
  Animation ///< frames of one size
};

/** Properties of a file format. */
struct PictureFormat
{
  std::string name;        ///< in OpenImageIO
  std::string compression; ///< in OpenImageIO
  bool isLinear;           ///< stores linear light as half floats instead of bytes of sRGB
  bool isLossless;         ///< an 8-bit picture that is read back is the same
  bool needsFile;          ///< OpenImageIO can't encode the format in memory
  bool hasAlpha;
  std::vector<PictureUse> uses;
};

/** The format of the path's extension, in upper or lower case. Throws Failure(Usage), listing the known extensions, for
 * others, and for pictures with alpha in a format without it. */
PictureFormat
FormatOf(const std::filesystem::path & path, PictureUse use, bool hasAlpha);

} // namespace rhombic

#endif
