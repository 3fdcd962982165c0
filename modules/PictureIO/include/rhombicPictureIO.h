#ifndef rhombicPictureIO_h
#define rhombicPictureIO_h

#include "rhombicAtomicFile.h"
#include "rhombicPicture.h"

#include <filesystem>
#include <string>

namespace rhombic
{

/** The metadata of a picture file. Empty strings are not written. */
struct PictureMetadata
{
  std::string software;    ///< the program and its version
  std::string commandLine; ///< the command that made the picture
};

/** Throws Failure(Usage) where WritePicture() would throw it because of the extension. Call it before long work. Thread
 * safe. */
void
CheckPicturePath(const std::filesystem::path & path);

/** Writes a picture in the format of the path's extension: .png, .jpg, .jpeg (quality 95), .tif, .tiff, or .exr (linear
 * light, half floats). The same picture and metadata give the same bytes. The file is read back before it replaces an
 * older one.
 *
 * Throws Failure: Usage when the extension is none of those or the picture has no pixels; Output when the file can't be
 * written or, read back, does not hold the picture. */
void
WritePicture(const Picture & picture, const std::filesystem::path & path, const PictureMetadata & metadata);

/** As WritePicture(), but the file appears only when \a staged is committed, with all its other files. */
void
StagePicture(const Picture & picture,
             const std::filesystem::path & path,
             StagedFiles & staged,
             const PictureMetadata & metadata);

/** Reads a picture as 8-bit sRGB. Grey becomes three equal channels, an alpha channel is dropped, and the linear light
 * of EXR is encoded.
 *
 * Throws Failure: NotFound when there is no such file; Unreadable when it is not a picture or is damaged. */
Picture
ReadPicture(const std::filesystem::path & path);

} // namespace rhombic

#endif
