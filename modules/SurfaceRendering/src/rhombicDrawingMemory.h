#ifndef rhombicDrawingMemory_h
#define rhombicDrawingMemory_h

#include "rhombicScene.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Bytes that OpenGL needs for the triangles of a scene while it draws them, without the surfaces themselves. */
std::uintmax_t
MemoryToHoldScene(const std::vector<SceneSurface> & scene);

/** The largest number of bytes that drawing needs at a time, including the picture. Measured with Mesa's software
 * renderer; a graphics card has its own memory.
 * \param sceneBytes the result of MemoryToHoldScene() */
std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

/** Throws Failure(Memory) when MemoryToDraw() is more than settings.maximumMemory allows, naming a size of the same
 * shape that would fit. */
void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

} // namespace rhombic

#endif
