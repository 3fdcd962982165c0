#ifndef detail_rhombicPictureCodec_h
#define detail_rhombicPictureCodec_h

#include "rhombicPictureIO.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

struct PictureDifference;
struct PictureFormat;

/** What is written to a file. */
struct PictureFile
{
  const Picture * pictures = nullptr;
  std::size_t count = 0;
  PictureMetadata metadata;
  double secondsPerFrame = 0.0; ///< 0: no animation
};

/** \class PictureCodec
 * \brief Encodes, decodes and compares pictures. Nothing else in the library calls OpenImageIO or giflib. Thread safe.
 */
class PictureCodec
{
public:
  virtual ~PictureCodec() = default;

  /** Gives the bytes of a file, or, for a format that OpenImageIO can't encode in memory, writes \a file and gives
   * none. Returns the reason of a failure, or an empty string. */
  virtual std::string
  Encode(const PictureFile & contents,
         const PictureFormat & format,
         const std::filesystem::path & file,
         std::vector<unsigned char> & bytes) const = 0;

  /** Reads pages or frames in their order until \a usePage returns false. Throws as ReadPicture() does. */
  virtual void
  Decode(const std::filesystem::path & file, const std::function<bool(Picture &&)> & usePage) const = 0;

  /** ComparePictures() for pictures of one size. */
  virtual PictureDifference
  Compare(const Picture & a, const Picture & b, double threshold) const = 0;
};

/** The codec of OpenImageIO. A program that is to start without OpenImageIO, which takes 0.5 s to load, defines this
 * function itself, and loads a library that has this one when it is called: the linker then leaves out the library's
 * function, and with --as-needed OpenImageIO. Throws Failure(Internal) where that fails. */
const PictureCodec &
GetPictureCodec();

} // namespace rhombic

#endif
