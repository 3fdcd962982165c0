#include "rhombicSurfaceRenderer.h"

#include "rhombicFailure.h"
#include "rhombicGLContext.h"
#include "rhombicSampleMean.h"
#include "rhombicSceneCheck.h"
#include "rhombicStage.h"
#include "vtkRhombicMessages.h"

#include <vtkAutoInit.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <mutex>
#include <new>

#include <GL/gl.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace rhombic
{
namespace
{

/** VTK's message window and GLEW's function table are the process's, so renderers take turns. */
std::mutex &
Turn()
{
  static std::mutex turn;
  return turn;
}

void
CheckErrors(const vtkRhombicMessages::Scope & messages)
{
  const GLenum error = glGetError();
  if (error == GL_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  if (error != GL_NO_ERROR || !messages.GetFirstError().empty())
  {
    throw Failure(
      FailureKind::Display,
      "Drawing failed: " +
        (messages.GetFirstError().empty() ? "OpenGL error " + std::to_string(error) : messages.GetFirstError()) +
        "; try a smaller picture (rhombic doctor tells what draws here).");
  }
}

/** \class RendererInWindow
 * \brief Takes a renderer out of its window again, which frees what it holds on the graphics card. */
class RendererInWindow
{
public:
  RendererInWindow(vtkRenderWindow * window, vtkSmartPointer<vtkRenderer> renderer)
    : m_Window(window)
    , m_Renderer(std::move(renderer))
  {
    m_Window->AddRenderer(m_Renderer);
  }
  ~RendererInWindow()
  {
    m_Window->RemoveRenderer(m_Renderer);
  }

  RendererInWindow(const RendererInWindow &) = delete;
  RendererInWindow &
  operator=(const RendererInWindow &) = delete;

private:
  vtkRenderWindow * m_Window;
  vtkSmartPointer<vtkRenderer> m_Renderer;
};

} // namespace

class SurfaceRenderer::Implementation
{
public:
  explicit Implementation(RenderBackend backend)
    : m_Context(CreateGLContext(backend))
  {
    const CurrentGLContext current(*m_Context.context);
    const vtkRhombicMessages::Scope messages;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &m_LargestSide);
    m_Window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    m_Window->SetReadyForRendering(true);
    m_Window->SetIsCurrent(true);
    m_Window->SetSupportsOpenGL(1);
    m_Window->SetUseOffScreenBuffers(true);
    m_Window->SetShowWindow(false);
    m_Window->SetMultiSamples(0); // MeanOfSamples() does that
    m_Window->SwapBuffersOff();
  }

  ~Implementation()
  {
    try
    {
      const CurrentGLContext current(*m_Context.context);
      const vtkRhombicMessages::Scope messages;
      m_Window->Finalize();
      m_Window = nullptr;
    }
    catch (const Failure &)
    {
      // Without its context there is nothing of VTK's left to free on the graphics card.
    }
  }

  void
  Check(const RenderSettings & settings) const
  {
    rhombic::CheckSettings(settings, m_LargestSide);
  }

  Picture
  Render(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
  {
    Check(settings);
    const auto drawable = DrawableSurfaces(scene);
    const CurrentGLContext current(*m_Context.context);
    const vtkRhombicMessages::Scope messages;

    const int width = settings.width * settings.samples;
    const int height = settings.height * settings.samples;
    m_Window->SetSize(width, height);
    const RendererInWindow stage(m_Window, SetStage(drawable, settings));
    m_Window->Render();
    vtkNew<vtkUnsignedCharArray> drawn;
    m_Window->GetPixelData(0, 0, width - 1, height - 1, 0, drawn, 0);
    CheckErrors(messages);
    return MeanOfSamples(drawn->GetPointer(0), settings.width, settings.height, settings.samples);
  }

  const std::string &
  GetDescription() const
  {
    return m_Context.description;
  }

private:
  DescribedGLContext m_Context;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> m_Window;
  int m_LargestSide = 0;
};

SurfaceRenderer::SurfaceRenderer(RenderBackend backend)
{
  const std::lock_guard<std::mutex> lock(Turn());
  m_Implementation = std::make_unique<Implementation>(backend);
}

SurfaceRenderer::~SurfaceRenderer()
{
  const std::lock_guard<std::mutex> lock(Turn());
  m_Implementation.reset();
}

Picture
SurfaceRenderer::Render(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
{
  const std::lock_guard<std::mutex> lock(Turn());
  try
  {
    return m_Implementation->Render(scene, settings);
  }
  catch (const std::bad_alloc &)
  {
    throw Failure(FailureKind::Memory,
                  "There is not enough memory to draw " + std::to_string(settings.width) + " x " +
                    std::to_string(settings.height) + " pixels of this scene; try fewer triangles, samples or pixels.");
  }
}

void
SurfaceRenderer::CheckSettings(const RenderSettings & settings) const
{
  m_Implementation->Check(settings);
}

std::string
SurfaceRenderer::GetBackendDescription() const
{
  return m_Implementation->GetDescription();
}

std::vector<BackendProbe>
SurfaceRenderer::ProbeBackends()
{
  const std::lock_guard<std::mutex> lock(Turn());
  return ProbeGLContexts();
}

} // namespace rhombic
