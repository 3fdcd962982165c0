#include "rhombicChildProcess.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

/** Opens a file as one of the standard streams. For the child before exec(), which may not allocate. */
bool
OpenAs(int stream, const char * path, int flags)
{
  const int descriptor = open(path, flags, 0666);
  return descriptor >= 0 && dup2(descriptor, stream) >= 0 && (descriptor == stream || close(descriptor) == 0);
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string> & arguments,
                           const std::filesystem::path & input,
                           const std::filesystem::path & output,
                           std::uintmax_t memory)
{
  std::vector<char *> texts;
  for (const std::string & argument : arguments)
  {
    texts.push_back(const_cast<char *>(argument.c_str()));
  }
  texts.push_back(nullptr);
  const rlimit allocations{ static_cast<rlim_t>(memory), static_cast<rlim_t>(memory) };
  const rlimit noCore{ 0, 0 };
  const pid_t parent = getpid();
  m_Process = fork();
  if (m_Process == 0) // only what is allowed in a copy of a process with threads
  {
    constexpr int written = O_WRONLY | O_CREAT | O_TRUNC;
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && OpenAs(STDIN_FILENO, input.c_str(), O_RDONLY) &&
        OpenAs(STDOUT_FILENO, output.c_str(), written) && OpenAs(STDERR_FILENO, "/dev/null", O_WRONLY))
    {
      setrlimit(RLIMIT_CORE, &noCore);
      setrlimit(RLIMIT_DATA, &allocations);
      execv(texts[0], texts.data());
    }
    _exit(127);
  }
  m_Descriptor = m_Process < 0 ? -1 : static_cast<int>(syscall(SYS_pidfd_open, m_Process, 0));
  if (m_Descriptor < 0)
  {
    const std::string why = std::strerror(errno);
    this->Kill();
    throw Failure(FailureKind::Internal, "Cannot start " + arguments.front() + ": " + why + ".");
  }
}

ChildProcess::~ChildProcess()
{
  if (m_Process > 0)
  {
    this->Kill();
    waitpid(m_Process, nullptr, 0);
  }
  close(m_Descriptor);
}

bool
ChildProcess::HasEnded()
{
  int status = 0;
  rusage usage{};
  if (m_Process > 0 && wait4(m_Process, &status, WNOHANG, &usage) == m_Process)
  {
    kill(-m_Process, SIGKILL); // what it has left behind
    m_Process = -1;
    m_ExitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    m_PeakMemory = static_cast<std::uintmax_t>(usage.ru_maxrss) * 1024u;
  }
  return m_Process < 0;
}

void
ChildProcess::Kill()
{
  if (m_Process > 0)
  {
    kill(-m_Process, SIGKILL);
    kill(m_Process, SIGKILL); // which may not lead its group yet
  }
}

} // namespace rhombic
