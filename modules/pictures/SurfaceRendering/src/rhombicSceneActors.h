#ifndef rhombicSceneActors_h
#define rhombicSceneActors_h

#include "rhombicCameraFit.h"

#include <vtkSmartPointer.h>

class vtkRenderer;

namespace rhombic
{

/** A scene as a renderer of VTK: surfaces, cuts and pictures become actors with clipping planes and textures, which
 * share the scene's memory, so the scene must outlive the renderer. Background, lights and effects are those of \a
 * settings; the pass is a vtkRhombicSurfacePass. */
vtkSmartPointer<vtkRenderer>
MakeRenderer(const Scene & scene, const RenderSettings & settings);

/** Gives a renderer of MakeRenderer() the camera of a picture; its window has the size of the picture. */
void
SetCamera(const Camera & camera, const Scene & scene, vtkRenderer * renderer);

} // namespace rhombic

#endif
