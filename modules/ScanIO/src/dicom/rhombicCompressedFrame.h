#ifndef rhombicCompressedFrame_h
#define rhombicCompressedFrame_h

#include "rhombicDicomSlice.h"
#include "rhombicTransferSyntax.h"

#include <string>
#include <string_view>

namespace rhombic
{

/** Why one frame's compressed pixels can't be what its header says, as "its ..."; empty when they may be.
 *
 * JPEG, JPEG-LS and JPEG 2000: size, bits and components of the stream, and its end; run lengths: that every segment
 * unpacks to exactly the frame's pixels. The codecs write past their buffers, or make up pixels, when these differ. */
std::string
FindFrameDamage(std::string_view frame, PixelCodec codec, const DicomPixelFormat & format);

/** How many bits the values of a stream of JPEG, JPEG-LS or JPEG 2000 may have, whatever the header says; 0 for other
 * codecs. */
unsigned int
BitsInFrame(std::string_view frame, PixelCodec codec);

} // namespace rhombic

#endif
