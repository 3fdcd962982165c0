#ifndef rhombicAtomicFile_h
#define rhombicAtomicFile_h

#include <cstdint>
#include <filesystem>

namespace rhombic
{

/** \class AtomicFile
 * \brief An output file that appears complete or not at all.
 *
 * The writer writes to GetTemporaryPath(), a hidden file beside the target with the target's extension. Commit()
 * checks its size, flushes it to the disk and renames it over the target; without Commit() the destructor removes it,
 * so an exception or a full disk leaves the target as it was.
 *
 * A process that is killed leaves its temporary file behind; the next AtomicFile for the same target removes it. Those
 * of living processes are known by a lock (flock), which ends with its process on any machine that shares the folder.
 *
 * Thread safety: one thread per object; objects for different targets are independent.
 */
class AtomicFile
{
public:
  /** Throws Failure(Output) when the target's folder is missing or can't be written, or the target is a folder. */
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

  /** The first half of Commit(), all that takes time or may fail for want of space: for files that belong together and
   * shall appear at nearly the same moment. */
  void
  Flush(std::uintmax_t minimumSize);

  /** Publishes the file. Libraries' writers may report success on a full disk, so the size in bytes that a complete
   * file has at least is given by the caller. Throws Failure(Output) when the file is smaller or can't be flushed or
   * renamed. */
  void
  Commit(std::uintmax_t minimumSize);

private:
  std::filesystem::path m_Target;
  std::filesystem::path m_Temporary;
  int m_Descriptor = -1; ///< holds the lock
  bool m_IsFlushed = false;
};

/** From now on SIGINT, SIGTERM and SIGHUP remove the temporary files of all AtomicFiles before they end the process as
 * they always do. Signals that are ignored, as SIGHUP is under nohup, stay so. SIGXFSZ is ignored: a file that reaches
 * the process's limit of size becomes an error of the writer. For programs, as it concerns
 * the whole process; a library leaves signals to its host. */
void
RemoveTemporaryFilesOnSignals();

} // namespace rhombic

#endif
