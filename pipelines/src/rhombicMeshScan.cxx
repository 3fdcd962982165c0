#include "rhombicMeshScan.h"

#include "itkMultiThreaderBase.h"
#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicMeasureTable.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSourceSurfaces.h"
#include "rhombicSurfaceReport.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

bool
HasFileForEach(const fs::path & mesh)
{
  return mesh.filename().string().find(NamePlaceholder) != std::string::npos;
}

/** The file's name with the placeholder replaced. */
std::string
InsertName(std::string file, const std::string & name)
{
  std::size_t begin = 0;
  while ((begin = file.find(NamePlaceholder, begin)) != std::string::npos)
  {
    file.replace(begin, sizeof(NamePlaceholder) - 1, name);
    begin += name.size();
  }
  return file;
}

/** The files' paths, all different: a path for each surface, or a path for all. */
std::vector<fs::path>
PathsOf(const fs::path & mesh, const std::vector<MeshedSurface> & surfaces)
{
  if (!HasFileForEach(mesh))
  {
    return { mesh };
  }
  std::set<std::string> taken;
  std::vector<fs::path> paths;
  for (const MeshedSurface & surface : surfaces)
  {
    const std::string name = FileStemOf(surface.scene.name);
    std::string unique = name;
    for (int number = 2; !taken.insert(unique).second; ++number)
    {
      unique = name + '-' + std::to_string(number);
    }
    paths.push_back(mesh.parent_path() / InsertName(mesh.filename().string(), unique));
  }
  return paths;
}

/** All files that are written for surface files. */
std::vector<fs::path>
OutputsOf(const std::vector<fs::path> & meshes, const MeshScanSettings & settings)
{
  std::vector<fs::path> outputs;
  for (const fs::path & mesh : meshes)
  {
    const std::vector<fs::path> files = SurfaceFilesOf(mesh);
    outputs.insert(outputs.end(), files.begin(), files.end());
    if (settings.provenance.writesSidecars)
    {
      outputs.push_back(SidecarOf(mesh));
    }
  }
  if (!settings.measures.empty())
  {
    outputs.push_back(settings.measures);
  }
  return outputs;
}

/** Throws Failure(Usage) for a file that can't hold all surfaces of a source, of which the surfaces are not yet made.
 */
void
CheckNumberOfSurfaces(const LoadedSource & loaded, const MeshScanSettings & settings)
{
  std::size_t fewest = loaded.requests.size();
  if (loaded.labels)
  {
    const auto & labels = loaded.labels->labels;
    const auto shown = std::count_if(labels.begin(), labels.end(), [](const LabelSummary & summary) {
      return summary.label.isVisible && summary.label.opacity > 0.0;
    });
    const bool areAllKept = settings.surfaces.labels->labels.empty() && settings.finish.minimumVolume == 0.0;
    fewest += areAllKept ? static_cast<std::size_t>(shown) : 1;
  }
  CheckSurfacePath(settings.mesh, HasFileForEach(settings.mesh) ? 1 : fewest);
}

/** The data that surface files are inspected with. */
struct FileInspection
{
  const MeshScanSettings & settings;
  const std::optional<Scan> & scan;
  const Events & events;
};

constexpr double NotablePercent = 1.0; // smaller differences of volumes are not mentioned

/** The steps of finishing that may have changed the volume of parts. */
std::string
NameSteps(const SurfaceFinish & finish)
{
  if (!finish.smoothing.IsNothing())
  {
    return finish.Simplifies() ? "smoothing and simplification" : "smoothing";
  }
  return finish.Simplifies() ? "simplification" : "untangling";
}

[[noreturn]] void
RefuseToWrite(const std::string & why)
{
  throw Failure(FailureKind::NotWatertight,
                why + ", so nothing was written; leave out --require-watertight to have it all the same.");
}

/** Sets the surface's sizes, measures, thin parts and deviation. For any thread. */
void
Measure(const FileInspection & inspection, MeshedSurface & surface)
{
  MeasureFinished(inspection.scan ? &*inspection.scan : nullptr, surface);
  surface.measures.isosurface = surface.parts.IsNothing() ? surface.isosurface : std::nullopt;
  if (const double limit = inspection.settings.minimumThickness; limit > 0.0)
  {
    surface.thin = FindThinParts(*surface.scene.surface, itk::TriangleTree(*surface.scene.surface), limit);
  }
  if (inspection.scan && surface.request)
  {
    constexpr std::size_t quick = 50'000; // the mean's standard error is below 0.5 % of the spread
    constexpr std::size_t thorough = 10'000'000;
    surface.deviation = ComputeDeviation(*surface.scene.surface,
                                         *inspection.scan,
                                         inspection.settings.source.lattice.kernel,
                                         surface.request->GetThreshold(),
                                         inspection.settings.audits ? thorough : quick);
  }
}

/** Notes how finishing changed the volume of the kept parts. */
void
NoteFinish(const FileInspection & inspection, const MeshedSurface & surface)
{
  const double before = surface.GetVolumeOfKeptParts();
  const double after = surface.measures.volume;
  const double change = PercentChange(before, after);
  if (std::abs(change) > NotablePercent)
  {
    inspection.events.Note(surface.scene.name + ": " + NameSteps(inspection.settings.finish) +
                           " changed the volume by " + (change > 0.0 ? "+" : "") + FormatFixed(change, 1) +
                           " %, from " + FormatFixed(before / CubicMillimetresPerMl, 1) + " to " +
                           DescribeVolume(after / CubicMillimetresPerMl));
  }
}

/** Advice to use a denser lattice; empty where no option makes it denser, or it would be very large. */
std::string
AdviseDensity(const FileInspection & inspection)
{
  constexpr double mostDense = 8.0;
  const LatticeSettings & lattice = inspection.settings.source.lattice;
  const bool isSpacingGiven = lattice.spacing != LatticeSettings().spacing;
  if (!inspection.scan || lattice.nested || isSpacingGiven || lattice.density > mostDense)
  {
    return "";
  }
  return "; try --density " + std::to_string(std::lround(std::ceil(2.0 * lattice.density)));
}

/** Notes by how much the surface's volume was off after extraction, if by more than the uncertainty. */
void
NoteThinParts(const FileInspection & inspection, const MeshedSurface & surface)
{
  if (surface.isosurface)
  {
    const double error = 100.0 * surface.isosurface->GetErrorOf(surface.extracted->volume);
    if (std::abs(error) > NotablePercent + 100.0 * surface.isosurface->GetRelativeUncertainty())
    {
      inspection.events.Note(surface.scene.name +
                             ": parts are thinner than the lattice's spacing, so the surface encloses " +
                             DescribeDifference(error) + " than the isosurface" + AdviseDensity(inspection));
    }
  }
  else if (surface.request && surface.measures.voxelVolume)
  {
    const double difference = PercentChange(*surface.measures.voxelVolume, surface.measures.volume);
    if (std::abs(difference) > NotablePercent)
    {
      inspection.events.Note(surface.scene.name + ": the volume is " + FormatFixed(std::abs(difference), 1) + " % " +
                             (difference < 0.0 ? "below" : "above") +
                             " that of the scan's voxels on this side of the threshold");
    }
  }
}

/** Notes where the surface's walls are thinner than asked for. */
void
NoteThinWalls(const FileInspection & inspection, const MeshedSurface & surface)
{
  const itk::ThinParts & thin = *surface.thin;
  const std::string limit = FormatNumber(thin.limit) + " mm";
  if (thin.parts.empty())
  {
    inspection.events.Note(surface.scene.name + ": no part is thinner than " + limit);
    return;
  }
  const itk::ThinPart & largest = thin.parts.front();
  const auto & at = largest.thinnestAt;
  inspection.events.Note("warning: " + surface.scene.name + ": " + FormatFixed(thin.area, 1) + " mm2 (" +
                         FormatFixed(100.0 * thin.area / thin.areaOfSurface, 1) +
                         " % of the surface) are thinner than " + limit + ", in " + Count(thin.parts.size(), "part") +
                         "; the largest, " + FormatFixed(largest.area, 1) + " mm2, is " +
                         FormatFixed(largest.thinnest, 2) + " mm thin at LPS " + FormatFixed(at[0], 1) + ", " +
                         FormatFixed(at[1], 1) + ", " + FormatFixed(at[2], 1) + " mm");
}

/** Notes the distance from the scan's isosurface, and the share of points that have none near. */
void
NoteDeviation(const FileInspection & inspection, const MeshedSurface & surface)
{
  using Parts = SurfaceRequest::Parts;
  const SurfaceDeviation & deviation = *surface.deviation;
  std::string note = surface.scene.name + ": from the scan's isosurface ";
  note += deviation.IsKnown() ? FormatNumber(deviation.mean, 2) + " mm on average, 95 % within " +
                                  FormatNumber(deviation.percentile95, 2) + " mm, all within " +
                                  FormatNumber(deviation.maximum, 2) + " mm"
                              : "at an unknown distance: it has no isosurface near this surface";
  const double percent = 100.0 * static_cast<double>(deviation.unresolved) /
                         static_cast<double>(std::max<std::size_t>(1, deviation.samples));
  if (percent > NotablePercent)
  {
    const Parts parts = surface.request->parts;
    note += "; " + FormatFixed(percent, 1) + " % of the measured points have no isosurface within two voxels" +
            (parts == Parts::Outermost  ? " (an outline also runs across filled hollows)"
             : parts == Parts::Enclosed ? " (the surface also runs where air around the body was cut off)"
                                        : "");
  }
  inspection.events.Note(note);
}

itk::TriangleSurfaceAuditSettings
AuditSettingsOf(const FileInspection & inspection)
{
  itk::TriangleSurfaceAuditSettings settings;
  settings.testsIntersections = inspection.settings.audits;
  return settings;
}

/** Sets and notes the audit of a surface.
 * \param stored the surface as the file holds it */
void
Audit(const FileInspection & inspection, const itk::TriangleSurface & stored, MeshedSurface & surface)
{
  const std::string & name = surface.scene.name;
  inspection.events.Progress("auditing " + name, 0.0);
  surface.audit = AuditTriangleSurface(stored, AuditSettingsOf(inspection));
  for (const std::string & line : DescribeAudit(*surface.audit))
  {
    inspection.events.Note(name + ": " + line);
  }
  if (inspection.settings.requiresWatertight && !surface.audit->IsWatertight())
  {
    RefuseToWrite("The surface " + name + " is not watertight (" + DescribeLeaks(*surface.audit) + ")");
  }
}

/** Writes \a count surfaces from \a begin on as one file with its sidecar, and sets their measures, deviation and
 * audit. Throws Failure, NotWatertight for a surface that has to be watertight and is not. \param sourceReport the
 * sidecar's part about the source */
void
StageInspected(const FileInspection & inspection,
               const std::filesystem::path & path,
               MeshedSurface * begin,
               std::size_t count,
               const Report & sourceReport,
               OutputFiles & outputs)
{
  std::vector<SceneSurface> scene;
  std::transform(begin, begin + count, std::back_inserter(scene), [](const auto & surface) { return surface.scene; });
  SurfaceFileSettings file;
  file.space = inspection.settings.space;
  ForEachOnThreads(2, [&](std::size_t task) {
    if (task == 0)
    {
      StageSurfaces(scene, path, outputs.staged, file);
    }
    else
    {
      std::for_each(begin, begin + count, [&](MeshedSurface & surface) { Measure(inspection, surface); });
    }
  });
  Report report = sourceReport;
  report["surfaces"] = Report::array();
  for (std::size_t n = 0; n < count; ++n)
  {
    inspection.events.Note(SummarizeMeasures(begin[n]));
    NoteFinish(inspection, begin[n]);
    NoteThinParts(inspection, begin[n]);
    if (begin[n].thin)
    {
      NoteThinWalls(inspection, begin[n]);
    }
    if (begin[n].deviation)
    {
      NoteDeviation(inspection, begin[n]);
    }
    if (inspection.settings.audits || inspection.settings.requiresWatertight)
    {
      Audit(inspection, *SurfaceAsStored(*scene[n].surface, path), begin[n]);
    }
    report["surfaces"].push_back(ReportMeshedSurface(begin[n]));
  }
  AddOutput(path, "mesh", report, outputs);
}

/** Sets the colours of all surfaces; returns their report. */
Report
ColourMeshes(const ColourBy & by,
             const std::string & frameOfReference,
             std::vector<MeshedSurface> & surfaces,
             const Events & events)
{
  std::vector<SceneSurface> scene;
  std::transform(
    surfaces.begin(), surfaces.end(), std::back_inserter(scene), [](const auto & surface) { return surface.scene; });
  const SurfaceColours colours = ColourSurfaces(by, frameOfReference, scene, events);
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    surfaces[n].scene = std::move(scene[n]);
  }
  return colours.report;
}

/** Notes the audit of the walls that labels share, and returns its report; nothing if they share none. Throws
 * Failure(NotWatertight) as StageInspected() does. */
std::optional<Report>
AuditTogether(const FileInspection & inspection, const std::vector<MeshedSurface> & surfaces)
{
  std::map<std::size_t, std::vector<SceneSurface>> layers; // whose labels do not overlap
  for (const MeshedSurface & surface : surfaces)
  {
    if (surface.label)
    {
      layers[surface.label->layer].push_back(surface.scene);
    }
  }
  inspection.events.Progress("auditing walls", 0.0);
  WallAudit audit;
  for (const auto & [layer, scene] : layers)
  {
    audit.Add(AuditWalls(scene, AuditSettingsOf(inspection)));
  }
  if (audit.sharedTriangles == 0)
  {
    return std::nullopt;
  }
  inspection.events.Note((layers.size() > 1 ? "all surfaces together, in " + std::to_string(layers.size()) + " layers: "
                                            : "all surfaces together: ") +
                         DescribeWalls(audit));
  if (inspection.settings.requiresWatertight && !audit.IsClosed())
  {
    RefuseToWrite("The walls that surfaces share have flaws (" + DescribeWalls(audit) + ")");
  }
  return ReportWalls(audit);
}

/** How to have at most \a share of a mesh's triangles. */
std::string
AdviseCoarser(const LatticeSettings & lattice, double share)
{
  const double density = 0.95 * lattice.density * std::pow(share, 1.5); // triangles follow the distances of sites
  const std::string coarser = lattice.nested ? ""
                              : lattice.spacing != LatticeSettings().spacing
                                ? "a coarser lattice with a larger --spacing, "
                              : density >= 0.001 ? "a coarser lattice with --density " + FormatNumber(density, 2) + ", "
                                                 : "";
  return "use " + coarser + "another threshold or a part of the scan";
}

} // namespace

std::vector<fs::path>
CheckMeshScan(const MeshScanSettings & settings)
{
  const bool showsAll = settings.surfaces.rules.only.empty() && settings.surfaces.rules.hidden.empty();
  const std::size_t fewest = showsAll ? settings.surfaces.requests.size() + (settings.surfaces.labels ? 1 : 0) : 1;
  CheckSurfacePath(settings.mesh, HasFileForEach(settings.mesh) ? 1 : fewest);
  if (settings.colourBy)
  {
    CheckPointColours(settings.mesh);
  }
  CheckSurfaceFinish(settings.finish);
  CheckSelection(settings.surfaces);
  if (!settings.measures.empty())
  {
    CheckMeasureTablePath(settings.measures);
  }
  return OutputsOf({ settings.mesh }, settings);
}

SurfaceWork
WorkOf(const MeshScanSettings & settings)
{
  const bool audits = settings.audits || settings.requiresWatertight;
  return { settings.source, settings.surfaces, settings.finish, settings.colourBy, audits };
}

void
CheckMesh(MeshEstimate & mesh, const MeshScanSettings & settings)
{
  const LatticeSettings & lattice = settings.source.lattice;
  const bool isDenoised = lattice.denoising.kind != Denoising::Kind::None;
  const std::uintmax_t allowed = AllowedBytes(settings.source);
  FitIntoMemory(mesh, WorkOf(settings));
  if (isDenoised)
  {
    return;
  }
  if (mesh.bytes.afterwards > allowed)
  {
    const double share = static_cast<double>(allowed) / static_cast<double>(mesh.bytes.afterwards);
    RequireMemory(mesh.bytes.afterwards,
                  lattice.maximumMemory > 0 ? lattice.maximumMemory : allowed,
                  "Making surfaces of " + DescribeTriangles(mesh.triangles),
                  AdviseCoarser(lattice, share));
  }
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  constexpr double bytesOfGLB = 24.0; // of a triangle with its share of the points
  const auto files = HasFileForEach(settings.mesh) ? static_cast<double>(settings.surfaces.requests.size()) : 1.0;
  const bool isSimplified = settings.finish.Simplifies();
  const bool isLimitedByGLB = !isSimplified && LowerCase(settings.mesh.extension().string()) == ".glb";
  // Closed surfaces have half as many points as triangles.
  const double fitting = files * most * (isSimplified ? 2.0 : isLimitedByGLB ? 1.0 / bytesOfGLB : 1.0);
  if (mesh.triangles >= fitting)
  {
    throw Failure(FailureKind::Memory,
                  "The surfaces would have " + DescribeTriangles(mesh.triangles) + ", and 32-bit numbers" +
                    (isLimitedByGLB ? " of lengths in GLB files" : " of points and triangles") + " reach for " +
                    DescribeTriangles(fitting) + "; " + (isSimplified ? "" : "simplify them with --max-triangles, ") +
                    (isLimitedByGLB ? "write a .ply or .vtp file, or "
                     : isSimplified ? ""
                                    : "or ") +
                    AdviseCoarser(lattice, fitting / mesh.triangles) + ".");
  }
}

std::vector<MadeFile>
MeshScan(const MeshScanSettings & settings, const Events & events, std::optional<SourceVolume> volume)
{
  CheckOutputs(CheckMeshScan(settings), settings.source, settings.surfaces, InputsOf(settings.colourBy));
  ScanSource source = settings.source;
  source.streams = true;
  SurfacesInFiles inFiles;
  source.checkMesh = [&](MeshEstimate & mesh) {
    CheckMesh(mesh, settings);
    inFiles.Put(mesh, settings.source, events);
  };
  LoadedSource loaded = LoadSource(source, settings.surfaces, std::move(volume), events);
  CheckNumberOfSurfaces(loaded, settings);
  // The hash of the files is made beside the surfaces, or behind them where no thread may or can be started.
  const bool hasThreads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads() > 1;
  const auto policy = hasThreads ? std::launch::async | std::launch::deferred : std::launch::deferred;
  std::future<Report> input = std::async(policy, ReportInput, std::cref(loaded), std::cref(settings.source));
  SurfaceMaking making{ settings.source, settings.surfaces, settings.finish, SurfaceUse::Files, events };
  making.checkLabels = [&](LabelWork work) {
    if (FitIntoMemory(work, WorkOf(settings)))
    {
      inFiles.Put(work, settings.source, events);
    }
  };
  std::vector<MeshedSurface> surfaces = ExtractSource(making, loaded, StoresNormals(settings.mesh));
  const std::string frame =
    loaded.FindScan() != nullptr ? ReadDicomExamination(*loaded.FindScan()).frameOfReference : "";
  Report sourceReport = ReportSource(loaded, settings.source, input.get());
  loaded.DropVolumes();
  std::vector<std::string> names;
  std::transform(surfaces.begin(), surfaces.end(), std::back_inserter(names), [](const auto & surface) {
    return surface.scene.name;
  });
  for (const std::string & sentence : FindUnusedRules(settings.surfaces.rules.rules, names))
  {
    events.Note("warning: " + sentence);
  }
  CheckOutputs(OutputsOf(PathsOf(settings.mesh, surfaces), settings),
               settings.source,
               settings.surfaces,
               InputsOf(settings.colourBy));
  FinishSurfaces(making, surfaces);
  if (settings.colourBy)
  {
    const ColourBy by = inFiles.IsUsed() ? WithinMemory(*settings.colourBy, settings.source) : *settings.colourBy;
    sourceReport["colours"] = ColourMeshes(by, frame, surfaces, events);
  }

  const FileInspection inspection{ settings, loaded.scan, events };
  const std::vector<fs::path> paths = PathsOf(settings.mesh, surfaces);
  const std::size_t perFile = HasFileForEach(settings.mesh) ? 1 : surfaces.size();
  CheckSurfacePath(paths.front(), perFile);
  if ((settings.audits || settings.requiresWatertight) && surfaces.back().label)
  {
    if (const auto walls = AuditTogether(inspection, surfaces))
    {
      sourceReport["walls"] = *walls;
    }
  }
  OutputFiles outputs{ settings.provenance };
  for (std::size_t n = 0; n < paths.size(); ++n)
  {
    events.Progress("writing and measuring", static_cast<double>(n) / static_cast<double>(paths.size()));
    StageInspected(inspection, paths[n], surfaces.data() + n * perFile, perFile, sourceReport, outputs);
    const std::vector<fs::path> files = SurfaceFilesOf(paths[n]);
    AddOutputs({ files.begin() + 1, files.end() }, "mesh", outputs.made, false);
  }
  if (!settings.measures.empty())
  {
    StageMeasureTable(surfaces, settings.measures, outputs.staged);
    AddOutputs({ settings.measures }, "table", outputs.made, false);
  }
  outputs.staged.Commit();
  events.Progress("writing and measuring", 1.0);
  return outputs.made;
}

} // namespace rhombic
