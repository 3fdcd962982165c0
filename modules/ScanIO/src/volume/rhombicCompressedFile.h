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

/** A file read from its beginning to its end, unpacked on the way if its content is gzip, whatever its name. Functions
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

  /** Passes over \a size bytes, or as many as there are. Returns how many. */
  std::uintmax_t
  Skip(std::uintmax_t size);

  /** Checks a compressed file to its end: its streams have to be complete and their checksums right, and little may be
   * left of them. */
  void
  Finish();

private:
  const std::filesystem::path m_Path;
  gzFile_s * m_File;
};

/** The most bytes that may follow behind voxels: some writers append a few, but a file can hold any number. */
constexpr std::uintmax_t LongestTail = 1 << 20;

/** The most bytes that a file can hold, unpacked if its content is gzip: 1032 times its size, which deflate can't
 * exceed. */
std::uintmax_t
LargestUnpackedSize(const std::filesystem::path & path);

/** A zlib or gzip stream that begins somewhere in a file. */
class InflatedStream
{
public:
  InflatedStream(const std::filesystem::path & path, std::uintmax_t offset);
  ~InflatedStream();

  InflatedStream(const InflatedStream &) = delete;
  InflatedStream &
  operator=(const InflatedStream &) = delete;

  /** The next \a size bytes, or as many as there are up to the stream's end or its damage. */
  std::size_t
  Read(void * buffer, std::size_t size);

  /** Passes over \a size bytes, or as many as there are. Returns how many. */
  std::uintmax_t
  Skip(std::uintmax_t size);

  /** Passes over the rest, \a most bytes and a little more. How many bytes that was, or nothing when the stream is
   * damaged, cut off or longer. */
  std::optional<std::uintmax_t>
  Finish(std::uintmax_t most);

private:
  std::ifstream m_File;
  std::vector<char> m_Packed;
  std::unique_ptr<z_stream_s> m_Stream;
  int m_State = 0;
};

} // namespace rhombic

#endif
