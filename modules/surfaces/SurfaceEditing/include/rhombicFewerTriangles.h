#ifndef rhombicFewerTriangles_h
#define rhombicFewerTriangles_h

#include "rhombicSceneSurface.h"

#include <vector>

namespace rhombic
{

/** Surfaces to look at, in fewer triangles: about as near to the surfaces as a distance in mm by which a picture does
 * not change (itk::SimplifySheetForRendering()). Points are some of those of the surfaces, with their normals, colours
 * and values. Walls that two surfaces share are simplified once, so that the surfaces still share them; triangles at
 * the curves where walls meet stay, so that closed surfaces stay closed.
 *
 * \param surfaces which stay as they are
 * \param distance mm, above 0
 * \param leastShare of the triangles of each wall, 0 to 1
 *
 * Time nearly linear, on several threads; memory about 150 bytes a triangle. The same bytes for any number of threads.
 */
std::vector<SceneSurface>
InFewerTriangles(const std::vector<SceneSurface> & surfaces, double distance, double leastShare = 0.0);

} // namespace rhombic

#endif
