// rhombic-unpack-chunk: unpacks the chunks of Zarr arrays.

#include "rhombicSandboxChild.h"

#include <limits>
#include <string>

#include <blosc.h>
#include <zlib.h>
#include <zstd.h>

namespace rhombic
{
namespace
{

[[noreturn]] void
RefuseChunk(const std::string & codec)
{
  throw SandboxRefusal("its " + codec +
                       " content is damaged, or is not as large as the array's chunks; copy it again from its source");
}

/** Unpacks one zlib or gzip stream. Returns whether it is sound and gives exactly \a size bytes. */
bool
Inflate(const SandboxInput & input, std::byte * buffer, std::size_t size)
{
  constexpr int zlibOrGzip = 15 + 32; // zlib's window bits, and 32 for either header
  constexpr std::size_t largest = std::numeric_limits<uInt>::max();
  z_stream stream{};
  if (input.size > largest || size > largest || inflateInit2(&stream, zlibOrGzip) != Z_OK)
  {
    return false;
  }
  stream.next_in = const_cast<Bytef *>(reinterpret_cast<const Bytef *>(input.file));
  stream.avail_in = static_cast<uInt>(input.size);
  stream.next_out = reinterpret_cast<Bytef *>(buffer);
  stream.avail_out = static_cast<uInt>(size);
  const int state = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  return state == Z_STREAM_END && stream.avail_out == 0 && stream.avail_in == 0;
}

/** Unpacks blosc's content, by one thread. Returns whether it is sound and gives exactly \a size bytes. */
bool
UnpackBlosc(const SandboxInput & input, std::byte * buffer, std::size_t size)
{
  std::size_t announced = 0;
  const bool isSound = blosc_cbuffer_validate(input.file, input.size, &announced) == 0 && announced == size;
  const int unpacked = isSound ? blosc_decompress_ctx(input.file, buffer, size, 1) : -1;
  return unpacked >= 0 && static_cast<std::size_t>(unpacked) == size;
}

/** Unpacks frames of zstd. Returns whether they are sound and give exactly \a size bytes. */
bool
UnpackZstd(const SandboxInput & input, std::byte * buffer, std::size_t size)
{
  return ZSTD_decompress(buffer, size, input.file, input.size) == size; // errors are larger than any size
}

/** Unpacks a chunk, whose codec is the argument, to exactly as many bytes as a piece has. */
void
UnpackChunk(const SandboxInput & input, SandboxOutput & output)
{
  const std::string & codec = input.arguments;
  std::byte * const buffer = output.GetBuffer();
  const std::size_t size = output.GetSize();
  const bool isSound = codec == "blosc"  ? UnpackBlosc(input, buffer, size)
                       : codec == "zstd" ? UnpackZstd(input, buffer, size)
                                         : (codec == "zlib" || codec == "gzip") && Inflate(input, buffer, size);
  if (!isSound)
  {
    RefuseChunk(codec);
  }
  output.Deliver(size);
}

} // namespace
} // namespace rhombic

int
main(int argc, char ** argv)
{
  return rhombic::RunSandboxChild(argc, argv, rhombic::UnpackChunk);
}
