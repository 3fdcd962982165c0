#include "rhombicCompressedFrame.h"

#include <algorithm>
#include <cstdint>

namespace rhombic
{
namespace
{

/** The properties of the picture in a stream; all 0 when it has none. */
struct StreamPicture
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned int bits = 0;
  unsigned int components = 0;
};

std::uint32_t
BigEndian(std::string_view bytes, std::size_t offset, std::size_t count)
{
  std::uint32_t number = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[offset + n]);
  }
  return number;
}

std::uint32_t
LittleEndian(std::string_view bytes, std::size_t offset)
{
  std::uint32_t number = 0;
  for (std::size_t n = 4; n-- > 0;)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[offset + n]);
  }
  return number;
}

/** From the SIZ marker that JPEG 2000 begins with (ISO/IEC 15444-1, A.5.1). */
StreamPicture
PictureInJPEG2000(std::string_view stream)
{
  constexpr std::size_t needed = 43;
  const std::size_t marker = stream.find("\xff\x4f\xff\x51");
  if (marker == std::string_view::npos || marker + needed > stream.size())
  {
    return {};
  }
  const auto at = [&](std::size_t offset, std::size_t count) { return BigEndian(stream, marker + offset, count); };
  return { at(8, 4) - at(16, 4), at(12, 4) - at(20, 4), (at(42, 1) & 0x7f) + 1, at(40, 2) };
}

/** From the start-of-frame marker of JPEG or JPEG-LS, which comes after other segments (ISO/IEC 10918-1, B.2.2). */
StreamPicture
PictureInJPEG(std::string_view stream)
{
  constexpr std::size_t needed = 10;
  for (std::size_t segment = 2; segment + needed <= stream.size() && stream[segment] == '\xff';)
  {
    const std::uint32_t code = BigEndian(stream, segment + 1, 1);
    const bool isTable = code == 0xc4 || code == 0xc8 || code == 0xcc;
    if ((code >= 0xc0 && code <= 0xcf && !isTable) || code == 0xf7)
    {
      return { BigEndian(stream, segment + 7, 2),
               BigEndian(stream, segment + 5, 2),
               BigEndian(stream, segment + 4, 1),
               BigEndian(stream, segment + 9, 1) };
    }
    segment += 2 + BigEndian(stream, segment + 2, 2);
  }
  return {};
}

/** Whether a stream ends with FF D9, as JPEG, JPEG-LS and JPEG 2000 do; padding may follow. */
bool
HasEndMarker(std::string_view stream)
{
  const std::size_t last = stream.find_last_not_of(std::string_view("\0\xff", 2));
  return last != std::string_view::npos && last > 0 && stream[last] == '\xd9' && stream[last - 1] == '\xff';
}

std::string
FindPictureDamage(std::string_view stream, const StreamPicture & picture, const DicomPixelFormat & format)
{
  if (picture.width != format.columns || picture.height != format.rows)
  {
    return "its compressed pixels are " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
           ", its header says " + std::to_string(format.columns) + "x" + std::to_string(format.rows);
  }
  const bool needsTwoBytes = picture.bits > 8;
  if (picture.components != 1 || picture.bits == 0 || picture.bits > format.bitsAllocated ||
      needsTwoBytes != (format.bitsAllocated > 8 && format.bitsStored > 8))
  {
    return "its compressed pixels have " + std::to_string(picture.components) +
           (picture.components == 1 ? " component of " : " components of ") + std::to_string(picture.bits) +
           " bits, its header says one of " + std::to_string(format.bitsStored);
  }
  return HasEndMarker(stream) ? "" : "its compressed pixels are cut off";
}

/** Whether PackBits runs (TIFF 6.0, section 9) unpack to \a size bytes and are followed by padding only. */
bool
UnpacksTo(std::string_view packed, std::size_t size)
{
  std::size_t count = 0;
  std::size_t n = 0;
  while (count < size && n < packed.size())
  {
    const auto code = static_cast<signed char>(packed[n++]);
    if (code >= 0) // code + 1 literal bytes
    {
      n += static_cast<std::size_t>(code) + 1;
      count += static_cast<std::size_t>(code) + 1;
    }
    else if (code != -128) // one byte, 1 - code times
    {
      n += 1;
      count += static_cast<std::size_t>(1 - code);
    }
  }
  const std::string_view padding("\0\x80", 2);
  return count == size && n <= packed.size() && packed.find_first_not_of(padding, n) == std::string_view::npos;
}

/** PS3.5, annex G: a table of offsets, then a segment for each byte of a pixel. */
std::string
FindRunLengthDamage(std::string_view frame, const DicomPixelFormat & format)
{
  constexpr std::size_t tableSize = 64;
  constexpr std::size_t mostSegments = 15;
  const std::size_t segments = format.bitsAllocated / 8;
  const std::size_t pixels = std::size_t{ format.columns } * format.rows;
  if (segments == 0 || segments > mostSegments)
  {
    return "run lengths can't hold its pixels of " + std::to_string(format.bitsAllocated) + " bits";
  }
  if (frame.size() < tableSize || LittleEndian(frame, 0) != segments)
  {
    return "the table before its run lengths is damaged";
  }
  for (std::size_t n = 0; n < segments; ++n)
  {
    const std::size_t begin = LittleEndian(frame, 4 + 4 * n);
    const std::size_t end = n + 1 < segments ? LittleEndian(frame, 8 + 4 * n) : frame.size();
    const std::size_t expected = n == 0 ? tableSize : begin;
    if (begin != expected || begin > end || end > frame.size())
    {
      return "the table before its run lengths is damaged";
    }
    if (!UnpacksTo(frame.substr(begin, end - begin), pixels))
    {
      return "its run lengths unpack to something else than its pixels";
    }
  }
  return "";
}

} // namespace

std::string
FindFrameDamage(std::string_view frame, PixelCodec codec, const DicomPixelFormat & format)
{
  switch (codec)
  {
    case PixelCodec::JPEG:
    case PixelCodec::JPEGLS:
      return FindPictureDamage(frame, PictureInJPEG(frame), format);
    case PixelCodec::JPEG2000:
      return FindPictureDamage(frame, PictureInJPEG2000(frame), format);
    case PixelCodec::RunLength:
      return FindRunLengthDamage(frame, format);
    default:
      return "its compression is not supported";
  }
}

unsigned int
BitsInFrame(std::string_view frame, PixelCodec codec)
{
  switch (codec)
  {
    case PixelCodec::JPEG:
    case PixelCodec::JPEGLS:
      return PictureInJPEG(frame).bits;
    case PixelCodec::JPEG2000:
      return PictureInJPEG2000(frame).bits;
    default:
      return 0;
  }
}

} // namespace rhombic
