#ifndef rhombicPassParts_h
#define rhombicPassParts_h

#include "rhombicSamplePasses.h"
#include "vtkRhombicOpaquePass.h"

class vtkRenderState;

/** What vtkRhombicOpaquePass keeps between pictures, and vtkRhombicTranslucentPass uses. */
struct vtkRhombicOpaquePass::Parts
{
  Parts() = default;
  ~Parts();
  Parts(const Parts &) = delete;
  Parts &
  operator=(const Parts &) = delete;

  /** Draws in this window from now on. What another window has is freed. */
  void
  Use(vtkOpenGLRenderWindow * window);

  /** Frees what the window has, with the window's context. Called by a window that is deleted. */
  void
  Release();

  rhombic::ActorBuffers actors;
  rhombic::SamplePasses samples;

private:
  vtkOpenGLRenderWindow * m_Window = nullptr; // alive, see Release()
  unsigned long m_DeleteObserver = 0;
};

namespace rhombic
{

/** The props of a render state: the actors that Rhombic's passes draw, and the rest. */
struct SortedProps
{
  /** Without \a state's props that lack its keys. All are others during a hardware selection. */
  explicit SortedProps(const vtkRenderState * state);

  std::vector<vtkActor *> surfaces; ///< opaque and translucent
  std::vector<vtkProp *> others;
};

/** Draws props by another pass. Returns the number of props that it has drawn. */
int
RenderOthers(vtkRenderPass * pass, const vtkRenderState * state, std::vector<vtkProp *> props);

/** The part of the framebuffer that a state draws to. */
Viewport
ViewportOf(const vtkRenderState * state);

ActorLook
LookOf(vtkRhombicOpaquePass * pass, vtkRenderer * renderer);

SampleSettings
SamplesOf(vtkRhombicOpaquePass * pass);

} // namespace rhombic

#endif
