#ifndef rhombicAtomicFile_h
#define rhombicAtomicFile_h

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace rhombic
{

/** \class AtomicFile
 * \brief An output file that appears complete or not at all.
 *
 * The writer writes to GetTemporaryPath(), a hidden file beside the target with the target's extension. Commit()
 * checks its size, flushes it to the disk and renames it over the target; without Commit() the destructor removes it,
 * so an exception or a full disk leaves the target as it was.
 *
 * A process that is killed leaves its temporary file behind; the next AtomicFile for the same target removes it. The
 * temporary files of running processes are locked (flock), on all machines that share the folder.
 *
 * Thread safety: one thread per object; objects for different targets are independent.
 */
class AtomicFile
{
public:
  /** Throws Failure(Output) when the folder is missing or can't be written, or the target is one; Memory as Flush(). */
  explicit AtomicFile(const std::filesystem::path & target);
  ~AtomicFile();

  AtomicFile(const AtomicFile &) = delete;
  AtomicFile &
  operator=(const AtomicFile &) = delete;

  const std::filesystem::path &
  GetTemporaryPath() const
  {
    return m_Temporary;
  }

  /** Checks the file's size and flushes it to the disk; only the renaming remains. \a minimumSize is the smallest size
   * in bytes that a complete file has: libraries' writers may report success on a full disk. Throws Failure(Output)
   * when the file is smaller or can't be flushed; Failure(Memory) when too many files are open. */
  void
  Flush(std::uintmax_t minimumSize);

  /** Flushes the file and renames it over the target. Throws Failure(Output). */
  void
  Commit(std::uintmax_t minimumSize);

private:
  friend class StagedFiles;

  void
  Rename();

  std::filesystem::path m_Target;
  std::filesystem::path m_Temporary;
  int m_Descriptor = -1; ///< holds the lock
};

/** \class StagedFiles
 * \brief The output files of one command, which appear together or not at all.
 *
 * Writers add a file with Begin(), write it and flush it. Commit() renames all of them over their targets in the order
 * of Begin(), which needs no space on the disk. Without Commit() the destructor removes all of them, and the targets
 * stay as they were.
 *
 * Each file keeps a file descriptor open until Commit(). A process that is killed during Commit() leaves the files that
 * were renamed before.
 *
 * Thread safety: one thread per object. */
class StagedFiles
{
public:
  /** A new file for a target, to be written and flushed. Throws as AtomicFile's constructor does. */
  AtomicFile &
  Begin(const std::filesystem::path & target);

  /** Renames all files. Throws Failure(Output) at the first that can't be renamed; the sentence names the targets that
   * were replaced before it. Files that were not flushed must not be committed. */
  void
  Commit();

private:
  std::vector<std::unique_ptr<AtomicFile>> m_Files;
};

/** Makes a folder for output files, and those above it. Throws Failure(Output) where it can't be made. */
void
MakeOutputFolder(const std::filesystem::path & folder);

/** Makes SIGINT, SIGTERM and SIGHUP remove the temporary files of all AtomicFiles before they end the process as usual.
 * Signals that are ignored, as SIGHUP under nohup, stay ignored. SIGXFSZ is ignored, so that a file beyond the
 * process's size limit becomes an error of its writer. SIGBUS, which a mapped file causes that has become shorter, ends
 * the process with a sentence on standard error, the exit code of FailureKind::Unreadable, and without temporary files.
 * For programs only, as signal handlers belong to the whole process. */
void
RemoveTemporaryFilesOnSignals();

} // namespace rhombic

#endif
