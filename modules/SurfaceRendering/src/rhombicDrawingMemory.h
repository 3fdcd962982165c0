#ifndef rhombicDrawingMemory_h
#define rhombicDrawingMemory_h

#include "rhombicScene.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** Bytes that OpenGL takes for the triangles of a scene while it draws them, beside the surfaces themselves. */
std::uintmax_t
MemoryToHoldScene(const std::vector<SceneSurface> & scene);

/** Most bytes that drawing takes at a time, with the picture that comes out of it. As measured with Mesa's software
 * renderer; a graphics card has memory of its own.
 * \param sceneBytes what MemoryToHoldScene() says */
std::uintmax_t
MemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

/** Throws Failure(Memory) when MemoryToDraw() is more than settings.maximumMemory allows, naming a size of the same
 * shape that would fit. */
void
RequireMemoryToDraw(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes);

} // namespace rhombic

#endif
