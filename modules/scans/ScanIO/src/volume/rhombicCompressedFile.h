#ifndef rhombicCompressedFile_h
#define rhombicCompressedFile_h

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

struct z_stream_s;

namespace rhombic
{

/** Whether the content of a file is gzip, whatever its name. */
bool
IsGzip(const std::filesystem::path & path);

/** The largest number of bytes that may follow the voxels: some writers append a few. */
constexpr std::uintmax_t LongestTail = 1 << 20;

/** The largest ratio of deflate. */
constexpr std::uintmax_t LargestRatio = 1032;

/** Bytes of a file from an offset on, as they are or unpacked by zlib: a zlib stream, or gzip streams one after the
 * other. The constructor throws Failure(Unreadable) when the file can't be opened. */
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

  /** Whether exactly \a size bytes are left, and at most LongestTail more; for compressed streams, whether their end is
   * there and their checksum right. */
  bool
  EndsAfter(std::uintmax_t size);

private:
  /** Whether there are \a count packed bytes, at most m_Packed.size(), to unpack. */
  bool
  Provide(std::size_t count);

  std::ifstream m_File;
  std::vector<unsigned char> m_Packed;
  std::unique_ptr<z_stream_s> m_Inflation; ///< null for bytes that are not compressed
  int m_State = 0;
};

} // namespace rhombic

#endif
