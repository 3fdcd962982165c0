#ifndef rhombicThumbnail_h
#define rhombicThumbnail_h

#include "rhombicPictureIO.h"
#include "rhombicSidecar.h"

namespace rhombic
{

/** Writes the first of some pictures as one of at most 320 pixels a side: means of blocks, and adds it to the
 * outputs. Does nothing without pictures or path. Throws Failure as StagePicture() does. */
void
StageThumbnail(const std::vector<Picture> & pictures,
               const std::filesystem::path & path,
               StagedFiles & staged,
               std::vector<MadeFile> & outputs);

} // namespace rhombic

#endif
