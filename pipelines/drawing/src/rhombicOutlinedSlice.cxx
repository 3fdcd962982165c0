#include "rhombicOutlinedSlice.h"

#include "rhombicCapPicture.h"
#include "rhombicOutline.h"
#include "rhombicSlicePicture.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rhombic
{
namespace
{

/** A slice without a scan: grey, with the areas inside the surfaces in their colours. Larger surfaces lie under smaller
 * ones, which may be inside them. */
Picture
FillAreas(const PictureScene & scene, const Projection & projection)
{
  constexpr std::uint8_t grey = 56;
  constexpr double tint = 0.55;
  std::vector<std::size_t> order(scene.surfaces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&scene](std::size_t a, std::size_t b) {
    return scene.rows[a].volume.value_or(0.0) > scene.rows[b].volume.value_or(0.0);
  });
  Picture slice(projection.width, projection.height);
  std::fill(slice.pixels.begin(), slice.pixels.end(), grey);
  std::vector<CapSurface> areas;
  for (const std::size_t n : order)
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

SheetPicture
DrawOutlinedSlice(const PictureScene & scene,
                  const PlaneRequest & request,
                  const Vector3 & point,
                  const SliceSettings & settings,
                  int width,
                  int height)
{
  SheetPicture slice;
  slice.projection = SliceOfSize(width, height, point, scene.box, FrameOf(request.plane, settings.convention));
  slice.picture = scene.scan ? DrawSlice(*scene.scan, slice.projection, WindowFromText(settings.window, *scene.scan))
                             : FillAreas(scene, slice.projection);
  for (const SceneSurface & surface : scene.surfaces)
  {
    if (!settings.outlines)
    {
      break;
    }
    for (Outline & outline : CutSurface(*surface.surface, slice.projection))
    {
      slice.outlines.push_back({ std::move(outline.points), surface.colour, outline.isClosed });
    }
  }
  const std::size_t axis = request.plane == SlicePlane::Axial ? 2 : request.plane == SlicePlane::Coronal ? 1 : 0;
  slice.caption =
    NameOf(request.plane) + (settings.convention == SliceConvention::Neurological ? " (neurological)" : "");
  slice.position = std::string(1, "xyz"[axis]) + " = " + FormatFixed(point[axis], 1) + " mm";
  return slice;
}

} // namespace rhombic
