#include "rhombicRenderPage.h"

#include "rhombicFailure.h"
#include "rhombicGreyWindow.h"
#include "rhombicInteractivePage.h"
#include "rhombicPictureIO.h"
#include "rhombicPictureSteps.h"
#include "rhombicSilhouette.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr int SideOfView = 640;      // pixels
constexpr int SideOfTurntable = 440; // pixels
constexpr int FramesOfTurntable = 24;

RenderSettings
SettingsOf(const RenderPageSettings & settings, int side)
{
  RenderSettings render;
  render.width = render.height = side;
  render.sameScale = true;
  render.maximumMemory = settings.source.scan.lattice.maximumMemory;
  return render;
}

SceneUse
UseOf(const RenderPageSettings & settings)
{
  const auto countDrawing = [&settings](const DrawnTriangles & triangles) {
    const bool hasLabels = settings.source.surfaces.labels.has_value();
    return CheckDrawing(SettingsOf(settings, SideOfView), false, true, hasLabels, triangles);
  };
  return { countDrawing, settings.colourBy, settings.hasSlices };
}

/** The letters and the scale bar of a still picture. */
Annotations
AnnotationsOf(const PictureScene & scene)
{
  Annotations annotations;
  annotations.letters = scene.isOriented;
  annotations.figure = false;
  return annotations;
}

/** Draws still pictures. Returns the surfaces in as few triangles as these need. */
std::vector<SceneSurface>
DrawViews(const RenderPageSettings & settings,
          const PictureScene & source,
          SurfaceRenderer & renderer,
          PageContent & page)
{
  RenderSettings render = SettingsOf(settings, SideOfView);
  render.ambientOcclusion = !source.scale; // colours of numbers are seen as they are
  Annotations annotations = AnnotationsOf(source);
  annotations.scale = source.scale;
  render.margins = MarginsOf(annotations, render.width, render.height, settings.views.front().frame);
  Scene scene;
  std::vector<SceneSurface> fewer = FewerForViews(source.surfaces, render, settings.views);
  scene.surfaces = ShadedSurfaces(fewer);
  auto drawn = renderer.Render(scene, render, settings.views);
  for (std::size_t n = 0; n < drawn.size(); ++n)
  {
    annotations.outlines =
      FindSilhouettes(source.drawnAsLines, drawn[n].projection.value(), InkOn({ { 0.0, 0.0, 0.0 } }).colour);
    Annotate(drawn[n].picture, drawn[n].projection.value(), annotations);
    page.views.push_back({ std::move(drawn[n].picture), settings.views[n].name });
  }
  return fewer;
}

void
DrawTurntable(const RenderPageSettings & settings,
              const PictureScene & source,
              const std::vector<SceneSurface> & fewer,
              SurfaceRenderer & renderer,
              PageContent & page)
{
  std::vector<View> turn;
  for (int n = 0; n < FramesOfTurntable; ++n)
  {
    turn.push_back(ObliqueView(360.0 * n / FramesOfTurntable, 0.0));
  }
  RenderSettings render = SettingsOf(settings, SideOfTurntable);
  render.ambientOcclusion = !source.scale;
  render.centre = CentreOf(BoxAround(source.surfaces));
  constexpr int quality = 78;
  Scene scene;
  scene.surfaces = SurfacesForViews(fewer, render, turn);
  renderer.Render(scene, render, turn, [&page](const RenderedView & view) {
    page.turntable.push_back(EncodeJpeg(view.picture, quality, true));
  });
}

/** The planes of the still slices: those asked for, or three through the middle. */
std::vector<PlaneRequest>
PlanesOf(const RenderPageSettings & settings)
{
  if (!settings.slices.empty() || !settings.source.surfaceFiles.empty() || !settings.hasSlices)
  {
    return settings.slices;
  }
  return { { SlicePlane::Axial, "" }, { SlicePlane::Coronal, "" }, { SlicePlane::Sagittal, "" } };
}

void
DrawSlices(const RenderPageSettings & settings, const PictureScene & scene, PageContent & page)
{
  for (const PlaneRequest & plane : PlanesOf(settings))
  {
    SheetPicture slice = CutScene(scene, plane, FindPlace(plane, scene), settings.slice).picture;
    Annotations annotations = AnnotationsOf(scene);
    const Margins margins = MarginsOf(annotations, SideOfView, SideOfView, slice.projection.frame);
    DrawSceneSlice(scene, settings.slice, SideOfView, SideOfView, margins, slice);
    annotations.outlines = slice.outlines;
    Annotate(slice.picture, slice.projection, annotations);
    page.slices.push_back({ std::move(slice.picture), slice.caption + ", " + slice.position });
  }
}

/** As the title of a sheet. */
std::string
TitleOf(const RenderPageSettings & settings, const PictureScene & scene)
{
  constexpr std::size_t few = 3;
  std::vector<std::string> names;
  for (const LegendRow & row : scene.rows)
  {
    names.push_back(row.name);
  }
  const std::string shown = names.size() <= few ? Enumerate(names, "and") : Count(names.size(), "structure");
  return settings.title.empty() ? scene.examination + ": " + shown : settings.title;
}

/** A sentence about what tells the patient from others: whether the face can be recognised follows from the part of the
 * body that DICOM names, and from the names of surfaces; where neither tells, the sentence leaves it open. */
std::string
DescribePrivacy(const PictureScene & scene, bool hasSlices)
{
  const std::vector<std::string> headWords{ "head", "skull", "brain", "face",     "facial", "orbit",
                                            "eye",  "eyes",  "jaw",   "mandible", "whole" };
  const std::vector<std::string> skinWords{ "skin", "body", "outline", "head", "face", "facial", "scalp" };
  const auto hasOneOf = [](const std::string & text, const std::vector<std::string> & words) {
    return std::any_of(words.begin(), words.end(), [padded = " " + text + " "](const std::string & word) {
      return padded.find(" " + word + " ") != std::string::npos;
    });
  };
  const std::string examination = LowerCase(scene.examination);
  bool hasHead = hasOneOf(examination, headWords);
  bool hasSkin = hasSlices;
  for (const LegendRow & row : scene.rows)
  {
    hasHead = hasHead || hasOneOf(LowerCase(row.name), headWords);
    hasSkin = hasSkin || hasOneOf(LowerCase(row.name), skinWords);
  }
  const bool isOtherPart = examination.find(' ') != std::string::npos; // "CT chest"
  const std::string none = "privacy: no name, number or date of the patient is in this file";
  return !hasSkin || (isOtherPart && !hasHead) ? none
         : hasHead ? none + ", but the head is, and a face can be recognised from it: guard the file like a photograph "
                            "of the patient"
                   : none + "; if the head is in the scan, the face can be recognised from skin and slices";
}

PageContent
ContentOf(const RenderPageSettings & settings, const PictureScene & scene)
{
  PageContent page;
  page.title = TitleOf(settings, scene);
  page.facts = scene.facts;
  page.facts.push_back("made by: " + settings.provenance.software);
  page.unit = scene.unit;
  page.scale = scene.scale;
  page.isOriented = scene.isOriented;
  page.largestSize = settings.largestSize;
  constexpr std::size_t few = 8; // need no groups
  const bool hasOthers = !scene.drawnAsLines.empty();
  const bool hasGroups = scene.rows.size() > few || hasOthers;
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    const LegendRow & row = scene.rows[n];
    const std::string group = hasOthers ? "A" : row.group.empty() ? "other" : row.group;
    page.surfaces.push_back({ scene.surfaces[n], hasGroups ? group : "", row.volume, row.area, row.mean });
    page.surfaces.back().scene.name = row.name;
  }
  if (settings.hasSlices && scene.scan)
  {
    page.scan = scene.scan;
    page.box = BoxOf(*scene.scan);
    page.window = WindowFromText(settings.slice.window, *scene.scan);
  }
  for (SceneSurface other : scene.drawnAsLines)
  {
    constexpr double opacity = 0.5;
    other.opacity = opacity;
    page.surfaces.push_back({ other, "B", {}, {}, {}, true });
  }
  if (!scene.headings.empty())
  {
    page.table.emplace().headings = scene.headings;
    for (const LegendRow & row : scene.rows)
    {
      page.table->rows.push_back({ row.name, row.colour, row.figures });
    }
  }
  page.facts.push_back(DescribePrivacy(scene, page.scan.has_value()));
  return page;
}

void
DrawPictures(const RenderPageSettings & settings,
             const PictureScene & scene,
             SurfaceRenderer & renderer,
             const Events & events,
             PageContent & content)
{
  events.Progress("drawing views", 0.0);
  const std::vector<SceneSurface> fewer = DrawViews(settings, scene, renderer, content);
  events.Progress("turning the surfaces", 0.0);
  DrawTurntable(settings, scene, fewer, renderer, content); // smaller pictures, which need fewer triangles yet
  events.Progress("drawing slices", 0.0);
  DrawSlices(settings, scene, content);
}

Report
ReportWeight(const PageWeight & weight)
{
  Report report{ { "bytes", weight.size },
                 { "bytesOfSurfaces", weight.sizeOfSurfaces },
                 { "bytesOfSlices", weight.sizeOfSlices },
                 { "bytesOfPictures", weight.sizeOfPictures },
                 { "trianglesBefore", weight.trianglesBefore },
                 { "triangles", weight.triangles },
                 { "measuredSurfaceError_mm", weight.measuredError },
                 { "positionStep_mm", weight.quantum } };
  if (weight.grid[0] > 0)
  {
    report["slices"] = { { "size", weight.grid },
                         { "spacing_mm", weight.spacing },
                         { "largestValueError", weight.valueError },
                         { "lowestValue", weight.lowest },
                         { "highestValue", weight.highest } };
  }
  report["notes"] = weight.notes;
  return report;
}

} // namespace

bool
IsPagePath(const fs::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  return extension == ".html" || extension == ".htm";
}

std::vector<fs::path>
CheckRenderPage(const RenderPageSettings & settings)
{
  ParseWindow(settings.slice.window);
  if (settings.writesDicom)
  {
    throw Failure(FailureKind::Usage,
                  "DICOM files hold pictures, and an interactive page is none; leave out --dicom-sc.");
  }
  if (settings.source.surfaceFiles.empty())
  {
    SurfaceSelection selection = settings.source.surfaces;
    NeedPlaces(settings.slices, selection.rules);
    CheckSelection(selection);
  }
  return WithSidecars({ settings.page }, settings.provenance);
}

void
StageScenePage(const RenderPageSettings & settings,
               PictureScene scene,
               SurfaceRenderer & renderer,
               const Events & events,
               OutputFiles & outputs)
{
  PageContent content = ContentOf(settings, scene);
  events.Note("page: " + content.facts.back());
  DrawPictures(settings, scene, renderer, events, content);
  const Picture first = content.views.front().picture; // for a thumbnail
  scene.surfaces = scene.drawnAsLines = {};
  scene.scan.reset();
  const MadePage page = MakeInteractivePage(std::move(content), events);
  for (const std::string & note : page.weight.notes)
  {
    events.Note("page: " + note);
  }
  scene.report["page"] = ReportWeight(page.weight);
  StageText(page.html, settings.page, outputs.staged);
  AddOutput(settings.page, "page", scene.report, outputs);
  StageFilesBeside({ first }, settings, std::nullopt, {}, 0.0, events, outputs);
}

std::string
PlanRenderPage(const RenderPageSettings & settings, const Events & events)
{
  return PlanPictureScene(settings.source, settings.page, UseOf(settings), events);
}

std::vector<MadeFile>
RenderPage(const RenderPageSettings & settings, const Events & events, std::optional<SourceVolume> volume)
{
  CheckOutputs(CheckRenderPage(settings), settings.source.scan, settings.source.surfaces, InputsOf(settings.colourBy));
  SurfaceRenderer renderer;
  renderer.CheckSettings(SettingsOf(settings, SideOfView));
  PictureSource source = settings.source;
  NeedPlaces(PlanesOf(settings), source.surfaces.rules);
  PictureScene scene = MakePictureScene(source, std::move(volume), UseOf(settings), events);
  OpenEnclosing(source.surfaces, {}, scene, events);
  ColourSurfaces(settings, scene, events);
  OutputFiles outputs{ settings.provenance };
  StageScenePage(settings, std::move(scene), renderer, events, outputs);
  outputs.staged.Commit();
  return outputs.made;
}

} // namespace rhombic
