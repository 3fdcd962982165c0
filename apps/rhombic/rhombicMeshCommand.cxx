#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicMemoryPlan.h"
#include "rhombicMeshScan.h"
#include "rhombicScanOptions.h"
#include "rhombicSurfaceOptions.h"

#include <cmath>
#include <iostream>

namespace rhombic
{
namespace
{

struct MeshOptions
{
  ScanOptions scan;
  SurfaceOptions surfaces;
  SurfaceFinish finish;
  std::string threshold;
  std::string mesh;
  std::string space = "lps";
  std::string maximumTriangles;
  std::string measures;
  bool audits = false;
  bool requiresWatertight = false;
  std::string colourBy;
  double minimumThickness = 0.0;
  bool isDryRun = false;
};

/** A number of triangles, or a percentage of the triangles as extracted. */
void
ParseTriangles(const std::string & text, SurfaceFinish & finish)
{
  if (text.empty())
  {
    return;
  }
  const bool isShare = text.back() == '%';
  const double number = ToNumber<double>(text.substr(0, text.size() - (isShare ? 1 : 0))).value_or(0.0);
  if (!(number > 0.0) || number > 4e9 || (isShare ? number > 100.0 : number != std::floor(number)))
  {
    throw Failure(FailureKind::Usage,
                  "'" + text + "' is no number of triangles; write --max-triangles 200000, or 10% of what there are.");
  }
  if (isShare)
  {
    finish.share = number / 100.0;
  }
  else
  {
    finish.maximumTriangles = static_cast<std::size_t>(number);
  }
}

SurfaceSelection
GetSelection(const MeshOptions & options, const Preset & preset)
{
  if (options.threshold.empty())
  {
    return options.surfaces.GetSelection(preset);
  }
  SurfaceRequest request;
  request.name = "surface";
  if (!ParseThreshold(options.threshold, request))
  {
    throw Failure(FailureKind::Usage,
                  "The threshold '" + options.threshold +
                    "' is no number; write -t -300.5, -t '<-500.5' for what lies below, -t otsu or -t otsu-low.");
  }
  return options.surfaces.GetSelection(preset, request);
}

std::vector<MadeFile>
Mesh(const MeshOptions & options, const CommandContext & context)
{
  MeshScanSettings settings;
  if (options.mesh.empty())
  {
    throw Failure(FailureKind::Usage, "No file is named; give one with -o, for example -o bone.stl.");
  }
  settings.source = options.scan.GetSource();
  settings.mesh = options.mesh;
  settings.space = FindNamed<SurfaceFileSpace>(
    "space", options.space, { { "lps", SurfaceFileSpace::LPS }, { "ras", SurfaceFileSpace::RAS } });
  settings.finish = options.finish;
  ParseTriangles(options.maximumTriangles, settings.finish);
  settings.measures = options.measures;
  settings.audits = options.audits;
  settings.requiresWatertight = options.requiresWatertight;
  settings.minimumThickness = options.minimumThickness;
  settings.colourBy = GetColourBy(options.colourBy);
  settings.provenance = options.scan.GetProvenance(*context.settings);
  settings.surfaces = GetSelection(options, options.surfaces.GetNamedPreset());
  std::vector<MadeFile> outputs;
  AddOutputs(CheckMeshScan(settings), "", outputs);
  if (context.onlyChecks)
  {
    return outputs;
  }
  const Events events = context.console->MakeEvents();
  if (options.isDryRun)
  {
    std::cout << PlanMeshScan(settings, events);
    return {};
  }
  std::optional<SourceVolume> volume;
  const Preset preset = options.surfaces.GetPreset(settings.source, volume, events);
  options.scan.ApplyPreset(preset, settings.source);
  settings.surfaces = GetSelection(options, preset);
  outputs = MeshScan(settings, events, std::move(volume));
  NoteOutputs("mesh", outputs, *context.console);
  return outputs;
}

} // namespace

CommandRun
AddMeshCommand(CommandSettings & command)
{
  static const SettingsTable<MeshOptions> threshold{
    { "-t,--threshold",
      &MeshOptions::threshold,
      "one surface by its isovalue: a number in the scan's units, <number for what lies below, otsu, otsu-low, "
      "otsu-lowest or otsu-high" },
  };
  static const SettingsTable<MeshOptions> file{
    { "-o,--output",
      &MeshOptions::mesh,
      "the mesh: " + GetSurfaceFileExtensions() + "; a file for each surface if its name holds {name}",
      OfKind(SettingKind::Output) },
    { "--space", &MeshOptions::space, "axes of the file: lps or ras, in mm", ShowingDefault },
    { "--colour-by", &MeshOptions::colourBy, GetColourByHelp(), OfKind(SettingKind::Source) },
  };
  static const SettingsTable<MeshOptions> checks{
    { "--max-error",
      &MeshOptions::finish,
      &SurfaceFinish::maximumError,
      "simplify, staying within so many mm everywhere" },
    { "--max-triangles",
      &MeshOptions::maximumTriangles,
      "simplify to so many triangles, or to a share, as 10%, within --max-error or a lattice spacing; the number is "
      "for each isosurface, and for all labels together" },
    { "--measures",
      &MeshOptions::measures,
      "volumes, areas and other measures as a table: .csv or .json",
      OfKind(SettingKind::Output) },
    { "--audit",
      &MeshOptions::audits,
      "check the files read back: closed, manifold, self-intersections, distance to the scan's isosurface" },
    { "--min-thickness",
      &MeshOptions::minimumThickness,
      "warn, before printing, where and on how much area walls are thinner than so many mm",
      AboveZero },
    { "--require-watertight",
      &MeshOptions::requiresWatertight,
      "write no file with holes or other defects, but end with exit code 8; that triangles pass through each other is "
      "reported by --audit, and no reason not to write it" },
  };
  static const SettingsTable<MeshOptions> run{
    { "--dry-run",
      &MeshOptions::isDryRun,
      "print where voxels and lattice will be, slabs and passes, and the memory, triangles and time as estimates, and "
      "stop; refused as the work would be",
      OfKind(SettingKind::Run) },
  };
  const auto options = std::make_shared<MeshOptions>();
  command.Add(ScanOptions::SourceTable(), options->scan);
  command.Add(threshold, *options);
  command.Add(SurfaceOptions::Table(), options->surfaces);
  command.Add(file, *options);
  command.Add(FinishTable(), options->finish);
  command.Add(checks, *options);
  command.Add(ScanOptions::LatticeTable(), options->scan);
  command.Add(ScanOptions::SidecarTable(), options->scan);
  command.Add(run, *options);
  return AddPipelineOption(command, [options](const CommandContext & context) { return Mesh(*options, context); });
}

} // namespace rhombic
