#ifndef rhombicColourSurfaces_h
#define rhombicColourSurfaces_h

#include "rhombicColourBy.h"
#include "rhombicPictureSteps.h"

namespace rhombic
{

/** Sets the colours of the points of all surfaces, the scene's scale and its report. Notes give the range. Throws
 * Failure: Geometry for a volume that reaches no surface; Usage for one with unevenly spaced slices; and those of the
 * files. */
void
ColourSurfaces(const ColourBy & by, PictureScene & scene, const Events & events);

} // namespace rhombic

#endif
