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
  Scan scan = ReadScan(source.path, source.read);
  const auto & geometry = GeometryOf(scan.image);
  const auto & size = geometry.GetLargestPossibleRegion().GetSize();
  const auto & spacing = geometry.GetSpacing();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << scan.format << (scan.modality.empty() ? "" : " " + scan.modality) << ": " << size[0] << " x " << size[1]
       << " x " << size[2] << " samples, spacing " << spacing[0] << " x " << spacing[1] << " x " << spacing[2]
       << " mm, " << PixelTypeName(scan.image);
  events.Note(text.str());
  for (const std::string & note : scan.notes)
  {
    events.Note(note);
  }
  return scan;
}

/** The surfaces of a source, and whether it is known how they lie in the patient. */
struct LoadedSurfaces
{
  std::vector<SceneSurface> surfaces;
  bool isOriented = true;
};

LoadedSurfaces
LoadSurfaces(const ScanSource & source,
             const std::vector<SurfaceRequest> & requests,
             itk::FCCIsosurfaceMode mode,
             const Events & events)
{
  if (IsFCCImageFile(source.path))
  {
    events.Progress("reading", 0.0);
    const FCCVolume volume = ReadFCCImage(source.path);
    return { LatticeToSurfaces(volume, ResolveIsovalues(requests, ComputeIntensities(volume)), mode, events) };
  }
  CheckLatticeSettings(source.lattice);
  Scan scan = LoadScan(source, events);
  const auto resolved = ResolveIsovalues(requests, ComputeIntensities(scan.image));
  const FCCVolume volume = ScanToLattice(scan, source.lattice, events);
  scan.image = {}; // its memory is needed for the surfaces
  return { LatticeToSurfaces(volume, resolved, mode, events), scan.isOriented };
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
    WritePicture(renderer.Render(loaded.surfaces, render), pictures[n], settings.metadata);
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
  WriteSurface(*loaded.surfaces.front().surface, settings.mesh);
  events.Progress("writing", 1.0);
}

void
ResampleScan(const ResampleScanSettings & settings, const Events & events)
{
  CheckOutput(settings.volume, settings.source.path);
  if (IsFCCImageFile(settings.source.path))
  {
    CheckScanPath(settings.volume);
    const ScanImage image = LatticeToScan(ReadFCCImage(settings.source.path), settings.source.lattice.spacing, events);
    events.Progress("writing", 0.0);
    WriteScan(image, settings.volume);
  }
  else
  {
    if (settings.volume.extension() != ".nrrd")
    {
      throw Failure(FailureKind::Usage,
                    "A lattice volume is a NRRD file; give " + settings.volume.string() + " the extension .nrrd.");
    }
    const FCCVolume volume = ScanToLattice(LoadScan(settings.source, events), settings.source.lattice, events);
    events.Progress("writing", 0.0);
    WriteFCCImage(volume, settings.volume);
  }
  events.Progress("writing", 1.0);
}

} // namespace rhombic
