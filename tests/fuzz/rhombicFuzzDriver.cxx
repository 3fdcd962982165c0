// Runs a fuzz target without libFuzzer: `target [-runs=N] [-seed=S] [-malformed=PREFIX] files or folders...` replays
// the inputs, then N mutations of them. The input of a crash is left in ./crash-input.

#include "rhombicFuzzMutation.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size);

namespace
{

constexpr std::size_t LongestMutated = 1 << 16;

const std::string * CurrentInput = nullptr;

void
KeepInput(int signal)
{
  std::signal(signal, SIG_DFL);
  const int file = open("crash-input", O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (CurrentInput != nullptr && write(file, CurrentInput->data(), CurrentInput->size()) >= 0)
  {
    std::fputs("The input is kept in ./crash-input\n", stderr);
  }
  std::raise(signal);
}

void
RunOnce(const std::string & input)
{
  CurrentInput = &input;
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(input.data()), input.size());
}

struct Arguments
{
  std::uint64_t runs = 0;
  std::uint64_t seed = 1;
  std::vector<fs::path> inputs;
};

/** Adds a file, or those in a folder whose names begin with \a prefix, by name. */
void
AddInputs(const fs::path & path, const std::string & prefix, std::vector<fs::path> & inputs)
{
  if (!fs::is_directory(path))
  {
    inputs.push_back(path);
    return;
  }
  std::vector<fs::path> files;
  for (const auto & entry : fs::directory_iterator(path))
  {
    if (entry.is_regular_file() && entry.path().filename().string().rfind(prefix, 0) == 0)
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  inputs.insert(inputs.end(), files.begin(), files.end());
}

/** The damaged files beside the real scans, on machines that have them. */
void
AddMalformed(const std::string & prefix, std::vector<fs::path> & inputs)
{
  const char * const scans = std::getenv("RHOMBIC_SCANS");
  const fs::path folder = fs::path(scans == nullptr ? "" : scans) / ".." / "malformed";
  if (scans != nullptr && fs::is_directory(folder))
  {
    AddInputs(folder, prefix, inputs);
  }
}

Arguments
ParseArguments(int count, char ** texts)
{
  Arguments arguments;
  for (int n = 1; n < count; ++n)
  {
    const std::string text = texts[n];
    const std::string value = text.substr(std::min(text.find('=') + 1, text.size()));
    if (text.rfind("-runs=", 0) == 0)
    {
      arguments.runs = std::stoull(value);
    }
    else if (text.rfind("-seed=", 0) == 0)
    {
      arguments.seed = std::stoull(value);
    }
    else if (text.rfind("-malformed=", 0) == 0)
    {
      AddMalformed(value, arguments.inputs);
    }
    else
    {
      AddInputs(text, "", arguments.inputs);
    }
  }
  return arguments;
}

std::string
ReadFile(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    std::fprintf(stderr, "Cannot read %s\n", path.c_str());
    std::exit(1);
  }
  return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace

int
main(int argc, char ** argv)
{
  for (const int signal : { SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM })
  {
    std::signal(signal, KeepInput);
  }
  const Arguments arguments = ParseArguments(argc, argv);
  std::vector<std::string> seeds;
  for (const fs::path & path : arguments.inputs)
  {
    std::string & input = seeds.emplace_back(ReadFile(path));
    RunOnce(input);
    input.resize(std::min(input.size(), LongestMutated));
  }
  if (seeds.empty())
  {
    std::fputs("There is no input to begin with; name a file or a folder\n", stderr);
    return 1;
  }
  rhombicfuzz::FuzzRandom random(arguments.seed);
  for (std::uint64_t run = 0; run < arguments.runs; ++run)
  {
    alarm(1000); // seconds; an input that hangs is kept too
    RunOnce(Mutate(seeds, random));
  }
  std::printf(
    "%zu inputs and %llu mutations of them ran\n", seeds.size(), static_cast<unsigned long long>(arguments.runs));
}
