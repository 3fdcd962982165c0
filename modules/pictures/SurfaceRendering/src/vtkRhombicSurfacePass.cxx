#include "vtkRhombicSurfacePass.h"

#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicTranslucentPass.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkRhombicSurfacePass);

vtkRhombicSurfacePass::vtkRhombicSurfacePass()
{
  const vtkNew<vtkRhombicOpaquePass> opaque;
  const vtkNew<vtkRhombicTranslucentPass> translucent;
  translucent->SetOpaquePass(opaque);
  this->SetOpaquePass(opaque);
  this->SetTranslucentPass(translucent);
}

vtkRhombicOpaquePass *
vtkRhombicSurfacePass::GetSurfaces()
{
  return vtkRhombicOpaquePass::SafeDownCast(this->OpaquePass);
}
