#ifndef rhombicCompressedFile_h
#define rhombicCompressedFile_h

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

struct gzFile_s;

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

  /** Checks a compressed file to its end: its streams have to be complete and their checksums right. */
  void
  Finish();

private:
  const std::filesystem::path m_Path;
  gzFile_s * m_File;
};

/** The most bytes that a file can hold, unpacked if its content is gzip: 1032 times its size, which deflate can't
 * exceed. */
std::uintmax_t
LargestUnpackedSize(const std::filesystem::path & path);

/** Unpacks the zlib or gzip stream that begins at \a offset of a file: calls take(bytes, count) for each part. False
 * when it is damaged or cut off. */
bool
Inflate(const std::filesystem::path & path,
        std::uintmax_t offset,
        const std::function<void(const std::byte * bytes, std::size_t count)> & take);

/** How many bytes the stream unpacks to; 0 when it is damaged or cut off. */
std::uintmax_t
CountInflated(const std::filesystem::path & path, std::uintmax_t offset);

} // namespace rhombic

#endif
