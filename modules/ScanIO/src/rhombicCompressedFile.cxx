#include "rhombicCompressedFile.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <cstring>
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
  GzipFile & operator=(const GzipFile &) = delete;

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

} // namespace rhombic
