#include "rhombicCommandLine.h"

#include "rhombicWording.h"
#include "rhombicOptionNames.h"

#include <algorithm>
#include <new>
#include <vector>

namespace rhombic
{
namespace
{

/** "rhombic render --help". */
std::string
HelpOf(const CLI::App & program, const CLI::App & command)
{
  return program.get_name() + (&command == &program ? "" : " " + command.get_name()) + " --help";
}

/** The options that can be given: the command's, and those of the program. */
std::vector<const CLI::Option *>
FindOptions(const CLI::App & program, const CLI::App & command)
{
  std::vector<const CLI::Option *> options = command.get_options();
  const auto ofProgram = program.get_options();
  options.insert(options.end(), ofProgram.begin(), ofProgram.end());
  return options;
}

std::string
DescribeUnknownOption(const CLI::App & program, const CLI::App & command, const std::string & argument)
{
  const std::string option = argument.substr(0, argument.find('='));
  const auto options = FindOptions(program, command);
  const auto isIt = [&option](const CLI::Option * known) { return known->check_name(option); };
  if (std::any_of(options.begin(), options.end(), isIt))
  {
    return "The option " + option + " goes behind the command, as in rhombic " + command.get_name() + " " + option +
           ".";
  }
  std::vector<std::string> names; // without dashes
  for (const CLI::Option * const known : options)
  {
    names.insert(names.end(), known->get_lnames().begin(), known->get_lnames().end());
  }
  const std::string nearest = NearestName(option.substr(option.find_first_not_of('-')), names);
  return "There is no option " + option + "; " + (nearest.empty() ? "" : "did you mean --" + nearest + "? Otherwise ") +
         "see " + HelpOf(program, command) + " for all of them.";
}

/** An unknown command or option, or one path too many. */
std::string
DescribeUnexpected(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error)
{
  const std::vector<std::string> unexpected = program.remaining(true); // in the order in which they were given
  const auto isOption = [](const std::string & word) {
    return word.size() > 1 && word[0] == '-' && word.find_first_not_of('-') != std::string::npos;
  };
  const auto option = std::find_if(unexpected.begin(), unexpected.end(), isOption);
  const bool isCommandMissing = &command == &program;
  if (option != unexpected.end() && (!isCommandMissing || option == unexpected.begin()))
  {
    return DescribeUnknownOption(program, command, *option);
  }
  if (unexpected.empty() && isCommandMissing)
  {
    return "No command is given; " + HelpOf(program, command) + " lists them.";
  }
  if (unexpected.empty())
  {
    return std::string(error.what()) + "; see " + HelpOf(program, command) + ".";
  }
  if (isCommandMissing)
  {
    std::vector<std::string> names;
    for (const CLI::App * const known : program.get_subcommands([](const CLI::App *) { return true; }))
    {
      names.push_back(known->get_name());
    }
    return DescribeUnknown(
      "command", unexpected.front(), names, "see " + HelpOf(program, command) + " for all of them");
  }
  return "'" + unexpected.front() + "' is one name too many; a name with spaces needs quotes (see " +
         HelpOf(program, command) + ").";
}

/** An option that has too many values, or none. */
std::string
DescribeMismatch(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error)
{
  for (const CLI::Option * const option : FindOptions(program, command))
  {
    const int most = option->get_items_expected_max(); // 0 for flags, which may be repeated
    if (most > 0 && option->count() > static_cast<std::size_t>(most))
    {
      return option->get_name() + " is given " + Count(option->count(), "time") + "; give it once.";
    }
  }
  const std::string text = error.what(); // the option's name, ": ", and what is missing
  return text.substr(0, text.find(':')) + " needs a value (see " + HelpOf(program, command) + ").";
}

/** A value that is no number. CLI11's message is "Could not convert: --density = abc". */
std::string
DescribeConversion(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error)
{
  const std::string text = error.what();
  const auto colon = text.find(": ");
  return (colon == std::string::npos ? text : text.substr(colon + 2)) +
         " is no number, or no whole number where one is needed (see " + HelpOf(program, command) + ").";
}

} // namespace

std::string
DescribeUsageError(const CLI::App & program, const CLI::App & command, const CLI::ParseError & error)
{
  switch (static_cast<CLI::ExitCodes>(error.get_exit_code()))
  {
    case CLI::ExitCodes::RequiredError: // also when there is a command that the program does not know
    case CLI::ExitCodes::ExtrasError:
      return DescribeUnexpected(program, command, error);
    case CLI::ExitCodes::ArgumentMismatch:
      return DescribeMismatch(program, command, error);
    case CLI::ExitCodes::ConversionError:
      return DescribeConversion(program, command, error);
    default:
      return std::string(error.what()) + " (see " + HelpOf(program, command) + ").";
  }
}

Failure
FailureOfException()
{
  constexpr const char * noMemory = "There is not enough memory; try a lower --density or close other programs.";
  try
  {
    throw;
  }
  catch (const Failure & failure)
  {
    return { failure.GetKind(),
             NameOptions(failure.GetDescription()),
             failure.GetFile(),
             failure.GetLine(),
             failure.GetLocation() };
  }
  catch (const itk::MemoryAllocationError &)
  {
    return { FailureKind::Memory, noMemory };
  }
  catch (const std::bad_alloc &)
  {
    return { FailureKind::Memory, noMemory };
  }
  catch (const std::exception & error)
  {
    return { FailureKind::Internal, DescribeError(error) + "; this is a defect, please report it." };
  }
}

} // namespace rhombic
