#include "rhombicCommands.h"
#include "rhombicComparison.h"
#include "rhombicFailure.h"

namespace rhombic
{

CommandRun
AddCompareCommand(CLI::App & parser)
{
  struct Options
  {
    std::string experiments;
    std::string output;
    std::string scans;
    ComparisonSettings settings;
  };
  const auto options = std::make_shared<Options>();
  parser.add_option("EXPERIMENTS", options->experiments, "a file of experiments, as pipelines/comparison/paper.yaml");
  parser.add_option("-o,--output", options->output, "folder for tables and pictures")->required();
  parser.add_option("--only", options->settings.only, "run this experiment alone");
  parser
    .add_option("--scans", options->scans, "folder of the scans that EXPERIMENTS names; without it, its own folder")
    ->envname("RHOMBIC_SCANS");
  parser.add_option("--repeats", options->settings.repeats, "runs of each method, of which the median time is taken")
    ->check(CLI::Range(1u, 1000u))
    ->capture_default_str();
  parser.add_flag("!--no-pictures", options->settings.hasPictures, "tables only");
  return [options](const CommandContext & context) {
    options->settings.output = options->output;
    RunComparison(
      ReadComparisonRequest(options->experiments, options->scans), options->settings, context.console->MakeEvents());
  };
}

} // namespace rhombic
