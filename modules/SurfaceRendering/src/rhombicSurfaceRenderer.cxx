#include "rhombicSurfaceRenderer.h"

#include "rhombicDrawingMemory.h"
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

#include <algorithm>
#include <mutex>
#include <new>

#include <GL/gl.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace rhombic
{
namespace
{

/** Locked while a renderer works: all renderers of the process share VTK's message window and GLEW's table of
 * functions.
 */
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
        "; try a smaller picture (rhombic doctor lists the ways to draw on this machine).");
  }
}

/** \class RendererInWindow
 * \brief A renderer in a window. The destructor removes it, which frees its memory on the graphics card. */
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

/** \class Canvas
 * \brief An OpenGL context with an offscreen window. Mesa frees the textures of a picture only when the context is
 * destroyed. */
class Canvas
{
public:
  explicit Canvas(RenderBackend backend)
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
    m_Window->SetMultiSamples(0); // MeanOfSamples() smooths instead
    m_Window->SwapBuffersOff();
  }

  ~Canvas()
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
      // The context does not work any more, so its memory on the graphics card is gone.
    }
  }

  Canvas(const Canvas &) = delete;
  Canvas &
  operator=(const Canvas &) = delete;

  Picture
  Draw(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
  {
    const CurrentGLContext current(*m_Context.context);
    const vtkRhombicMessages::Scope messages;
    m_Window->SetSize(settings.width * settings.samples, settings.height * settings.samples);
    const RendererInWindow stage(m_Window, SetStage(scene, settings));
    m_Window->Render();
    Picture picture = ReadWindow(settings);
    CheckErrors(messages);
    return picture;
  }

  const std::string &
  GetDescription() const
  {
    return m_Context.description;
  }

  int
  GetLargestSide() const
  {
    return m_LargestSide;
  }

private:
  /** Reads the samples band by band, which avoids a second copy of all of them. */
  Picture
  ReadWindow(const RenderSettings & settings) const
  {
    constexpr int bandRows = 32;
    const int columns = settings.width * settings.samples;
    Picture picture(settings.width, settings.height);
    vtkNew<vtkUnsignedCharArray> drawn;
    for (int top = 0; top < settings.height; top += bandRows)
    {
      const int rows = std::min(bandRows, settings.height - top);
      const int lowest = (settings.height - top - rows) * settings.samples;
      m_Window->GetPixelData(0, lowest, columns - 1, lowest + rows * settings.samples - 1, 0, drawn, 0);
      MeanOfSamples(drawn->GetPointer(0), settings.samples, top, rows, picture);
    }
    return picture;
  }

  DescribedGLContext m_Context;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> m_Window;
  int m_LargestSide = 0;
};

} // namespace

class SurfaceRenderer::Implementation
{
public:
  explicit Implementation(RenderBackend backend)
    : m_Backend(backend)
    , m_Canvas(std::make_unique<Canvas>(backend))
    , m_Description(m_Canvas->GetDescription())
    , m_LargestSide(m_Canvas->GetLargestSide())
  {}

  void
  Check(const RenderSettings & settings, bool isTranslucent, std::uintmax_t sceneBytes = 0) const
  {
    rhombic::CheckSettings(settings, m_LargestSide);
    RequireMemoryToDraw(settings, isTranslucent, sceneBytes);
  }

  Picture
  Render(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
  {
    const auto drawable = DrawableSurfaces(scene);
    Check(settings, IsTranslucent(drawable), MemoryToHoldScene(drawable));
    const auto canvas = m_Canvas ? std::move(m_Canvas) : std::make_unique<Canvas>(m_Backend);
    return canvas->Draw(drawable, settings);
  }

  const std::string &
  GetDescription() const
  {
    return m_Description;
  }

private:
  RenderBackend m_Backend;
  std::unique_ptr<Canvas> m_Canvas; ///< for the first picture
  std::string m_Description;
  int m_LargestSide;
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
SurfaceRenderer::CheckSettings(const RenderSettings & settings, bool isTranslucent) const
{
  m_Implementation->Check(settings, isTranslucent);
}

std::uintmax_t
SurfaceRenderer::EstimateMemory(const std::vector<SceneSurface> & scene, const RenderSettings & settings)
{
  const auto drawable = DrawableSurfaces(scene);
  return MemoryToDraw(settings, IsTranslucent(drawable), MemoryToHoldScene(drawable));
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
