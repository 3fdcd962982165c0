#ifndef rhombicOrientationFigure_h
#define rhombicOrientationFigure_h

#include "rhombicDrawing.h"

namespace rhombic
{

/** Draws a standing human figure as a view sees it, in a square place. The face is light, so that front and back
 * differ. */
void
DrawOrientationFigure(Drawing & drawing, const Rectangle & place, const ViewFrame & frame, const Ink & outline);

} // namespace rhombic

#endif
