#ifndef rhombicCompressedFile_h
#define rhombicCompressedFile_h

#include "rhombicSandbox.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>

namespace rhombic
{

/** Whether the content of a file is gzip, whatever its name. */
bool
IsGzip(const std::filesystem::path & path);

/** The largest number of bytes that may follow the voxels: some writers append a few. */
constexpr std::uintmax_t LongestTail = 1 << 20;

/** The largest ratio of deflate. */
constexpr std::uintmax_t LargestRatio = 1032;

/** Bytes of a file from an offset on, as they are or unpacked by zlib in a child process: a zlib stream, or gzip
 * streams one after the other. The constructor throws Failure(Unreadable) when the file can't be opened, all functions
 * as SandboxRun does. */
class ByteStream
{
public:
  ByteStream(const std::filesystem::path & path, std::uintmax_t offset, bool isDeflated);
  ~ByteStream();

  ByteStream(const ByteStream &) = delete;
  ByteStream &
  operator=(const ByteStream &) = delete;

  /** The next \a size bytes, or fewer at the end of the stream or where it is damaged. */
  std::size_t
  Read(void * buffer, std::size_t size);

  /** Skips \a size bytes, or as many as there are. */
  void
  Skip(std::uintmax_t size);

  /** For compressed streams: whether \a size bytes are left, and less than LongestTail more, their end is there and
   * their checksum right. */
  bool
  EndsAfter(std::uintmax_t size);

private:
  /** Copies the next unpacked bytes to \a buffer unless it is null. Returns their number: \a size, or fewer at the end
   * of the stream or where it is damaged. */
  std::uintmax_t
  Take(std::byte * buffer, std::uintmax_t size);

  std::ifstream m_File;                    ///< of bytes that are not compressed
  std::unique_ptr<SandboxRun> m_Inflation; ///< null for them
  SandboxPiece m_Piece{};                  ///< unpacked bytes that were not taken
  bool m_HasMore = true;                   ///< whether there may be more of them
  bool m_IsComplete = false;               ///< whether the end of the stream was reached
};

} // namespace rhombic

#endif
