#include "rhombicMappedPages.h"

#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

namespace rhombic
{
namespace
{

namespace fs = std::filesystem;

constexpr char NoAddresses[] = "a limit of the address space, as ulimit -v, forbids it";

[[noreturn]] void
Refuse(const TemporaryStore & store, const std::string & why)
{
  throw Failure(FailureKind::Memory,
                store.what +
                  " are too large for the memory that is allowed, and can't be put into temporary files in " +
                  store.FindFolder().string() + " (" + why + "); name a folder on a disk with more room by " +
                  (store.folder.empty() ? "TMPDIR, or by " : "") + "temporaryFolder = FOLDER.");
}

/** Opens a new file without a name; where the file system makes none, its name is removed at once. Below 0 where that
 * can't be. */
int
OpenTemporaryFile(const fs::path & folder)
{
  if (const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR); file >= 0)
  {
    return file;
  }
  std::string name = (folder / "rhombic-XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0)
  {
    unlink(name.c_str());
  }
  return file;
}

} // namespace

MappedPages::MappedPages(int file, std::uintmax_t begin, std::size_t size, int flags)
  : m_File(file)
  , m_Size(size)
  , m_IsShared((flags & MAP_SHARED) != 0)
{
  void * const pages = mmap(nullptr, size, PROT_READ | PROT_WRITE, flags, file, static_cast<off_t>(begin));
  m_Address = pages == MAP_FAILED ? nullptr : static_cast<std::byte *>(pages);
}

MappedPages::~MappedPages()
{
  if (m_Address != nullptr)
  {
    munmap(m_Address, m_Size);
  }
  this->CloseFile();
}

void
MappedPages::CloseFile()
{
  m_File >= 0 ? close(std::exchange(m_File, -1)) : 0;
}

void
MappedPages::ExpectInOrder() const
{
  madvise(m_Address, m_Size, MADV_SEQUENTIAL);
}

void
MappedPages::Drop() const
{
  for (const auto & [begin, size] : this->FindUnchanged())
  {
    madvise(m_Address + begin, size, MADV_DONTNEED);
  }
  if (m_Size > FreeMemory())
  {
    if (m_IsShared)
    {
      fdatasync(m_File); // only pages that are on the disk can be dropped
    }
    posix_fadvise(m_File, 0, 0, POSIX_FADV_DONTNEED);
  }
}

/** Runs of pages that are in memory as the file has them: their first byte and their size. None where the system does
 * not tell which these are. */
std::vector<std::pair<std::size_t, std::size_t>>
MappedPages::FindUnchanged() const
{
  if (m_IsShared)
  {
    return { { 0, m_Size } };
  }
  constexpr std::uint64_t isPresent = std::uint64_t{ 1 } << 63, isOfFile = std::uint64_t{ 1 } << 61;
  constexpr std::size_t atOnce = 1 << 16; // pages
  const auto pageSize = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t count = (m_Size + pageSize - 1) / pageSize;
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  std::vector<std::uint64_t> entries(std::min(count, atOnce));
  std::ifstream pagemap("/proc/self/pagemap", std::ios::binary);
  pagemap.seekg(static_cast<std::streamoff>(reinterpret_cast<std::uintptr_t>(m_Address) / pageSize * 8));
  for (std::size_t first = 0; first < count; first += atOnce)
  {
    const std::size_t part = std::min(atOnce, count - first);
    if (!pagemap.read(reinterpret_cast<char *>(entries.data()), static_cast<std::streamsize>(part * 8)))
    {
      return {};
    }
    for (std::size_t n = 0; n < part; ++n)
    {
      const std::size_t begin = (first + n) * pageSize;
      if ((entries[n] & isPresent) == 0 || (entries[n] & isOfFile) == 0)
      {
        continue;
      }
      if (!runs.empty() && runs.back().first + runs.back().second == begin)
      {
        runs.back().second += pageSize;
      }
      else
      {
        runs.emplace_back(begin, pageSize);
      }
    }
  }
  return runs;
}

fs::path
TemporaryStore::FindFolder() const
{
  for (const char * const variable : { "TMPDIR", "TMP", "TEMP", "TEMPDIR" })
  {
    const char * const named = std::getenv(variable);
    if (folder.empty() && named != nullptr && *named != '\0')
    {
      return named;
    }
  }
  return folder.empty() ? "/tmp" : folder;
}

std::string
FindObstacle(const TemporaryStore & store, std::uintmax_t size)
{
  const fs::path folder = store.FindFolder();
  struct statfs system
  {};
  if (statfs(folder.c_str(), &system) != 0)
  {
    return errno == ENOENT ? "which is not there" : std::strerror(errno);
  }
  if (system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC)
  {
    return "it is in memory itself";
  }
  const std::uintmax_t free = std::uintmax_t{ system.f_bavail } * static_cast<std::uintmax_t>(system.f_bsize);
  if (free < size)
  {
    return "where " + DescribeBytes(free) + " are free, and " + DescribeBytes(size) + " are needed";
  }
  const int file = OpenTemporaryFile(folder);
  if (file < 0)
  {
    return std::strerror(errno);
  }
  close(file);
  void * const addresses = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (addresses == MAP_FAILED)
  {
    return NoAddresses;
  }
  munmap(addresses, size);
  return {};
}

void
RequireRoom(const TemporaryStore & store, std::uintmax_t size)
{
  if (const std::string obstacle = FindObstacle(store, size); !obstacle.empty())
  {
    Refuse(store, obstacle);
  }
}

std::unique_ptr<MappedPages>
MapTemporaryFile(const TemporaryStore & store, std::size_t size)
{
  RequireRoom(store, size);
  const int file = OpenTemporaryFile(store.FindFolder());
  if (file < 0)
  {
    Refuse(store, std::strerror(errno));
  }
  auto pages = std::make_unique<MappedPages>(file, 0, size, MAP_SHARED);
  if (pages->GetAddress() == nullptr)
  {
    Refuse(store, NoAddresses);
  }
  // Pages without room on the disk would end the process.
  if (const int error = posix_fallocate(file, 0, static_cast<off_t>(size)); error != 0)
  {
    Refuse(store, std::strerror(error));
  }
  return pages;
}

} // namespace rhombic
