#include "rhombicCompressedFile.h"

#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <vector>

#include <zlib.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

template <typename TSource>
std::uintmax_t
PassOver(TSource & source, std::uintmax_t size)
{
  std::vector<char> passed(std::min<std::uintmax_t>(size, 1 << 18));
  std::uintmax_t total = 0;
  while (total < size)
  {
    const std::size_t count = source.Read(passed.data(), std::min<std::uintmax_t>(passed.size(), size - total));
    if (count == 0)
    {
      break;
    }
    total += count;
  }
  return total;
}

constexpr std::uintmax_t LargestRatio = 1032; // largest ratio of deflate

} // namespace

UnpackedFile::UnpackedFile(const fs::path & path)
  : m_Path(path)
  , m_File(gzopen(path.c_str(), "rb")) // files that are not compressed are read as they are
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
  return PassOver(*this, size);
}

void
UnpackedFile::Finish()
{
  if (!this->IsCompressed())
  {
    return;
  }
  if (this->Skip(LongestTail + 1) > LongestTail)
  {
    RefuseVolume(m_Path, "its compressed content goes on behind the voxels that its header announces; export it again");
  }
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
  const std::uintmax_t size = fs::file_size(path);
  return UnpackedFile(path).IsCompressed() ? size * LargestRatio : size;
}

InflatedStream::InflatedStream(const fs::path & path, std::uintmax_t offset)
  : m_File(path, std::ios::binary)
  , m_Packed(1 << 16)
  , m_Stream(new z_stream{})
{
  m_File.seekg(static_cast<std::streamoff>(offset));
  constexpr int zlibOrGzip = 15 + 32; // zlib's window bits, and 32 for either header
  if (inflateInit2(m_Stream.get(), zlibOrGzip) != Z_OK)
  {
    throw std::bad_alloc();
  }
}

InflatedStream::~InflatedStream()
{
  inflateEnd(m_Stream.get());
}

std::size_t
InflatedStream::Read(void * buffer, std::size_t size)
{
  constexpr std::size_t largest = 1 << 30; // zlib counts in unsigned int
  std::size_t total = 0;
  while (total < size && m_State == Z_OK)
  {
    if (m_Stream->avail_in == 0)
    {
      m_File.read(m_Packed.data(), static_cast<std::streamsize>(m_Packed.size()));
      m_Stream->next_in = reinterpret_cast<Bytef *>(m_Packed.data());
      m_Stream->avail_in = static_cast<uInt>(m_File.gcount());
      if (m_Stream->avail_in == 0)
      {
        break;
      }
    }
    const auto room = static_cast<uInt>(std::min(largest, size - total));
    m_Stream->next_out = static_cast<Bytef *>(buffer) + total;
    m_Stream->avail_out = room;
    m_State = inflate(m_Stream.get(), Z_NO_FLUSH);
    total += room - m_Stream->avail_out;
  }
  return total;
}

std::uintmax_t
InflatedStream::Skip(std::uintmax_t size)
{
  return PassOver(*this, size);
}

std::optional<std::uintmax_t>
InflatedStream::Finish(std::uintmax_t most)
{
  const std::uintmax_t total = this->Skip(most + LongestTail);
  return m_State == Z_STREAM_END ? std::make_optional(total) : std::nullopt;
}

} // namespace rhombic
