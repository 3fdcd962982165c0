#ifndef rhombicSceneCheck_h
#define rhombicSceneCheck_h

#include "rhombicScene.h"

#include <vector>

namespace rhombic
{

/** Throws Failure(Usage) for a setting out of range, or more samples than \a largestSide across. */
void
CheckSettings(const RenderSettings & settings, int largestSide);

/** The surfaces that have triangles. Throws Failure: Empty when there is none, Usage for a look out of range. */
std::vector<SceneSurface>
DrawableSurfaces(const std::vector<SceneSurface> & scene);

/** Whether light passes through any of the surfaces. */
bool
IsTranslucent(const std::vector<SceneSurface> & scene);

} // namespace rhombic

#endif
