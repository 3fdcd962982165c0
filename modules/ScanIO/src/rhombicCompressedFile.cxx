#include "rhombicCompressedFile.h"

#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <vector>

#include <zlib.h>

namespace fs = std::filesystem;

namespace rhombic
{

UnpackedFile::UnpackedFile(const fs::path & path)
  : m_Path(path)
  , m_File(gzopen(path.c_str(), "rb")) // reads files that are not compressed as they are
{
  if (m_File == nullptr)
  {
    RefuseVolume(path, std::string(std::strerror(errno)) + "; check that it is there and yours");
  }
  gzbuffer(m_File, 1 << 17);
}

UnpackedFile::~UnpackedFile()
{
  gzclose(m_File);
}

bool
UnpackedFile::IsCompressed()
{
  return gzdirect(m_File) == 0;
}

std::size_t
UnpackedFile::Read(void * buffer, std::size_t size)
{
  constexpr std::size_t largest = 1 << 30; // gzread counts in int
  std::size_t total = 0;
  while (total < size)
  {
    const auto step = static_cast<unsigned int>(std::min(largest, size - total));
    const int count = gzread(m_File, static_cast<char *>(buffer) + total, step);
    if (count < 0)
    {
      RefuseVolume(m_Path, "its compression is damaged, or the disk is; copy it again");
    }
    if (count == 0)
    {
      break;
    }
    total += static_cast<std::size_t>(count);
  }
  return total;
}

std::uintmax_t
UnpackedFile::Skip(std::uintmax_t size)
{
  std::vector<char> passed(std::min<std::uintmax_t>(size, 1 << 18));
  std::uintmax_t total = 0;
  while (total < size)
  {
    const std::size_t count = this->Read(passed.data(), std::min<std::uintmax_t>(passed.size(), size - total));
    if (count == 0)
    {
      break;
    }
    total += count;
  }
  return total;
}

void
UnpackedFile::Finish()
{
  if (!this->IsCompressed())
  {
    return;
  }
  this->Skip(UINTMAX_MAX);
  int state = Z_OK;
  gzerror(m_File, &state);
  if (state != Z_OK)
  {
    RefuseVolume(m_Path, "its compressed content is cut off; copy it again");
  }
}

std::uintmax_t
LargestUnpackedSize(const fs::path & path)
{
  constexpr std::uintmax_t ratio = 1032;
  const std::uintmax_t size = fs::file_size(path);
  return UnpackedFile(path).IsCompressed() ? size * ratio : size;
}

bool
Inflate(const fs::path & path,
        std::uintmax_t offset,
        const std::function<void(const std::byte * bytes, std::size_t count)> & take)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  constexpr int zlibOrGzip = 15 + 32; // zlib's window bits, and 32 for either header
  z_stream stream{};
  if (inflateInit2(&stream, zlibOrGzip) != Z_OK)
  {
    throw std::bad_alloc();
  }
  std::vector<char> packed(1 << 16);
  std::vector<std::byte> unpacked(1 << 18);
  int state = Z_OK;
  while (state == Z_OK)
  {
    if (stream.avail_in == 0)
    {
      file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
      stream.next_in = reinterpret_cast<Bytef *>(packed.data());
      stream.avail_in = static_cast<uInt>(file.gcount());
      if (stream.avail_in == 0)
      {
        break;
      }
    }
    stream.next_out = reinterpret_cast<Bytef *>(unpacked.data());
    stream.avail_out = static_cast<uInt>(unpacked.size());
    state = inflate(&stream, Z_NO_FLUSH);
    take(unpacked.data(), unpacked.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END;
}

std::uintmax_t
CountInflated(const fs::path & path, std::uintmax_t offset)
{
  std::uintmax_t total = 0;
  const bool isWhole = Inflate(path, offset, [&total](const std::byte *, std::size_t count) { total += count; });
  return isWhole ? total : 0;
}

} // namespace rhombic
