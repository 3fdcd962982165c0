#ifndef rhombicSceneCheck_h
#define rhombicSceneCheck_h

#include "rhombicCameraFit.h"

#include <cstdint>
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

/** Bytes that OpenGL needs for points and triangles while it draws them, without those of the surfaces themselves. */
std::uintmax_t
MemoryToHold(std::uintmax_t points, std::uintmax_t triangles);

/** The same for the triangles and planes of a scene while it draws them, without those of the scene itself. */
std::uintmax_t
MemoryToHoldScene(const Scene & scene);

/** The largest number of bytes that drawing one view needs at a time, including its picture; a side of 0 pixels counts
 * as 1200. Measured with Mesa's software renderer; a graphics card has its own memory.
 * \param sceneBytes the result of MemoryToHoldScene() */
std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

/** Throws Failure(Memory) when MemoryToDraw() is more than settings.maximumMemory allows, naming a size of the same
 * shape that would fit. */
void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

} // namespace rhombic

#endif
