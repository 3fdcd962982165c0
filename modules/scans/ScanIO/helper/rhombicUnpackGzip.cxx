// rhombic-unpack-gzip: unpacks zlib and gzip streams by zlib.

#include "rhombicSandboxChild.h"

#include <algorithm>
#include <cstring>
#include <string>

#include <zlib.h>

namespace rhombic
{
namespace
{

/** Unpacks the zlib stream, or gzip streams one after the other, that begin at the byte whose number is the argument:
 * to their end or to where they are damaged. A piece without bytes says that they are complete, with right checksums.
 */
void
UnpackGzip(const SandboxInput & input, SandboxOutput & output)
{
  const std::byte * next = input.file + std::min<std::size_t>(input.size, std::stoull(input.arguments));
  const std::byte * const end = input.file + input.size;
  z_stream stream{};
  constexpr int zlibOrGzip = 15 + 32; // zlib's window bits, and 32 for either header
  int state = inflateInit2(&stream, zlibOrGzip);
  while (state == Z_OK && next != end)
  {
    stream.next_out = reinterpret_cast<Bytef *>(output.GetBuffer());
    stream.avail_out = static_cast<uInt>(output.GetSize());
    while (state == Z_OK && next != end && stream.avail_out > 0)
    {
      constexpr std::ptrdiff_t largest = 1 << 30; // zlib counts in unsigned int
      stream.next_in = const_cast<Bytef *>(reinterpret_cast<const Bytef *>(next));
      stream.avail_in = static_cast<uInt>(std::min(largest, end - next));
      state = inflate(&stream, Z_NO_FLUSH);
      next = reinterpret_cast<const std::byte *>(stream.next_in);
      const bool goesOn = state == Z_STREAM_END && end - next >= 2 && std::memcmp(next, "\x1f\x8b", 2) == 0;
      state = goesOn ? inflateReset(&stream) : state;
    }
    if (const std::size_t size = output.GetSize() - stream.avail_out; size > 0)
    {
      output.Deliver(size);
    }
  }
  if (state == Z_STREAM_END)
  {
    output.Deliver(0);
  }
  inflateEnd(&stream); // not reached after an exception, which ends this process
}

} // namespace
} // namespace rhombic

int
main(int argc, char ** argv)
{
  return rhombic::RunSandboxChild(argc, argv, rhombic::UnpackGzip);
}
