#include "rhombicFailure.h"
#include "rhombicGreyWindow.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPictureSteps.h"
#include "rhombicSilhouette.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr double PointsPerInch = 72.0;
constexpr double PointsOfLetters = 7.0; // the size of letters on sheets

bool
IsPdf(const fs::path & path)
{
  return LowerCase(path.extension().string()) == ".pdf";
}

/** Height of the surfaces divided by their width, the larger of those seen from the front and from the side. */
double
AspectOf(const PictureScene & scene)
{
  const LPSBox box = BoxAround(scene.surfaces);
  const double height = box.highest[2] - box.lowest[2];
  const double width = std::max(box.highest[0] - box.lowest[0], box.highest[1] - box.lowest[1]);
  return width > 0.0 ? height / width : 1.0;
}

/** The examination, and the names of a few surfaces, or the number of many. */
std::string
TitleOf(const PictureScene & scene)
{
  constexpr std::size_t few = 3;
  std::vector<std::string> names;
  for (const LegendRow & row : scene.rows)
  {
    names.push_back(row.name);
  }
  return scene.examination + ": " + (names.size() <= few ? Enumerate(names, "and") : Count(names.size(), "structure"));
}

/** A sheet that has the pictures' numbers only. */
Sheet
EmptySheet(const RenderSheetSettings & settings, std::size_t slices)
{
  Sheet sheet;
  sheet.views.resize(settings.views.size());
  sheet.slices.resize(slices);
  sheet.isLandscape = settings.isLandscape;
  sheet.pixelsPerInch = settings.pixelsPerInch;
  sheet.hasNames = settings.names;
  return sheet;
}

/** A sheet without its pictures, but with the slices' outlines. */
Sheet
PlanSheet(const RenderSheetSettings & settings, const PictureScene & scene, const std::vector<PlaneRequest> & planes)
{
  Sheet sheet = EmptySheet(settings, planes.size());
  sheet.title = settings.title.empty() ? TitleOf(scene) : settings.title;
  sheet.viewAspect = AspectOf(scene);
  sheet.rows = scene.rows;
  sheet.headings = scene.headings;
  sheet.meanUnit = scene.unit;
  sheet.scale = scene.scale;
  sheet.provenance = scene.facts;
  sheet.provenance.push_back("made by: " + settings.provenance.software);
  sheet.letters = settings.letters && scene.isOriented;
  sheet.scaleBar = settings.scaleBar;
  sheet.isDark = settings.style == PictureStyle::Clinic;
  for (std::size_t n = 0; n < sheet.views.size(); ++n)
  {
    sheet.views[n].caption = settings.views[n].name;
    sheet.views[n].background = PaperOf(sheet);
  }
  for (std::size_t n = 0; n < planes.size(); ++n)
  {
    const Vector3 point = planes[n].place.empty() ? PlaceOfMost(planes[n].plane, scene) : FindPlace(planes[n], scene);
    SheetPicture & slice = sheet.slices[n];
    slice = CutScene(scene, planes[n], point, settings.slice).picture;
    slice.width = slice.projection.pixelSize * slice.projection.width;
    slice.height = slice.projection.pixelSize * slice.projection.height;
  }
  return sheet;
}

/** The planes of the slices: those asked for, or three; none without a scan or label map. */
std::vector<PlaneRequest>
PlanesOf(const RenderSheetSettings & settings)
{
  if (!settings.slices.empty() || !settings.source.surfaceFiles.empty())
  {
    return settings.slices;
  }
  return { { SlicePlane::Axial, "" }, { SlicePlane::Coronal, "" }, { SlicePlane::Sagittal, "" } };
}

void
DrawViews(const RenderSheetSettings & settings,
          const PictureScene & source,
          const SheetPlaces & sheetPlaces,
          SurfaceRenderer & renderer,
          Sheet & sheet)
{
  if (sheetPlaces.views.empty())
  {
    return;
  }
  RenderSettings render;
  render.width = static_cast<int>(std::lround(sheetPlaces.views.front().width));
  render.height = static_cast<int>(std::lround(sheetPlaces.views.front().height));
  render.style = settings.style;
  render.background = PaperOf(sheet).colour;
  render.sameScale = true;
  render.ambientOcclusion = !source.scale; // colours of numbers are seen as they are
  Annotations annotations;                 // the sheet draws these over the views
  annotations.figure = false;
  annotations.textSize = PointsOfLetters * sheet.pixelsPerInch / PointsPerInch;
  annotations.letters = sheet.letters;
  annotations.scaleBar = sheet.scaleBar;
  render.margins = MarginsOf(annotations, render.width, render.height, settings.views.front().frame);
  render.maximumMemory = settings.source.scan.lattice.maximumMemory;
  Scene scene;
  scene.surfaces = SurfacesForViews(source.surfaces, render, settings.views);
  std::vector<std::vector<NamePlace>> places(settings.views.size());
  if (settings.names)
  {
    const std::vector<Projection> planned = SurfaceRenderer::Plan(scene, render, settings.views);
    for (std::size_t n = 0; n < planned.size(); ++n)
    {
      places[n] = FindNamePlaces(scene, planned[n]);
      const std::vector<PointedName> names = NamesOf(source, places[n], planned[n]);
      annotations.names.insert(annotations.names.end(), names.begin(), names.end());
    }
    render.margins = MarginsOf(annotations, render.width, render.height, settings.views.front().frame);
  }
  auto drawn = renderer.Render(scene, render, settings.views);
  for (std::size_t n = 0; n < drawn.size(); ++n)
  {
    sheet.views[n].picture = std::move(drawn[n].picture);
    sheet.views[n].projection = drawn[n].projection.value();
    sheet.views[n].names = NamesOf(source, places[n], sheet.views[n].projection);
    sheet.views[n].outlines =
      FindSilhouettes(source.drawnAsLines, sheet.views[n].projection, InkOn(PaperOf(sheet)).colour);
  }
}

/** Draws slices of one scale, each in the middle of its place. */
void
DrawSlices(const RenderSheetSettings & settings, const PictureScene & scene, const SheetPlaces & places, Sheet & sheet)
{
  for (std::size_t n = 0; n < sheet.slices.size(); ++n)
  {
    SheetPicture & slice = sheet.slices[n];
    const Rectangle & place = places.slices[n];
    const double beside = 0.5 * (place.width - places.sliceScale * slice.width);
    const double above = 0.5 * (place.height - places.sliceScale * slice.height);
    DrawSceneSlice(scene,
                   settings.slice,
                   static_cast<int>(std::lround(place.width)),
                   static_cast<int>(std::lround(place.height)),
                   { beside, beside, above, above },
                   slice);
  }
}

/** The files of a page's pictures: the path, or numbered ones. */
std::vector<fs::path>
PathsOfPages(const fs::path & path, std::size_t pages)
{
  std::vector<fs::path> paths{ path };
  for (std::size_t n = 2; n <= pages; ++n)
  {
    paths.push_back(WithPart(path, std::to_string(n)));
  }
  return paths;
}

std::vector<fs::path>
StageSheet(const Sheet & sheet,
           const std::vector<Picture> & pages,
           const RenderSheetSettings & settings,
           StagedFiles & staged)
{
  const PictureMetadata metadata{ settings.provenance.software, settings.provenance.command, sheet.pixelsPerInch };
  const std::string extension = LowerCase(settings.page.extension().string());
  if (IsPdf(settings.page))
  {
    const PdfPages pdf = DrawSheetPdf(sheet, settings.provenance.software);
    StagePdf(pdf.bytes, pdf.count, settings.page, staged);
    return { settings.page };
  }
  if (extension == ".tif" || extension == ".tiff")
  {
    StagePages(pages, settings.page, staged, metadata);
    return { settings.page };
  }
  const std::vector<fs::path> paths = PathsOfPages(settings.page, pages.size());
  for (std::size_t n = 0; n < pages.size(); ++n)
  {
    StagePicture(pages[n], paths[n], staged, metadata);
  }
  return paths;
}

/** Throws Failure(Memory) where there is too little for pages of the resolution, or for views in their largest places.
 * Returns what the largest view likely takes. */
std::uintmax_t
CheckMemory(const RenderSheetSettings & settings, const DrawnTriangles & triangles = {})
{
  const SheetPlaces places = PlacesOn(EmptySheet(settings, PlanesOf(settings).size()));
  RenderSettings render;
  render.maximumMemory = settings.source.scan.lattice.maximumMemory;
  std::uintmax_t most = 0;
  constexpr std::uintmax_t bytesPerPixel = 12; // drawing, picture, and its rows as they are written
  RequireMemory(bytesPerPixel * static_cast<std::uintmax_t>(places.width) * static_cast<std::uintmax_t>(places.height),
                render.maximumMemory,
                "A page of " + FormatNumber(settings.pixelsPerInch) + " dots per inch",
                "choose a smaller --dpi");
  for (const Rectangle & place : places.views)
  {
    render.width = static_cast<int>(std::lround(place.width));
    render.height = static_cast<int>(std::lround(place.height));
    const bool hasLabels = settings.source.surfaces.labels.has_value();
    most = std::max(most, CheckDrawing(render, false, true, hasLabels, triangles));
  }
  return most;
}

SceneUse
UseOf(const RenderSheetSettings & settings)
{
  return { [&settings](const DrawnTriangles & triangles) { return CheckMemory(settings, triangles); },
           settings.colourBy,
           true };
}

} // namespace

std::vector<fs::path>
CheckRenderSheet(const RenderSheetSettings & settings)
{
  if (!IsPdf(settings.page))
  {
    CheckPicturePath(settings.page);
  }
  ParseWindow(settings.slice.window);
  if (settings.source.surfaceFiles.empty())
  {
    SurfaceSelection selection = settings.source.surfaces;
    NeedPlaces(settings.slices, selection.rules);
    CheckSelection(selection);
  }
  std::vector<fs::path> outputs = WithSidecars({ settings.page }, settings.provenance);
  const std::vector<fs::path> dicomPaths = DicomPathsOf(settings, { settings.page });
  outputs.insert(outputs.end(), dicomPaths.begin(), dicomPaths.end());
  return outputs;
}

std::vector<Picture>
StageScenePages(const RenderSheetSettings & settings,
                const PictureScene & scene,
                const std::vector<PlaneRequest> & planes,
                bool needsPictures,
                SurfaceRenderer & renderer,
                const Events & events,
                OutputFiles & outputs)
{
  events.Progress("drawing the page", 0.0);
  Sheet sheet = PlanSheet(settings, scene, planes);
  const SheetPlaces places = PlacesOn(sheet);
  DrawViews(settings, scene, places, renderer, sheet);
  events.Progress("drawing the page", 0.7);
  DrawSlices(settings, scene, places, sheet);
  std::vector<Picture> pages = needsPictures || !IsPdf(settings.page) ? DrawSheet(sheet) : std::vector<Picture>();
  const std::vector<fs::path> paths = StageSheet(sheet, pages, settings, outputs.staged);
  AddOutput(settings.page, "page", scene.report, outputs);
  AddOutputs({ paths.begin() + 1, paths.end() }, "page", outputs.made);
  return pages;
}

std::string
PlanRenderSheet(const RenderSheetSettings & settings, const Events & events)
{
  return PlanPictureScene(settings.source, settings.page, UseOf(settings), events);
}

std::vector<MadeFile>
RenderSheet(const RenderSheetSettings & given, const Events & events, std::optional<SourceVolume> volume)
{
  RenderSheetSettings settings = given;
  const std::vector<fs::path> planned = CheckRenderSheet(settings);
  const std::optional<DicomStudy> study = OpenStudy(settings.source, DicomPathsOf(settings, { settings.page }));
  CheckOutputs(planned, settings.source.scan, settings.source.surfaces, InputsOf(settings.colourBy));
  SurfaceRenderer renderer;
  const std::vector<PlaneRequest> planes = PlanesOf(settings);
  CheckMemory(settings);
  PictureSource source = settings.source;
  NeedPlaces(planes, source.surfaces.rules);
  PictureScene scene = MakePictureScene(source, std::move(volume), UseOf(settings), events);
  OpenEnclosing(source.surfaces, {}, scene, events);
  if (const std::vector<View> faces = ViewsOfFaces(scene.surfaces); settings.choosesViews && !faces.empty())
  {
    settings.views = faces;
  }
  ColourSurfaces(settings, scene, events);
  OutputFiles outputs{ settings.provenance };
  const std::vector<Picture> pages =
    StageScenePages(settings, scene, planes, study.has_value(), renderer, events, outputs);
  const std::vector<fs::path> dicomPaths = DicomPathsOf(settings, PathsOfPages(settings.page, pages.size()));
  StageFilesBeside(pages, settings, study, dicomPaths, 0.0, events, outputs);
  outputs.staged.Commit();
  events.Progress("drawing the page", 1.0);
  return outputs.made;
}

} // namespace rhombic
