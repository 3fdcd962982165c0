#include "rhombicPictureSteps.h"

#include "rhombicFailure.h"
#include "rhombicSlicePicture.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rhombic
{
namespace
{

constexpr double PixelsOfCap = 1500.0;    // along the longer side of the scene
constexpr std::uint8_t GreyOfNoScan = 56; // behind the areas of slices without a scan

/** A slice of the scene's box in a plane, of about PixelsOfCap pixels. */
Projection
PlaneThrough(const Vector3 & point, SlicePlane plane, const PictureScene & source)
{
  return SliceThrough(point, source.box, FrameOf(plane), LongestSideOf(BoxAround(source.surfaces)) / PixelsOfCap);
}

std::vector<std::string>
NamesOfCutSurfaces(const RenderScanSettings & settings, const PictureScene & source)
{
  std::vector<std::string> names;
  for (const SceneSurface & surface : source.surfaces)
  {
    const bool isCut = std::none_of(settings.uncut.begin(), settings.uncut.end(), [&](const std::string & pattern) {
      return FitsPattern(pattern, surface.name);
    });
    if (isCut)
    {
      names.push_back(surface.name);
    }
  }
  return names;
}

/** Throws Failure(Usage) for a cut that removes all or nothing. */
void
RequireMeeting(const CutRequest & cut, const Vector3 & point, const PictureScene & source)
{
  const LPSBox box = BoxAround(source.surfaces);
  const std::size_t axis = AxisOf(cut.plane.plane);
  if (point[axis] <= box.lowest[axis] || point[axis] >= box.highest[axis])
  {
    throw Failure(FailureKind::Usage,
                  std::string("The cut at ") + "xyz"[axis] + " = " + FormatNumber(point[axis], 5) +
                    " mm does not meet the surfaces, which reach from " + FormatNumber(box.lowest[axis], 5) + " to " +
                    FormatNumber(box.highest[axis], 5) + " mm; choose a place in between.");
  }
}

/** Makes pixels transparent that lie where other planes cut the scene. */
void
ClearWhereCut(const Projection & projection, const std::vector<ClipPlane> & cuts, std::size_t own, Picture & picture)
{
  for (std::size_t n = 0; n < cuts.size(); ++n)
  {
    if (n == own)
    {
      continue;
    }
    std::uint8_t * alpha = picture.pixels.data() + 3;
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x, alpha += 4)
      {
        const Vector3 point = projection.PointAt({ x + 0.5, y + 0.5 });
        const Vector3 offset{ point[0] - cuts[n].point[0], point[1] - cuts[n].point[1], point[2] - cuts[n].point[2] };
        *alpha = Dot(offset, cuts[n].normal) > 0.0 ? 0 : *alpha;
      }
    }
  }
}

/** The numbers of a scene's surfaces, larger volumes first: of areas in one place, that of the smallest is seen, as a
 * lesion in its organ. */
std::vector<std::size_t>
FromLargestOn(const PictureScene & scene)
{
  std::vector<std::size_t> order(scene.surfaces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&scene](std::size_t a, std::size_t b) {
    return scene.rows[a].volume.value_or(0.0) > scene.rows[b].volume.value_or(0.0);
  });
  return order;
}

/** A slice without a scan: grey, with the areas inside the surfaces in their colours. */
Picture
FillAreas(const PictureScene & scene, const Projection & projection)
{
  constexpr std::uint8_t grey = GreyOfNoScan;
  constexpr double tint = 0.55;
  Picture slice(projection.width, projection.height);
  std::fill(slice.pixels.begin(), slice.pixels.end(), grey);
  std::vector<CapSurface> areas;
  for (const std::size_t n : FromLargestOn(scene))
  {
    const SceneSurface & surface = scene.surfaces[n];
    areas.push_back({ CutSurface(*surface.surface, projection), surface.colour, tint });
  }
  const Picture cap = DrawCap(slice, areas);
  for (std::size_t pixel = 0; pixel < slice.pixels.size() / 3; ++pixel)
  {
    const double alpha = cap.pixels[4 * pixel + 3] / 255.0;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      const double area = cap.pixels[4 * pixel + channel];
      slice.pixels[3 * pixel + channel] = static_cast<std::uint8_t>(std::lround(grey + alpha * (area - grey)));
    }
  }
  return slice;
}

} // namespace

std::vector<ClipPlane>
ClipPlanesOf(const RenderScanSettings & settings, const PictureScene & source)
{
  std::vector<ClipPlane> cuts;
  const std::vector<std::string> names = NamesOfCutSurfaces(settings, source);
  if (!settings.cuts.empty() && names.empty())
  {
    throw Failure(FailureKind::Usage, "No surface is left to cut after --uncut; leave it or --cut out.");
  }
  for (const CutRequest & cut : settings.cuts)
  {
    const Vector3 point = FindPlace(cut.plane, source);
    RequireMeeting(cut, point, source);
    ClipPlane plane;
    plane.point = point;
    plane.normal = {};
    plane.normal[AxisOf(cut.plane.plane)] = cut.removesHigher ? 1.0 : -1.0;
    plane.surfaces = names;
    cuts.push_back(plane);
  }
  return cuts;
}

void
AddCaps(const RenderScanSettings & settings, const PictureScene & source, Scene & scene)
{
  const std::vector<std::size_t> order = FromLargestOn(source);
  for (std::size_t n = 0; n < settings.cuts.size(); ++n)
  {
    const Projection projection = PlaneThrough(scene.cuts[n].point, settings.cuts[n].plane.plane, source);
    std::vector<CapSurface> cut;
    for (const std::size_t number : order)
    {
      const SceneSurface & surface = source.surfaces[number];
      if (IsCut(surface, scene.cuts[n]))
      {
        const double tint = !source.scan ? 1.0 : surface.opacity < 1.0 ? 0.0 : 0.25;
        cut.push_back({ CutSurface(*surface.surface, projection), surface.colour, tint });
      }
    }
    const Picture greys = source.scan
                            ? DrawSlice(*source.scan, projection, WindowFromText(settings.slice.window, *source.scan))
                            : Picture(projection.width, projection.height);
    Picture cap = DrawCap(greys, cut);
    ClearWhereCut(projection, scene.cuts, n, cap);
    scene.planes.push_back({ std::move(cap), projection });
  }
}

void
AddPlanes(const RenderScanSettings & settings, const PictureScene & source, Scene & scene)
{
  for (const PlaneRequest & request : settings.planes)
  {
    if (!source.scan)
    {
      throw Failure(FailureKind::Usage, "Slices in the scene need a scan, and this source is none.");
    }
    const Projection projection = PlaneThrough(FindPlace(request, source), request.plane, source);
    scene.planes.push_back(
      { DrawSlice(*source.scan, projection, WindowFromText(settings.slice.window, *source.scan), { 0, 0, 0, 0 }),
        projection });
  }
}

SceneSlice
CutScene(const PictureScene & scene,
         const PlaneRequest & request,
         const Vector3 & point,
         const SliceSettings & settings)
{
  SceneSlice slice;
  SheetPicture & picture = slice.picture;
  picture.projection = SliceThrough(point, scene.box, FrameOf(request.plane, settings.convention));
  const double grey = scene.scan ? 0.0 : GreyOfNoScan / 255.0;
  picture.background = { { grey, grey, grey } };
  for (const SceneSurface & surface : scene.surfaces)
  {
    std::vector<Outline> outlines =
      settings.outlines ? CutSurface(*surface.surface, picture.projection) : std::vector<Outline>();
    for (Outline & outline : outlines)
    {
      picture.outlines.push_back({ std::move(outline.points), LineColourOnDark(surface.colour), outline.isClosed });
    }
    slice.isSeen.push_back(!outlines.empty());
  }
  constexpr Colour white{ 1.0, 1.0, 1.0 };
  for (const SceneSurface & surface : scene.drawnAsLines)
  {
    for (Outline & outline : CutSurface(*surface.surface, picture.projection))
    {
      picture.outlines.push_back({ std::move(outline.points), white, outline.isClosed });
    }
  }
  const std::size_t axis = AxisOf(request.plane);
  picture.caption =
    NameOf(request.plane) + (settings.convention == SliceConvention::Neurological ? " (neurological)" : "");
  picture.position = std::string(1, "xyz"[axis]) + " = " + FormatFixed(point[axis], 1) + " mm";
  return slice;
}

void
DrawSceneSlice(const PictureScene & scene,
               const SliceSettings & settings,
               int width,
               int height,
               const Margins & margins,
               SheetPicture & slice)
{
  const Projection before = slice.projection;
  slice.projection = SliceOfSize(width, height, before.centre, scene.box, before.frame, margins);
  for (ColouredOutline & outline : slice.outlines)
  {
    for (PicturePosition & position : outline.points)
    {
      position = slice.projection.PositionOf(before.PointAt(position));
    }
  }
  slice.picture = scene.scan ? DrawSlice(*scene.scan, slice.projection, WindowFromText(settings.window, *scene.scan))
                             : FillAreas(scene, slice.projection);
}

double
AspectOfSlice(const PictureScene & scene, const PlaneRequest & request, const Vector3 & point)
{
  const Projection whole = SliceThrough(point, scene.box, FrameOf(request.plane));
  return static_cast<double>(whole.height) / static_cast<double>(whole.width);
}

} // namespace rhombic
