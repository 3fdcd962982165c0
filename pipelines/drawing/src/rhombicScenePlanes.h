#ifndef rhombicScenePlanes_h
#define rhombicScenePlanes_h

#include "rhombicPictureScene.h"
#include "rhombicRenderScan.h"
#include "rhombicSheet.h"

namespace rhombic
{

/** Cuts a scene: adds clip planes, and in each of them the greys of the scan inside the surfaces that are cut, in their
 * colours where there is no scan. Throws Failure(Usage) for a plane that does not meet the scene. */
void
AddCuts(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

/** Adds slices that stand in the scene. */
void
AddPlanes(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

/** A slice of the scan in greys, black without a scan, and the curves along which it cuts the surfaces, in their
 * colours, fitted into so many pixels. */
SheetPicture
DrawOutlinedSlice(const PictureScene & scene,
                  const PlaneRequest & request,
                  const Vector3 & point,
                  const SliceSettings & settings,
                  int width,
                  int height);

} // namespace rhombic

#endif
