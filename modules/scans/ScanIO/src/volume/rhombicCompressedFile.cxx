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

std::uintmax_t
PassOver(ByteStream & stream, std::uintmax_t size)
{
  std::vector<char> passed(std::min<std::uintmax_t>(size, 1 << 18));
  std::uintmax_t total = 0;
  while (total < size)
  {
    const std::size_t count = stream.Read(passed.data(), std::min<std::uintmax_t>(passed.size(), size - total));
    if (count == 0)
    {
      break;
    }
    total += count;
  }
  return total;
}

bool
IsGzipMagic(const void * bytes)
{
  return std::memcmp(bytes, "\x1f\x8b", 2) == 0;
}

} // namespace

bool
IsGzip(const fs::path & path)
{
  char beginning[2] = {};
  return ByteStream(path, 0, false).Read(beginning, 2) == 2 && IsGzipMagic(beginning);
}

ByteStream::ByteStream(const fs::path & path, std::uintmax_t offset, bool isDeflated)
  : m_File(path, std::ios::binary)
{
  if (!m_File)
  {
    RefuseVolume(path, std::string(std::strerror(errno)) + "; check that it is there and yours");
  }
  m_File.seekg(static_cast<std::streamoff>(offset));
  if (isDeflated)
  {
    m_Packed.resize(1 << 17);
    m_Inflation.reset(new z_stream{});
    m_Inflation->next_in = m_Packed.data();
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
  while (total < size && m_State == Z_OK && this->Provide(1))
  {
    const auto room = static_cast<uInt>(std::min(largest, size - total));
    m_Inflation->next_out = static_cast<Bytef *>(buffer) + total;
    m_Inflation->avail_out = room;
    m_State = inflate(m_Inflation.get(), Z_NO_FLUSH);
    total += room - m_Inflation->avail_out;
    if (m_State == Z_STREAM_END && this->Provide(2) && IsGzipMagic(m_Inflation->next_in))
    {
      m_State = inflateReset(m_Inflation.get());
    }
  }
  return total;
}

bool
ByteStream::Provide(std::size_t count)
{
  z_stream & inflation = *m_Inflation;
  if (inflation.avail_in < count)
  {
    std::copy_n(inflation.next_in, inflation.avail_in, m_Packed.begin());
    inflation.next_in = m_Packed.data();
    m_File.read(reinterpret_cast<char *>(m_Packed.data()) + inflation.avail_in,
                static_cast<std::streamsize>(m_Packed.size() - inflation.avail_in));
    inflation.avail_in += static_cast<uInt>(m_File.gcount());
  }
  return inflation.avail_in >= count;
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
