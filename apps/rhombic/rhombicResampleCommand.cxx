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
  settings.source = options.scan.GetSource(context);
  if (options.volume.empty())
  {
    throw Failure(FailureKind::Usage, "No output is named; give one with -o, for example -o scan.fcc.nrrd.");
  }
  settings.volume = options.volume;
  settings.provenance = options.scan.GetProvenance(context);
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
AddResampleCommand(CLI::App & parser)
{
  const auto options = std::make_shared<ResampleOptions>();
  options->scan.AddSource(parser);
  parser.add_option("-o,--output",
                    options->volume,
                    "the lattice volume (.nrrd); when SCAN is one, the Cartesian volume (.nrrd, .nii, .nii.gz, .mha)");
  options->scan.AddLattice(parser);
  options->scan.AddSidecar(parser);
  return [options](const CommandContext & context) { Resample(*options, context); };
}

} // namespace rhombic
