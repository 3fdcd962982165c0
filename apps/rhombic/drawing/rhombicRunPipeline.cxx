#include "rhombicFailure.h"
#include "rhombicOutputCommands.h"
#include "rhombicScanOptions.h"
#include "rhombicUsageError.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The value of an option, or nothing. */
std::string
ValueOf(const CLI::App & command, const std::string & option)
{
  const auto & values = command.get_option(option)->results();
  return values.empty() ? "" : values.front();
}

fs::path
AbsolutePathOf(const CLI::App & command, const std::string & option)
{
  const std::string path = ValueOf(command, option);
  return path.empty() ? fs::path() : fs::absolute(path);
}

/** The options of reading the scan that a command line has. Refuses others, which a pipeline file holds. */
std::vector<std::string>
FindScanOptions(const CLI::App & command, const CLI::App & scanOptions)
{
  std::vector<std::string> found;
  for (const CLI::Option * const option : command.get_options([](const auto * one) { return one->count() > 0; }))
  {
    const std::string name = option->get_name();
    if (name == "--max-memory")
    {
      setenv("RHOMBIC_MAX_MEMORY", ValueOf(command, name).c_str(), 1); // which reports of outputs do not hold
    }
    else if (name != "SCAN" && name != "--output" && name != "--labels" && name != "--pipeline")
    {
      if (scanOptions.get_option_no_throw(name) == nullptr)
      {
        throw Failure(FailureKind::Usage,
                      name + " does not go with --pipeline, whose file holds the options of its outputs; only SCAN, "
                             "-o, --labels and options of reading the scan, as --series, do.");
      }
      found.push_back(option->get_items_expected_max() == 0 ? name : name + "=" + ValueOf(command, name));
    }
  }
  return found;
}

/** Removes the steps of other commands, and says which. */
void
KeepStepsOf(const std::string & command, const std::string & file, Pipeline & pipeline, const Events & events)
{
  const auto others = std::stable_partition(
    pipeline.steps.begin(), pipeline.steps.end(), [&](const auto & step) { return step.arguments.front() == command; });
  std::string outputs;
  for (auto other = others; other != pipeline.steps.end(); ++other)
  {
    outputs += (outputs.empty() ? "" : ", ") + other->output + ", which rhombic " + other->arguments.front() + " makes";
  }
  if (others == pipeline.steps.begin())
  {
    throw Failure(FailureKind::Usage,
                  "The pipeline " + file + " has no output that rhombic " + command + " makes, but " + outputs + ".");
  }
  if (!outputs.empty())
  {
    events.Note("left out: " + outputs);
  }
  pipeline.steps.erase(others, pipeline.steps.end());
}

} // namespace

void
RunPipeline(const std::string & file, const CLI::App & command, const CommandContext & context)
{
  Pipeline pipeline = ReadPipeline(file, OutputCommands::GetSyntax());
  KeepStepsOf(command.get_name(), file, pipeline, context.console->MakeEvents());

  CLI::App scanParser;
  ScanOptions scan;
  scan.AddSource(scanParser);
  BatchCase batchCase;
  batchCase.options = FindScanOptions(command, scanParser);
  batchCase.scan = AbsolutePathOf(command, "SCAN");
  batchCase.labels = AbsolutePathOf(command, "--labels");
  if (command.get_option("--labels")->count() > 1)
  {
    throw Failure(FailureKind::Usage, "--pipeline takes one --labels; put the masks into a folder, and name that.");
  }
  const std::string folder = ValueOf(command, "--output");
  if (folder.empty() || batchCase.scan.empty())
  {
    throw Failure(FailureKind::Usage,
                  "Name a scan, and a folder with -o, as in rhombic " + command.get_name() + " scan --pipeline " +
                    file + " -o results.");
  }

  std::error_code error;
  fs::create_directories(folder, error);
  fs::current_path(folder, error); // names of outputs in options, as of --measures, are relative to it
  if (error)
  {
    throw Failure(FailureKind::Output, "Cannot write to the folder " + folder + ": " + error.message() + ".");
  }
  std::vector<std::vector<std::string>> steps;
  for (const PipelineStep & step : pipeline.steps)
  {
    steps.push_back(GetArguments(step, batchCase));
    OutputCommands::GetSyntax().check(steps.back());
  }
  std::optional<Failure> first;
  std::string failed;
  for (std::size_t n = 0; n < steps.size(); ++n)
  {
    try
    {
      OutputCommands commands;
      commands.Parse(steps[n])({ context.console, context.decoder, steps[n] });
    }
    catch (const std::exception &)
    {
      failed += (failed.empty() ? "" : ", ") + pipeline.steps[n].output;
      if (!first)
      {
        first.emplace(FailureOfException());
      }
    }
  }
  if (first)
  {
    throw Failure(first->GetKind(), std::string(first->GetDescription()) + " Not made: " + failed + ".");
  }
  context.console->Note("folder: " + folder);
}

} // namespace rhombic
