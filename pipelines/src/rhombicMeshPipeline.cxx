#include "rhombicMeshPipeline.h"

#include "rhombicAuditReport.h"
#include "rhombicFailure.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicMeasureTable.h"
#include "rhombicScanLoading.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceMeasures.h"

#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A surface as it was extracted, before it is finished. */
struct ExtractedSize
{
  double volume; ///< mm^3
  double area;   ///< mm^2
  itk::SizeValueType triangles;
};

/** A surface on its way from the scan to a file. */
struct MeshedSurface
{
  SceneSurface scene;
  std::optional<SurfaceRequest> request; ///< of isosurfaces
  Report report;
  ExtractedSize extracted;
  std::optional<double> labelVolume;          ///< of a label's voxels, in mm^3
  std::optional<IsosurfaceVolume> isosurface; ///< of a whole isosurface
  double volumeOfKeptParts = 0.0;             ///< in mm^3, as extracted
  bool isWhole = true;                        ///< no part of it was removed or filled
};

constexpr char NamePlace[] = "{name}";
constexpr double CubicMillimetresPerMillilitre = 1000.0;
constexpr double NotablePercent = 1.0; ///< smaller differences of volumes are not mentioned

std::ostringstream
MakeText(int decimals)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(decimals);
  return text;
}

bool
HasFileForEach(const fs::path & mesh)
{
  return mesh.filename().string().find(NamePlace) != std::string::npos;
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
    std::string file = mesh.filename().string();
    for (std::size_t place = 0; (place = file.find(NamePlace, place)) != std::string::npos; place += unique.size())
    {
      file.replace(place, sizeof(NamePlace) - 1, unique);
    }
    paths.push_back(mesh.parent_path() / file);
  }
  return paths;
}

ExtractedSize
SizeOf(const itk::TriangleSurface & surface)
{
  return { ComputeVolume(surface), ComputeArea(surface), surface.GetNumberOfTriangles() };
}

/** What the scan's isosurface encloses, where the lattice tells: neither of some of its parts, nor if the lattice holds
 * another field or few samples, nor if the uncertainty is as large as half the volume. */
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
    return {};
  }
  const auto countOf = [](const itk::ImageBase<3> & image) {
    return static_cast<double>(image.GetLargestPossibleRegion().GetNumberOfPixels());
  };
  const double sites = std::visit([&](const auto & image) { return countOf(*image); }, loaded.lattice);
  if (sites < fewestSites * countOf(GeometryOf(loaded.scan->image)))
  {
    return {};
  }
  const auto estimate = EstimateIsosurfaceVolume(loaded.lattice, request, area, loaded.grid.GetPointer());
  return estimate.uncertainty < 0.5 * estimate.volume ? std::optional(estimate) : std::nullopt;
}

/** The surfaces of a source as they were extracted. */
std::vector<MeshedSurface>
Extract(LoadedSource & loaded, const MeshScanSettings & settings, const Events & events)
{
  std::vector<MeshedSurface> surfaces;
  const SurfaceSelection & selection = settings.surfaces;
  if (!loaded.requests.empty())
  {
    const auto extracted = ExtractSurfaces(loaded.lattice, loaded.requests, selection.mode, events, loaded.grid);
    for (std::size_t n = 0; n < extracted.size(); ++n)
    {
      const SurfaceRequest & request = loaded.requests[n];
      const SceneSurface & scene = extracted[n].scene;
      const ExtractedSize size = SizeOf(*scene.surface);
      surfaces.push_back({ scene, request, ReportSurface(request, extracted[n], selection.mode), size, {}, {} });
      surfaces.back().isosurface = EstimateIsosurface(loaded, request, size.area, settings.source.lattice);
    }
  }
  if (loaded.labels)
  {
    if (settings.source.lattice.denoising.kind != Denoising::Kind::None)
    {
      events.Note("labels have no noise: --denoise is not for them");
    }
    const auto labels = LabelsToSurfaces(*loaded.labels, GetLabelSettings(settings.source, selection), events);
    const Report reports = ReportLabelSurfaces(labels);
    for (std::size_t n = 0; n < labels.size(); ++n)
    {
      surfaces.push_back({ labels[n].scene,
                           std::nullopt,
                           reports[n],
                           SizeOf(*labels[n].scene.surface),
                           labels[n].voxelMillilitres * CubicMillimetresPerMillilitre,
                           {} });
    }
  }
  return surfaces;
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

/** Removes parts of a surface, smooths and simplifies it. Returns whether anything is left. */
bool
Finish(MeshedSurface & surface, const SurfaceFinish & finish, double spacing, const Events & events)
{
  const auto finished = itk::TriangleSurface::New();
  finished->Graft(surface.scene.surface);
  surface.scene.surface = finished;
  const PartRemoval removal = RemoveParts(*finished, finish, surface.scene.name, events);
  if (finished->GetNumberOfTriangles() == 0)
  {
    events.Note(surface.scene.name + ": left out, as all its parts are below --min-volume");
    return false;
  }
  surface.isWhole = removal.IsNothing();
  surface.volumeOfKeptParts = surface.extracted.volume - removal.filled.volume - removal.removed.volume;
  if (!surface.isWhole)
  {
    surface.report["parts"] = ReportPartRemoval(removal);
  }
  const Report refined = RefineSurface(*finished, finish, spacing, surface.scene.name, events);
  if (!refined.is_null())
  {
    surface.report.update(refined);
  }
  return true;
}

/** Finishes surfaces, and drops those of which nothing is left. */
void
FinishAll(std::vector<MeshedSurface> & surfaces, const SurfaceFinish & finish, double spacing, const Events & events)
{
  std::vector<MeshedSurface> finished;
  for (MeshedSurface & surface : surfaces)
  {
    if (Finish(surface, finish, spacing, events))
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

double
PercentChange(double before, double after)
{
  return 100.0 * (after - before) / before;
}

/** The voxels that a surface encloses, in mm^3, counted without it; unknown where parts were left out. */
std::optional<double>
CountVoxels(const MeshedSurface & surface, const std::optional<Scan> & scan)
{
  if (!surface.isWhole)
  {
    return {};
  }
  if (surface.request && scan && surface.request->parts == SurfaceRequest::Parts::All)
  {
    return CountVoxelVolume(*scan, *surface.request->isovalue, surface.request->side);
  }
  return surface.labelVolume;
}

/** Volume, area and mean value, in one line. */
std::string
Summarize(const std::string & name, const SurfaceMeasures & measures)
{
  std::ostringstream text = MakeText(1);
  text << name << ": " << measures.volume / CubicMillimetresPerMillilitre << " ml";
  if (measures.isosurface)
  {
    const double error = *measures.GetVolumeError();
    text << ", " << std::abs(error) << (error < 0.0 ? " % less" : " % more") << " than the scan's isosurface encloses ("
         << measures.isosurface->volume / CubicMillimetresPerMillilitre << " +- "
         << measures.isosurface->uncertainty / CubicMillimetresPerMillilitre << " ml)";
  }
  if (measures.voxelVolume)
  {
    text << ", voxels " << *measures.voxelVolume / CubicMillimetresPerMillilitre << " ml";
  }
  text << ", " << measures.area / 100.0 << " cm2, longest diameter " << measures.longestDiameter << " mm";
  if (measures.meanValue)
  {
    text << ", mean value " << *measures.meanValue;
  }
  return text.str();
}

/** Judges surfaces as a file holds them. */
class FileInspection
{
public:
  FileInspection(const MeshScanSettings & settings, const std::optional<Scan> & scan, const Events & events)
    : m_Settings(settings)
    , m_Scan(scan)
    , m_Events(events)
  {}

  /** Measures a surface, and adds to its report. Throws Failure(NotWatertight) for one that has to be watertight and is
   * not. */
  void
  Inspect(const itk::TriangleSurface & read, MeshedSurface & surface) const
  {
    this->Measure(read, surface);
    if (m_Scan && surface.request)
    {
      this->MeasureDeviation(read, surface);
    }
    if (m_Settings.audits || m_Settings.requiresWatertight)
    {
      this->Audit(read, surface);
    }
  }

private:
  void
  Measure(const itk::TriangleSurface & read, MeshedSurface & surface) const
  {
    const std::string & name = surface.scene.name;
    m_Events.Progress("measuring " + name, 0.0);
    SurfaceMeasures measures = m_Scan ? MeasureSurface(read, *m_Scan) : MeasureSurface(read);
    measures.voxelVolume = CountVoxels(surface, m_Scan);
    measures.isosurface = surface.isWhole ? surface.isosurface : std::nullopt;
    m_Events.Note(Summarize(name, measures));
    this->NoteRefinement(surface, measures);
    this->NoteThinParts(surface, measures);
    surface.report["points"] = read.GetNumberOfPoints();
    surface.report["triangles"] = read.GetNumberOfTriangles();
    surface.report["measures"] = ReportMeasures(measures);
    const ExtractedSize & extracted = surface.extracted;
    surface.report["extracted"] = { { "volumeInMillilitres", extracted.volume / CubicMillimetresPerMillilitre },
                                    { "areaInSquareMillimetres", extracted.area },
                                    { "triangles", extracted.triangles },
                                    { "volumeChangeInPercent", PercentChange(extracted.volume, measures.volume) },
                                    { "areaChangeInPercent", PercentChange(extracted.area, measures.area) } };
  }

  /** Advice to use a denser lattice; empty where no option makes it denser, or it would be very large. */
  std::string
  AdviseDensity() const
  {
    constexpr double mostDense = 8.0;
    const LatticeSettings & lattice = m_Settings.source.lattice;
    const bool isSpacingGiven = lattice.spacing != LatticeSettings().spacing;
    if (!m_Scan || lattice.nested || isSpacingGiven || lattice.density > mostDense)
    {
      return "";
    }
    return "; try --density " + std::to_string(std::lround(std::ceil(2.0 * lattice.density)));
  }

  /** Says how smoothing and simplification changed the volume, if they changed it by more than 1 %. */
  void
  NoteRefinement(const MeshedSurface & surface, const SurfaceMeasures & measures) const
  {
    const double change = PercentChange(surface.volumeOfKeptParts, measures.volume);
    if (std::abs(change) > NotablePercent)
    {
      const bool isSmoothed = m_Settings.finish.smoothing > 0.0;
      const bool isSimplified = IsSimplified(m_Settings.finish);
      std::ostringstream note = MakeText(1);
      note << surface.scene.name << ": "
           << (isSmoothed && isSimplified ? "smoothing and simplification"
               : isSmoothed               ? "smoothing"
               : isSimplified             ? "simplification"
                                          : "untangling")
           << " changed the volume by " << std::showpos << change << std::noshowpos << " %, from "
           << surface.volumeOfKeptParts / CubicMillimetresPerMillilitre << " to "
           << measures.volume / CubicMillimetresPerMillilitre << " ml";
      m_Events.Note(note.str());
    }
  }

  /** Says where the volume of an isosurface was off when it was extracted, by more than 1 % beyond the uncertainty. */
  void
  NoteThinParts(const MeshedSurface & surface, const SurfaceMeasures & measures) const
  {
    std::ostringstream note = MakeText(1);
    if (surface.isosurface)
    {
      const double error = 100.0 * surface.isosurface->GetErrorOf(surface.extracted.volume);
      if (std::abs(error) > NotablePercent + 100.0 * surface.isosurface->GetRelativeUncertainty())
      {
        note << surface.scene.name << ": parts are thinner than the lattice's spacing, so the surface encloses "
             << std::abs(error) << (error < 0.0 ? " % less" : " % more") << " than the isosurface"
             << this->AdviseDensity();
        m_Events.Note(note.str());
      }
    }
    else if (surface.request && measures.voxelVolume)
    {
      const double difference = PercentChange(*measures.voxelVolume, measures.volume);
      if (std::abs(difference) > NotablePercent)
      {
        note << surface.scene.name << ": the volume is " << std::abs(difference) << " % "
             << (difference < 0.0 ? "below" : "above") << " that of the scan's voxels on this side of the threshold";
        m_Events.Note(note.str());
      }
    }
  }

  void
  MeasureDeviation(const itk::TriangleSurface & read, MeshedSurface & surface) const
  {
    constexpr std::size_t quick = 250'000;
    constexpr std::size_t thorough = 10'000'000;
    m_Events.Progress("measuring how far " + surface.scene.name + " is from the scan", 0.0);
    const SurfaceDeviation deviation = ComputeDeviation(read,
                                                        *m_Scan,
                                                        m_Settings.source.lattice.kernel,
                                                        *surface.request->isovalue,
                                                        surface.request->side,
                                                        m_Settings.audits ? thorough : quick);
    surface.report["deviation"] = ReportDeviation(deviation);
    std::ostringstream note;
    note.imbue(std::locale::classic());
    note << std::setprecision(2) << surface.scene.name << ": from the scan's isosurface ";
    if (deviation.IsKnown())
    {
      note << deviation.mean << " mm on average, 95 % within " << deviation.percentile95 << " mm, all within "
           << deviation.maximum << " mm";
    }
    else
    {
      note << "at an unknown distance: it has no isosurface near this surface";
    }
    if (deviation.unresolved > 0)
    {
      note << "; around " << deviation.unresolved << " of " << deviation.samples
           << " measured points there is no isosurface within two voxels: small or thin parts may be wrong there"
           << this->AdviseDensity();
    }
    m_Events.Note(note.str());
  }

  void
  Audit(const itk::TriangleSurface & read, MeshedSurface & surface) const
  {
    m_Events.Progress("auditing " + surface.scene.name, 0.0);
    itk::TriangleSurfaceAuditSettings auditSettings;
    auditSettings.testsIntersections = m_Settings.audits;
    const auto audit = AuditSurface(read, auditSettings);
    surface.report["audit"] = ReportAudit(audit);
    for (const std::string & line : DescribeAudit(audit))
    {
      m_Events.Note(surface.scene.name + ": " + line);
    }
    if (m_Settings.requiresWatertight && !audit.IsWatertight())
    {
      throw Failure(FailureKind::NotWatertight,
                    "The surface " + surface.scene.name + " is not watertight (" + DescribeLeaks(audit) +
                      "), so nothing was written; leave out --require-watertight to have it all the same.");
    }
  }

  const MeshScanSettings & m_Settings;
  const std::optional<Scan> & m_Scan;
  const Events & m_Events;
};

/** Writes surfaces that follow each other as one file, with its sidecar. */
void
StageFile(const fs::path & path,
          MeshedSurface * begin,
          std::size_t count,
          const MeshScanSettings & settings,
          const FileInspection & inspection,
          Report report,
          StagedFiles & staged)
{
  std::vector<SceneSurface> scene;
  std::transform(begin, begin + count, std::back_inserter(scene), [](const auto & surface) { return surface.scene; });
  SurfaceFileSettings file;
  file.space = settings.space;
  file.inspect = [&](const std::vector<SceneSurface> & read) {
    for (std::size_t n = 0; n < count; ++n)
    {
      inspection.Inspect(*read[n].surface, begin[n]);
    }
  };
  StageSurfaces(scene, path, staged, file);
  report["surfaces"] = Report::array();
  for (std::size_t n = 0; n < count; ++n)
  {
    report["surfaces"].push_back(begin[n].report);
  }
  StageSidecar(path, settings.provenance, report, staged);
}

/** Throws Failure where files can't be written, or would take the place of each other or of what was read. */
void
CheckFiles(const std::vector<fs::path> & meshes, const MeshScanSettings & settings)
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
  CheckOutputs(outputs, InputsOf(settings.source, settings.surfaces));
}

/** Finds out before the work begins what can be found out. */
void
CheckSettings(const MeshScanSettings & settings)
{
  const bool isForEach = HasFileForEach(settings.mesh);
  const std::size_t least = settings.surfaces.requests.size() + (settings.surfaces.labels ? 1 : 0);
  CheckSurfacePath(settings.mesh, isForEach ? 1 : least);
  CheckSurfaceFinish(settings.finish);
  if (!settings.measures.empty())
  {
    CheckMeasureTablePath(settings.measures);
  }
  CheckFiles(isForEach ? std::vector<fs::path>{} : std::vector<fs::path>{ settings.mesh }, settings);
}

} // namespace

std::vector<fs::path>
MeshScan(const MeshScanSettings & settings, const Events & events)
{
  CheckSettings(settings);
  LoadedSource loaded = LoadSource(settings.source, settings.surfaces, events);
  std::vector<MeshedSurface> surfaces = Extract(loaded, settings, events);
  const double spacing = SpacingOf(loaded);
  loaded.lattice = FCCVolume();
  loaded.labels.reset();
  CheckFiles(PathsOf(settings.mesh, surfaces), settings);
  FinishAll(surfaces, settings.finish, spacing, events);

  const FileInspection inspection(settings, loaded.scan, events);
  const std::vector<fs::path> paths = PathsOf(settings.mesh, surfaces);
  const std::size_t perFile = HasFileForEach(settings.mesh) ? 1 : surfaces.size();
  CheckSurfacePath(paths.front(), perFile);
  StagedFiles staged;
  for (std::size_t n = 0; n < paths.size(); ++n)
  {
    events.Progress("writing", static_cast<double>(n) / static_cast<double>(paths.size()));
    StageFile(paths[n], surfaces.data() + n * perFile, perFile, settings, inspection, loaded.report, staged);
  }
  if (!settings.measures.empty())
  {
    Report table = Report::array();
    for (const MeshedSurface & surface : surfaces)
    {
      table.push_back(surface.report);
    }
    StageMeasureTable(table, settings.measures, staged);
  }
  staged.Commit();
  events.Progress("writing", 1.0);
  return paths;
}

} // namespace rhombic
