#include "rhombicAtomicFile.h"
#include "rhombicCommandLine.h"
#include "rhombicScanOptions.h"
#include "rhombicWording.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The settings of reading the scan that a command has, for all outputs. Refuses others, which a pipeline file holds.
 */
Report
FindScanSettings(const Report & given)
{
  CLI::App parser;
  CommandSettings source(parser);
  ScanOptions options;
  source.Add(ScanOptions::SourceTable(), options);
  Report known = Report::object();
  for (const auto & setting : source.GetNames())
  {
    known[setting.first] = true;
  }
  Report found = Report::object();
  for (const auto & [name, value] : given.items())
  {
    if (known.contains(name))
    {
      found[name] = value;
    }
    else if (name != "scan" && name != "output" && name != "labels" && name != "pipeline")
    {
      throw Failure(FailureKind::Usage,
                    "--" + name +
                      " does not go with --pipeline, whose file holds the options of its outputs; only SCAN, "
                      "-o, --labels and options of reading the scan, as --series, do.");
    }
  }
  return found;
}

/** Removes the steps of other commands, and says which. */
void
KeepStepsOf(const std::string & command, const std::string & file, Pipeline & pipeline, const Events & events)
{
  const auto others = std::stable_partition(
    pipeline.steps.begin(), pipeline.steps.end(), [&](const auto & step) { return step.command == command; });
  std::string outputs;
  for (auto other = others; other != pipeline.steps.end(); ++other)
  {
    outputs += (outputs.empty() ? "" : ", ") + other->output + ", which rhombic " + other->command + " makes";
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

/** Makes those outputs of a pipeline file that a command makes, with the same bytes as rhombic batch. All are checked
 * before the first is made; one that fails then keeps no other from being made. Throws Failure, of the kind of the
 * first failure. */
void
RunPipeline(const std::string & file, const CommandContext & context)
{
  const std::string & command = context.settings->GetCommand();
  Pipeline pipeline = ReadPipeline(file, GetCommandSyntax());
  KeepStepsOf(command, file, pipeline, context.console->MakeEvents());

  const Report given = context.settings->Get();
  const Report scanSettings = FindScanSettings(given);
  const Report labels = given.value("labels", Report::array());
  if (labels.size() > 1)
  {
    throw Failure(FailureKind::Usage, "--pipeline takes one --labels; put the masks into a folder, and name that.");
  }
  const std::string folder = given.value("output", std::string());
  if (folder.empty() || !given.contains("scan"))
  {
    throw Failure(FailureKind::Usage,
                  "Name a scan, and a folder with -o, as in rhombic " + command + " scan --pipeline " + file +
                    " -o results.");
  }
  BatchCase batchCase;
  batchCase.scan = given["scan"].get<std::string>();
  batchCase.labels = labels.empty() ? "" : labels[0].get<std::string>();

  MakeOutputFolder(folder);
  std::vector<Report> steps;
  for (const PipelineStep & step : pipeline.steps)
  {
    steps.push_back(GetSettings(step, batchCase, scanSettings, folder));
    GetCommandSyntax().check(command, steps.back());
  }
  std::optional<Failure> first;
  std::string failed;
  for (std::size_t n = 0; n < steps.size(); ++n)
  {
    try
    {
      CommandLine commandLine;
      Command & step = commandLine.Set(command, steps[n]);
      step.run({ context.console, &step.settings });
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

} // namespace

void
NoteOutputs(const std::string & word, const std::vector<MadeFile> & outputs, Console & console)
{
  for (const MadeFile & output : outputs)
  {
    if (output.isMain)
    {
      console.Note(word + ": " + output.path.string());
    }
  }
}

CommandRun
AddPipelineOption(CommandSettings & command, const CommandRun & otherwise)
{
  struct Options
  {
    std::string pipeline;
  };
  static const SettingsTable<Options> table{
    { "--pipeline",
      &Options::pipeline,
      "make what this command makes of a pipeline file (.yaml, as of rhombic batch); -o is the folder",
      OfKind(SettingKind::Run) },
  };
  const auto options = std::make_shared<Options>();
  command.Add(table, *options);
  return [options, otherwise](const CommandContext & context) {
    if (options->pipeline.empty())
    {
      return otherwise(context);
    }
    RunPipeline(options->pipeline, context);
    return std::vector<MadeFile>();
  };
}

} // namespace rhombic
