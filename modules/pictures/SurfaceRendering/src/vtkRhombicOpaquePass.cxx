#include "vtkRhombicOpaquePass.h"

#include "rhombicPassParts.h"

#include <vtkObjectFactory.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

vtkStandardNewMacro(vtkRhombicOpaquePass);

vtkCxxSetObjectMacro(vtkRhombicOpaquePass, OtherPass, vtkRenderPass);

vtkRhombicOpaquePass::vtkRhombicOpaquePass()
  : OtherPass(vtkOpaquePass::New())
  , Internals(std::make_unique<Parts>())
{}

vtkRhombicOpaquePass::~vtkRhombicOpaquePass()
{
  this->SetOtherPass(nullptr);
}

void
vtkRhombicOpaquePass::Render(const vtkRenderState * state)
{
  const rhombic::SortedProps props(state);
  this->NumberOfRenderedProps = rhombic::RenderOthers(this->OtherPass, state, props.others);
  vtkRenderer * const renderer = state->GetRenderer();
  auto * const window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const rhombic::Viewport viewport = rhombic::ViewportOf(state);
  if (props.surfaces.empty() || viewport.width < 1 || viewport.height < 1)
  {
    return;
  }
  const rhombic::CameraMatrices camera(renderer, viewport.width, viewport.height);
  Parts & parts = *this->Internals;
  parts.Use(window);
  parts.actors.SetActors(props.surfaces, camera, rhombic::LookOf(this, renderer));
  parts.samples.DrawOpaque(parts.actors, camera, rhombic::SamplesOf(this), viewport, window);
  this->NumberOfRenderedProps += parts.actors.NumberOf(false);
}

void
vtkRhombicOpaquePass::ReleaseGraphicsResources(vtkWindow * window)
{
  if (this->OtherPass)
  {
    this->OtherPass->ReleaseGraphicsResources(window);
  }
  this->Internals->Release();
}

void
vtkRhombicOpaquePass::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lights: " << this->Lights << '\n';
  os << indent << "Samples: " << this->Samples << '\n';
  os << indent << "AmbientOcclusion: " << this->AmbientOcclusion << '\n';
  os << indent << "Silhouettes: " << this->Silhouettes << '\n';
  os << indent << "StraightAlpha: " << this->StraightAlpha << '\n';
  os << indent << "OtherPass: " << this->OtherPass << '\n';
}
