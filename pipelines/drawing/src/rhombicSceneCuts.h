#ifndef rhombicSceneCuts_h
#define rhombicSceneCuts_h

#include "rhombicPictureScene.h"
#include "rhombicRenderScan.h"

namespace rhombic
{

/** Cuts a scene: adds clip planes, and in each of them the greys of the scan inside the surfaces that are cut, in their
 * colours where there is no scan. Throws Failure(Usage) for a plane that does not meet the scene. */
void
AddCuts(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

/** Adds slices that stand in the scene. */
void
AddPlanes(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

} // namespace rhombic

#endif
