#ifndef rhombicProgram_h
#define rhombicProgram_h

#include "rhombicTemporaryFolder.h"

#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

namespace rhombictest
{

inline std::string
ReadText(const std::filesystem::path & path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/** What a run of a shell command line left behind. */
struct Outcome
{
  int exitCode;       ///< minus the signal's number when one ended it
  std::string output; ///< standard output
  std::string errors; ///< standard error
};

/** Runs a command line in a folder, with the program under test on the PATH and without an X display. */
inline Outcome
RunShell(const std::string & commandLine, const std::filesystem::path & folder)
{
  const TemporaryFolder captured;
  const auto script = captured.Path() / "script";
  const auto output = captured.Path() / "output";
  const auto errors = captured.Path() / "errors";
  std::ofstream(script) << "set -e\nunset DISPLAY\nexport PATH=\"" RHOMBIC_PROGRAM_FOLDER ":$PATH\"\ncd '"
                        << folder.string() << "'\n"
                        << commandLine << '\n';
  const std::string run =
    "bash '" + script.string() + "' >'" + output.string() + "' 2>'" + errors.string() + "' </dev/null";
  const int status = std::system(run.c_str());
  return { WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), ReadText(output), ReadText(errors) };
}

} // namespace rhombictest

#endif
