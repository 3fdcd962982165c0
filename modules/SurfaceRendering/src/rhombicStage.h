#ifndef rhombicStage_h
#define rhombicStage_h

#include "rhombicScene.h"

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace rhombic
{

/** Surfaces, lights, camera and letters, ready to be drawn by a window of width x height times samples. */
vtkSmartPointer<vtkRenderer>
SetStage(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

} // namespace rhombic

#endif
