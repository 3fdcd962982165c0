#include "rhombicRenderScan.h"

#include "rhombicLabelSurfaces.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicPictureIO.h"
#include "rhombicScanReport.h"
#include "rhombicSourceLoading.h"
#include "rhombicSurfaceReport.h"
#include "rhombicSurfaceRenderer.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** All surfaces of a selection. */
struct ScanScene
{
  std::vector<SceneSurface> surfaces;
  bool isOriented = true; ///< whether it is known how the scan lies in the patient
  Report report;
};

ScanScene
MakeScene(const ScanSource & source, const SurfaceSelection & selection, const Events & events)
{
  LoadedSource loaded = LoadSource(source, selection, events);
  ScanScene scene;
  scene.report = ReportSource(loaded, source);
  scene.report["surfaces"] = Report::array();
  const Scan * const scan = loaded.FindScan();
  scene.isOriented = scan == nullptr || scan->isOriented;
  loaded.scan.reset(); // frees memory for the surfaces
  if (!loaded.requests.empty())
  {
    const auto extracted = LatticeToSurfaces(loaded.lattice, loaded.requests, selection.mode, events, loaded.grid);
    for (std::size_t n = 0; n < extracted.size(); ++n)
    {
      scene.surfaces.push_back(extracted[n]);
      scene.report["surfaces"].push_back(ReportIsosurface(loaded.requests[n], extracted[n], selection.mode));
    }
  }
  if (loaded.labels)
  {
    for (const LabelSurface & label : LabelsToSurfaces(*loaded.labels, GetLabelSettings(source, selection), events))
    {
      scene.surfaces.push_back(label.scene);
      scene.report["surfaces"].push_back(ReportLabelSurface(label));
    }
  }
  return scene;
}

/** Whether an isosurface is translucent. Labels are not known before they are read; the renderer checks them again. */
bool
IsTranslucent(const std::vector<SurfaceRequest> & requests)
{
  return std::any_of(
    requests.begin(), requests.end(), [](const SurfaceRequest & request) { return request.opacity < 1.0; });
}

/** The picture's path, with the view's name if there are several. */
fs::path
PathOfView(const fs::path & picture, View view, std::size_t views)
{
  return views == 1
           ? picture
           : picture.parent_path() / (picture.stem().string() + "-" + NameOf(view) + picture.extension().string());
}

} // namespace

std::vector<fs::path>
RenderScan(const RenderScanSettings & settings, const Events & events)
{
  std::vector<fs::path> pictures;
  for (const View view : settings.views)
  {
    pictures.push_back(PathOfView(settings.picture, view, settings.views.size()));
  }
  CheckOutputs(WithSidecars(pictures, settings.provenance), settings.source, settings.surfaces);
  CheckPicturePath(settings.picture);
  SurfaceRenderer renderer;
  RenderSettings render = settings.render;
  render.maximumMemory = settings.source.lattice.maximumMemory;
  renderer.CheckSettings(render, IsTranslucent(settings.surfaces.requests));

  const ScanScene scene = MakeScene(settings.source, settings.surfaces, events);
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

} // namespace rhombic
