#include "rhombicRenderScan.h"

#include "rhombicFailure.h"
#include "rhombicGreyWindow.h"
#include "rhombicHiding.h"
#include "rhombicLightbox.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPictureSteps.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

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

/** One path for each picture, with the picture's name if there are several; one path for an animation. */
std::vector<fs::path>
PlanPictures(const RenderScanSettings & settings)
{
  std::vector<std::string> names;
  if (settings.turntable > 0)
  {
    const std::size_t digits = std::max<std::size_t>(3, std::to_string(settings.turntable).size());
    for (std::size_t n = 1; n <= settings.turntable; ++n) // 001, 002, ...
    {
      const std::string number = std::to_string(n);
      names.push_back(std::string(digits - number.size(), '0') + number);
    }
  }
  else
  {
    for (const View & view : settings.views)
    {
      names.push_back(view.name);
    }
    for (const PlaneRequest & slice : settings.slices)
    {
      names.push_back(NameOf(slice));
    }
    if (settings.onlyPicture > names.size())
    {
      throw Failure(FailureKind::Usage,
                    "There is no picture " + std::to_string(settings.onlyPicture) + " among " +
                      std::to_string(names.size()) + " views and slices.");
    }
  }
  const bool isAnimation = settings.turntable > 0 && IsGif(settings.picture);
  const bool isOne = settings.turntable == 0 && settings.onlyPicture > 0;
  if (names.size() == 1 || isAnimation || isOne)
  {
    return { settings.picture };
  }
  std::vector<fs::path> paths;
  for (const std::string & name : names)
  {
    paths.push_back(WithPart(settings.picture, name));
  }
  return paths;
}

/** The DICOM files beside the pictures, if any are written. */
std::vector<fs::path>
PlanDicom(const RenderScanSettings & settings)
{
  return DicomPathsOf(settings,
                      settings.turntable > 0 ? std::vector<fs::path>{ settings.picture } : PlanPictures(settings));
}

/** The annotations of a picture, but for its legend. */
Annotations
AnnotationsOf(const RenderScanSettings & settings, const PictureScene & scene, const Ink & background)
{
  Annotations annotations;
  annotations.letters = settings.annotations.letters && scene.isOriented;
  annotations.scaleBar = settings.annotations.scaleBar;
  annotations.figure = settings.annotations.figure && scene.isOriented;
  annotations.title = settings.annotations.title;
  annotations.scale = scene.scale;
  annotations.background = background;
  if (settings.annotations.footnote)
  {
    const std::string thresholds = scene.thresholds.empty() ? "" : scene.thresholds + "; ";
    annotations.footnote = thresholds + settings.provenance.software;
  }
  return annotations;
}

/** The rows of the surfaces that are seen, if the settings have a legend and the scene several surfaces. */
std::vector<LegendRow>
LegendOf(const RenderScanSettings & settings, const PictureScene & scene, const std::vector<bool> & isSeen)
{
  std::vector<LegendRow> legend;
  for (std::size_t n = 0; n < scene.rows.size(); ++n)
  {
    if (isSeen[n] && settings.annotations.legend && scene.rows.size() > 1 && !scene.scale)
    {
      legend.push_back(scene.rows[n]);
    }
  }
  return legend;
}

/** LegendOf() with the colours of outlines. */
std::vector<LegendRow>
LegendOfOutlines(const RenderScanSettings & settings, const PictureScene & scene, const std::vector<bool> & isSeen)
{
  std::vector<LegendRow> legend = LegendOf(settings, scene, isSeen);
  for (LegendRow & row : legend)
  {
    row.colour = LineColourOnDark(row.colour);
  }
  return legend;
}

constexpr double Margins::*Sides[] = { &Margins::left, &Margins::right, &Margins::top, &Margins::bottom };

/** The margins of a picture's annotations, limited so that small pictures keep room for the scene: these have
 * annotations over it. */
Margins
LimitedMargins(const Annotations & annotations, const Projection & picture)
{
  Margins margins = MarginsOf(annotations, picture.width, picture.height, picture.frame);
  const double beside = annotations.names.empty() ? 0.0 : 0.2 * picture.width;
  const Margins limits{
    0.2 * picture.width + beside, 0.4 * picture.width + beside, 0.2 * picture.height, 0.2 * picture.height
  };
  for (const auto side : Sides)
  {
    margins.*side = std::min(margins.*side, limits.*side);
  }
  return margins;
}

/** For each side, the largest margin of all pictures' annotations. No margin is below that of \a least. */
Margins
LargestMargins(const std::vector<Annotations> & annotations,
               const std::vector<Projection> & pictures,
               const Margins & least)
{
  Margins largest = least;
  for (std::size_t n = 0; n < pictures.size(); ++n)
  {
    const Margins margins = LimitedMargins(annotations[n], pictures[n]);
    for (const auto side : Sides)
    {
      largest.*side = std::max(largest.*side, margins.*side);
    }
  }
  return largest;
}

/** Settings of which all pictures are higher, if they would be less than a quarter as high as wide and their height is
 * free; or wider, if less than half as wide as high, their width is free and they have legends. Letters and legends
 * then have room. */
RenderSettings
Widened(RenderSettings render, std::vector<Projection> planned, const std::vector<Annotations> & annotations)
{
  constexpr double lowest = 0.25;
  constexpr double narrowest = 0.5;
  const auto areAll = [&planned](const auto & is) { return std::all_of(planned.begin(), planned.end(), is); };
  const bool areLow =
    render.height <= 0 && areAll([](const auto & picture) { return picture.height < lowest * picture.width; });
  const bool haveLegends = std::any_of(
    annotations.begin(), annotations.end(), [](const Annotations & given) { return !given.legend.empty(); });
  const bool areNarrow = haveLegends && render.width <= 0 &&
                         areAll([](const auto & picture) { return picture.width < narrowest * picture.height; });
  if (!areLow && !areNarrow)
  {
    return render;
  }
  for (const Projection & picture : planned)
  {
    render.width = std::max(render.width, picture.width);
    render.height = std::max(render.height, picture.height);
  }
  (areLow ? render.height : render.width) =
    static_cast<int>(std::lround(areLow ? lowest * render.width : narrowest * render.height));
  for (Projection & picture : planned)
  {
    picture.width = render.width;
    picture.height = render.height;
  }
  render.margins = LargestMargins(annotations, planned, { 0.0, 0.0, 0.0, 0.0 });
  return render;
}

/** Fits the settings to a scene: its extent, and margins for the annotations of each view. The margins depend on the
 * size of the pictures; a size that is not given depends on the margins. */
RenderSettings
FitToScene(const RenderScanSettings & settings,
           const PictureScene & source,
           const Scene & scene,
           const std::vector<View> & views,
           const std::vector<Annotations> & annotations)
{
  RenderSettings render = settings.render;
  if (!settings.focus.empty())
  {
    render.extent = BoxAround(SurfacesNamed(source.surfaces, settings.focus));
  }
  if (settings.turntable > 0)
  {
    render.sameScale = true;
    render.centre = CentreOf(render.extent ? *render.extent : BoxAround(source.surfaces));
  }
  const int width = render.width > 0 ? render.width : LongerSide;
  const int height = render.height > 0 ? render.height : LongerSide;
  std::vector<Projection> planned(views.size());
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    planned[n].width = width;
    planned[n].height = height;
    planned[n].frame = views[n].frame;
  }
  // Mostly two rounds. Should a legend change its columns to and fro, the wider margins of all further rounds count.
  constexpr Margins none{ 0.0, 0.0, 0.0, 0.0 };
  constexpr int freeRounds = 4;
  constexpr int mostRounds = 8;
  for (int n = 0; n < mostRounds; ++n)
  {
    const Margins last = render.margins.value_or(none);
    render.margins = LargestMargins(annotations, planned, n < freeRounds ? none : last);
    planned = SurfaceRenderer::Plan(scene, render, views);
    constexpr double tolerance = 0.5; // pixels
    const bool isNear = std::all_of(std::begin(Sides), std::end(Sides), [&](double Margins::*side) {
      return std::abs(last.*side - (*render.margins).*side) <= tolerance;
    });
    if (n > 0 && isNear)
    {
      break;
    }
  }
  if (settings.turntable > 0) // all frames have one size
  {
    for (const Projection & frame : planned)
    {
      render.width = std::max(render.width, frame.width);
      render.height = std::max(render.height, frame.height);
    }
    for (Projection & frame : planned)
    {
      frame.width = render.width;
      frame.height = render.height;
    }
    render.margins = LargestMargins(annotations, planned, none);
  }
  return Widened(render, planned, annotations);
}

/** Gives each view's annotations the legend of the surfaces that are seen in it; all frames of a turntable have the
 * legend of those that are seen in any. Perspective is taken for parallel. */
void
SetLegends(const RenderScanSettings & settings,
           const PictureScene & source,
           const Scene & scene,
           RenderSettings render,
           const std::vector<View> & views,
           std::vector<Annotations> & annotations)
{
  render.perspective = false;
  std::vector<bool> isSeenInAny(scene.surfaces.size(), false);
  const std::vector<Projection> planned = SurfaceRenderer::Plan(scene, render, views);
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    const std::vector<bool> isSeen = FindSeenSurfaces(scene, planned[n]);
    std::transform(isSeen.begin(), isSeen.end(), isSeenInAny.begin(), isSeenInAny.begin(), std::logical_or<>());
    annotations[n].legend = LegendOf(settings, source, isSeen);
  }
  for (std::size_t n = 0; settings.turntable > 0 && n < views.size(); ++n)
  {
    annotations[n].legend = LegendOf(settings, source, isSeenInAny);
  }
}

/** Gives each view's annotations the names of the surfaces that are seen in it, if the settings have names. Returns the
 * places of the names. */
std::vector<std::vector<NamePlace>>
SetNames(const RenderScanSettings & settings,
         const PictureScene & source,
         const Scene & scene,
         const RenderSettings & render,
         const std::vector<View> & views,
         std::vector<Annotations> & annotations)
{
  std::vector<std::vector<NamePlace>> places(views.size());
  if (settings.annotations.names)
  {
    const std::vector<Projection> planned = SurfaceRenderer::Plan(scene, render, views);
    for (std::size_t n = 0; n < views.size(); ++n)
    {
      places[n] = FindNamePlaces(scene, planned[n]);
      annotations[n].names = NamesOf(source, places[n], planned[n]);
    }
  }
  return places;
}

std::vector<Picture>
DrawViews(const RenderScanSettings & settings,
          const PictureScene & source,
          const std::vector<ClipPlane> & cuts,
          SurfaceRenderer & renderer)
{
  const bool isTransparent = settings.render.style == PictureStyle::Transparent;
  std::vector<View> views = ViewsOf(settings);
  Scene scene;
  scene.surfaces = settings.turntable > 0 && !source.isForViews
                     ? SurfacesForViews(source.surfaces, settings.render, views)
                     : ShadedSurfaces(source.surfaces);
  scene.cuts = cuts;
  AddCaps(settings, source, scene);
  AddPlanes(settings, source, scene);
  Annotations ofAll = AnnotationsOf(settings, source, { BackgroundOf(settings.render), isTransparent ? 0.0 : 1.0 });
  ofAll.legend = LegendOf(settings, source, std::vector<bool>(source.rows.size(), true));
  for (const LegendRow & row : source.rows)
  {
    if (settings.annotations.names)
    {
      ofAll.names.push_back({ row.name });
    }
  }
  std::vector<Annotations> annotations(views.size(), ofAll);
  RenderSettings render = FitToScene(settings, source, scene, views, annotations);
  std::vector<std::vector<NamePlace>> names(views.size());
  if (!ofAll.legend.empty() || settings.annotations.names)
  {
    SetLegends(settings, source, scene, render, views, annotations);
    names = SetNames(settings, source, scene, render, views, annotations);
    render = FitToScene(settings, source, scene, views, annotations);
  }
  if (settings.turntable == 0 && settings.onlyPicture > 0)
  {
    views = { views[settings.onlyPicture - 1] };
    annotations = { annotations[settings.onlyPicture - 1] };
    names = { names[settings.onlyPicture - 1] };
  }
  std::vector<Picture> pictures;
  std::vector<RenderedView> drawn = renderer.Render(scene, render, views);
  for (std::size_t n = 0; n < drawn.size(); ++n)
  {
    Projection unscaled;
    unscaled.frame = views[n].frame;
    unscaled.width = drawn[n].picture.width;
    unscaled.height = drawn[n].picture.height;
    annotations[n].scaleBar = annotations[n].scaleBar && drawn[n].projection.has_value();
    annotations[n].names = NamesOf(source, names[n], drawn[n].projection.value_or(unscaled));
    Annotate(drawn[n].picture, drawn[n].projection.value_or(unscaled), annotations[n]);
    pictures.push_back(std::move(drawn[n].picture));
  }
  return pictures;
}

/** The size of a slice's picture, and the margins about the slice. */
struct SliceLayout
{
  int width = 0;
  int height = 0;
  Margins margins;
};

/** Given sides as they are, others as long as the slice and its annotations need, but not below a quarter of \a
 * longerSide: thin slices have letters apart.
 * \param aspect height of the slice, divided by its width */
SliceLayout
FitSlice(const RenderSettings & given,
         double aspect,
         const Annotations & annotations,
         const ViewFrame & frame,
         int longerSide)
{
  const bool isFree = given.width == 0 && given.height == 0;
  Projection picture;
  picture.frame = frame;
  picture.width = isFree || given.width > 0 ? std::max(given.width, isFree ? longerSide : 0) : given.height;
  picture.height = isFree || given.height > 0 ? std::max(given.height, isFree ? longerSide : 0) : given.width;
  SliceLayout layout;
  constexpr int rounds = 5; // margins depend on the size
  for (int n = 0; n < rounds; ++n)
  {
    layout.margins = LimitedMargins(annotations, picture);
    const double besides = layout.margins.left + layout.margins.right;
    const double aboves = layout.margins.top + layout.margins.bottom;
    const double widest = isFree ? longerSide - besides : given.width > 0 ? given.width - besides : INFINITY;
    const double highest = isFree ? longerSide - aboves : given.height > 0 ? given.height - aboves : INFINITY;
    const double width = std::min(widest, highest / aspect);
    const double thinnest = 0.25 * (isFree ? longerSide : std::max(given.width, given.height));
    const auto sideOf = [thinnest](double side) { return static_cast<int>(std::lround(std::max(side, thinnest))); };
    picture.width = given.width > 0 ? given.width : sideOf(width + besides);
    picture.height = given.height > 0 ? given.height : sideOf(width * aspect + aboves);
  }
  layout.margins = LimitedMargins(annotations, picture);
  layout.width = picture.width;
  layout.height = picture.height;
  return layout;
}

/** The picture of a slice that is cut already.
 * \param legend of its outlines
 * \param given sizes, 0 for free ones */
Picture
DrawSlicePicture(const RenderScanSettings & settings,
                 const PictureScene & scene,
                 SceneSlice slice,
                 const std::vector<LegendRow> & legend,
                 const RenderSettings & given,
                 double aspect,
                 int longerSide)
{
  Annotations annotations = AnnotationsOf(settings, scene, slice.picture.background);
  annotations.title += (annotations.title.empty() ? "" : ", ") + slice.picture.caption + ", " + slice.picture.position;
  annotations.legend = legend;
  const SliceLayout layout = FitSlice(given, aspect, annotations, slice.picture.projection.frame, longerSide);
  DrawSceneSlice(scene, settings.slice, layout.width, layout.height, layout.margins, slice.picture);
  annotations.outlines = slice.picture.outlines;
  Annotate(slice.picture.picture, slice.picture.projection, annotations);
  return slice.picture.picture;
}

Picture
DrawSliceWithOutlines(const RenderScanSettings & settings, const PictureScene & scene, const PlaneRequest & request)
{
  const Vector3 point = FindPlace(request, scene);
  const SceneSlice slice = CutScene(scene, request, point, settings.slice);
  return DrawSlicePicture(settings,
                          scene,
                          slice,
                          LegendOfOutlines(settings, scene, slice.isSeen),
                          settings.render,
                          AspectOfSlice(scene, request, point),
                          LongerSide);
}

/** The picture with a legend in a column at its right. */
Picture
WithLegend(const Picture & picture, const Annotations & legend, int width)
{
  Picture wider(std::max(width, picture.width), picture.height);
  for (int y = 0; y < picture.height; ++y)
  {
    std::copy_n(picture.At(0, y), 3 * picture.width, wider.pixels.begin() + (wider.At(0, y) - wider.pixels.data()));
  }
  Projection page;
  page.width = wider.width;
  page.height = wider.height;
  Annotate(wider, page, legend);
  return wider;
}

/** Slices evenly along an axis, in one picture of the settings' size, with one legend. */
Picture
DrawLightbox(const RenderScanSettings & settings, const PictureScene & scene, const PlaneRequest & request)
{
  constexpr int gap = 4; // pixels
  const int count = static_cast<int>(settings.slice.lightbox);
  std::vector<SceneSlice> slices;
  std::vector<bool> isSeen(scene.surfaces.size(), false);
  for (const Vector3 & point : PlacesInLightbox(request, settings.slice, scene))
  {
    slices.push_back(CutScene(scene, request, point, settings.slice));
    const std::vector<bool> & seen = slices.back().isSeen;
    std::transform(seen.begin(), seen.end(), isSeen.begin(), isSeen.begin(), std::logical_or<>());
  }
  Annotations legend;
  legend.letters = legend.scaleBar = legend.figure = false;
  legend.background = slices.front().picture.background;
  legend.legend = LegendOfOutlines(settings, scene, isSeen);
  const auto legendWidth = [&legend](double width, double height) {
    const int whole = static_cast<int>(width);
    return static_cast<int>(std::ceil(MarginsOf(legend, whole, static_cast<int>(height), {}).right));
  };
  const int height = settings.render.height;
  constexpr double usual = 0.75; // height of a lightbox, divided by its width
  int width = settings.render.width;
  width -= width > 0 ? legendWidth(width, height > 0 ? height : usual * width) : 0;

  const double aspect = AspectOfSlice(scene, request, slices.front().picture.projection.centre);
  const int freeWidth = static_cast<int>(std::lround(LongerSideOfTile / std::max(1.0, aspect)));
  const int freeHeight = static_cast<int>(std::lround(LongerSideOfTile / std::max(1.0, 1.0 / aspect)));
  const int columns = width > 0 && height > 0
                        ? LightboxColumns(count, freeWidth, freeHeight, static_cast<double>(width) / height)
                        : LightboxColumns(count, freeWidth, freeHeight);
  const int rows = (count + columns - 1) / columns;
  RenderScanSettings tile = settings;
  tile.render.width = width > 0 ? std::max(1, (width - gap) / columns - gap) : 0;
  tile.render.height = height > 0 ? std::max(1, (height - gap) / rows - gap) : 0;
  std::vector<Picture> pictures;
  for (const SceneSlice & slice : slices)
  {
    pictures.push_back(DrawSlicePicture(tile, scene, slice, {}, tile.render, aspect, LongerSideOfTile));
    tile.annotations.title.clear(); // the first slice has it
  }
  const Picture box = MakeLightbox(pictures, gap, legend.background.colour, columns, width, height);
  const int whole =
    settings.render.width > 0 ? settings.render.width : box.width + legendWidth(box.width / 0.8, box.height);
  return legend.legend.empty() ? box : WithLegend(box, legend, whole);
}

/** The source with the names of all surfaces in the settings, so that unknown names are refused before the work. */
PictureSource
SourceOf(const RenderScanSettings & settings)
{
  PictureSource source = settings.source;
  SceneRules & rules = source.surfaces.rules;
  rules.needed = settings.uncut;
  if (!settings.focus.empty())
  {
    rules.needed.push_back(settings.focus);
  }
  for (const CutRequest & cut : settings.cuts)
  {
    NeedPlaces({ cut.plane }, rules);
  }
  NeedPlaces(settings.planes, rules);
  NeedPlaces(settings.slices, rules);
  return source;
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

/** Writes the pictures, or the one file of a turntable, with their reports. */
void
StagePictures(const std::vector<Picture> & pictures,
              const std::vector<fs::path> & paths,
              double secondsPerFrame,
              const RenderScanSettings & settings,
              const Report & sceneReport,
              OutputFiles & outputs)
{
  const PictureMetadata metadata{ settings.provenance.software, settings.provenance.command };
  if (settings.turntable > 0 && IsGif(settings.picture))
  {
    StageAnimation(pictures, secondsPerFrame, paths.front(), outputs.staged);
  }
  else
  {
    for (std::size_t n = 0; n < pictures.size(); ++n)
    {
      StagePicture(pictures[n], paths[n], outputs.staged, metadata);
    }
  }
  for (std::size_t n = 0; n < paths.size(); ++n)
  {
    Report report = sceneReport;
    if (settings.turntable == 0 && paths.size() > 1)
    {
      report["picture"] = n + 1;
    }
    AddOutput(paths[n], "picture", report, outputs);
  }
}

/** An octahedron in a box, which is not larger in any view than a round surface in it. */
itk::TriangleSurface::Pointer
OctahedronIn(const std::array<double, 6> & bounds)
{
  const auto octahedron = itk::TriangleSurface::New();
  for (std::size_t n = 0; n < bounds.size(); ++n)
  {
    itk::TriangleSurface::PointType & point = octahedron->GetPoints().emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<float>(0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]));
    }
    point[n / 2] = static_cast<float>(bounds[n]);
  }
  octahedron->GetTriangles() = { { 0, 2, 4 }, { 1, 3, 5 } };
  return octahedron;
}

/** How large isosurfaces are seen; nothing where pictures show more of them than views do, or are not fitted to them.
 */
std::optional<SurfaceViewing>
ViewingOf(const RenderScanSettings & settings)
{
  const bool isOnlySeen =
    settings.slices.empty() && settings.cuts.empty() && settings.focus.empty() && !settings.colourBy;
  if (!isOnlySeen)
  {
    return std::nullopt;
  }
  SurfaceViewing viewing;
  viewing.maximumMemory = settings.source.scan.lattice.maximumMemory;
  viewing.findUnseen = [&settings](const std::array<double, 6> & bounds) {
    const double unseen = settings.render.perspective ? 0.05 : 0.1; // pixels; what is near is larger in perspective
    Scene scene;
    scene.surfaces.emplace_back().surface = OctahedronIn(bounds);
    double least = std::numeric_limits<double>::max();
    for (const Projection & view : SurfaceRenderer::Plan(scene, settings.render, ViewsOf(settings)))
    {
      least = std::min(least, view.pixelSize);
    }
    return unseen * least;
  };
  return viewing;
}

bool
DrawsViews(const RenderScanSettings & settings)
{
  return settings.turntable > 0 ||
         (settings.onlyPicture == 0 ? !settings.views.empty() : settings.onlyPicture <= settings.views.size());
}

/** Throws Failure(Memory) for pictures that are too many, or too large. */
void
RequireMemoryForPictures(const RenderScanSettings & settings)
{
  const auto sideOf = [](int side) { return static_cast<std::uintmax_t>(side > 0 ? side : LongerSide); };
  RequireMemory(sideOf(settings.render.width) * sideOf(settings.render.height) * 4 *
                  std::max(settings.turntable, PlanPictures(settings).size()),
                settings.source.scan.lattice.maximumMemory,
                "All pictures together",
                "choose a smaller --size, or fewer of them");
}

/** Whether isosurfaces are translucent, or planes and cut faces are drawn, as they are. The renderer checks labels,
 * which are not known yet. */
bool
HasTranslucent(const RenderScanSettings & settings)
{
  const auto & requests = settings.source.surfaces.requests;
  return !settings.planes.empty() || !settings.cuts.empty() ||
         std::any_of(
           requests.begin(), requests.end(), [](const SurfaceRequest & request) { return request.opacity < 1.0; });
}

SceneUse
UseOf(const RenderScanSettings & settings)
{
  SceneUse use;
  use.colourBy = settings.colourBy;
  use.keepsScan = !settings.cuts.empty() || !settings.planes.empty() || !settings.slices.empty();
  use.viewing = ViewingOf(settings);
  if (DrawsViews(settings))
  {
    use.countDrawing = [&settings](const DrawnTriangles & triangles) {
      RenderSettings render = settings.render;
      render.maximumMemory = settings.source.scan.lattice.maximumMemory;
      const bool hasLabels = settings.source.surfaces.labels.has_value();
      return CheckDrawing(render, HasTranslucent(settings), settings.turntable > 0, hasLabels, triangles);
    };
  }
  else if (settings.slice.lightbox == 0)
  {
    use.onlySlices = settings.slices;
  }
  return use;
}

} // namespace

std::vector<View>
ViewsOf(const RenderScanSettings & settings)
{
  std::vector<View> views = settings.turntable > 0 ? std::vector<View>() : settings.views;
  for (std::size_t n = 0; n < settings.turntable; ++n)
  {
    views.push_back(ObliqueView(360.0 * static_cast<double>(n) / static_cast<double>(settings.turntable), 0.0));
  }
  return views;
}

std::vector<fs::path>
CheckRenderScan(const RenderScanSettings & settings)
{
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
  if (settings.annotations.names && (settings.render.perspective || ViewsOf(settings).empty()))
  {
    throw Failure(FailureKind::Usage,
                  "Names stand beside views in parallel projection; leave out names, or --perspective and --slice.");
  }
  ParseWindow(settings.slice.window);
  const bool isOfFiles = !settings.source.surfaceFiles.empty();
  if (isOfFiles && !settings.planes.empty())
  {
    throw Failure(FailureKind::Usage, "Slices in the scene need a scan, and surface files are none.");
  }
  if (!isOfFiles)
  {
    CheckSelection(SourceOf(settings).surfaces);
  }
  std::vector<fs::path> outputs = WithSidecars(PlanPictures(settings), settings.provenance);
  const std::vector<fs::path> dicomPaths = PlanDicom(settings);
  outputs.insert(outputs.end(), dicomPaths.begin(), dicomPaths.end());
  return outputs;
}

std::string
PlanRenderScan(const RenderScanSettings & settings, const Events & events)
{
  CheckOutputs(CheckRenderScan(settings), settings.source.scan, settings.source.surfaces, InputsOf(settings.colourBy));
  RequireMemoryForPictures(settings);
  return PlanPictureScene(settings.source, settings.picture, UseOf(settings), events);
}

std::vector<MadeFile>
RenderScan(const RenderScanSettings & given, const Events & events, std::optional<SourceVolume> volume)
{
  RenderScanSettings settings = given;
  settings.render.maximumMemory = given.source.scan.lattice.maximumMemory;
  CheckOutputs(CheckRenderScan(settings), settings.source.scan, settings.source.surfaces, InputsOf(settings.colourBy));
  const std::vector<fs::path> paths = PlanPictures(settings);
  const std::vector<fs::path> dicomPaths = PlanDicom(settings);
  const std::optional<DicomStudy> study = OpenStudy(settings.source, dicomPaths);
  const RenderSettings & render = settings.render;
  const bool drawsAll = settings.turntable > 0 || settings.onlyPicture == 0;
  const bool drawsViews = DrawsViews(settings);
  std::optional<SurfaceRenderer> renderer;
  if (drawsViews)
  {
    renderer.emplace().CheckSettings(render, HasTranslucent(settings));
  }
  RequireMemoryForPictures(settings);
  PictureScene scene = MakePictureScene(SourceOf(settings), std::move(volume), UseOf(settings), events);
  events.Progress("rendering", 0.0);
  const std::vector<ClipPlane> cuts = ClipPlanesOf(settings, scene);
  std::vector<Picture> pictures;
  if (drawsViews)
  {
    OpenEnclosing(settings.source.surfaces, cuts, scene, events);
    PictureScene seen = scene;
    ShowFocus(cuts, settings, seen, events);
    ColourSurfaces(settings, seen, events);
    settings.render.ambientOcclusion = settings.render.ambientOcclusion && !seen.scale; // colours are seen as they are
    pictures = DrawViews(settings, seen, cuts, *renderer);
    scene.report = std::move(seen.report);
  }
  for (std::size_t n = 0; n < settings.slices.size(); ++n)
  {
    const PlaneRequest & request = settings.slices[n];
    if (drawsAll || settings.onlyPicture == settings.views.size() + n + 1)
    {
      pictures.push_back(settings.slice.lightbox > 0 ? DrawLightbox(settings, scene, request)
                                                     : DrawSliceWithOutlines(settings, scene, request));
    }
  }
  OutputFiles outputs{ settings.provenance };
  const double secondsPerFrame = SecondsPerTurn / static_cast<double>(pictures.size());
  StagePictures(pictures, paths, secondsPerFrame, settings, scene.report, outputs);
  StageFilesBeside(pictures, settings, study, dicomPaths, secondsPerFrame, events, outputs);
  outputs.staged.Commit();
  events.Progress("rendering", 1.0);
  return outputs.made;
}

} // namespace rhombic
