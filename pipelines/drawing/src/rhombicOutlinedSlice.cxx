#include "rhombicOutlinedSlice.h"

#include "rhombicOutline.h"
#include "rhombicSlicePicture.h"
#include "rhombicWording.h"

namespace rhombic
{

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
                             : Picture(width, height);
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
