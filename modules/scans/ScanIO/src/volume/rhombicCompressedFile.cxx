#include "rhombicCompressedFile.h"

#include "rhombicSandbox.h"
#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{

bool
IsGzip(const fs::path & path)
{
  char beginning[2] = {};
  return ByteStream(path, 0, false).Read(beginning, 2) == 2 && std::memcmp(beginning, "\x1f\x8b", 2) == 0;
}

ByteStream::ByteStream(const fs::path & path, std::uintmax_t offset, bool isDeflated)
{
  if (isDeflated)
  {
    constexpr std::size_t pieceSize = 1 << 18;
    m_Inflation =
      std::make_unique<SandboxRun>(SandboxJob{ "rhombic-unpack-gzip", path, std::to_string(offset), pieceSize });
    return;
  }
  m_File.open(path, std::ios::binary);
  if (!m_File)
  {
    RefuseVolume(path, std::string(std::strerror(errno)) + "; check that it is there and yours");
  }
  m_File.seekg(static_cast<std::streamoff>(offset));
}

ByteStream::~ByteStream() = default;

std::size_t
ByteStream::Read(void * buffer, std::size_t size)
{
  if (!m_Inflation)
  {
    m_File.read(static_cast<char *>(buffer), static_cast<std::streamsize>(size));
    return static_cast<std::size_t>(m_File.gcount());
  }
  return this->Take(static_cast<std::byte *>(buffer), size);
}

std::uintmax_t
ByteStream::Take(std::byte * buffer, std::uintmax_t size)
{
  std::uintmax_t left = size;
  while (left > 0 && m_HasMore)
  {
    const auto count = static_cast<std::size_t>(std::min<std::uintmax_t>(left, m_Piece.size));
    buffer = buffer != nullptr ? std::copy_n(m_Piece.data, count, buffer) : nullptr;
    m_Piece = { m_Piece.data + count, m_Piece.size - count };
    left -= count;
    if (m_Piece.size == 0)
    {
      const auto piece = m_Inflation->Next();
      m_HasMore = piece && piece->size > 0;
      m_IsComplete = piece && piece->size == 0;
      m_Piece = piece.value_or(SandboxPiece{});
      if (m_IsComplete)
      {
        m_Inflation->Next(); // nothing; the child is kept for other files
      }
    }
  }
  return size - left;
}

void
ByteStream::Skip(std::uintmax_t size)
{
  if (m_Inflation)
  {
    this->Take(nullptr, size);
  }
  else
  {
    m_File.seekg(static_cast<std::streamoff>(size), std::ios::cur);
  }
}

bool
ByteStream::EndsAfter(std::uintmax_t size)
{
  return this->Take(nullptr, size + LongestTail) >= size && m_IsComplete;
}

} // namespace rhombic
