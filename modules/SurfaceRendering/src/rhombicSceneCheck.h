#ifndef rhombicSceneCheck_h
#define rhombicSceneCheck_h

#include "rhombicScene.h"

#include <vector>

namespace rhombic
{

/** Throws Failure(Usage) for a setting out of range, and for more than \a largestSide samples along a side. */
void
CheckSettings(const RenderSettings & settings, int largestSide);

/** The surfaces that have triangles. Throws Failure: Empty when there is none, Usage for a colour or opacity out of
 * range.
 */
std::vector<SceneSurface>
DrawableSurfaces(const std::vector<SceneSurface> & scene);

/** Whether any of the surfaces has an opacity below 1. */
bool
IsTranslucent(const std::vector<SceneSurface> & scene);

} // namespace rhombic

#endif
