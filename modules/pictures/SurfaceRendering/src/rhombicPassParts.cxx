#include "rhombicPassParts.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkFrameBufferObjectBase.h>
#include <vtkOpenGLRenderer.h>
#include <vtkProp.h>
#include <vtkProperty.h>
#include <vtkRenderState.h>

vtkRhombicOpaquePass::Parts::~Parts()
{
  Release();
}

void
vtkRhombicOpaquePass::Parts::Use(vtkOpenGLRenderWindow * window)
{
  if (m_Window != window)
  {
    Release();
    m_Window = window;
    m_DeleteObserver = window->AddObserver(vtkCommand::DeleteEvent, this, &Parts::Release);
  }
}

void
vtkRhombicOpaquePass::Parts::Release()
{
  if (m_Window)
  {
    m_Window->RemoveObserver(m_DeleteObserver);
    m_Window->PushContext();
    actors.Release();
    samples.Release();
    m_Window->PopContext();
    m_Window = nullptr;
  }
}

namespace rhombic
{

SortedProps::SortedProps(const vtkRenderState * state)
{
  const bool isSelection = state->GetRenderer()->GetSelector() != nullptr;
  for (int n = 0; n < state->GetPropArrayCount(); ++n)
  {
    vtkProp * const prop = state->GetPropArray()[n];
    if (!prop->HasKeys(state->GetRequiredKeys()))
    {
      continue;
    }
    vtkActor * const surface = isSelection ? nullptr : CanDraw(prop);
    if (!surface)
    {
      others.push_back(prop);
    }
    else if (surface->GetProperty()->GetOpacity() > 0.0)
    {
      surfaces.push_back(surface);
    }
  }
}

int
RenderOthers(vtkRenderPass * pass, const vtkRenderState * state, std::vector<vtkProp *> props)
{
  if (!pass || props.empty())
  {
    return 0;
  }
  vtkRenderState rest(state->GetRenderer());
  rest.SetPropArrayAndCount(props.data(), static_cast<int>(props.size()));
  rest.SetFrameBuffer(state->GetFrameBuffer());
  rest.SetRequiredKeys(state->GetRequiredKeys());
  pass->Render(&rest);
  return pass->GetNumberOfRenderedProps();
}

Viewport
ViewportOf(const vtkRenderState * state)
{
  Viewport viewport;
  if (vtkFrameBufferObjectBase * const framebuffer = state->GetFrameBuffer())
  {
    framebuffer->GetLastSize(viewport.width, viewport.height);
    return viewport;
  }
  state->GetRenderer()->GetTiledSizeAndOrigin(&viewport.width, &viewport.height, &viewport.x, &viewport.y);
  return viewport;
}

ActorLook
LookOf(vtkRhombicOpaquePass * pass, vtkRenderer * renderer)
{
  ActorLook look;
  look.renderer = vtkOpenGLRenderer::SafeDownCast(renderer);
  if (pass->GetLights() == vtkRhombicOpaquePass::RendererLights)
  {
    look.light = SurfaceLight::Renderer;
    look.lights = { look.renderer->GetLightingUniforms(),
                    look.renderer->GetLightingComplexity(),
                    look.renderer->GetLightingCount() };
  }
  else if (pass->GetLights() == vtkRhombicOpaquePass::ClinicLights)
  {
    look.own = { { 0.68f, 0.24f, 0.20f, 0.16f }, { 0.07f, 0.0f }, { 0.14f, 0.40f } };
  }
  else
  {
    look.own = { { 0.48f, 0.24f, 0.39f, -0.06f }, { 0.03f, 0.0f }, { 0.10f, 0.28f } };
  }
  return look;
}

SampleSettings
SamplesOf(vtkRhombicOpaquePass * pass)
{
  const bool isClinic = pass->GetLights() == vtkRhombicOpaquePass::ClinicLights;
  return { pass->GetSamples(),
           pass->GetAmbientOcclusion(),
           pass->GetSilhouettes(),
           pass->GetStraightAlpha(),
           { isClinic ? 1.3f : 1.0f, isClinic ? 0.7f : 0.8f } };
}

} // namespace rhombic
