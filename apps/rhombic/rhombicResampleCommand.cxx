#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicResampleScan.h"
#include "rhombicScanOptions.h"

namespace rhombic
{
namespace
{

struct ResampleOptions
{
  ScanOptions scan;
  std::string volume;
};

void
Resample(const ResampleOptions & options, const CommandContext & context)
{
  ResampleScanSettings settings;
  settings.source = options.scan.GetSource(context.decoder);
  if (options.volume.empty())
  {
    throw Failure(FailureKind::Usage, "No output is named; give one with -o, for example -o scan.fcc.nrrd.");
  }
  settings.volume = options.volume;
  settings.provenance = options.scan.GetProvenance(*context.settings);
  if (context.planned != nullptr)
  {
    const auto planned = CheckResampleScan(settings);
    context.planned->insert(context.planned->end(), planned.begin(), planned.end());
    return;
  }
  ResampleScan(settings, context.console->MakeEvents());
  context.console->Note("volume: " + settings.volume.string());
}

} // namespace

CommandRun
AddResampleCommand(CommandSettings & command)
{
  static const SettingsTable<ResampleOptions> table{
    { "-o,--output",
      &ResampleOptions::volume,
      "the lattice volume (.nrrd); when SCAN is one, the Cartesian volume (.nrrd, .nii, .nii.gz, .mha)",
      OfKind(SettingKind::Output) },
  };
  const auto options = std::make_shared<ResampleOptions>();
  command.Add(ScanOptions::SourceTable(), options->scan);
  command.Add(table, *options);
  command.Add(ScanOptions::LatticeTable(), options->scan);
  command.Add(ScanOptions::SidecarTable(), options->scan);
  return [options](const CommandContext & context) { Resample(*options, context); };
}

} // namespace rhombic
