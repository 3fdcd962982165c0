#ifndef rhombicChildProcess_h
#define rhombicChildProcess_h

#include "rhombicFailure.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace rhombic
{

/** A program, and what it starts with. */
struct ChildSettings
{
  std::vector<std::string> arguments;         ///< the first one is the path of the program
  std::filesystem::path input = "/dev/null";  ///< the file that is its standard input
  std::filesystem::path output = "/dev/null"; ///< a file that is made for its standard output
  int socket = -1;                            ///< a descriptor that is its standard input; negative: the file is
  std::uintmax_t memory = 0;                  ///< the most that it can allocate, in bytes; 0: as much as this process
};

/** The kind of a failure to start a process, by the number of the error: Memory where the system has no more memory,
 * processes or open files, else Internal. */
FailureKind
KindOfStartError(int error);

/** \class ChildProcess
 * \brief A program that runs beside this one, without standard error, without a copy of this process's memory, and
 * without its open files. It and the processes that it starts are killed with this object.
 *
 * Thread safety: one thread per object. */
class ChildProcess
{
public:
  /** Starts the program. Throws Failure: Output where the file of its standard output cannot be made, Memory where the
   * system has no more memory, processes or open files, else Internal. */
  explicit ChildProcess(const ChildSettings & settings);

  /** Kills it, unless this process was forked off the one that started it. */
  ~ChildProcess();

  ChildProcess(const ChildProcess &) = delete;
  ChildProcess &
  operator=(const ChildProcess &) = delete;

  /** Is readable once the process has ended, for poll(). */
  int
  GetDescriptor() const
  {
    return m_Descriptor;
  }

  /** Whether it has ended. Then the functions below tell how. */
  bool
  HasEnded();

  /** Waits for its end. */
  void
  Wait();

  /** Ends the process at once, by SIGKILL. */
  void
  Kill();

  /** The exit code, or the number of the signal that ended it, negative. */
  int
  GetExitCode() const
  {
    return m_ExitCode;
  }

  /** The largest resident memory in bytes. */
  std::uintmax_t
  GetPeakMemory() const
  {
    return m_PeakMemory;
  }

private:
  /** Learns how the process has ended, with options of wait4(). Returns whether it has. */
  bool
  Collect(int options);

  const pid_t m_Parent;
  pid_t m_Process = -1; ///< -1 once it was waited for
  int m_Descriptor = -1;
  int m_ExitCode = 0;
  std::uintmax_t m_PeakMemory = 0;
};

} // namespace rhombic

#endif
