#ifndef rhombicSeenSurfaces_h
#define rhombicSeenSurfaces_h

#include "rhombicScene.h"

#include <vector>

namespace rhombic
{

/** Which surfaces of a scene can be seen in a view, in their order: those that are in front in at least three pixels of
 * a picture with 600 pixels along its longer side. Opaque surfaces hide what is behind them, translucent ones and
 * planes hide nothing; of several surfaces in one place the first is seen. What cuts remove is not there.
 *
 * Time is linear in the triangles, and does not depend on the size of the picture. Thread safe. */
std::vector<bool>
FindSeenSurfaces(const Scene & scene, const Projection & projection);

} // namespace rhombic

#endif
