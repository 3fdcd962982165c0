#include "rhombicRenderScan.h"

#include "rhombicFailure.h"
#include "rhombicLightbox.h"
#include "rhombicOutlinedSlice.h"
#include "rhombicPictureIO.h"
#include "rhombicPictureScene.h"
#include "rhombicSceneCuts.h"
#include "rhombicSourceLoading.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr int LongerSide = 1200;      // pixels, of slices whose size is not given
constexpr int LongerSideOfTile = 420; // pixels, of slices in a lightbox
constexpr double SecondsPerTurn = 4.0;

bool
IsGif(const fs::path & path)
{
  return LowerCase(path.extension().string()) == ".gif";
}

/** The picture's path with a part added to its stem. */
fs::path
WithPart(const fs::path & picture, const std::string & part)
{
  return picture.parent_path() / (picture.stem().string() + "-" + part + picture.extension().string());
}

/** Fit for a file's name: axial-liver, axial-slice40, axial-12.5mm, axial-minus12.5mm. */
std::string
NameOf(const PlaneRequest & request)
{
  std::string place = request.place;
  if (ToNumber<double>(place))
  {
    place = (place[0] == '-' ? "minus" + place.substr(1) : place) + "mm";
  }
  else if (!place.empty() && place[0] == '#')
  {
    place = "slice" + place.substr(1);
  }
  return NameOf(request.plane) + (place.empty() ? "" : "-" + FileStemOf(place));
}

/** One path for each picture, all different: with their names if there are several. */
std::vector<fs::path>
PathsOf(const fs::path & picture, const std::vector<std::string> & names)
{
  std::vector<fs::path> paths;
  for (const std::string & name : names)
  {
    paths.push_back(names.size() == 1 ? picture : WithPart(picture, name));
  }
  return paths;
}

/** Names of a turntable's frames: 001, 002, ... */
std::vector<std::string>
NumbersOf(std::size_t count)
{
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(count).size());
  std::vector<std::string> names;
  for (std::size_t n = 1; n <= count; ++n)
  {
    const std::string number = std::to_string(n);
    names.push_back(std::string(digits - number.size(), '0') + number);
  }
  return names;
}

std::vector<fs::path>
PlanPictures(const RenderScanSettings & settings)
{
  if (settings.turntable > 0)
  {
    return IsGif(settings.picture) ? std::vector<fs::path>{ settings.picture }
                                   : PathsOf(settings.picture, NumbersOf(settings.turntable));
  }
  std::vector<std::string> names;
  for (const View & view : settings.views)
  {
    names.push_back(view.name);
  }
  for (const PlaneRequest & slice : settings.slices)
  {
    names.push_back(NameOf(slice));
  }
  return PathsOf(settings.picture, names);
}

/** Whether an isosurface is translucent. Labels are not known before they are read; the renderer checks them again. */
bool
IsTranslucent(const std::vector<SurfaceRequest> & requests)
{
  return std::any_of(
    requests.begin(), requests.end(), [](const SurfaceRequest & request) { return request.opacity < 1.0; });
}

bool
NeedsScan(const RenderScanSettings & settings)
{
  return !settings.cuts.empty() || !settings.planes.empty() || !settings.slices.empty();
}

Annotations
AnnotationsOf(const RenderScanSettings & settings, const PictureScene & scene, const Ink & background)
{
  Annotations annotations;
  annotations.letters = settings.annotations.letters && scene.isOriented;
  annotations.scaleBar = settings.annotations.scaleBar;
  annotations.figure = settings.annotations.figure && scene.isOriented;
  annotations.title = settings.annotations.title;
  annotations.background = background;
  if (settings.annotations.legend && scene.rows.size() > 1)
  {
    annotations.legend = scene.rows;
  }
  if (settings.annotations.footnote)
  {
    const std::string thresholds = scene.thresholds.empty() ? "" : scene.thresholds + "; ";
    annotations.footnote = thresholds + settings.provenance.software;
  }
  return annotations;
}

/** Views around the patient that all have the same scale and centre. */
std::vector<View>
TurntableViews(std::size_t count)
{
  std::vector<View> views;
  for (std::size_t n = 0; n < count; ++n)
  {
    views.push_back(ObliqueView(360.0 * static_cast<double>(n) / static_cast<double>(count), 0.0));
  }
  return views;
}

/** The margins that annotations need, so far as they leave room for the scene: small pictures have them over it. */
Margins
LimitedMargins(const Annotations & annotations, int width, int height, const ViewFrame & frame)
{
  Margins margins = MarginsOf(annotations, width, height, frame);
  const auto limit = [](double & margin, double largest) { margin = std::min(margin, largest); };
  limit(margins.left, 0.2 * width);
  limit(margins.right, 0.45 * width);
  limit(margins.top, 0.2 * height);
  limit(margins.bottom, 0.2 * height);
  return margins;
}

/** Fits the settings to a scene: what is seen, and margins for the annotations. These depend on the size of the
 * pictures, and that, if it is not given, on them. */
RenderSettings
FitToScene(const RenderScanSettings & settings,
           const PictureScene & source,
           const Scene & scene,
           const std::vector<View> & views,
           const Annotations & annotations)
{
  RenderSettings render = settings.render;
  if (!settings.focus.empty())
  {
    render.extent = BoxAround(SurfacesNamed(source.surfaces, settings.focus));
  }
  if (settings.turntable > 0)
  {
    const LPSBox box = render.extent ? *render.extent : BoxAround(source.surfaces);
    render.sameScale = true;
    render.centre = Vector3{ 0.5 * (box.lowest[0] + box.highest[0]),
                             0.5 * (box.lowest[1] + box.highest[1]),
                             0.5 * (box.lowest[2] + box.highest[2]) };
  }
  int width = render.width > 0 ? render.width : LongerSide;
  int height = render.height > 0 ? render.height : LongerSide;
  constexpr int rounds = 3;
  for (int n = 0; n < rounds; ++n)
  {
    render.margins = LimitedMargins(annotations, width, height, views.front().frame);
    const Projection planned = SurfaceRenderer::Plan(scene, render, views).front();
    width = planned.width;
    height = planned.height;
  }
  if (views.size() == 1)
  {
    render.width = width;
    render.height = height;
    render.margins = LimitedMargins(annotations, width, height, views.front().frame);
  }
  return render;
}

std::vector<Picture>
DrawViews(const RenderScanSettings & settings, const PictureScene & source, SurfaceRenderer & renderer)
{
  const bool isTransparent = settings.render.style == PictureStyle::Transparent;
  const Annotations annotations =
    AnnotationsOf(settings, source, { BackgroundOf(settings.render), isTransparent ? 0.0 : 1.0 });
  const std::vector<View> views = settings.turntable > 0 ? TurntableViews(settings.turntable) : settings.views;
  Scene scene;
  scene.surfaces = source.surfaces;
  AddCuts(settings, source, scene);
  AddPlanes(settings, source, scene);
  RenderSettings render = FitToScene(settings, source, scene, views, annotations);
  render.maximumMemory = settings.source.scan.lattice.maximumMemory;
  std::vector<Picture> pictures;
  std::vector<RenderedView> drawn = renderer.Render(scene, render, views);
  for (std::size_t n = 0; n < drawn.size(); ++n)
  {
    Projection unscaled;
    unscaled.frame = views[n].frame;
    unscaled.width = drawn[n].picture.width;
    unscaled.height = drawn[n].picture.height;
    Annotations ofView = annotations;
    ofView.scaleBar = annotations.scaleBar && drawn[n].projection.has_value();
    Annotate(drawn[n].picture, drawn[n].projection.value_or(unscaled), ofView);
    pictures.push_back(std::move(drawn[n].picture));
  }
  return pictures;
}

/** The size of a slice's picture: what is given, and of the other side as much as the slice needs. */
Projection
SizedSlice(const RenderSettings & render,
           const PictureScene & scene,
           const PlaneRequest & request,
           const Vector3 & point,
           int longerSide)
{
  const ViewFrame frame = FrameOf(request.plane);
  const Projection whole = SliceThrough(point, scene.box, frame);
  const double aspect = static_cast<double>(whole.height) / static_cast<double>(whole.width);
  int width = render.width;
  int height = render.height;
  if (width == 0 && height == 0)
  {
    (aspect > 1.0 ? height : width) = longerSide;
  }
  width = width > 0 ? width : std::max(1, static_cast<int>(std::lround(height / aspect)));
  height = height > 0 ? height : std::max(1, static_cast<int>(std::lround(width * aspect)));
  Projection sized;
  sized.width = width;
  sized.height = height;
  return sized;
}

Picture
DrawSliceWithOutlines(const RenderScanSettings & settings,
                      const PictureScene & scene,
                      const PlaneRequest & request,
                      const Vector3 & point,
                      int longerSide = LongerSide)
{
  const Projection size = SizedSlice(settings.render, scene, request, point, longerSide);
  const SheetPicture slice = DrawOutlinedSlice(scene, request, point, settings.slice, size.width, size.height);
  Picture picture = slice.picture;
  Annotations annotations = AnnotationsOf(settings, scene, { { 0.0, 0.0, 0.0 } });
  annotations.title = annotations.title.empty() ? slice.caption + ", " + slice.position : annotations.title;
  annotations.legend.clear();
  annotations.outlines = slice.outlines;
  Annotate(picture, slice.projection, annotations);
  return picture;
}

Picture
DrawSlices(const RenderScanSettings & settings, const PictureScene & scene, const PlaneRequest & request)
{
  if (settings.slice.lightbox == 0)
  {
    return DrawSliceWithOutlines(settings, scene, request, FindPlace(request, scene));
  }
  RenderScanSettings tile = settings;
  tile.render.width = tile.render.height = 0;
  std::vector<Picture> pictures;
  for (const Vector3 & point : SpreadEvenly(scene.box, FrameOf(request.plane), settings.slice.lightbox))
  {
    pictures.push_back(DrawSliceWithOutlines(tile, scene, request, point, LongerSideOfTile));
  }
  constexpr int gap = 4; // pixels
  return MakeLightbox(pictures, gap, { 0.0, 0.0, 0.0 });
}

/** Throws Failure(Usage) for settings that slices can't have. */
void
CheckSlices(const RenderScanSettings & settings)
{
  constexpr int largestSide = 8192; // pixels
  if (settings.slices.empty())
  {
    return;
  }
  if (settings.render.width > largestSide || settings.render.height > largestSide)
  {
    throw Failure(FailureKind::Usage,
                  "Slices have at most " + std::to_string(largestSide) + " pixels on a side; choose a smaller --size.");
  }
  if (settings.render.style == PictureStyle::Transparent)
  {
    throw Failure(FailureKind::Usage, "Slices are not transparent; leave out --style transparent or --slice.");
  }
}

} // namespace

std::vector<fs::path>
RenderScan(const RenderScanSettings & settings, const Events & events)
{
  const std::vector<fs::path> paths = PlanPictures(settings);
  CheckOutputs(WithSidecars(paths, settings.provenance), settings.source.scan, settings.source.surfaces);
  const int channels = settings.render.style == PictureStyle::Transparent ? 4 : 3;
  if (settings.turntable > 0 && IsGif(settings.picture))
  {
    CheckAnimationPath(settings.picture, channels);
  }
  else
  {
    CheckPicturePath(settings.picture, channels);
  }
  CheckSlices(settings);
  const bool drawsViews = settings.turntable > 0 || !settings.views.empty();
  std::optional<SurfaceRenderer> renderer;
  RenderSettings render = settings.render;
  render.maximumMemory = settings.source.scan.lattice.maximumMemory;
  if (drawsViews)
  {
    renderer.emplace().CheckSettings(render, IsTranslucent(settings.source.surfaces.requests));
  }
  const PictureScene scene = MakePictureScene(settings.source, NeedsScan(settings), events);
  events.Progress("rendering", 0.0);
  std::vector<Picture> pictures;
  if (drawsViews)
  {
    pictures = DrawViews(settings, scene, *renderer);
  }
  for (const PlaneRequest & request : settings.slices)
  {
    pictures.push_back(DrawSlices(settings, scene, request));
  }
  StagedFiles staged;
  const PictureMetadata metadata{ settings.provenance.software, settings.provenance.GetCommand() };
  if (settings.turntable == 0 || !IsGif(settings.picture))
  {
    for (std::size_t n = 0; n < pictures.size(); ++n)
    {
      StagePicture(pictures[n], paths[n], staged, metadata);
    }
  }
  else
  {
    StageAnimation(pictures, SecondsPerTurn / static_cast<double>(pictures.size()), paths.front(), staged);
  }
  for (const fs::path & path : paths)
  {
    StageSidecar(path, settings.provenance, scene.report, staged);
  }
  staged.Commit();
  events.Progress("rendering", 1.0);
  return paths;
}

} // namespace rhombic
