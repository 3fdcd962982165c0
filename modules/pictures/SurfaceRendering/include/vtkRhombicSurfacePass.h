#ifndef vtkRhombicSurfacePass_h
#define vtkRhombicSurfacePass_h

#include <vtkRenderStepsPass.h>

class vtkRhombicOpaquePass;

/**
 * @class vtkRhombicSurfacePass
 * @brief All steps of a picture, with surfaces drawn by vtkRhombicOpaquePass and vtkRhombicTranslucentPass.
 *
 *     renderer->SetPass(vtkNew<vtkRhombicSurfacePass>());
 *
 * The steps are those of vtkRenderStepsPass: camera, lights, opaque and translucent props, volumes, overlays. What the
 * two passes of Rhombic do not draw is drawn by VTK's own, see their classes. A vtkHardwareSelector selects as in a
 * renderer without passes (by vtkRenderStepsPass it selects nothing).
 */
class vtkRhombicSurfacePass : public vtkRenderStepsPass
{
public:
  static vtkRhombicSurfacePass *
  New();
  vtkTypeMacro(vtkRhombicSurfacePass, vtkRenderStepsPass);

  void
  Render(const vtkRenderState * state) override;

  /** The pass with the settings of this one: lights, samples, ambient occlusion, silhouettes. */
  vtkRhombicOpaquePass *
  GetSurfaces();

protected:
  vtkRhombicSurfacePass();
  ~vtkRhombicSurfacePass() override = default;

private:
  vtkRhombicSurfacePass(const vtkRhombicSurfacePass &) = delete;
  void
  operator=(const vtkRhombicSurfacePass &) = delete;
};

#endif
