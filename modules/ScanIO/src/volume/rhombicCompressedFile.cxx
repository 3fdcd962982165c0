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

ByteStream::ByteStream(const fs::path & path, std::uintmax_t offset, bool isDeflated)
  : m_File(path, std::ios::binary)
{
  m_File.seekg(static_cast<std::streamoff>(offset));
  if (isDeflated)
  {
    m_Packed.resize(1 << 16);
    m_Inflation.reset(new z_stream{});
    constexpr int zlibOrGzip = 15 + 32; // zlib's window bits, and 32 for either header
    if (inflateInit2(m_Inflation.get(), zlibOrGzip) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
}

ByteStream::~ByteStream()
{
  if (m_Inflation)
  {
    inflateEnd(m_Inflation.get());
  }
}

std::size_t
ByteStream::Read(void * buffer, std::size_t size)
{
  if (!m_Inflation)
  {
    m_File.read(static_cast<char *>(buffer), static_cast<std::streamsize>(size));
    return static_cast<std::size_t>(m_File.gcount());
  }
  constexpr std::size_t largest = 1 << 30; // zlib counts in unsigned int
  std::size_t total = 0;
  while (total < size && m_State == Z_OK)
  {
    if (m_Inflation->avail_in == 0)
    {
      m_File.read(m_Packed.data(), static_cast<std::streamsize>(m_Packed.size()));
      m_Inflation->next_in = reinterpret_cast<Bytef *>(m_Packed.data());
      m_Inflation->avail_in = static_cast<uInt>(m_File.gcount());
      if (m_Inflation->avail_in == 0)
      {
        break;
      }
    }
    const auto room = static_cast<uInt>(std::min(largest, size - total));
    m_Inflation->next_out = static_cast<Bytef *>(buffer) + total;
    m_Inflation->avail_out = room;
    m_State = inflate(m_Inflation.get(), Z_NO_FLUSH);
    total += room - m_Inflation->avail_out;
  }
  return total;
}

void
ByteStream::Skip(std::uintmax_t size)
{
  if (m_Inflation)
  {
    PassOver(*this, size);
  }
  else
  {
    m_File.seekg(static_cast<std::streamoff>(size), std::ios::cur);
  }
}

bool
ByteStream::EndsAfter(std::uintmax_t size)
{
  const std::uintmax_t left = PassOver(*this, size + LongestTail);
  return left >= size && m_State == Z_STREAM_END;
}

} // namespace rhombic
