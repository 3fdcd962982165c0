#include "rhombicChildProcess.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

/** Starts a program with standard streams and no other open file, as the first process of a group, and without this
 * program's signal handlers. fork() would copy the page tables of a large process, and may hang in one with threads.
 * Returns 0 or the number of the error. */
int
Spawn(const ChildSettings & settings, int output, pid_t & process)
{
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (settings.socket < 0)
  {
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, settings.input.c_str(), O_RDONLY, 0);
  }
  else
  {
    posix_spawn_file_actions_adddup2(&files, settings.socket, STDIN_FILENO);
  }
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  sigset_t signals;
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);

  std::vector<char *> arguments;
  for (const std::string & argument : settings.arguments)
  {
    arguments.push_back(const_cast<char *>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  const int error = posix_spawn(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

} // namespace

FailureKind
KindOfStartError(int error)
{
  const bool isScarce = error == ENOMEM || error == EAGAIN || error == EMFILE || error == ENFILE;
  return isScarce ? FailureKind::Memory : FailureKind::Internal;
}

ChildProcess::ChildProcess(const ChildSettings & settings)
  : m_Parent(getpid())
{
  const int output = open(settings.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (output < 0)
  {
    const bool isOfProcess = KindOfStartError(errno) == FailureKind::Memory;
    throw Failure(isOfProcess ? FailureKind::Memory : FailureKind::Output,
                  "Cannot write " + settings.output.string() + ": " + std::strerror(errno) + ".");
  }
  int error = Spawn(settings, output, m_Process);
  close(output);
  m_Process = error == 0 ? m_Process : -1;
  m_Descriptor = error == 0 ? static_cast<int>(syscall(SYS_pidfd_open, m_Process, 0)) : -1;
  error = error == 0 && m_Descriptor < 0 ? errno : error;
  if (error != 0)
  {
    this->Kill();
    this->Wait();
    throw Failure(KindOfStartError(error),
                  "Cannot start " + settings.arguments.front() + ": " + std::strerror(error) + ".");
  }
  const rlimit noCore{ 0, 0 };
  prlimit(m_Process, RLIMIT_CORE, &noCore, nullptr);
  if (settings.memory > 0)
  {
    const rlimit allocations{ settings.memory, settings.memory };
    prlimit(m_Process, RLIMIT_DATA, &allocations, nullptr);
  }
}

ChildProcess::~ChildProcess()
{
  if (m_Parent == getpid())
  {
    this->Kill();
    this->Wait();
  }
  close(m_Descriptor);
}

bool
ChildProcess::HasEnded()
{
  return this->Collect(WNOHANG);
}

void
ChildProcess::Wait()
{
  while (!this->Collect(0))
  {}
}

bool
ChildProcess::Collect(int options)
{
  int status = 0;
  rusage usage{};
  const pid_t waited = m_Process > 0 ? wait4(m_Process, &status, options, &usage) : 0;
  if (waited == m_Process || (waited < 0 && errno == ECHILD)) // a host that waits for any child took this one
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
  }
}

} // namespace rhombic
