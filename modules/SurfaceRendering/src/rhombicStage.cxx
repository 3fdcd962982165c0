#include "rhombicStage.h"

#include "rhombicCameraFit.h"
#include "rhombicOrientationLabels.h"
#include "rhombicSceneCheck.h"
#include "rhombicSurfaceActor.h"

#include <vtkBoundingBox.h>
#include <vtkLight.h>
#include <vtkNew.h>

#include <algorithm>

namespace rhombic
{
namespace
{

/** Pixels between the scene and the picture's edges: at most a quarter of the shorter side. */
double
MarginOf(const RenderSettings & settings)
{
  const int side = std::min(settings.width, settings.height);
  const double margin = settings.orientationLabels ? OrientationLabelMargin(settings) : 0.02 * side;
  return std::min(margin, 0.25 * side);
}

/** Adds a light that moves with the camera and points at its focal point, from (x, y, z): x is right, y is up, and the
 * viewer is at (0, 0, 1). */
void
AddLight(vtkRenderer * renderer, double x, double y, double z, double intensity)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetIntensity(intensity);
  renderer->AddLight(light);
}

void
AddLights(vtkRenderer * renderer)
{
  renderer->SetAutomaticLightCreation(false);
  AddLight(renderer, -0.45, 0.75, 1.0, 0.76); // key
  AddLight(renderer, 0.8, -0.3, 0.9, 0.20);   // fill
  AddLight(renderer, 0.0, 0.0, 1.0, 0.26);    // head
  AddLight(renderer, 0.9, 0.3, -0.6, 0.15);   // rim
  AddLight(renderer, -0.9, 0.3, -0.6, 0.15);  // rim
}

/** Length in mm of the diagonal of the box around the scene. */
double
DiagonalOf(const std::vector<SceneSurface> & scene)
{
  vtkBoundingBox box;
  for (const auto & item : scene)
  {
    box.AddBounds(item.surface->GetBounds().data());
  }
  return box.GetDiagonalLength();
}

/** Darkens cavities, which shows depth better than lights alone. */
void
AddAmbientOcclusion(const std::vector<SceneSurface> & scene, vtkRenderer * renderer)
{
  const double diagonal = DiagonalOf(scene);
  renderer->UseSSAOOn();
  renderer->SetSSAORadius(0.1 * diagonal);
  renderer->SetSSAOBias(0.004 * diagonal);
  renderer->SetSSAOKernelSize(16); // few, because each pixel has several samples
  renderer->SSAOBlurOn();
}

/** Sorts translucent surfaces by depth in each pixel. Each peel finds the nearest and the farthest wall that are left,
 * and draws every triangle again. Walls that are left after the last peel are blended without sorting, which can't be
 * seen between four near and four far walls. */
void
AddDepthPeeling(vtkRenderer * renderer)
{
  renderer->UseDepthPeelingOn();
  renderer->SetOcclusionRatio(0.0);     // peels until nothing changes,
  renderer->SetMaximumNumberOfPeels(4); // but at most so often
}

} // namespace

vtkSmartPointer<vtkRenderer>
SetStage(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(settings.background[0], settings.background[1], settings.background[2]);
  AddLights(renderer);
  for (const auto & item : scene)
  {
    renderer->AddActor(MakeSurfaceActor(item));
  }
  if (IsTranslucent(scene))
  {
    AddDepthPeeling(renderer);
  }
  if (settings.ambientOcclusion)
  {
    AddAmbientOcclusion(scene, renderer);
  }
  FitCamera(scene, settings, MarginOf(settings), renderer->GetActiveCamera());
  if (settings.orientationLabels)
  {
    AddOrientationLabels(settings, renderer);
  }
  return renderer;
}

} // namespace rhombic
