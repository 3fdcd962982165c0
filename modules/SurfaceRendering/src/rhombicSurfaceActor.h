#ifndef rhombicSurfaceActor_h
#define rhombicSurfaceActor_h

#include "rhombicScene.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

namespace rhombic
{

/** Makes an actor with the surface's colour and opacity. The surface must not change during the actor's lifetime. */
vtkSmartPointer<vtkActor>
MakeSurfaceActor(const SceneSurface & item);

} // namespace rhombic

#endif
