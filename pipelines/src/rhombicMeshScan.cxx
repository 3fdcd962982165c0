#include "rhombicMeshScan.h"

#include "rhombicFailure.h"
#include "rhombicFileInspection.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicMeasureTable.h"
#include "rhombicSourceLoading.h"
#include "rhombicSurfaceReport.h"

#include "itkFCCScanBorder.h"
#include "rhombicForEachBlock.h"
#include "itkTriangleSurfaceIntersections.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

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

/** The files' paths, one for each surface or one for all; no two are the same. */
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

/** The volume inside the scan's isosurface, estimated from the lattice. Nothing if only some parts of it are kept, if
 * the lattice samples another field than the scan or has few sites, or if the uncertainty is half the volume or more.
 */
std::optional<IsosurfaceVolume>
EstimateIsosurface(const LoadedSource & loaded,
                   const SurfaceRequest & request,
                   double area,
                   const LatticeSettings & settings)
{
  constexpr double fewestSites = 0.7; // per sample of the scan
  const bool isFieldOfScan = loaded.scan && !settings.nested && settings.denoising.kind == Denoising::Kind::None;
  if (!isFieldOfScan || request.parts != SurfaceRequest::Parts::All)
  {
    return std::nullopt;
  }
  const auto countOf = [](const itk::ImageBase<3> & image) {
    return static_cast<double>(image.GetLargestPossibleRegion().GetNumberOfPixels());
  };
  const double sites = std::visit([&](const auto & image) { return countOf(*image); }, loaded.lattice);
  if (sites < fewestSites * countOf(GeometryOf(loaded.scan->image)))
  {
    return std::nullopt;
  }
  const auto estimate =
    EstimateIsosurfaceVolume(loaded.lattice, request.GetThreshold(), area, loaded.grid.GetPointer());
  return estimate.uncertainty < 0.5 * estimate.volume ? std::optional(estimate) : std::nullopt;
}

void
AddIsosurfaces(const LoadedSource & loaded,
               const MeshScanSettings & settings,
               const Events & events,
               std::vector<MeshedSurface> & surfaces)
{
  const auto extracted = LatticeToSurfaces(
    loaded.lattice, loaded.requests, settings.surfaces.mode, events, loaded.grid, StoresNormals(settings.mesh));
  for (std::size_t n = 0; n < extracted.size(); ++n)
  {
    MeshedSurface & surface = surfaces.emplace_back();
    surface.scene = extracted[n];
    surface.request = loaded.requests[n];
    surface.mode = settings.surfaces.mode;
    surface.enclosed = extracted[n].enclosed;
    surface.extracted = MeasureExtracted(*surface.scene.surface);
    surface.isosurface = EstimateIsosurface(loaded, *surface.request, surface.extracted->area, settings.source.lattice);
  }
}

/** Adds labels whose walls are finished once for both sides. */
void
AddLabels(const LoadedSource & loaded,
          const MeshScanSettings & settings,
          const Events & events,
          std::vector<MeshedSurface> & surfaces)
{
  if (settings.source.lattice.denoising.kind != Denoising::Kind::None)
  {
    events.Note("labels have no noise: --denoise is not for them");
  }
  LabelMesh mesh = LabelsToWalls(*loaded.labels, GetLabelSettings(settings.source, settings.surfaces), events);
  ExtractSurfaces(mesh);
  std::vector<ExtractedSize> extracted;
  for (const LabelSurface & label : mesh.labels)
  {
    extracted.push_back(MeasureExtracted(*label.scene.surface));
  }
  const double spacing = MeanSpacingOf(GeometryOf(loaded.labels->scan.image));
  const std::vector<Refinement> refinements = RefineWalls(mesh, settings.finish, spacing, events);
  if (refinements.front().smoothing || refinements.front().simplification)
  {
    ExtractSurfaces(mesh);
  }
  for (std::size_t n = 0; n < mesh.labels.size(); ++n)
  {
    MeshedSurface & surface = surfaces.emplace_back();
    surface.scene = std::exchange(mesh.labels[n].scene, {});
    surface.label = std::move(mesh.labels[n]);
    surface.extracted = extracted[n];
    surface.refinement = refinements[surface.label->layer];
  }
}

/** The spacing that surfaces were sampled with, in mm. */
double
SpacingOf(const LoadedSource & loaded)
{
  if (!loaded.requests.empty())
  {
    return std::visit([](const auto & image) { return MeanSpacingOf(*image); }, loaded.lattice);
  }
  return MeanSpacingOf(GeometryOf(loaded.labels->scan.image));
}

/** Finds which triangles of an isosurface may cross; nothing if all may. */
using CandidateSearch = std::function<std::optional<itk::CrossingCandidates>(const itk::TriangleSurface &)>;

/** In modes Tetrahedra and Fine points lie on the edges of tetrahedra, but for those near the walls, which were moved.
 */
CandidateSearch
MakeCandidateSearch(const LoadedSource & loaded, itk::FCCIsosurfaceMode mode)
{
  using Mode = itk::FCCIsosurfaceMode;
  if (loaded.requests.empty() || (mode != Mode::Tetrahedra && mode != Mode::Fine))
  {
    return [](const itk::TriangleSurface &) { return std::nullopt; };
  }
  const auto spacing = std::visit([](const auto & image) { return image->GetSpacing(); }, loaded.lattice);
  const double smallest = *std::min_element(spacing.Begin(), spacing.End());
  const double largest = *std::max_element(spacing.Begin(), spacing.End());
  return [smallest, largest, grid = loaded.grid](const itk::TriangleSurface & surface) {
    constexpr double widthOfTetrahedron = 2.0; // spacings
    itk::CrossingCandidates candidates;
    candidates.longestEdge = itk::FindLongestRoundedEdge(surface, smallest, largest);
    if (grid)
    {
      candidates.triangles = itk::FindTrianglesNearFCCWalls(surface, *grid, 1.5 * widthOfTetrahedron * largest);
    }
    return std::optional(candidates);
  };
}

/** Removes parts of a surface; smooths and simplifies isosurfaces. Returns whether anything is left.
 */
bool
Finish(MeshedSurface & surface,
       const SurfaceFinish & commandFinish,
       double spacing,
       const CandidateSearch & findCandidates,
       const Events & events)
{
  const SurfaceFinish finish = surface.request ? CombineFinish(surface.request->finish, commandFinish) : commandFinish;
  const auto finished = itk::TriangleSurface::New();
  finished->Graft(surface.scene.surface);
  surface.scene.surface = finished;
  finished->GetTriangles().shrink_to_fit(); // extraction may leave room for more
  surface.parts = RemoveParts(*finished, finish, surface.scene.name, events);
  if (finished->GetNumberOfTriangles() == 0)
  {
    events.Note(surface.scene.name + ": left out, as all its parts are below --min-volume");
    return false;
  }
  if (surface.request)
  {
    const auto candidates = findCandidates(*finished);
    surface.refinement = RefineSurface(*finished, finish, spacing, surface.scene.name, events, candidates);
  }
  return true;
}

/** Finishes surfaces, and drops those of which nothing is left. */
void
FinishAll(std::vector<MeshedSurface> & surfaces,
          const SurfaceFinish & finish,
          double spacing,
          const CandidateSearch & findCandidates,
          const Events & events)
{
  std::vector<MeshedSurface> finished;
  for (MeshedSurface & surface : surfaces)
  {
    if (Finish(surface, finish, spacing, findCandidates, events))
    {
      finished.push_back(std::move(surface));
    }
  }
  surfaces.swap(finished);
  if (surfaces.empty())
  {
    throw Failure(FailureKind::Empty, "Nothing is left: all parts are below --min-volume; lower it.");
  }
}

/** Drops the lattice and the labels. What extraction freed goes back to the system, so that it does not add to the
 * memory of the steps behind. */
void
DropVolumes(LoadedSource & loaded)
{
  loaded.lattice = FCCVolume();
  loaded.labels.reset();
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/** \class FileStaging
 * \brief Writes surfaces as files, with their sidecars. */
class FileStaging
{
public:
  FileStaging(const MeshScanSettings & settings, const FileInspection & inspection, const Report & sourceReport)
    : m_Settings(settings)
    , m_Inspection(inspection)
    , m_SourceReport(sourceReport)
  {}

  /** Writes \a count surfaces from \a begin on as one file, to appear with all others of \a staged, and meanwhile
   * measures them. */
  void
  Stage(const fs::path & path, MeshedSurface * begin, std::size_t count, StagedFiles & staged) const
  {
    std::vector<SceneSurface> scene;
    std::transform(begin, begin + count, std::back_inserter(scene), [](const auto & surface) { return surface.scene; });
    SurfaceFileSettings file;
    file.space = m_Settings.space;
    ForEachOnThreads(2, [&](std::size_t task) {
      if (task == 0)
      {
        StageSurfaces(scene, path, staged, file);
      }
      else
      {
        std::for_each(begin, begin + count, [this](MeshedSurface & surface) { m_Inspection.Measure(surface); });
      }
    });
    for (std::size_t n = 0; n < count; ++n)
    {
      m_Inspection.NoteResults(begin[n]);
      if (m_Inspection.NeedsAudit())
      {
        m_Inspection.Audit(*SurfaceAsStored(*scene[n].surface, path), begin[n]);
      }
    }
    Report report = m_SourceReport;
    report["surfaces"] = Report::array();
    for (std::size_t n = 0; n < count; ++n)
    {
      report["surfaces"].push_back(ReportMeshedSurface(begin[n]));
    }
    StageSidecar(path, m_Settings.provenance, report, staged);
  }

private:
  const MeshScanSettings & m_Settings;
  const FileInspection & m_Inspection;
  const Report & m_SourceReport;
};

} // namespace

std::vector<fs::path>
CheckMeshScan(const MeshScanSettings & settings)
{
  const bool showsAll = settings.surfaces.rules.only.empty() && settings.surfaces.rules.hidden.empty();
  const std::size_t fewest = showsAll ? settings.surfaces.requests.size() + (settings.surfaces.labels ? 1 : 0) : 1;
  CheckSurfacePath(settings.mesh, HasFileForEach(settings.mesh) ? 1 : fewest);
  CheckSurfaceFinish(settings.finish);
  CheckSelection(settings.surfaces);
  if (!settings.measures.empty())
  {
    CheckMeasureTablePath(settings.measures);
  }
  return OutputsOf({ settings.mesh }, settings);
}

std::vector<fs::path>
MeshScan(const MeshScanSettings & settings, const Events & events)
{
  CheckOutputs(CheckMeshScan(settings), settings.source, settings.surfaces);
  LoadedSource loaded = LoadSource(settings.source, settings.surfaces, events);
  CheckNumberOfSurfaces(loaded, settings);
  Report sourceReport = ReportSource(loaded, settings.source);
  std::vector<MeshedSurface> surfaces;
  if (!loaded.requests.empty())
  {
    AddIsosurfaces(loaded, settings, events, surfaces);
  }
  if (loaded.labels)
  {
    AddLabels(loaded, settings, events, surfaces);
  }
  const double spacing = SpacingOf(loaded);
  const auto findCandidates = MakeCandidateSearch(loaded, settings.surfaces.mode);
  DropVolumes(loaded);
  CheckOutputs(OutputsOf(PathsOf(settings.mesh, surfaces), settings), settings.source, settings.surfaces);
  FinishAll(surfaces, settings.finish, spacing, findCandidates, events);

  const FileInspection inspection(settings, loaded.scan, events);
  const FileStaging staging(settings, inspection, sourceReport);
  const std::vector<fs::path> paths = PathsOf(settings.mesh, surfaces);
  const std::size_t perFile = HasFileForEach(settings.mesh) ? 1 : surfaces.size();
  CheckSurfacePath(paths.front(), perFile);
  if (inspection.NeedsAudit() && surfaces.back().label)
  {
    if (const auto walls = inspection.AuditTogether(surfaces))
    {
      sourceReport["walls"] = *walls;
    }
  }
  StagedFiles staged;
  for (std::size_t n = 0; n < paths.size(); ++n)
  {
    events.Progress("writing and measuring", static_cast<double>(n) / static_cast<double>(paths.size()));
    staging.Stage(paths[n], surfaces.data() + n * perFile, perFile, staged);
  }
  if (!settings.measures.empty())
  {
    StageMeasureTable(surfaces, settings.measures, staged);
  }
  staged.Commit();
  events.Progress("writing and measuring", 1.0);
  return paths;
}

} // namespace rhombic
