#include "rhombicAtomicFile.h"
#include "rhombicCommandLine.h"
#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkMultiThreaderBase.h"
#include "itkThreadPool.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace
{

using namespace rhombic;

/** Puts streams that fail in the places of standard streams that are closed, which files would be opened in. */
void
OccupyClosedStreams()
{
  for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    if (fcntl(stream, F_GETFD) < 0)
    {
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); // as the lowest free descriptor
    }
  }
}

/** Raises the limit of open files to the system's: each output keeps a file open until all are renamed. */
void
RaiseFileLimit()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0)
  {
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
  }
}

/** Has freed memory kept for the next volume or mesh: fresh pages of the system cost up to a tenth of the time. Where
 * the address space is limited, threads share the arenas of malloc(), each of which takes 64 MiB of the address space.
 */
void
KeepFreedMemory()
{
#ifdef __GLIBC__
  constexpr int largestKept = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, largestKept);
  mallopt(M_TRIM_THRESHOLD, largestKept);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
  {
    mallopt(M_ARENA_MAX, 1);
  }
#endif
}

std::terminate_handler usualEnd = nullptr;

/** Of a thread, or of a library that is being loaded. Without memory, none is taken to tell it. */
[[noreturn]] void
TellOfExceptionNobodyCaught()
{
  if (std::current_exception())
  {
    try
    {
      throw;
    }
    catch (const std::bad_alloc &)
    {
      std::fputs("rhombic: There is not enough memory; close other programs, or allow more, as by ulimit -v.\n",
                 stderr);
      std::_Exit(static_cast<int>(FailureKind::Memory));
    }
    catch (...)
    {}
  }
  usualEnd();
  std::abort();
}

/** Starts the threads of ITK's pool. Where the system has none left, this tells a failure and ends the process: what
 * ITK leaves of the pool ends it otherwise, at once or when it is deleted. \param tell returns the exit code */
void
StartThreads(const std::function<int(const Failure &)> & tell)
{
  static const auto * const end = &tell; // for a function without arguments; called once
  constexpr auto refuse = [] {
    const std::string threads = Count(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads(), "thread");
    const std::string advice = "; close other programs, or give a lower number as --threads.";
    std::_Exit((*end)(Failure(FailureKind::Memory, "Cannot start " + threads + advice)));
  };
  const std::terminate_handler usual = std::set_terminate(refuse);
  try
  {
    itk::ThreadPool::GetInstance();
  }
  catch (const std::exception &)
  {
    refuse();
  }
  std::set_terminate(usual);
}

/** What another process of this program asks for, as JSON on standard input: {"command": "mesh", "settings": {...},
 * "threads": 2, "parent": 1234}. This process ends with its parent, at once if that is not the process that is named.
 * Throws Failure(Usage). */
Report
ReadRequest()
{
  Report request = Report::parse(std::cin, nullptr, false);
  if (!request.is_object() || !request.contains("command") || !request.contains("settings"))
  {
    throw Failure(FailureKind::Usage, "Standard input holds no command with its settings.");
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (request.value("parent", getppid()) != getppid())
  {
    std::_Exit(static_cast<int>(FailureKind::Internal));
  }
  return request;
}

/** What another process gets on standard output: {"outputs": [{"name": "bone.stl", "kind": "mesh", "measures":
 * [...]}]}.
 */
Report
ReportOutputs(const std::vector<MadeFile> & outputs)
{
  Report report{ { "outputs", Report::array() } };
  for (const MadeFile & output : outputs)
  {
    report["outputs"].push_back(
      { { "name", output.path.filename().string() }, { "kind", output.kind }, { "measures", output.measures } });
  }
  return report;
}

/** Tells why a command failed; returns the exit code. */
int
Tell(const Failure & failure, bool isRequested, Console & console)
{
  if (isRequested)
  {
    std::cout << ToJson({ { "failure", failure.GetDescription() } }) << std::flush;
  }
  console.Error(failure.GetDescription());
  return static_cast<int>(failure.GetKind());
}

/** Runs the command that the words name, or that standard input requests. */
void
Run(CommandLine & commandLine, const std::vector<std::string> & words, bool isRequested, Console & console)
{
  const Report request = isRequested ? ReadRequest() : Report();
  Command & command = isRequested ? commandLine.Set(request["command"].get<std::string>(), request["settings"])
                                  : commandLine.Parse(words);
  const ProgramOptions & options = commandLine.GetOptions();
  console.SetVerbosity(options.isQuiet ? Verbosity::Quiet : options.isVerbose ? Verbosity::Verbose : Verbosity::Normal);
  const unsigned int threads = isRequested ? request.value("threads", 0u) : options.threads;
  if (threads > 0)
  {
    itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  }
  StartThreads([&](const Failure & failure) { return Tell(failure, isRequested, console); });
  const std::vector<MadeFile> outputs = command.run({ &console, &command.settings });
  console.NoteStepTimes();
  console.Finish();
  if (isRequested)
  {
    std::cout << ToJson(ReportOutputs(outputs));
  }
}

/** Throws Failure(Output). */
void
FlushStandardOutput()
{
  if (!std::cout.flush())
  {
    throw Failure(FailureKind::Output, "Cannot write to standard output; is the disk full, or the pipe closed?");
  }
}

} // namespace

int
main(int argc, char ** argv)
{
  setenv("EGL_LOG_LEVEL", "fatal", 0); // Mesa would warn of missing drivers beside our own sentence
  OccupyClosedStreams();
  RemoveTemporaryFilesOnSignals();
  RaiseFileLimit();
  KeepFreedMemory();
  usualEnd = std::set_terminate(TellOfExceptionNobodyCaught);
  Console console;
  CommandLine commandLine;
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool isRequested = words == std::vector<std::string>{ RequestOption };
  try
  {
    try
    {
      Run(commandLine, words, isRequested, console);
    }
    catch (const CLI::Success & asked)
    {
      commandLine.Print(asked);
    }
    FlushStandardOutput();
    return 0;
  }
  catch (const std::exception &)
  {
    return Tell(FailureOfException(), isRequested, console);
  }
}
