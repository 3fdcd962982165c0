#ifndef rhombicSilhouette_h
#define rhombicSilhouette_h

#include "rhombicAnnotations.h"
#include "rhombicScene.h"

#include <vector>

namespace rhombic
{

/** The borders of surfaces as a view shows them, where each would hide all surfaces behind it: closed lines between
 * pixels, in the colour \a ink and without halos. They are a pixel exact. */
std::vector<ColouredOutline>
FindSilhouettes(const std::vector<SceneSurface> & surfaces, const Projection & projection, const Colour & ink);

} // namespace rhombic

#endif
