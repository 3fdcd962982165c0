#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicFinishOptions.h"
#include "rhombicNamedValues.h"
#include "rhombicMeshScan.h"
#include "rhombicScanOptions.h"
#include "rhombicSurfaceOptions.h"

#include <charconv>
#include <cmath>

namespace rhombic
{
namespace
{

struct MeshOptions
{
  ScanOptions scan;
  SurfaceOptions surfaces;
  std::string threshold;
  std::string mesh;
  std::string space = "lps";
  std::string maximumTriangles;
  FinishOptions finish;
  std::optional<double> maximumError;
  std::string measures;
  bool audits = false;
  bool requiresWatertight = false;
};

/** A number of triangles, or a percentage of the triangles as extracted. */
void
ParseTriangles(const std::string & text, SurfaceFinish & finish)
{
  if (text.empty())
  {
    return;
  }
  const char * const end = text.data() + text.size();
  double number = 0.0;
  const auto parsed = std::from_chars(text.data(), end, number);
  const bool isShare = std::string(parsed.ptr, end) == "%";
  if (parsed.ec != std::errc() || (parsed.ptr != end && !isShare) || !(number > 0.0) || number > 4e9 ||
      (isShare ? number > 100.0 : number != std::floor(number)))
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

SurfaceFileSpace
ParseSpace(const std::string & text)
{
  static const NamedValues<SurfaceFileSpace> spaces{ { "lps", SurfaceFileSpace::LPS },
                                                     { "ras", SurfaceFileSpace::RAS } };
  return FindNamed("space", text, spaces);
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

void
Mesh(const MeshOptions & options, const CommandContext & context)
{
  MeshScanSettings settings;
  if (options.mesh.empty())
  {
    throw Failure(FailureKind::Usage, "No file is named; give one with -o, for example -o bone.stl.");
  }
  settings.source = options.scan.GetSource(context);
  settings.mesh = options.mesh;
  settings.space = ParseSpace(options.space);
  settings.finish = options.finish.Get();
  settings.finish.maximumError = options.maximumError;
  ParseTriangles(options.maximumTriangles, settings.finish);
  settings.measures = options.measures;
  settings.audits = options.audits;
  settings.requiresWatertight = options.requiresWatertight;
  settings.provenance = options.scan.GetProvenance(context, options.surfaces.GetNames());
  settings.surfaces = GetSelection(options, options.surfaces.GetNamedPreset());
  const auto planned = CheckMeshScan(settings);
  if (context.planned != nullptr)
  {
    context.planned->insert(context.planned->end(), planned.begin(), planned.end());
    return;
  }
  const Events events = context.console->MakeEvents();
  const Preset preset = options.surfaces.GetPreset(settings.source, events);
  options.scan.ApplyPreset(preset, settings.source);
  settings.surfaces = GetSelection(options, preset);
  for (const auto & mesh : MeshScan(settings, events))
  {
    context.console->Note("mesh: " + mesh.string());
  }
}

} // namespace

CommandRun
AddMeshCommand(CLI::App & parser)
{
  const auto options = std::make_shared<MeshOptions>();
  options->scan.AddSource(parser);
  parser.add_option(
    "-t,--threshold",
    options->threshold,
    "one surface by its isovalue: a number in the scan's units, <number for what lies below, otsu, otsu-low, "
    "otsu-lowest or otsu-high");
  options->surfaces.Add(parser);
  parser.add_option("-o,--output",
                    options->mesh,
                    "the mesh: " + GetSurfaceFileExtensions() + "; a file for each surface if its name holds {name}");
  parser.add_option("--space", options->space, "axes of the file: lps or ras, in mm")->capture_default_str();
  options->finish.Add(parser);
  parser.add_option("--max-error", options->maximumError, "simplify, staying within so many mm everywhere");
  parser.add_option("--max-triangles",
                    options->maximumTriangles,
                    "simplify to so many triangles, or to a share, as 10%, within --max-error or a lattice spacing; "
                    "the number is for each isosurface, and for all labels together");
  parser.add_option("--measures", options->measures, "volumes, areas and other measures as a table: .csv or .json");
  parser.add_flag("--audit",
                  options->audits,
                  "check the files read back: closed, manifold, self-intersections, distance to the scan's isosurface");
  parser.add_flag("--require-watertight",
                  options->requiresWatertight,
                  "write no file with holes or other defects, but end with exit code 8; that triangles pass through "
                  "each other is reported by --audit, and no reason not to write it");
  options->scan.AddLattice(parser);
  options->scan.AddSidecar(parser);
  return AddPipelineOption(parser, [options](const CommandContext & context) { Mesh(*options, context); });
}

} // namespace rhombic
