#include "vtkRhombicTranslucentPass.h"

#include "rhombicPassParts.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkTranslucentPass.h>

vtkStandardNewMacro(vtkRhombicTranslucentPass);

vtkCxxSetObjectMacro(vtkRhombicTranslucentPass, OpaquePass, vtkRhombicOpaquePass);
vtkCxxSetObjectMacro(vtkRhombicTranslucentPass, OtherPass, vtkRenderPass);

vtkRhombicTranslucentPass::vtkRhombicTranslucentPass()
  : OpaquePass(vtkRhombicOpaquePass::New())
  , OtherPass(vtkTranslucentPass::New())
{}

vtkRhombicTranslucentPass::~vtkRhombicTranslucentPass()
{
  this->SetOpaquePass(nullptr);
  this->SetOtherPass(nullptr);
}

void
vtkRhombicTranslucentPass::Render(const vtkRenderState * state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->OpaquePass)
  {
    vtkErrorMacro("There is no OpaquePass, which gives lights and samples.");
    return;
  }
  const rhombic::SortedProps props(state);
  vtkRenderer * const renderer = state->GetRenderer();
  auto * const window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const rhombic::Viewport viewport = rhombic::ViewportOf(state);
  if (!props.surfaces.empty() && viewport.width > 0 && viewport.height > 0)
  {
    const rhombic::CameraMatrices camera(renderer, viewport.width, viewport.height);
    vtkRhombicOpaquePass::Parts & parts = *this->OpaquePass->Internals;
    parts.Use(window);
    if (!rhombic::FragmentLists::AreSupported())
    {
      vtkErrorMacro("Translucent surfaces need OpenGL 4.3 with storage blocks of 64 MiB. Draw them opaque, or in a "
                    "vtkRhombicHeadlessRenderWindow.");
    }
    else
    {
      parts.actors.SetActors(props.surfaces, camera, rhombic::LookOf(this->OpaquePass, renderer));
      this->NumberOfRenderedProps = parts.actors.NumberOf(true);
      if (this->NumberOfRenderedProps > 0)
      {
        parts.samples.DrawTranslucent(parts.actors, rhombic::SamplesOf(this->OpaquePass), viewport, window);
      }
    }
  }
  this->NumberOfRenderedProps += rhombic::RenderOthers(this->OtherPass, state, props.others);
}

void
vtkRhombicTranslucentPass::ReleaseGraphicsResources(vtkWindow * window)
{
  if (this->OtherPass)
  {
    this->OtherPass->ReleaseGraphicsResources(window);
  }
  if (this->OpaquePass)
  {
    this->OpaquePass->ReleaseGraphicsResources(window);
  }
}

void
vtkRhombicTranslucentPass::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpaquePass: " << this->OpaquePass << '\n';
  os << indent << "OtherPass: " << this->OtherPass << '\n';
}
