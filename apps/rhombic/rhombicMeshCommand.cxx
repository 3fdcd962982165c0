#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicScanOptions.h"

namespace rhombic
{
namespace
{

struct MeshOptions
{
  ScanOptions scan;
  std::string threshold;
  std::string mesh;
};

void
Mesh(const MeshOptions & options, const CommandContext & context)
{
  MeshScanSettings settings;
  settings.source = options.scan.GetSource(context);
  if (options.threshold.empty() || options.mesh.empty())
  {
    throw Failure(FailureKind::Usage, "A threshold and a file are needed, for example -t 250.5 -o bone.stl.");
  }
  settings.surface.name = "the mesh";
  if (!ParseThreshold(options.threshold, settings.surface))
  {
    throw Failure(FailureKind::Usage,
                  "The threshold '" + options.threshold +
                    "' is no number; write -t -300.5, -t '<-500.5' for what lies below, or -t otsu.");
  }
  settings.mode = options.scan.GetMode();
  settings.table = options.scan.GetTable(false);
  settings.mesh = options.mesh;
  settings.provenance = options.scan.GetProvenance(context);
  MeshScan(settings, context.console->MakeEvents());
  context.console->Note("mesh: " + settings.mesh.string());
}

} // namespace

CommandRun
AddMeshCommand(CLI::App & parser)
{
  const auto options = std::make_shared<MeshOptions>();
  options->scan.AddSource(parser);
  parser.add_option("-t,--threshold",
                    options->threshold,
                    "isovalue: a number in the scan's units, <number for what lies below, or otsu");
  parser.add_option("-o,--output", options->mesh, "the mesh: .stl, .ply or .vtp, in LPS mm");
  options->scan.AddTable(parser);
  options->scan.AddExtraction(parser);
  options->scan.AddLattice(parser);
  options->scan.AddSidecar(parser);
  return [options](const CommandContext & context) { Mesh(*options, context); };
}

} // namespace rhombic
