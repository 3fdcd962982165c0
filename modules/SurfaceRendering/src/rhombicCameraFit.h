#ifndef rhombicCameraFit_h
#define rhombicCameraFit_h

#include "rhombicScene.h"

#include <vtkCamera.h>

namespace rhombic
{

/** Places the camera for a view so that every point of the scene is inside a picture of width x height pixels, at least
 * \a margin pixels from each edge, and touches that margin at two opposite edges. */
void
FitCamera(const std::vector<SceneSurface> & scene, const RenderSettings & settings, double margin, vtkCamera * camera);

} // namespace rhombic

#endif
