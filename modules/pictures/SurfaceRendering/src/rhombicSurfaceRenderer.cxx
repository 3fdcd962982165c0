#include "rhombicSurfaceRenderer.h"

#include "rhombicCameraFit.h"
#include "rhombicFailure.h"
#include "rhombicGLContext.h"
#include "rhombicSceneBuffers.h"
#include "rhombicSceneCheck.h"
#include "rhombicViewPasses.h"
#include "vtkRhombicMessages.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>

#include <mutex>
#include <new>

#include <vtk_glew.h>

namespace rhombic
{
namespace
{

/** Held while a renderer works: all renderers of the process share VTK's message window and GLEW's table of functions.
 * Then the caller's OpenGL context is current again. */
class Turn
{
public:
  Turn()
    : m_Lock(Mutex())
  {}

private:
  static std::mutex &
  Mutex()
  {
    static std::mutex mutex;
    return mutex;
  }

  const std::lock_guard<std::mutex> m_Lock;
  const CallersContext m_Caller;
};

/** A window for a context without a display. */
class Window : public vtkGenericOpenGLRenderWindow
{
public:
  static Window *
  New();

  bool
  IsInitialized() const
  {
    return this->Initialized;
  }

  /** GLEW looks up OpenGL's functions for VTK. Without a display it finds all but those of GLX, which nobody calls
   * here, and reports an error. Where the caller's program has called GLEW, its table stays as it is. */
  void
  OpenGLInitContext() override
  {
    const GLenum result = GLEW_VERSION_3_2 ? GLEW_OK : glewInit();
    this->GlewInitValid =
      result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY || result == GLEW_ERROR_GLX_VERSION_11_ONLY;
    this->Initialized = this->GlewInitValid;
    this->ContextCreationTime.Modified();
  }
};

vtkStandardNewMacro(Window);

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
    m_Window = vtkSmartPointer<Window>::New();
    m_Window->SetReadyForRendering(true);
    m_Window->SetIsCurrent(true);
    m_Window->SetSupportsOpenGL(1);
    m_Window->SetUseOffScreenBuffers(true);
    m_Window->SetShowWindow(false);
    m_Window->SwapBuffersOff();
    m_Window->OpenGLInit();
    if (!m_Window->IsInitialized())
    {
      throw Failure(
        FailureKind::Display,
        "GLEW finds no functions of OpenGL; install the Debian package libgl1 (rhombic doctor lists the ways "
        "to draw on this machine).");
    }
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

  std::vector<RenderedView>
  Draw(const Scene & scene, const RenderSettings & settings, const std::vector<Camera> & cameras)
  {
    const CurrentGLContext current(*m_Context.context);
    const vtkRhombicMessages::Scope messages;
    SceneBuffers buffers(scene, settings, m_Window);
    ViewPasses passes(scene, settings, m_Window);
    std::vector<RenderedView> rendered;
    for (const Camera & camera : cameras)
    {
      rendered.push_back(
        { passes.Draw(buffers, camera), settings.perspective ? std::nullopt : std::optional(camera.ToProjection()) });
      CheckErrors(messages);
    }
    return rendered;
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
  DescribedGLContext m_Context;
  vtkSmartPointer<Window> m_Window;
  int m_LargestSide = 0;
};

} // namespace

struct SurfaceRenderer::Implementation
{
  RenderBackend backend;
  std::unique_ptr<Canvas> canvas; ///< for the first picture
  std::string description;
  int largestSide; ///< samples
};

SurfaceRenderer::SurfaceRenderer(RenderBackend backend)
{
  const Turn turn;
  auto canvas = std::make_unique<Canvas>(backend);
  const std::string description = canvas->GetDescription();
  const int largestSide = canvas->GetLargestSide();
  m_Implementation.reset(new Implementation{ backend, std::move(canvas), description, largestSide });
}

SurfaceRenderer::~SurfaceRenderer()
{
  const Turn turn;
  m_Implementation.reset();
}

std::vector<RenderedView>
SurfaceRenderer::Render(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views)
{
  const Turn turn;
  try
  {
    const Scene drawable = DrawableScene(scene);
    rhombic::CheckSettings(settings, m_Implementation->largestSide);
    const auto cameras = FitCameras(drawable, settings, views);
    CheckSizes(cameras, settings.samples, m_Implementation->largestSide);
    std::uintmax_t held = MemoryToHoldScene(drawable);
    for (const Camera & camera : cameras)
    {
      RenderSettings sized = settings;
      sized.width = camera.width;
      sized.height = camera.height;
      RequireMemoryToDraw(sized, IsTranslucent(drawable), held);
      held += 4 * static_cast<std::uintmax_t>(camera.width) * static_cast<std::uintmax_t>(camera.height); // its picture
    }
    auto & first = m_Implementation->canvas;
    const auto canvas = first ? std::move(first) : std::make_unique<Canvas>(m_Implementation->backend);
    return canvas->Draw(drawable, settings, cameras);
  }
  catch (const std::bad_alloc &)
  {
    throw Failure(FailureKind::Memory,
                  "There is not enough memory to draw " + std::to_string(settings.width) + " x " +
                    std::to_string(settings.height) + " pixels of this scene; try fewer triangles, samples or pixels.");
  }
}

std::vector<Projection>
SurfaceRenderer::Plan(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views)
{
  std::vector<Projection> projections;
  for (const Camera & camera : FitCameras(scene, settings, views))
  {
    projections.push_back(camera.ToProjection());
  }
  return projections;
}

void
SurfaceRenderer::CheckSettings(const RenderSettings & settings, bool isTranslucent) const
{
  rhombic::CheckSettings(settings, m_Implementation->largestSide);
  RequireMemoryToDraw(settings, isTranslucent, 0);
}

std::uintmax_t
SurfaceRenderer::EstimateMemory(const Scene & scene, const RenderSettings & settings)
{
  const Scene drawable = DrawableScene(scene);
  return MemoryToDraw(settings, IsTranslucent(drawable), MemoryToHoldScene(drawable));
}

std::string
SurfaceRenderer::GetBackendDescription() const
{
  return m_Implementation->description;
}

std::vector<BackendProbe>
SurfaceRenderer::ProbeBackends()
{
  const Turn turn;
  return ProbeGLContexts();
}

} // namespace rhombic
