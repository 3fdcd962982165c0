#include "rhombicCompressedFrame.h"
#include "rhombicFuzzBytes.h"
#include "rhombicFuzzProperty.h"

using rhombic::DicomPixelFormat;
using rhombic::PixelCodec;
using rhombicfuzz::FuzzBytes;
using rhombicfuzz::Require;

namespace
{

std::size_t
LittleEndian(std::string_view bytes, std::size_t offset)
{
  FuzzBytes number(reinterpret_cast<const std::uint8_t *>(bytes.data()) + offset, 4);
  return number.Take<std::uint32_t>();
}

/** How many bytes a decoder that checks nothing would write. */
std::size_t
UnpackedSize(std::string_view packed, std::size_t needed)
{
  std::size_t written = 0;
  for (std::size_t n = 0; n < packed.size() && written < needed;)
  {
    const int code = static_cast<signed char>(packed[n]);
    written += code == -128 ? 0 : static_cast<std::size_t>(code >= 0 ? code + 1 : 1 - code);
    n += code == -128 ? 1 : code >= 0 ? static_cast<std::size_t>(code) + 2 : 2;
    Require(n <= packed.size(), "no run reaches behind its segment");
  }
  return written;
}

void
CheckRunLengths(std::string_view frame, const DicomPixelFormat & format)
{
  const std::size_t pixels = std::size_t{ format.columns } * format.rows;
  const std::size_t segments = LittleEndian(frame, 0);
  Require(segments * pixels == format.FrameBytes(), "segments make up the frame");
  Require(segments > 0 && segments <= 15, "the table holds its segments");
  for (std::size_t n = 0; n < segments; ++n)
  {
    const std::size_t begin = LittleEndian(frame, 4 + 4 * n);
    const std::size_t end = n + 1 < segments ? LittleEndian(frame, 8 + 4 * n) : frame.size();
    Require(begin <= end && end <= frame.size(), "segments lie inside the frame");
    Require(UnpackedSize(frame.substr(begin, end - begin), pixels) == pixels, "a segment unpacks to the pixels");
  }
}

} // namespace

/** The codec, bits allocated and stored, columns and rows (16 bits each, little endian), then the frame. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  FuzzBytes bytes(data, size);
  constexpr unsigned int usualBits[]{ 1, 8, 16, 32 };
  const auto codec = static_cast<PixelCodec>(bytes.TakeBelow(6));
  const auto bits = bytes.Take<std::uint8_t>();
  DicomPixelFormat format;
  format.bitsAllocated = bits < 4 ? usualBits[bits] : 8u * bits;
  format.bitsStored = bytes.Take<std::uint8_t>();
  format.columns = bytes.Take<std::uint16_t>();
  format.rows = bytes.Take<std::uint16_t>();

  const std::string frame(bytes.Rest()); // of its exact size, so that sanitizers see what lies behind it
  const std::string damage = FindFrameDamage(frame, codec, format);
  if (damage.empty() && codec == PixelCodec::RunLength)
  {
    CheckRunLengths(frame, format);
  }
  return 0;
}
