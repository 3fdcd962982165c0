#ifndef vtkRhombicTranslucentPass_h
#define vtkRhombicTranslucentPass_h

#include <vtkRenderPass.h>

class vtkRhombicOpaquePass;

/**
 * @class vtkRhombicTranslucentPass
 * @brief Draws translucent surfaces, sorted by depth in each sample, up to 32 behind each other.
 *
 * This pass draws translucent actors of the kinds that vtkRhombicOpaquePass draws, and unlit translucent actors with a
 * texture of bytes, as pictures that stand in the scene. The surfaces are hidden by everything opaque that the
 * framebuffer holds in front of them, whoever has drawn it. All other translucent props are drawn by OtherPass, after
 * the surfaces, so they lie over them. A volume inside a translucent surface can't be ordered: draw it with
 * vtkVolumetricPass afterwards, and it lies over the surface. OpenGL 4.3 is needed, which Mesa's software has, too; in
 * older contexts Render() reports an error of VTK and draws OtherPass alone.
 *
 * With lights of the renderer, surfaces are blended as VTK blends them. With the lights that go with the camera, only
 * the near walls of surfaces are drawn, and opacity follows the angle between wall and viewer: it is low where the wall
 * faces the viewer, so that what is inside is clear, and 1 at the outline, so that the shape is seen. With an actor's
 * opacity o, it is Schlick's form of Fresnel's reflection (An inexpensive BRDF model for physically-based rendering,
 * Computer Graphics Forum 13, 1994),
 *
 *     f + (1 - f) (1 - cos angle)^p, f = max(o / 2, 1.2 o - 0.2), p = max(2, (sqrt(16 / o - 7) - 3) / 2)
 *
 * whose exponent p, 5 for glass, is such that the mean over the picture of a ball is o. Below an opacity of 1/4 it is
 * that of 1/4 times 4 o, so that outlines of faint surfaces are faint, too.
 *
 * @sa vtkRhombicOpaquePass vtkRhombicSurfacePass
 */
class vtkRhombicTranslucentPass : public vtkRenderPass
{
public:
  static vtkRhombicTranslucentPass *
  New();
  vtkTypeMacro(vtkRhombicTranslucentPass, vtkRenderPass);
  void
  PrintSelf(ostream & os, vtkIndent indent) override;

  void
  Render(const vtkRenderState * state) override;

  void
  ReleaseGraphicsResources(vtkWindow * window) override;

  ///@{
  /** The pass that gives lights and samples. If it has drawn opaque surfaces before, in the same picture, their edges
   * behind translucent surfaces are as smooth as without these. By default a pass with default settings that
   * draws nothing. Must not be null. */
  void
  SetOpaquePass(vtkRhombicOpaquePass * pass);
  vtkGetObjectMacro(OpaquePass, vtkRhombicOpaquePass);
  ///@}

  ///@{
  /** Draws the translucent props that this pass does not draw; a vtkTranslucentPass by default. May be null. */
  void
  SetOtherPass(vtkRenderPass * pass);
  vtkGetObjectMacro(OtherPass, vtkRenderPass);
  ///@}

protected:
  vtkRhombicTranslucentPass();
  ~vtkRhombicTranslucentPass() override;

  vtkRhombicOpaquePass * OpaquePass = nullptr;
  vtkRenderPass * OtherPass = nullptr;

private:
  vtkRhombicTranslucentPass(const vtkRhombicTranslucentPass &) = delete;
  void
  operator=(const vtkRhombicTranslucentPass &) = delete;
};

#endif
