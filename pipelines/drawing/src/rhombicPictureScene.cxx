#include "rhombicPictureSteps.h"

#include "rhombicScanReader.h"
#include "rhombicSlicePart.h"
#include "rhombicFailure.h"
#include "rhombicFewerTriangles.h"
#include "rhombicForEachBlock.h"
#include "rhombicGreyWindow.h"
#include "rhombicLabelTable.h"
#include "rhombicMeasureTable.h"
#include "rhombicMemoryBudget.h"
#include "rhombicMemoryPlan.h"
#include "rhombicSourceSurfaces.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceReport.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceShading.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace rhombic
{
namespace
{

/** "512 x 512 x 138 voxels of 0.7 x 0.7 x 2 mm", with the words between size and spacing. */
std::string
DescribeGrid(const itk::ImageBase<3> & image, const std::string & words)
{
  return FormatProduct(image.GetLargestPossibleRegion().GetSize()) + words + DescribeSpacing(image.GetSpacing(), 4);
}

/** A part of the body as DICOM has it, in words: "chest", "head and neck". */
std::string
WordsOfBodyPart(const std::string & term)
{
  static const std::map<std::string, std::string> words{ { "ABDOMENPELVIS", "abdomen and pelvis" },
                                                         { "CHESTABDOMEN", "chest and abdomen" },
                                                         { "CHESTABDPELVIS", "chest, abdomen and pelvis" },
                                                         { "CSPINE", "cervical spine" },
                                                         { "HEADNECK", "head and neck" },
                                                         { "LSPINE", "lumbar spine" },
                                                         { "NECKCHEST", "neck and chest" },
                                                         { "TSPINE", "thoracic spine" },
                                                         { "WHOLEBODY", "whole body" } };
  const auto found = words.find(term);
  return found != words.end() ? found->second : LowerCase(term);
}

/** What a title says of a scan: its modality, CT also of values that are taken for HU, and the part of the body if
 * DICOM names one. */
std::string
DescribeExamination(const Scan & scan, bool isLabelMap)
{
  const std::string known = scan.modality.empty() && !isLabelMap && IsInHounsfieldUnits(scan) ? "CT" : scan.modality;
  const std::string modality = isLabelMap ? "Segmentation" : known.empty() ? "Scan" : known == "PT" ? "PET" : known;
  const std::string part = WordsOfBodyPart(ReadDicomExamination(scan).bodyPart);
  return modality + (part.empty() ? "" : " " + part);
}

/** Measures finished surfaces, or the voxels of labels near a part of their map. */
void
MeasureSurfaces(std::vector<MeshedSurface> & surfaces, const std::optional<Scan> & scan)
{
  ForEachOnThreads(surfaces.size(), [&](std::size_t n) {
    MeshedSurface & surface = surfaces[n];
    if (surface.label && surface.label->isPart)
    {
      surface.measures.volume = surface.label->voxelMillilitres * CubicMillimetresPerMl;
    }
    else
    {
      MeasureFinished(scan ? &*scan : nullptr, surface);
    }
  });
}

void
AddSurface(const MeshedSurface & surface, PictureScene & scene)
{
  const SurfaceMeasures & measures = surface.measures;
  scene.surfaces.push_back(surface.scene);
  scene.isForViews = scene.isForViews || surface.whole;
  if (surface.forDrawing && surface.parts.IsNothing())
  {
    scene.surfaces.back().surface = surface.forDrawing;
  }
  std::string name = surface.scene.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  scene.rows.push_back({ name,
                         surface.scene.colour,
                         measures.volume / CubicMillimetresPerMl,
                         measures.area / 100.0,
                         measures.meanValue,
                         FindAnatomicalGroup(name) });
  scene.report["surfaces"].push_back(ReportMeshedSurface(surface));
}

/** Lines about the scan and the lattice, for a page. */
void
AddFacts(const LoadedSource & loaded, const PictureSource & source, PictureScene & scene)
{
  if (const Scan * const scan = loaded.FindScan())
  {
    const auto & grid = GeometryOf(scan->image);
    scene.facts.push_back("scan: " + scan->format + (scan->modality.empty() ? "" : " " + scan->modality) + ", " +
                          DescribeGrid(grid, " voxels of ") + ", axes " + OrientationLetters(grid.GetDirection()));
    for (const Report & note : scene.report["scan"]["notes"]) // without the scan's name
    {
      scene.facts.push_back("note: " + note.get<std::string>());
    }
  }
  for (const std::string & warning : loaded.warnings)
  {
    scene.facts.push_back("warning: " + warning);
  }
  if (!loaded.requests.empty())
  {
    std::visit(
      [&scene](const auto & image) {
        scene.facts.push_back("lattice: face-centered cubic, " + DescribeGrid(*image, " sites, spacing "));
      },
      loaded.lattice);
    if (source.scan.lattice.denoising.kind == Denoising::Kind::Gaussian)
    {
      scene.facts.push_back("smoothed: Gaussian of " + FormatNumber(source.scan.lattice.denoising.sigma) + " mm");
    }
  }
}

/** Measures finished surfaces, and adds them with their thresholds, if any are isosurfaces. */
void
AddSurfaces(std::vector<MeshedSurface> & surfaces, bool hasThresholds, PictureScene & scene)
{
  MeasureSurfaces(surfaces, scene.scan);
  std::vector<std::string> thresholds;
  for (const MeshedSurface & surface : surfaces)
  {
    if (const auto & request = surface.request)
    {
      thresholds.push_back(request->name + (request->insideIsBelow ? " below " : " from ") +
                           FormatNumber(request->isovalue.value()));
    }
    AddSurface(surface, scene);
  }
  if (hasThresholds)
  {
    scene.thresholds = Enumerate(thresholds, "and");
    scene.facts.push_back("thresholds: " + scene.thresholds + (scene.unit.empty() ? "" : " " + scene.unit));
  }
}

/** Whether isosurfaces are drawn as they are extracted. */
bool
AreLeftAsTheyAre(const PictureSource & source)
{
  const std::vector<SurfaceRequest> & requests = source.surfaces.requests;
  return MayBeInSlabs(requests) && std::all_of(requests.begin(), requests.end(), [&](const SurfaceRequest & request) {
           const SurfaceFinish finish = CombineFinish(request.finish, source.finish);
           return finish.minimumVolume == 0.0 && !finish.keepsLargestPart && !finish.fillsCavities &&
                  finish.smoothing.IsNothing();
         });
}

/** The scan of pictures, whose lattice may be made in slabs. \param keepsAll whether surfaces keep all triangles */
ScanSource
StreamedSource(const PictureSource & source, const SceneUse & use, bool keepsAll)
{
  ScanSource scan = source.scan;
  scan.streams = true;
  scan.mostTriangles = keepsAll ? 0.0 : 2.0 * static_cast<double>(use.viewing->mostPoints);
  return scan;
}

PictureScene
MakeSceneOfScan(const PictureSource & source,
                std::optional<SourceVolume> volume,
                const SceneUse & use,
                const Events & events)
{
  const SurfaceWork work{ source.scan, source.surfaces, source.finish, use.colourBy, false };
  const auto inFiles = std::make_shared<SurfacesInFiles>();
  const bool keepsAll = !use.viewing || !AreLeftAsTheyAre(source);
  SurfaceViewing viewing = use.viewing.value_or(SurfaceViewing());
  ScanSource streamed = StreamedSource(source, use, keepsAll);
  streamed.checkMesh = [&](MeshEstimate & mesh) {
    const std::uintmax_t drawing = FitDrawn(mesh, work, use.countDrawing);
    if (const std::string doubt = DoubtDrawing(drawing, source.scan); !doubt.empty())
    {
      events.Note("drawing the surfaces will take some " + DescribeBytes(drawing) + doubt);
    }
    inFiles->Put(mesh, source.scan, events);
    viewing.maximumMemory = inFiles->IsUsed() ? std::numeric_limits<std::uintmax_t>::max() : viewing.maximumMemory;
  };
  LoadedSource loaded = LoadSource(streamed, source.surfaces, std::move(volume), events);
  PictureScene scene;
  scene.inFiles = inFiles;
  SlicePart part = FindSlicePart(use.onlySlices, source, loaded);
  scene.places = std::move(part.places);
  scene.report = ReportSource(loaded, source.scan, ReportInput(loaded, source.scan));
  scene.report["surfaces"] = Report::array();
  AddFacts(loaded, source, scene);
  const Scan * const scan = loaded.FindScan();
  const bool isLattice = scan == nullptr;
  scene.isOriented = isLattice || scan->isOriented;
  scene.examination = isLattice ? "Scan" : DescribeExamination(*scan, !loaded.scan);
  scene.frameOfReference = isLattice ? "" : ReadDicomExamination(*scan).frameOfReference;
  const std::optional<SliceBox> box = isLattice ? std::nullopt : std::optional(BoxOf(*scan));
  if (use.keepsScan && loaded.scan)
  {
    scene.scan = std::move(loaded.scan);
    scene.unit = IsInHounsfieldUnits(*scene.scan) ? "HU" : ReadDicomExamination(*scene.scan).units;
  }
  loaded.scan.reset(); // frees memory for the surfaces
  SurfaceMaking making{ source.scan,
                        source.surfaces,
                        source.finish,
                        SurfaceUse::Pictures,
                        events,
                        part.voxels,
                        keepsAll ? nullptr : &viewing };
  making.checkLabels = [&](LabelWork labels) {
    bool areInFiles = false;
    FitDrawn(labels, work, use.countDrawing, areInFiles);
    areInFiles ? inFiles->Put(labels, source.scan, events) : void();
  };
  std::vector<MeshedSurface> surfaces = ExtractSource(making, loaded);
  std::optional<Scan> greys; // of a lattice volume, whose samples are no voxels: nothing is measured in them
  if (isLattice && use.keepsScan)
  {
    greys.emplace().image = LatticeToScan(loaded.lattice, {}, events);
  }
  loaded.DropVolumes();
  FinishSurfaces(making, surfaces);
  AddSurfaces(surfaces, !loaded.requests.empty(), scene);
  if (greys)
  {
    scene.scan = std::move(greys);
  }
  scene.box = box ? *box : BoxOfSurfaces(scene.surfaces);
  return scene;
}

/** Surfaces of files, shown and coloured by the rules. */
PictureScene
MakeSceneOfFiles(const PictureSource & source, const Events & events)
{
  if (!source.finish.smoothing.IsNothing())
  {
    throw Failure(FailureKind::Usage,
                  "--smooth is for surfaces of scans and labels, not for surface files; leave it out.");
  }
  const SurfaceMaking making{ source.scan, source.surfaces, source.finish, SurfaceUse::Pictures, events };
  PictureScene scene;
  scene.inFiles = std::make_shared<SurfacesInFiles>();
  scene.examination = "Surfaces";
  scene.report["surfaces"] = Report::array();
  std::vector<SceneSurface> read;
  std::vector<SurfaceRequest> names;
  for (const auto & path : source.surfaceFiles)
  {
    events.Progress("reading", static_cast<double>(read.size()) / static_cast<double>(source.surfaceFiles.size()));
    for (const SceneSurface & surface : ReadSurfaces(path))
    {
      SurfaceRequest name;
      name.name = surface.name;
      name.colour = surface.colour;
      name.opacity = surface.opacity;
      names.push_back(name);
      read.push_back(surface);
    }
  }
  ApplySceneRules(source.surfaces.rules, names, nullptr);
  auto name = names.begin();
  std::vector<MeshedSurface> shown;
  for (SceneSurface & surface : read)
  {
    if (name == names.end() || name->name != surface.name)
    {
      continue; // not shown
    }
    surface.colour = name->colour;
    surface.opacity = name->opacity;
    ++name;
    MeshedSurface finished;
    finished.scene = surface;
    if (FinishSurface(making, finished))
    {
      shown.push_back(std::move(finished));
    }
  }
  MeasureSurfaces(shown, scene.scan);
  for (const MeshedSurface & surface : shown)
  {
    AddSurface(surface, scene);
  }
  if (scene.surfaces.empty())
  {
    throw Failure(FailureKind::Empty, "Nothing is left of the surfaces; show more of them, or lower --min-volume.");
  }
  scene.box = BoxOfSurfaces(scene.surfaces);
  scene.facts.push_back("surfaces: " + Count(source.surfaceFiles.size(), "file"));
  return scene;
}

} // namespace

SliceBox
BoxOfSurfaces(const std::vector<SceneSurface> & surfaces)
{
  constexpr double spacings = 512.0; // along the longest side
  const LPSBox box = BoxAround(surfaces);
  const double spacing = std::max(1.0, LongestSideOf(box)) / spacings;
  return BoxOf(box.lowest, box.highest, { spacing, spacing, spacing });
}

std::uintmax_t
CheckDrawing(const RenderSettings & render, bool isTranslucent, bool areFewer, bool hasLabels, DrawnTriangles triangles)
{
  constexpr double fewOfPixel = 3.0; // triangles that views need
  constexpr int defaultSide = 1200;
  if (areFewer)
  {
    const auto sideOf = [](int side) { return side > 0 ? side : defaultSide; };
    triangles.least = 0.0;
    triangles.likely = std::min(triangles.likely, fewOfPixel * sideOf(render.width) * sideOf(render.height));
  }
  SurfaceRenderer::CheckMemory(render, isTranslucent, triangles.least);
  RenderSettings unlimited = render;
  unlimited.maximumMemory = std::numeric_limits<std::uintmax_t>::max();
  return SurfaceRenderer::CheckMemory(unlimited, isTranslucent || hasLabels, triangles.likely);
}

PictureScene
MakePictureScene(const PictureSource & source,
                 std::optional<SourceVolume> volume,
                 const SceneUse & use,
                 const Events & events)
{
  PictureScene scene = source.surfaceFiles.empty() ? MakeSceneOfScan(source, std::move(volume), use, events)
                                                   : MakeSceneOfFiles(source, events);
  std::vector<std::string> names;
  for (SceneSurface & surface : scene.surfaces)
  {
    surface.isGlossy = IsGlossy(source.surfaces.rules.rules, surface.name);
    names.push_back(surface.name);
  }
  for (const std::string & sentence : FindUnusedRules(source.surfaces.rules.rules, names))
  {
    events.Note("warning: " + sentence);
  }
  return scene;
}

std::string
PlanPictureScene(const PictureSource & source,
                 const std::filesystem::path & output,
                 const SceneUse & use,
                 const Events & events)
{
  if (!source.surfaceFiles.empty())
  {
    throw Failure(FailureKind::Usage, "--dry-run plans what is made of a scan, not of surface files; leave it out.");
  }
  const ScanSource streamed = StreamedSource(source, use, !use.viewing || !AreLeftAsTheyAre(source));
  const auto findPart = [&](const LoadedSource & loaded) {
    return FindSlicePart(use.onlySlices, source, loaded).voxels;
  };
  return PlanPictures(
    { streamed, source.surfaces, source.finish, use.colourBy }, use.countDrawing, findPart, output, events);
}

void
ColourSurfaces(const PictureSettings & settings, PictureScene & scene, const Events & events)
{
  if (!settings.colourBy)
  {
    return;
  }
  const bool isInFiles = scene.inFiles->IsUsed();
  const ColourBy by = isInFiles ? WithinMemory(*settings.colourBy, settings.source.scan) : *settings.colourBy;
  SurfaceColours colours = ColourSurfaces(by, scene.frameOfReference, scene.surfaces, events);
  for (SceneSurface & surface : scene.surfaces)
  {
    if (scene.surfaces.size() == 1)
    {
      surface.opacity = 1.0; // there is nothing behind it
    }
    else if (surface.opacity < 1.0)
    {
      events.Note("warning: " + surface.name +
                  " is translucent, so its colours are mixed with those behind it; --draw '" + surface.name +
                  "=1' makes it opaque");
    }
  }
  scene.scale = std::move(colours.scale);
  scene.report["colours"] = std::move(colours.report);
}

std::vector<SceneSurface>
ShadedSurfaces(std::vector<SceneSurface> surfaces)
{
  for (SceneSurface & surface : surfaces)
  {
    if (!surface.surface->HasNormals() && !surface.pointColours)
    {
      const auto copy = itk::TriangleSurface::New();
      copy->Graft(surface.surface);
      ComputeTriangleSurfaceShadingNormals(*copy);
      surface.surface = copy;
    }
  }
  return surfaces;
}

std::vector<SceneSurface>
FewerForViews(const std::vector<SceneSurface> & surfaces,
              const RenderSettings & render,
              const std::vector<View> & views)
{
  if (std::any_of(surfaces.begin(), surfaces.end(), [](const auto & surface) { return surface.pointColours; }))
  {
    return surfaces;
  }
  constexpr double unseen = 0.25; // pixels
  Scene scene;
  scene.surfaces = surfaces;
  const double pixelSize = SurfaceRenderer::Plan(scene, render, views).front().pixelSize;
  return InFewerTriangles(surfaces, unseen * pixelSize);
}

std::vector<SceneSurface>
SurfacesForViews(const std::vector<SceneSurface> & surfaces,
                 const RenderSettings & render,
                 const std::vector<View> & views)
{
  return ShadedSurfaces(FewerForViews(surfaces, render, views));
}

std::vector<PointedName>
NamesOf(const PictureScene & scene, const std::vector<NamePlace> & places, const Projection & projection)
{
  std::vector<PointedName> names;
  for (const NamePlace & place : places)
  {
    const LegendRow & row = scene.rows[place.surface];
    names.push_back({ row.name,
                      row.colour,
                      projection.PositionOf(place.point),
                      place.seen,
                      projection.PositionOf(place.left).x,
                      projection.PositionOf(place.right).x });
  }
  return names;
}

std::vector<SceneSurface>
SurfacesNamed(const std::vector<SceneSurface> & surfaces, const std::string & pattern)
{
  std::vector<std::string> names;
  std::vector<SceneSurface> found;
  for (const SceneSurface & surface : surfaces)
  {
    names.push_back(surface.name);
    if (FitsPattern(pattern, surface.name))
    {
      found.push_back(surface);
    }
  }
  if (found.empty())
  {
    throw Failure(FailureKind::Usage, DescribeUnknown("surface", pattern, names, "use " + Enumerate(names)));
  }
  return found;
}

Vector3
CentreOf(const LPSBox & box)
{
  return { 0.5 * (box.lowest[0] + box.highest[0]),
           0.5 * (box.lowest[1] + box.highest[1]),
           0.5 * (box.lowest[2] + box.highest[2]) };
}

double
LongestSideOf(const LPSBox & box)
{
  return std::max(
    { box.highest[0] - box.lowest[0], box.highest[1] - box.lowest[1], box.highest[2] - box.lowest[2], 0.0 });
}

} // namespace rhombic
