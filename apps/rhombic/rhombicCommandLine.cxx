#include "rhombicCommandLine.h"
#include "rhombicLoadLibrary.h"

#include "itkVersion.h"

#include <OpenImageIO/oiioversion.h>
#include <vtkVersionMacros.h>

namespace rhombic
{
namespace
{

struct CommandEntry
{
  const char * name;
  const char * description;
  CommandRun (*add)(CommandSettings &);
};

constexpr CommandEntry entries[] = {
  { "info", "What is in a scan: series, geometry, values, thresholds worth trying", AddInfoCommand },
  { "render", "Pictures of a scan's surfaces", AddOnDemandCommand },
  { "mesh", "A scan's surface as a file", AddMeshCommand },
  { "batch", "Pictures, pages and meshes of many scans", AddBatchCommand },
  { "bids", "The same of a BIDS dataset, as a BIDS App", AddBIDSCommand },
  { "compare-labels", "How well two segmentations agree, label by label", AddOnDemandCommand },
  { "compare-pictures", "Whether two pictures are the same, within a tolerance", AddOnDemandCommand },
  { "audit", "Whether a surface file is closed, oriented and free of defects", AddAuditCommand },
  { "resample", "A scan on the face-centered cubic lattice, and back", AddResampleCommand },
  { "compare", "Lattices and methods compared, as in the paper: tables, plots, pictures", AddOnDemandCommand },
  { "phantom", "The analytic test scan, with organs of known volume", AddOnDemandCommand },
  { "doctor", "What works on this machine", AddOnDemandCommand },
};

constexpr char exitCodes[] = "Exit codes:\n"
                             "  0   done\n"
                             "  1   a defect in rhombic or its installation; please report it\n"
                             "  2   wrong usage: an option, a preset, a file extension\n"
                             "  3   no such file or folder, or no scan in it\n"
                             "  4   the input is damaged or of a kind that is not supported\n"
                             "  5   the input's position in the patient can't be known\n"
                             "  6   there is no surface at this threshold\n"
                             "  7   the output can't be written\n"
                             "  8   a surface is not watertight (audit, --require-watertight)\n"
                             "  9   not enough memory, or no more threads, processes or open files\n"
                             "  10  this machine can't draw (see rhombic doctor)\n"
                             "  11  pictures differ by more than the tolerance\n"
                             "  12  some cases of a batch failed";

const SettingsTable<ProgramOptions> &
ProgramTable()
{
  static const SettingsTable<ProgramOptions> table{
    { "--threads",
      &ProgramOptions::threads,
      "number of threads (default: all cores)",
      DefaultsTo("RHOMBIC_THREADS"),
      Checked(CLI::Range(1u, 1024u)) },
    { "-v,--verbose", &ProgramOptions::isVerbose, "print more, with times" },
    { "-q,--quiet", &ProgramOptions::isQuiet, "print errors only", Excludes({ "--verbose" }) },
  };
  return table;
}

/** Settings of which pipelines or batches give the values themselves, or that change no output. */
bool
IsOfPipeline(const std::string & name, SettingKind kind)
{
  return kind == SettingKind::Run || name == "output" || name == "sheet";
}

} // namespace

void
Command::AddSettings()
{
  if (!run)
  {
    run = add(settings);
    settings.Relate();
  }
}

CommandLine::CommandLine()
  : m_Parser(std::string("Rhombic: ") + RHOMBIC_DESCRIPTION, "rhombic")
  , m_Program(m_Parser)
{
  m_Parser.footer(exitCodes);
  m_Parser.require_subcommand(1);
  m_Parser.fallthrough();
  m_Parser.set_version_flag("--version", VersionText());
  m_Program.Add(ProgramTable(), m_Options);
  m_Program.Relate();
  for (const CommandEntry & entry : entries)
  {
    CLI::App * const parser = m_Parser.add_subcommand(entry.name, entry.description);
    parser->footer(exitCodes);
    Command & command = m_Commands.try_emplace(entry.name, *parser, entry.add).first->second;
    parser->preparse_callback([&command](std::size_t) { command.AddSettings(); });
  }
}

Command &
CommandLine::Parse(const std::vector<std::string> & words)
{
  try
  {
    m_Parser.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return m_Commands.at(m_Parser.get_subcommands().front()->get_name());
  }
  catch (const CLI::Success &)
  {
    throw;
  }
  catch (const CLI::ParseError & error)
  {
    const auto named = m_Parser.get_subcommands();
    throw Failure(FailureKind::Usage, DescribeUsageError(m_Parser, named.empty() ? m_Parser : *named.front(), error));
  }
}

Command &
CommandLine::Get(const std::string & command)
{
  const auto found = m_Commands.find(command);
  if (found == m_Commands.end())
  {
    throw Failure(FailureKind::Usage, "There is no command '" + command + "'.");
  }
  found->second.AddSettings();
  return found->second;
}

Command &
CommandLine::Set(const std::string & command, const Report & settings)
{
  Command & chosen = this->Get(command);
  try
  {
    chosen.settings.Set(settings);
  }
  catch (const CLI::ParseError & error)
  {
    throw Failure(FailureKind::Usage, DescribeUsageError(m_Parser, *m_Parser.get_subcommand(command), error));
  }
  return chosen;
}

CommandRun
AddOnDemandCommand(CommandSettings & command)
{
  using Function = void (*)(CommandSettings &, CommandRun &);
  const auto add = reinterpret_cast<Function>(FindInLibrary(
    "rhombic-on-demand.so", "rhombicAddOnDemandCommand", ("runs rhombic " + command.GetCommand()).c_str()));
  CommandRun run;
  add(command, run);
  return run;
}

CommandSyntax
GetCommandSyntax()
{
  CommandSyntax syntax;
  syntax.settingsOf = [](const std::string & command) {
    CommandLine commandLine;
    std::vector<CommandSyntax::Setting> settings;
    for (const auto & [name, kind] : commandLine.Get(command).settings.GetNames())
    {
      if (!IsOfPipeline(name, kind))
      {
        settings.push_back({ name, kind == SettingKind::InputFile, kind == SettingKind::Output });
      }
    }
    return settings;
  };
  syntax.check = [](const std::string & command, const Report & settings) {
    CommandLine commandLine;
    std::vector<std::filesystem::path> files;
    Command & checked = commandLine.Set(command, settings);
    for (const MadeFile & output : checked.run({ nullptr, &checked.settings, true }))
    {
      files.push_back(output.path);
    }
    return files;
  };
  syntax.parse = [](const std::string & command, const std::vector<std::string> & options) {
    std::vector<std::string> words{ command };
    words.insert(words.end(), options.begin(), options.end());
    CommandLine commandLine;
    return commandLine.Parse(words).settings.Get();
  };
  return syntax;
}

std::string
VersionText()
{
  return "rhombic      " RHOMBIC_VERSION "\nITK          " + std::string(itk::Version::GetITKVersion()) +
         "\nVTK          " VTK_VERSION "\nOpenImageIO  " + std::to_string(OIIO_VERSION_MAJOR) + "." +
         std::to_string(OIIO_VERSION_MINOR) + "." + std::to_string(OIIO_VERSION_PATCH) + "\n";
}

} // namespace rhombic
