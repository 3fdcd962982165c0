#include "vtkRhombicSurfacePass.h"

#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicTranslucentPass.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

vtkStandardNewMacro(vtkRhombicSurfacePass);

vtkRhombicSurfacePass::vtkRhombicSurfacePass()
{
  const vtkNew<vtkRhombicOpaquePass> opaque;
  const vtkNew<vtkRhombicTranslucentPass> translucent;
  translucent->SetOpaquePass(opaque);
  this->SetOpaquePass(opaque);
  this->SetTranslucentPass(translucent);
}

void
vtkRhombicSurfacePass::Render(const vtkRenderState * state)
{
  vtkRenderer * const renderer = state->GetRenderer();
  if (!renderer->GetSelector())
  {
    this->Superclass::Render(state);
    return;
  }
  this->UpdateCamera(renderer);
  this->UpdateLightGeometry(renderer);
  this->UpdateLights(renderer);
  this->UpdateGeometry(renderer, state->GetFrameBuffer());
}

vtkRhombicOpaquePass *
vtkRhombicSurfacePass::GetSurfaces()
{
  return vtkRhombicOpaquePass::SafeDownCast(this->OpaquePass);
}
