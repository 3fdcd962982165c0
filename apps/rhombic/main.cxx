#include "rhombicAtomicFile.h"
#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicIsolatedDecoder.h"
#include "rhombicUsageError.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <sys/resource.h>

namespace
{

using namespace rhombic;

struct Command
{
  const char * name;
  const char * description;
  CommandRun (*add)(CLI::App &);
};

constexpr Command commands[] = {
  { "info", "What is in a scan: series, geometry, values, thresholds worth trying", AddInfoCommand },
  { "render", "Pictures of a scan's surfaces", AddRenderCommand },
  { "mesh", "A scan's surface as a file", AddMeshCommand },
  { "batch", "Pictures, pages and meshes of many scans", AddBatchCommand },
  { "bids", "The same of a BIDS dataset, as a BIDS App", AddBIDSCommand },
  { "compare-pictures", "Whether two pictures are the same, within a tolerance", AddComparePicturesCommand },
  { "audit", "Whether a surface file is closed, oriented and free of defects", AddAuditCommand },
  { "resample", "A scan on the face-centered cubic lattice, and back", AddResampleCommand },
  { "compare", "Lattices and methods compared, as in the paper: tables, plots, pictures", AddCompareCommand },
  { "phantom", "The analytic test scan, with organs of known volume", AddPhantomCommand },
  { "doctor", "What works on this machine", AddDoctorCommand },
};

constexpr char exitCodes[] = "Exit codes:\n"
                             "  0   done\n"
                             "  1   a defect in rhombic; please report it\n"
                             "  2   wrong usage: an option, a preset, a file extension\n"
                             "  3   no such file or folder, or no scan in it\n"
                             "  4   the input is damaged or of a kind that is not supported\n"
                             "  5   the input's position in the patient can't be known\n"
                             "  6   there is no surface at this threshold\n"
                             "  7   the output can't be written\n"
                             "  8   a surface is not watertight (audit, --require-watertight)\n"
                             "  9   not enough memory\n"
                             "  10  this machine can't draw (see rhombic doctor)\n"
                             "  11  pictures differ by more than the tolerance\n"
                             "  12  some cases of a batch failed";

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

/** Throws Failure when this process may not start the threads that ITK's pool starts at once, where ITK would end it.
 */
void
RequireThreads()
{
  const std::size_t count = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  std::vector<std::thread> threads;
  std::mutex guard;
  std::unique_lock<std::mutex> allAtOnce(guard);
  try
  {
    while (threads.size() < count)
    {
      threads.emplace_back([&guard] { const std::lock_guard<std::mutex> wait(guard); });
    }
  }
  catch (const std::system_error &)
  {}
  allAtOnce.unlock();
  std::for_each(threads.begin(), threads.end(), [](std::thread & thread) { thread.join(); });
  if (threads.size() < count)
  {
    throw Failure(FailureKind::Internal,
                  "Cannot start " + std::to_string(count) +
                    " threads; close other programs, or give a lower number as --threads.");
  }
}

int
Fail(Console & console, FailureKind kind, const std::string & sentence)
{
  console.Error(sentence);
  return static_cast<int>(kind);
}

} // namespace

int
main(int argc, char ** argv)
{
  StartDrawingProgram(argv);
  setenv("EGL_LOG_LEVEL", "fatal", 0); // Mesa would warn of missing drivers beside our own sentence
  RemoveTemporaryFilesOnSignals();
  RaiseFileLimit();
  Console console;
  CLI::App app{ std::string("Rhombic: ") + RHOMBIC_DESCRIPTION, "rhombic" };
  app.footer(exitCodes);
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", VersionText());

  unsigned int threads = 0;
  bool isVerbose = false;
  bool isQuiet = false;
  app.add_option("--threads", threads, "number of threads (default: all cores)")
    ->envname("RHOMBIC_THREADS")
    ->check(CLI::Range(1u, 1024u));
  const auto verbose = app.add_flag("-v,--verbose", isVerbose, "print more, with times");
  app.add_flag("-q,--quiet", isQuiet, "print errors only")->excludes(verbose);

  const CommandRun * chosen = nullptr;
  std::vector<CommandRun> runs;
  runs.reserve(std::size(commands));
  for (const Command & command : commands)
  {
    CLI::App * const parser = app.add_subcommand(command.name, command.description);
    runs.push_back(command.add(*parser));
    const CommandRun * const run = &runs.back();
    parser->footer(exitCodes);
    parser->callback([&chosen, run] { chosen = run; });
  }

  try
  {
    app.parse(argc, argv);
    console.SetVerbosity(isQuiet ? Verbosity::Quiet : isVerbose ? Verbosity::Verbose : Verbosity::Normal);
    if (threads > 0)
    {
      itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
      itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    }
    IsolatedDecoder decoder(threads); // before there are more threads
    RequireThreads();
    (*chosen)({ &console, &decoder, std::vector<std::string>(argv + 1, argv + argc) });
    console.NoteStepTimes();
    console.Finish();
    if (!std::cout.flush())
    {
      throw Failure(FailureKind::Output, "Cannot write to standard output; is the disk full, or the pipe closed?");
    }
    return 0;
  }
  catch (const CLI::Success & help)
  {
    return app.exit(help);
  }
  catch (const CLI::ParseError & error)
  {
    return Fail(console, FailureKind::Usage, DescribeUsageError(app, error));
  }
  catch (const std::exception &)
  {
    const Failure failure = FailureOfException();
    return Fail(console, failure.GetKind(), failure.GetDescription());
  }
}
