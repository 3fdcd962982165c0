#ifndef rhombicSceneCheck_h
#define rhombicSceneCheck_h

#include "rhombicCameraFit.h"

#include <vector>

namespace rhombic
{

/** Throws Failure(Usage) for a setting out of range, and for more than \a largestSide samples along a side. */
void
CheckSettings(const RenderSettings & settings, int largestSide);

/** Throws Failure(Usage) for pictures of cameras that are larger than \a largestSide samples along a side. */
void
CheckSizes(const std::vector<Camera> & cameras, int samples, int largestSide);

/** The scene without surfaces that have no triangles. Throws Failure: Empty when nothing is left, Usage for a colour or
 * opacity out of range, for a cut without direction or of a surface that does not exist, for too many cuts, and for a
 * plane whose picture and projection differ in size. */
Scene
DrawableScene(const Scene & scene);

/** Whether the scene has planes or surfaces with an opacity below 1. */
bool
IsTranslucent(const Scene & scene);

} // namespace rhombic

#endif
