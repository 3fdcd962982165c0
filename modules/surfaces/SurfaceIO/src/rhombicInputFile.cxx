#include "rhombicInputFile.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

constexpr std::size_t BlockSize = std::size_t{ 1 } << 20;

} // namespace

InputFile::InputFile(const std::filesystem::path & path)
  : m_Path(path)
  , m_Descriptor(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC))
{
  struct stat status
  {};
  if (m_Descriptor < 0)
  {
    const bool isMissing = errno == ENOENT || errno == ENOTDIR;
    throw Failure(isMissing ? FailureKind::NotFound : FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + std::strerror(errno) +
                    (isMissing ? "; check its name." : "; check its permissions."));
  }
  if (fstat(m_Descriptor, &status) != 0 || !S_ISREG(status.st_mode))
  {
    close(m_Descriptor);
    this->Refuse("it is no regular file; name a surface file");
  }
  m_Size = static_cast<std::uintmax_t>(status.st_size);
}

InputFile::~InputFile()
{
  if (m_Descriptor >= 0)
  {
    close(m_Descriptor);
  }
}

void
InputFile::Read(std::uintmax_t offset, void * to, std::size_t size) const
{
  if (offset > m_Size || size > m_Size - offset)
  {
    this->Refuse("it ends early; it may be a part of a file, so copy or export it again");
  }
  if (m_Bytes != nullptr)
  {
    std::copy_n(m_Bytes + offset, size, static_cast<std::byte *>(to));
    return;
  }
  for (std::size_t done = 0; done < size;)
  {
    const ssize_t count =
      pread(m_Descriptor, static_cast<char *>(to) + done, size - done, static_cast<off_t>(offset + done));
    if (count == 0 || (count < 0 && errno != EINTR))
    {
      this->Refuse(count == 0 ? "it became shorter meanwhile; try again" : std::strerror(errno));
    }
    done += count < 0 ? 0 : static_cast<std::size_t>(count);
  }
}

void
InputFile::Refuse(const std::string & why) const
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + m_Path.string() + ": " + why + ".");
}

void
InputFile::RefuseDamaged(const std::string & flaw) const
{
  this->Refuse(flaw + "; the file is damaged, so export it again");
}

void
InputFile::RequireMemoryToRead(std::uintmax_t bytes) const
{
  RequireMemory(bytes, 0, "Reading " + m_Path.string());
}

void
InputStream::Fill(std::size_t size)
{
  m_Block.erase(m_Block.begin(), m_Block.begin() + static_cast<std::ptrdiff_t>(m_Taken));
  m_Taken = 0;
  const std::size_t kept = m_Block.size();
  const auto more =
    static_cast<std::size_t>(std::min<std::uintmax_t>(std::max(size, BlockSize), m_File.GetSize() - m_Next));
  if (kept + more < size)
  {
    m_File.Refuse("it ends early; it may be a part of a file, so copy or export it again");
  }
  m_Block.resize(kept + more);
  m_File.Read(m_Next, m_Block.data() + kept, more);
  m_Next += more;
}

bool
InputStream::TakeLine(std::string_view & line)
{
  std::size_t searched = 0;
  for (;;)
  {
    const char * const begin = m_Block.data() + m_Taken;
    const std::size_t available = m_Block.size() - m_Taken;
    const void * const found =
      available == searched ? nullptr : std::memchr(begin + searched, '\n', available - searched);
    const bool isLast = found == nullptr && m_Next == m_File.GetSize();
    if (isLast && available == 0)
    {
      return false;
    }
    if (found != nullptr || isLast)
    {
      const std::size_t length =
        found == nullptr ? available : static_cast<std::size_t>(static_cast<const char *>(found) - begin);
      ++m_LineNumber;
      m_Taken += length + (found != nullptr);
      line = m_LineNumber == 1 ? WithoutMark({ begin, length }) : std::string_view(begin, length);
      if (!line.empty() && line.back() == '\r')
      {
        line.remove_suffix(1);
      }
      return true;
    }
    if (available > BlockSize)
    {
      ++m_LineNumber;
      this->RefuseLine("it is longer than any such file has; check what kind of file it is");
    }
    searched = available;
    this->Fill(available + 1);
  }
}

void
InputStream::RefuseLine(const std::string & why) const
{
  throw Failure(FailureKind::Unreadable,
                "Cannot read " + m_File.GetPath().string() + ", line " + std::to_string(m_LineNumber) + ": " + why +
                  ".");
}

} // namespace rhombic
