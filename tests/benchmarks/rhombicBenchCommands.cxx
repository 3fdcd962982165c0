#include "rhombicBenchCommands.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char ** environ;

namespace rhombic
{
namespace
{

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

/** Starts a command without output, in a process group of its own. */
pid_t
Start(const Command & command)
{
  std::vector<char *> arguments;
  for (const std::string & argument : command)
  {
    arguments.push_back(const_cast<char *>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int error = posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
  {
    throw Failure(FailureKind::NotFound,
                  command[0] + " can't be started; build it, and call this program from its folder.");
  }
  return process;
}

void
CheckStatus(const Command & command, int status)
{
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    throw Failure(FailureKind::Internal, command[0] + " failed; the times mean nothing.");
  }
}

int
RunCommand(const Command & command)
{
  int status = 0;
  waitpid(Start(command), &status, 0);
  CheckStatus(command, status);
  return status;
}

/** Proportional memory of all processes of a group in MiB: pages that several of them share count once. */
double
GetGroupMemory(pid_t group)
{
  double sum = 0.0;
  std::error_code error;
  for (const auto & entry : fs::directory_iterator("/proc", error))
  {
    const std::string name = entry.path().filename();
    if (!std::all_of(name.begin(), name.end(), [](unsigned char letter) { return std::isdigit(letter); }) ||
        getpgid(std::stoi(name)) != group)
    {
      continue;
    }
    std::ifstream memory(entry.path() / "smaps_rollup");
    for (std::string word; memory >> word;)
    {
      if (double kilobytes = 0.0; word == "Pss:" && memory >> kilobytes)
      {
        sum += kilobytes / 1024.0;
      }
    }
  }
  return sum;
}

/** Peak memory of a command with its child processes in MiB, looked at every 10 ms. */
double
MeasurePeakMemory(const Command & command)
{
  const pid_t process = Start(command);
  double peak = 0.0;
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0)
  {
    peak = std::max(peak, GetGroupMemory(process));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CheckStatus(command, status);
  return peak;
}

} // namespace

std::vector<BenchResult>
MeasureCommands(const std::string & scan, double isovalue, const BenchSettings & settings)
{
  if (!fs::is_directory(scan))
  {
    return {};
  }
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path folder = fs::temp_directory_path() / ("rhombic-bench-" + std::to_string(getpid()));
  fs::create_directory(folder);
  const std::string threads = std::to_string(settings.threads);
  const std::string value = FormatExact(isovalue);
  const Command ours{ programs / "rhombic", "-q", "--threads", threads, "mesh", scan, "-t", value, "-o",
                      folder / "a.stl" };
  const Command bare{ programs / "rhombic-bare-script", scan, value, folder / "b.stl" };

  BenchResult result;
  result.section = "commands";
  result.candidate = "rhombic mesh";
  result.reference = "bare script";
  result.threads = settings.threads;
  result.details["MiB"] = std::round(MeasurePeakMemory(ours));
  result.details["bare MiB"] = std::round(MeasurePeakMemory(bare));
  result.times = TimePairs(
    settings.repeats, [&] { return RunCommand(bare); }, [&] { return RunCommand(ours); });
  constexpr double stlHeader = 84.0;
  constexpr double stlTriangle = 50.0;
  result.details["triangles"] =
    std::llround((static_cast<double>(fs::file_size(folder / "a.stl")) - stlHeader) / stlTriangle);
  result.details["bare triangles"] =
    std::llround((static_cast<double>(fs::file_size(folder / "b.stl")) - stlHeader) / stlTriangle);
  result.target = settings.threads > 1 ? std::optional<double>(1.15) : std::nullopt;
  fs::remove_all(folder);
  return { result };
}

} // namespace rhombic
