#ifndef rhombicGif_h
#define rhombicGif_h

#include "detail/rhombicPictureCodec.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Encodes frames of one size and three channels as a GIF that repeats for ever. All frames have one palette: colours
 * of even areas are kept exactly, up to 96 of them; median cut finds 160 more for the others. Nothing is dithered.
 * Returns what failed; empty if nothing did. */
std::string
EncodeGif(const PictureFile & contents, std::vector<unsigned char> & bytes);

} // namespace rhombic

#endif
