#include "rhombicScanPipeline.h"

#include "rhombicFailure.h"
#include "rhombicLabelSurfaces.h"
#include "rhombicScanLoading.h"
#include "rhombicScanWriter.h"
#include "rhombicSurfaceRenderer.h"

#include <algorithm>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** All surfaces of a selection, and what is known about them. */
struct Scene
{
  std::vector<SceneSurface> surfaces;
  bool isOriented = true;
  Report report;
};

Scene
MakeScene(const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  LoadedSource loaded = LoadSource(source, selection, events);
  loaded.scan.reset(); // its memory is needed for the surfaces
  Scene scene;
  scene.isOriented = loaded.isOriented;
  scene.report = std::move(loaded.report);
  scene.report["surfaces"] = Report::array();
  if (!loaded.requests.empty())
  {
    const auto extracted = ExtractSurfaces(loaded.lattice, loaded.requests, selection.mode, events, loaded.grid);
    for (std::size_t n = 0; n < loaded.requests.size(); ++n)
    {
      scene.surfaces.push_back(extracted[n].scene);
      scene.report["surfaces"].push_back(ReportSurface(loaded.requests[n], extracted[n], selection.mode));
    }
  }
  if (loaded.labels)
  {
    const auto labels = LabelsToSurfaces(*loaded.labels, GetLabelSettings(source, selection), events);
    for (const LabelSurface & label : labels)
    {
      scene.surfaces.push_back(label.scene);
    }
    for (const Report & label : ReportLabelSurfaces(labels))
    {
      scene.report["surfaces"].push_back(label);
    }
  }
  return scene;
}

/** Labels are not known before they are read; the renderer asks again for the whole scene. */
bool
IsTranslucent(const std::vector<SurfaceRequest> & requests)
{
  return std::any_of(
    requests.begin(), requests.end(), [](const SurfaceRequest & request) { return request.opacity < 1.0; });
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
  }
  CheckOutputs(WithSidecars(pictures, settings.provenance), InputsOf(settings.source, settings.surfaces));
  CheckPicturePath(settings.picture);
  SurfaceRenderer renderer;
  RenderSettings render = settings.render;
  render.maximumMemory = settings.source.lattice.maximumMemory;
  renderer.CheckSettings(render, IsTranslucent(settings.surfaces.requests));

  const Scene scene = MakeScene(settings.source, settings.surfaces, events);
  StagedFiles staged;
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    events.Progress("rendering", static_cast<double>(n) / static_cast<double>(pictures.size()));
    render.view = settings.views[n];
    render.orientationLabels = settings.render.orientationLabels && scene.isOriented;
    const PictureMetadata metadata{ settings.provenance.software, settings.provenance.command };
    StagePicture(renderer.Render(scene.surfaces, render), pictures[n], staged, metadata);
    StageSidecar(pictures[n], settings.provenance, scene.report, staged);
  }
  staged.Commit();
  events.Progress("rendering", 1.0);
  return pictures;
}

void
ResampleScan(const ResampleScanSettings & settings, const Events & events)
{
  CheckOutputs(WithSidecars({ settings.volume }, settings.provenance), { settings.source.path });
  StagedFiles staged;
  if (IsFCCImageFile(settings.source.path))
  {
    CheckScanPath(settings.volume);
    const LatticeSettings & lattice = settings.source.lattice;
    const FCCVolume volume =
      DenoiseLattice(ReadFCCImage(settings.source.path), lattice.denoising, lattice.maximumMemory, events);
    const ScanImage image = LatticeToScan(volume, lattice.spacing, events);
    events.Progress("writing", 0.0);
    StageScan(image, settings.volume, staged);
    StageSidecar(settings.volume,
                 settings.provenance,
                 { { "denoising", ReportDenoising(lattice.denoising) }, { "lattice", ReportLattice(volume) } },
                 staged);
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
    StageFCCImage(volume, settings.volume, staged);
    StageSidecar(settings.volume,
                 settings.provenance,
                 { { "scan", ReportWithoutNames(scan, settings.source.path) },
                   { "denoising", ReportDenoising(settings.source.lattice.denoising) },
                   { "lattice", ReportLattice(volume) } },
                 staged);
  }
  staged.Commit();
  events.Progress("writing", 1.0);
}

} // namespace rhombic
