#include "rhombicCommands.h"
#include "rhombicComparison.h"
#include "rhombicFailure.h"

namespace rhombic
{

namespace
{

struct CompareOptions
{
  std::string experiments;
  std::string output;
  std::string scans;
  bool hasNoPictures = false;
  ComparisonSettings settings;
};

} // namespace

CommandRun
AddCompareCommand(CommandSettings & command)
{
  static const SettingsTable<CompareOptions> table{
    { "EXPERIMENTS", &CompareOptions::experiments, "a file of experiments, as pipelines/comparison/paper.yaml" },
    { "-o,--output", &CompareOptions::output, "folder for tables and pictures", Required, OfKind(SettingKind::Output) },
    { "--only", &CompareOptions::settings, &ComparisonSettings::only, "run this experiment alone" },
    { "--scans",
      &CompareOptions::scans,
      "folder of the scans that EXPERIMENTS names; without it, its own folder",
      DefaultsTo("RHOMBIC_SCANS"),
      OfKind(SettingKind::Source) },
    { "--repeats",
      &CompareOptions::settings,
      &ComparisonSettings::repeats,
      "runs of each method, of which the median time is taken",
      Checked(CLI::Range(1u, 1000u)),
      ShowingDefault },
    { "--no-pictures", &CompareOptions::hasNoPictures, "tables only" },
  };
  const auto options = std::make_shared<CompareOptions>();
  command.Add(table, *options);
  return WithoutOutputs([options](const CommandContext & context) {
    options->settings.output = options->output;
    options->settings.hasPictures = !options->hasNoPictures;
    RunComparison(
      ReadComparisonRequest(options->experiments, options->scans), options->settings, context.console->MakeEvents());
  });
}

} // namespace rhombic
