#ifndef rhombicPictureIO_h
#define rhombicPictureIO_h

#include "rhombicAtomicFile.h"
#include "rhombicPicture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Files of pictures. The same pictures and metadata give the same bytes. Each file is read back before it replaces an
 * older one. Functions with \a staged write files that appear when it is committed, with all its other files.
 *
 * All that write throw Failure: Usage when the extension is another, a picture has no pixels, or alpha in a format
 * without; Output when the file can't be written or, read back, does not hold what it should. */

/** The metadata of a picture file. Empty strings are not written. */
struct PictureMetadata
{
  std::string software;       ///< the program and its version
  std::string commandLine;    ///< the command that made the picture
  double pixelsPerInch = 0.0; ///< for printing; 0: not written
  int jpegQuality = 95;       ///< 1 to 100
};

/** Throws Failure(Usage) where WritePicture() would throw it because of the extension, for a picture of 3 or 4
 * channels. Call it before long work. Thread safe. */
void
CheckPicturePath(const std::filesystem::path & path, int channels = 3);

/** Writes a picture in the format of the path's extension: .png, .jpg, .jpeg (no alpha), .tif, .tiff, or
 * .exr (linear light, half floats, colours multiplied by alpha). */
void
WritePicture(const Picture & picture, const std::filesystem::path & path, const PictureMetadata & metadata);

/** The bytes of a JPEG file, of a picture of 3 channels, without metadata; made by libjpeg alone, as OpenImageIO takes
 * 70 MB of memory. Thread safe. Throws Failure(Output) when the picture can't be encoded.
 * \param quality 1 to 100
 * \param halvesColour whether colours are held at half the size, which blurs those of thin lines */
std::string
EncodeJpeg(const Picture & picture, int quality, bool halvesColour);

/** As WritePicture(). */
void
StagePicture(const Picture & picture,
             const std::filesystem::path & path,
             StagedFiles & staged,
             const PictureMetadata & metadata);

/** Writes one or more pictures of any sizes as the pages of a .tif or .tiff file. */
void
StagePages(const std::vector<Picture> & pages,
           const std::filesystem::path & path,
           StagedFiles & staged,
           const PictureMetadata & metadata);

/** CheckPicturePath() for StageAnimation(). */
void
CheckAnimationPath(const std::filesystem::path & path, int channels = 3);

/** Writes frames of one size as a .gif file that repeats for ever. All frames have one palette of 256 colours, in
 * which even areas keep theirs; nothing is dithered. \a secondsPerFrame is rounded to hundredths; browsers slow down
 * below 0.02. GIF has no metadata. */
void
StageAnimation(const std::vector<Picture> & frames,
               double secondsPerFrame,
               const std::filesystem::path & path,
               StagedFiles & staged);

/** Writes the bytes of a PDF of version 1.4 or less to a .pdf file. Throws Failure(Output) also when they lack header,
 * trailer, or do not have \a pages pages. */
void
StagePdf(const std::string & bytes, std::size_t pages, const std::filesystem::path & path, StagedFiles & staged);

/** Reads a picture as 8-bit sRGB. Grey becomes three equal channels, without its alpha, and the linear light of EXR is
 * encoded. Of several pages the first is read.
 *
 * Throws Failure: NotFound when there is no such file; Unreadable when it is not a picture or is damaged. */
Picture
ReadPicture(const std::filesystem::path & path);

/** All pages or frames of a file. Throws as ReadPicture() does. */
std::vector<Picture>
ReadPictures(const std::filesystem::path & path);

} // namespace rhombic

#endif
