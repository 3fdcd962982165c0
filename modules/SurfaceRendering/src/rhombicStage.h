#ifndef rhombicStage_h
#define rhombicStage_h

#include "rhombicScene.h"

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace rhombic
{

/** Makes a renderer with surfaces, lights, camera and letters, for a window of settings.samples times the picture's
 * width and height. */
vtkSmartPointer<vtkRenderer>
SetStage(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

} // namespace rhombic

#endif
