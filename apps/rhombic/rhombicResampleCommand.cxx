#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicMemoryPlan.h"
#include "rhombicResampleScan.h"
#include "rhombicScanOptions.h"

#include <iostream>

namespace rhombic
{
namespace
{

struct ResampleOptions
{
  ScanOptions scan;
  std::string volume;
  bool isDryRun = false;
};

std::vector<MadeFile>
Resample(const ResampleOptions & options, const CommandContext & context)
{
  ResampleScanSettings settings;
  settings.source = options.scan.GetSource();
  if (options.volume.empty())
  {
    throw Failure(FailureKind::Usage, "No output is named; give one with -o, for example -o scan.fcc.nrrd.");
  }
  settings.volume = options.volume;
  settings.provenance = options.scan.GetProvenance(*context.settings);
  std::vector<MadeFile> outputs;
  if (context.onlyChecks)
  {
    AddOutputs(CheckResampleScan(settings), "", outputs);
    return outputs;
  }
  if (options.isDryRun)
  {
    std::cout << PlanResampleScan(settings, context.console->MakeEvents());
    return {};
  }
  outputs = ResampleScan(settings, context.console->MakeEvents());
  NoteOutputs("volume", outputs, *context.console);
  return outputs;
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
  static const SettingsTable<ResampleOptions> run{
    { "--dry-run",
      &ResampleOptions::isDryRun,
      "print where voxels and lattice will be, slabs, and the memory and time as estimates, and stop; refused as the "
      "work would be",
      OfKind(SettingKind::Run) },
  };
  const auto options = std::make_shared<ResampleOptions>();
  command.Add(ScanOptions::SourceTable(), options->scan);
  command.Add(table, *options);
  command.Add(ScanOptions::LatticeTable(), options->scan);
  command.Add(ScanOptions::SidecarTable(), options->scan);
  command.Add(run, *options);
  return [options](const CommandContext & context) { return Resample(*options, context); };
}

} // namespace rhombic
