#ifndef rhombicSurfaceActor_h
#define rhombicSurfaceActor_h

#include "rhombicScene.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace rhombic
{

/** Draws the surface in its colour and opacity. The surface must not change as long as the actor lives. */
vtkSmartPointer<vtkActor>
MakeSurfaceActor(const SceneSurface & item);

} // namespace rhombic

#endif
