#include "rhombicAtomicFile.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

[[noreturn]] void
Fail(const fs::path & path, const std::string & why, int error = 0) // errno, where it is known
{
  const std::string lack = error == EMFILE || error == ENFILE ? "too many files are open; allow more by ulimit -n" : "";
  throw Failure(lack.empty() ? FailureKind::Output : FailureKind::Memory,
                "Cannot write " + path.string() + ": " + (lack.empty() ? why : lack) + ".");
}

/** Flushes a file or folder to the disk. Some file systems can't flush folders (EINVAL); that is no loss of data. */
bool
FlushToDisk(const fs::path & path, int flags)
{
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0)
  {
    return false;
  }
  const bool flushed = fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
  close(descriptor);
  return flushed;
}

fs::path
FolderOf(const fs::path & path)
{
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/** The extension by which writers choose the format: .png, .nii.gz. */
std::string
ExtensionOf(const fs::path & path)
{
  const std::string last = path.extension().string();
  return last == ".gz" ? path.stem().extension().string() + last : last;
}

/** Names of temporary files for the signal handler, which may neither lock nor allocate. Files beyond this number are
 * not listed. */
constexpr std::size_t listedFiles = 4096;
std::atomic<const char *> temporaryFiles[listedFiles];

/** Replaces the first entry that is \a before by \a after; null is an entry that is free. */
void
ReplaceListed(const char * before, const char * after)
{
  for (auto & entry : temporaryFiles)
  {
    const char * listed = before;
    if (entry.compare_exchange_strong(listed, after))
    {
      return;
    }
  }
}

/** Locks a file until its descriptor is closed. False when another process has locked it. */
bool
Lock(int descriptor)
{
  return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/** Removes the temporary files of processes that have ended. A file system without locks keeps them. */
void
RemoveAbandoned(const fs::path & folder, const std::string & prefix)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    if (entry->path().filename().string().rfind(prefix, 0) != 0)
    {
      continue;
    }
    const int descriptor = open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor >= 0)
    {
      if (Lock(descriptor))
      {
        unlink(entry->path().c_str());
      }
      close(descriptor);
    }
  }
}

/** Creates and locks a file. Returns its descriptor, or -1 with errno. Another process may remove the file as abandoned
 * between its creation and the lock: that is reported as EEXIST. */
int
CreateLocked(const fs::path & path)
{
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  struct stat status
  {};
  const bool isOurs = descriptor >= 0 && (Lock(descriptor) || errno != EWOULDBLOCK);
  int error = EEXIST;
  if (isOurs && fstat(descriptor, &status) != 0)
  {
    error = errno;
    unlink(path.c_str());
  }
  if (descriptor < 0 || status.st_nlink > 0)
  {
    return descriptor;
  }
  close(descriptor);
  errno = error;
  return -1;
}

/** May be called by a signal handler. */
void
UnlinkTemporaryFiles()
{
  for (const auto & entry : temporaryFiles)
  {
    if (const char * const path = entry.load())
    {
      unlink(path);
    }
  }
}

/** A mapped file has no bytes at an address where it had some. */
extern "C" void
EndWithoutInput(int)
{
  constexpr char sentence[] =
    "rhombic: An input file became shorter or could not be read any more, while it was used; check the file, and "
    "the disk or network that it is on, and try again.\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, sentence, sizeof sentence - 1);
  UnlinkTemporaryFiles();
  _exit(static_cast<int>(FailureKind::Unreadable));
}

extern "C" void
RemoveTemporaryFiles(int signal)
{
  UnlinkTemporaryFiles();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

} // namespace

AtomicFile::AtomicFile(const fs::path & target)
  : m_Target(target)
{
  std::error_code error;
  if (target.filename().empty() || fs::is_directory(target, error))
  {
    Fail(target, "it is a folder; give a file name");
  }
  const fs::path folder = FolderOf(target);
  if (!fs::is_directory(folder, error))
  {
    Fail(target,
         "the folder " + folder.string() +
           (error == std::errc::permission_denied
              ? " is in one that may not be entered; choose another, or ask for access"
              : " does not exist; create it first"));
  }
  const fs::file_type type = fs::status(target, error).type();
  if (type == fs::file_type::none)
  {
    Fail(target, error.message() + "; choose another file name");
  }
  if (type != fs::file_type::not_found && type != fs::file_type::regular)
  {
    Fail(target, "it is not a regular file; give a file name");
  }

  // A file of that name may be left from a killed process that had the same number.
  const std::string prefix = ".tmp-" + HashText(target.filename().string()) + "-"; // short, whatever the name's length
  RemoveAbandoned(folder, prefix);
  static std::atomic<unsigned> counter{ 0 };
  do
  {
    m_Temporary = folder / (prefix + std::to_string(getpid()) + "-" + std::to_string(counter++) + ExtensionOf(target));
    m_Descriptor = CreateLocked(m_Temporary);
  } while (m_Descriptor < 0 && errno == EEXIST);
  if (m_Descriptor < 0)
  {
    Fail(target, std::string(std::strerror(errno)) + "; choose another folder or file name", errno);
  }
  ReplaceListed(nullptr, m_Temporary.c_str());
}

AtomicFile::~AtomicFile()
{
  if (!m_Temporary.empty())
  {
    ReplaceListed(m_Temporary.c_str(), nullptr);
    std::error_code ignored; // a destructor must not throw
    fs::remove(m_Temporary, ignored);
  }
  close(m_Descriptor);
}

void
AtomicFile::Flush(std::uintmax_t minimumSize)
{
  if (!FlushToDisk(m_Temporary, O_WRONLY)) // fails as writers did that found too many files open
  {
    Fail(m_Target, std::string(std::strerror(errno)) + " while flushing it to the disk", errno);
  }
  std::error_code error;
  const auto size = fs::file_size(m_Temporary, error);
  if (error || size < minimumSize)
  {
    Fail(m_Target,
         "only " + std::to_string(error ? 0 : size) + " of at least " + std::to_string(minimumSize) +
           " bytes arrived, as on a full disk; make room there");
  }
}

void
AtomicFile::Commit(std::uintmax_t minimumSize)
{
  this->Flush(minimumSize);
  this->Rename();
  FlushToDisk(FolderOf(m_Target), O_RDONLY | O_DIRECTORY);
}

void
AtomicFile::Rename()
{
  std::error_code error;
  fs::rename(m_Temporary, m_Target, error);
  if (error)
  {
    Fail(m_Target, error.message());
  }
  ReplaceListed(m_Temporary.c_str(), nullptr);
  m_Temporary.clear();
}

AtomicFile &
StagedFiles::Begin(const fs::path & target)
{
  m_Files.push_back(std::make_unique<AtomicFile>(target));
  return *m_Files.back();
}

void
StagedFiles::Commit()
{
  std::string replaced;
  std::set<fs::path> folders;
  for (const auto & file : m_Files)
  {
    const std::string target = file->m_Target.string();
    try
    {
      file->Rename();
    }
    catch (const Failure & failure)
    {
      throw replaced.empty()
        ? failure
        : Failure(FailureKind::Output,
                  std::string(failure.GetDescription()) + " Files of this run are already in place: " + replaced + ".");
    }
    replaced += (replaced.empty() ? "" : ", ") + target;
    folders.insert(FolderOf(file->m_Target));
  }
  for (const fs::path & folder : folders)
  {
    FlushToDisk(folder, O_RDONLY | O_DIRECTORY);
  }
  m_Files.clear();
}

void
MakeOutputFolder(const fs::path & folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
  {
    throw Failure(FailureKind::Output, "Cannot make the folder " + folder.string() + ": " + error.message() + ".");
  }
}

void
RemoveTemporaryFilesOnSignals()
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    if (std::signal(signal, RemoveTemporaryFiles) == SIG_IGN)
    {
      std::signal(signal, SIG_IGN);
    }
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, EndWithoutInput);
}

} // namespace rhombic
