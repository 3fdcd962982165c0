#ifndef rhombicChildProcess_h
#define rhombicChildProcess_h

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace rhombic
{

/** \class ChildProcess
 * \brief A program that runs beside this one. It and the processes that it starts are killed with this object, and with
 * the thread that made it.
 *
 * Thread safety: one thread per object. */
class ChildProcess
{
public:
  /** Starts the program \a arguments[0] with the files \a input and \a output as its standard streams, and without
   * standard error. \a memory is the most that it can allocate, in bytes. Throws Failure(Internal). */
  ChildProcess(const std::vector<std::string> & arguments,
               const std::filesystem::path & input,
               const std::filesystem::path & output,
               std::uintmax_t memory);
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

  /** Whether it has ended. Then the other functions tell how. */
  bool
  HasEnded();

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
  pid_t m_Process = -1; ///< -1 once it was waited for
  int m_Descriptor = -1;
  int m_ExitCode = 0;
  std::uintmax_t m_PeakMemory = 0;
};

} // namespace rhombic

#endif
