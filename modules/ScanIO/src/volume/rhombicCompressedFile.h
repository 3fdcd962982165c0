#ifndef rhombicCompressedFile_h
#define rhombicCompressedFile_h

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

struct gzFile_s;
struct z_stream_s;

namespace rhombic
{

/** A file that is read from its beginning to its end, and unpacked if its content is gzip, whatever its name. Functions
 * throw Failure(Unreadable) when it can't be opened or read, or its compression is damaged. */
class UnpackedFile
{
public:
  explicit UnpackedFile(const std::filesystem::path & path);
  ~UnpackedFile();

  UnpackedFile(const UnpackedFile &) = delete;
  UnpackedFile &
  operator=(const UnpackedFile &) = delete;

  bool
  IsCompressed();

  /** The next \a size bytes, or as many as there are. */
  std::size_t
  Read(void * buffer, std::size_t size);

  /** Skips \a size bytes, or as many as there are. Returns their number. */
  std::uintmax_t
  Skip(std::uintmax_t size);

  /** Reads a compressed file to its end. Throws unless its streams are complete with the right checksums and at most
   * LongestTail bytes are left. */
  void
  Finish();

private:
  const std::filesystem::path m_Path;
  gzFile_s * m_File;
};

/** The largest number of bytes that may follow the voxels: some writers append a few. */
constexpr std::uintmax_t LongestTail = 1 << 20;

/** The largest ratio of deflate. */
constexpr std::uintmax_t LargestRatio = 1032;

/** The largest size that a file can have when unpacked: LargestRatio times its size if its content is gzip. */
std::uintmax_t
LargestUnpackedSize(const std::filesystem::path & path);

/** Bytes of a file from an offset on, as they are or unpacked by zlib (zlib or gzip streams). */
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
  std::ifstream m_File;
  std::vector<char> m_Packed;
  std::unique_ptr<z_stream_s> m_Inflation; ///< null for bytes that are not compressed
  int m_State = 0;
};

} // namespace rhombic

#endif
