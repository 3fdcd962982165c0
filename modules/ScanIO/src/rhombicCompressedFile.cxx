#include "rhombicCompressedFile.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <vector>

#include <zlib.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** zlib reads files that are not compressed as they are. */
class GzipFile
{
public:
  explicit GzipFile(const fs::path & path)
    : m_File(gzopen(path.c_str(), "rb"))
  {
    if (m_File == nullptr)
    {
      throw Failure(FailureKind::Unreadable,
                    "Cannot read " + path.string() + ": " + std::strerror(errno) +
                      "; check that it is there and yours.");
    }
    gzbuffer(m_File, 1 << 17);
  }

  ~GzipFile()
  {
    if (m_File != nullptr)
    {
      gzclose(m_File);
    }
  }

  GzipFile(const GzipFile &) = delete;
  GzipFile &
  operator=(const GzipFile &) = delete;

  /** Bytes read, 0 at the end, negative for damage. */
  int
  Read(char * buffer, std::size_t size)
  {
    return gzread(m_File, buffer, static_cast<unsigned int>(size));
  }

  bool
  IsCompressed()
  {
    return gzdirect(m_File) == 0;
  }

  /** Whether the last stream was complete. */
  bool
  Close()
  {
    const int result = gzclose(m_File);
    m_File = nullptr;
    return result == Z_OK;
  }

private:
  gzFile m_File;
};

} // namespace

std::string
ReadBeginning(const fs::path & path, std::size_t size)
{
  GzipFile file(path);
  if (file.IsCompressed() != (path.extension() == ".gz"))
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() +
                    ": its name and content disagree about compression; rename it to or from .gz.");
  }
  std::string bytes(size, '\0');
  const int count = file.Read(bytes.data(), size);
  if (count < 0)
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": its compression is damaged; copy it again.");
  }
  bytes.resize(static_cast<std::size_t>(count));
  return bytes;
}

std::uintmax_t
CountBytes(const fs::path & path, std::uintmax_t enough)
{
  if (path.extension() != ".gz")
  {
    return fs::file_size(path);
  }
  constexpr std::uintmax_t tolerated = 1 << 20; // what some programs leave behind the pixels
  GzipFile file(path);
  std::vector<char> buffer(1 << 18);
  std::uintmax_t total = 0;
  int count = 0;
  while (total <= enough + tolerated && (count = file.Read(buffer.data(), buffer.size())) > 0)
  {
    total += static_cast<std::uintmax_t>(count);
  }
  const bool isComplete = file.Close();
  return count > 0 || (count == 0 && isComplete) ? total : 0;
}

std::uintmax_t
CountInflated(const fs::path & path, std::uintmax_t offset, std::uintmax_t enough)
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
  std::vector<Bytef> unpacked(1 << 18);
  std::uintmax_t total = 0;
  int state = Z_OK;
  while (state == Z_OK && total < enough)
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
    stream.next_out = unpacked.data();
    stream.avail_out = static_cast<uInt>(unpacked.size());
    state = inflate(&stream, Z_NO_FLUSH);
    total += unpacked.size() - stream.avail_out;
  }
  inflateEnd(&stream);
  return total;
}

} // namespace rhombic
