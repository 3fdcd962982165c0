#ifndef rhombicOrientationLabels_h
#define rhombicOrientationLabels_h

#include "rhombicScene.h"

#include <vtkRenderer.h>

namespace rhombic
{

/** Pixels of the picture that the letters need at each edge. */
double
OrientationLabelMargin(const RenderSettings & settings);

/** Writes the view's letters at the middle of the picture's edges, black or white against the background. */
void
AddOrientationLabels(const RenderSettings & settings, vtkRenderer * renderer);

} // namespace rhombic

#endif
