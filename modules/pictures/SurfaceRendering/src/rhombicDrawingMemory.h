#ifndef rhombicDrawingMemory_h
#define rhombicDrawingMemory_h

#include "rhombicScene.h"

#include <cstdint>

namespace rhombic
{

/** Bytes that OpenGL needs for the triangles and planes of a scene while it draws them, without those of the scene
 * itself. */
std::uintmax_t
MemoryToHoldScene(const Scene & scene);

/** The largest number of bytes that drawing one view needs at a time, including its picture; a side of 0 pixels counts
 * as 1200. Measured with Mesa's software
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
