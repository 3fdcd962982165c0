#ifndef rhombicOrientationLabels_h
#define rhombicOrientationLabels_h

#include "rhombicScene.h"

#include <vtkRenderer.h>

namespace rhombic
{

/** Width in pixels of the margin that the letters need at each edge of the picture. */
double
OrientationLabelMargin(const RenderSettings & settings);

/** Adds the view's letters at the middle of the picture's edges, dark or bright depending on the background. */
void
AddOrientationLabels(const RenderSettings & settings, vtkRenderer * renderer);

} // namespace rhombic

#endif
