#include "rhombicScanPipeline.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicScanWriter.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceRenderer.h"

#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Finds out before the work begins whether an output can be written, and that it is not the input. */
void
CheckOutput(const fs::path & output, const fs::path & input)
{
  std::error_code error;
  if (fs::equivalent(output, input, error))
  {
    throw Failure(FailureKind::Usage, "The output " + output.string() + " is the input itself; give it another name.");
  }
  const AtomicFile probe(output);
}

Scan
LoadScan(const ScanSource & source, const Events & events)
{
  events.Progress("reading", 0.0);
  ScanReadOptions options = source.read;
  options.progress = [&events](double fraction) { events.Progress("reading", fraction); };
  Scan scan = ReadScan(source.path, options);
  const auto & geometry = GeometryOf(scan.image);
  const auto & size = geometry.GetLargestPossibleRegion().GetSize();
  const auto & spacing = geometry.GetSpacing();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << scan.format << (scan.modality.empty() ? "" : " " + scan.modality) << ": " << size[0] << " x " << size[1]
       << " x " << size[2] << " samples, spacing " << spacing[0] << " x " << spacing[1] << " x " << spacing[2]
       << " mm, " << PixelTypeName(scan.image);
  events.Note(text.str());
  for (const auto * const notes : { &scan.notes, &scan.fileNotes })
  {
    for (const std::string & note : *notes)
    {
      events.Note(note);
    }
  }
  return scan;
}

/** A scan's report for outputs: the names of its path and file may be the patient's. */
Report
ReportWithoutNames(const Scan & scan, const fs::path & path)
{
  Report report = ReportScan(scan);
  for (Report & note : report["notes"])
  {
    auto text = note.get<std::string>();
    for (const std::string & name : { path.string(), path.filename().string(), path.stem().string() })
    {
      for (std::size_t at = text.find(name); !name.empty() && at != std::string::npos; at = text.find(name, at + 4))
      {
        text.replace(at, name.size(), "SCAN");
      }
    }
    note = text;
  }
  return report;
}

/** What came out of a source, and what is known about it. */
struct LoadedSurfaces
{
  std::vector<SceneSurface> surfaces;
  bool isOriented = true; ///< whether it is known how they lie in the patient
  Report report;
};

Report
ReportSurfaces(const std::vector<SurfaceRequest> & requests,
               const std::vector<SceneSurface> & surfaces,
               itk::FCCIsosurfaceMode mode)
{
  Report report = Report::array();
  for (std::size_t n = 0; n < requests.size(); ++n)
  {
    std::ostringstream modeName;
    modeName << mode;
    report.push_back({ { "name", requests[n].name },
                       { "isovalue", requests[n].isovalue.value() },
                       { "inside", requests[n].side == SurfaceRequest::Side::Above ? "above" : "below" },
                       { "mode", modeName.str() },
                       { "points", surfaces[n].surface->GetNumberOfPoints() },
                       { "triangles", surfaces[n].surface->GetNumberOfTriangles() } });
  }
  return report;
}

LoadedSurfaces
LoadSurfaces(const ScanSource & source,
             const std::vector<SurfaceRequest> & requests,
             itk::FCCIsosurfaceMode mode,
             const Events & events)
{
  LoadedSurfaces loaded;
  FCCVolume volume;
  std::vector<SurfaceRequest> resolved;
  if (IsFCCImageFile(source.path))
  {
    events.Progress("reading", 0.0);
    volume = ReadFCCImage(source.path);
    resolved = ResolveIsovalues(requests, ComputeIntensities(volume));
  }
  else
  {
    CheckLatticeSettings(source.lattice);
    const Scan scan = LoadScan(source, events); // its memory is needed for the surfaces
    resolved = ResolveIsovalues(requests, ComputeIntensities(scan.image));
    volume = ScanToLattice(scan, source.lattice, events);
    loaded.report["scan"] = ReportWithoutNames(scan, source.path);
    loaded.isOriented = scan.isOriented;
  }
  loaded.surfaces = LatticeToSurfaces(volume, resolved, mode, events);
  loaded.report["lattice"] = ReportLattice(volume);
  loaded.report["surfaces"] = ReportSurfaces(resolved, loaded.surfaces, mode);
  return loaded;
}

fs::path
PathOfView(const fs::path & picture, View view, bool isOnlyOne)
{
  return isOnlyOne
           ? picture
           : picture.parent_path() / (picture.stem().string() + "-" + NameOf(view) + picture.extension().string());
}

} // namespace

std::vector<SurfaceRequest>
ResolveIsovalues(std::vector<SurfaceRequest> requests, const Intensities & intensities)
{
  for (SurfaceRequest & request : requests)
  {
    if (!request.isovalue)
    {
      request.isovalue = intensities.otsu;
    }
    // At the lowest value or below everything is inside, above the highest nothing: in both cases there is no surface.
    if (!(*request.isovalue > intensities.lowest) || !(*request.isovalue <= intensities.highest))
    {
      if (intensities.lowest == intensities.highest)
      {
        throw Failure(FailureKind::Empty,
                      "All values of the scan are the same; check that it was exported completely.");
      }
      std::ostringstream sentence;
      sentence.imbue(std::locale::classic());
      sentence << "The threshold " << *request.isovalue << " of " << request.name
               << " is outside the scan's values, which run from " << intensities.lowest << " to "
               << intensities.highest << "; choose one in between.";
      throw Failure(FailureKind::Empty, sentence.str());
    }
  }
  return requests;
}

std::vector<fs::path>
RenderScan(const RenderScanSettings & settings, const Events & events)
{
  std::vector<fs::path> pictures;
  for (const View view : settings.views)
  {
    pictures.push_back(PathOfView(settings.picture, view, settings.views.size() == 1));
    CheckOutput(pictures.back(), settings.source.path);
  }
  CheckPicturePath(settings.picture);
  SurfaceRenderer renderer;
  renderer.CheckSettings(settings.render);

  const LoadedSurfaces loaded = LoadSurfaces(settings.source, settings.surfaces, settings.mode, events);
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    events.Progress("rendering", static_cast<double>(n) / static_cast<double>(pictures.size()));
    RenderSettings render = settings.render;
    render.view = settings.views[n];
    render.orientationLabels = render.orientationLabels && loaded.isOriented;
    const PictureMetadata metadata{ settings.provenance.software, settings.provenance.command };
    WritePicture(renderer.Render(loaded.surfaces, render), pictures[n], metadata);
    WriteSidecar(pictures[n], settings.provenance, loaded.report);
  }
  events.Progress("rendering", 1.0);
  return pictures;
}

void
MeshScan(const MeshScanSettings & settings, const Events & events)
{
  CheckOutput(settings.mesh, settings.source.path);
  CheckSurfacePath(settings.mesh);
  const LoadedSurfaces loaded = LoadSurfaces(settings.source, { settings.surface }, settings.mode, events);
  events.Progress("writing", 0.0);
  WriteSurfaces(loaded.surfaces, settings.mesh);
  WriteSidecar(settings.mesh, settings.provenance, loaded.report);
  events.Progress("writing", 1.0);
}

void
ResampleScan(const ResampleScanSettings & settings, const Events & events)
{
  CheckOutput(settings.volume, settings.source.path);
  if (IsFCCImageFile(settings.source.path))
  {
    CheckScanPath(settings.volume);
    const FCCVolume volume = ReadFCCImage(settings.source.path);
    const ScanImage image = LatticeToScan(volume, settings.source.lattice.spacing, events);
    events.Progress("writing", 0.0);
    WriteScan(image, settings.volume);
    WriteSidecar(settings.volume, settings.provenance, { { "lattice", ReportLattice(volume) } });
  }
  else
  {
    if (settings.volume.extension() != ".nrrd")
    {
      throw Failure(FailureKind::Usage,
                    "A lattice volume is a NRRD file; give " + settings.volume.string() + " the extension .nrrd.");
    }
    const Scan scan = LoadScan(settings.source, events);
    const FCCVolume volume = ScanToLattice(scan, settings.source.lattice, events);
    events.Progress("writing", 0.0);
    WriteFCCImage(volume, settings.volume);
    WriteSidecar(settings.volume,
                 settings.provenance,
                 { { "scan", ReportWithoutNames(scan, settings.source.path) }, { "lattice", ReportLattice(volume) } });
  }
  events.Progress("writing", 1.0);
}

} // namespace rhombic
