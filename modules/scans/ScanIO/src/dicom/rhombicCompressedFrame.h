#ifndef rhombicCompressedFrame_h
#define rhombicCompressedFrame_h

#include "rhombicDicomSlice.h"

#include <string>
#include <string_view>

namespace rhombic
{

/** How one frame's compressed pixels contradict its header, as "its ..."; empty when they don't.
 *
 * Checks the size, bits and components of JPEG, JPEG-LS and JPEG 2000 streams and their end, and that each segment of
 * run lengths unpacks to exactly the frame's pixels. Otherwise the codecs would write past their buffers or invent
 * pixels. */
std::string
FindFrameDamage(std::string_view frame, PixelCodec codec, const DicomPixelFormat & format);

/** The number of bits of the values in a JPEG, JPEG-LS or JPEG 2000 stream, which may differ from the header's; 0 for
 * other codecs. */
unsigned int
BitsInFrame(std::string_view frame, PixelCodec codec);

} // namespace rhombic

#endif
