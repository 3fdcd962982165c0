#ifndef rhombicCommandLine_h
#define rhombicCommandLine_h

#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPipelineFile.h"
#include "rhombicSettings.h"

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

namespace rhombic
{

/** \class Command
 * \brief A command with its settings, which are added when the command is chosen. */
struct Command
{
  using AddFunction = CommandRun (*)(CommandSettings &);

  Command(CLI::App & parser, AddFunction addSettings)
    : settings(parser)
    , add(addSettings)
  {}

  /** Adds the settings, unless they are there. */
  void
  AddSettings();

  CommandSettings settings;
  CommandRun run; ///< holds what the settings set; empty before AddSettings()
  AddFunction add;
};

/** \class ProgramOptions
 * \brief The options of all commands. */
struct ProgramOptions
{
  unsigned int threads = 0; ///< 0: as many as there are cores
  bool isVerbose = false;
  bool isQuiet = false;
};

/** \class CommandLine
 * \brief The program's commands, one of which is chosen, with its settings, by a command line or by JSON. Each object
 * takes one of either. */
class CommandLine
{
public:
  CommandLine();

  CommandLine(const CommandLine &) = delete;
  CommandLine &
  operator=(const CommandLine &) = delete;

  /** The command of the words that follow the program's name. Throws Failure(Usage), and CLI::Success for --help and
   * --version. */
  Command &
  Parse(const std::vector<std::string> & words);

  /** A command with the settings of JSON (see CommandSettings). Throws Failure(Usage). */
  Command &
  Set(const std::string & command, const Report & settings);

  /** A command of which no setting is given. Throws Failure(Usage) if there is none of that name. */
  Command &
  Get(const std::string & command);

  const ProgramOptions &
  GetOptions() const
  {
    return m_Options;
  }

  /** Prints what --help or --version asked for. */
  void
  Print(const CLI::Success & asked) const
  {
    m_Parser.exit(asked);
  }

private:
  CLI::App m_Parser;
  CommandSettings m_Program;
  ProgramOptions m_Options;
  std::map<std::string, Command> m_Commands;
};

/** The only argument of the program when standard input holds its command: {"command": "mesh", "settings": {...},
 * "threads": 2}, with settings as CommandSettings has them. Standard output then holds {"outputs": [{"name":
 * "bone.stl", "kind": "mesh", "measures": [...]}]}, or {"failure": sentence}. */
constexpr char RequestOption[] = "--request";

/** The settings of the commands render, mesh and resample, for pipeline files. */
CommandSyntax
GetCommandSyntax();

/** A sentence about settings that \a program refused with \a error. It names the command or option, the nearest one if
 * it is unknown, and the help that lists all.
 * \param command whose settings they are; the program if none is named */
std::string
DescribeUsageError(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error);

/** The failure, with its exit code, of the exception that is being handled. */
Failure
FailureOfException();

/** Versions of the program and its libraries, a line each. */
std::string
VersionText();

} // namespace rhombic

#endif
