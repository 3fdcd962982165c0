#include "rhombicOutputCommands.h"

#include "rhombicFailure.h"
#include "rhombicUsageError.h"

namespace rhombic
{

OutputCommands::OutputCommands()
{
  m_Program.require_subcommand(1);
  m_Runs["render"] = AddRenderCommand(*m_Program.add_subcommand("render"));
  m_Runs["mesh"] = AddMeshCommand(*m_Program.add_subcommand("mesh"));
  m_Runs["resample"] = AddResampleCommand(*m_Program.add_subcommand("resample"));
}

const CommandRun &
OutputCommands::Parse(const std::vector<std::string> & arguments)
{
  try
  {
    m_Program.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  }
  catch (const CLI::ParseError & error)
  {
    throw Failure(FailureKind::Usage, DescribeUsageError(m_Program, error));
  }
  return m_Runs.at(arguments.front());
}

CommandSyntax
OutputCommands::GetSyntax()
{
  CommandSyntax syntax;
  syntax.optionsOf = [](const std::string & command) {
    std::vector<std::string> names;
    OutputCommands commands;
    for (const CLI::Option * const option : commands.m_Program.get_subcommand(command)->get_options())
    {
      names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
    }
    return names;
  };
  syntax.check = [](const std::vector<std::string> & arguments) {
    std::vector<std::filesystem::path> files;
    OutputCommands commands;
    commands.Parse(arguments)({ nullptr, nullptr, arguments, &files });
    return files;
  };
  return syntax;
}

} // namespace rhombic
