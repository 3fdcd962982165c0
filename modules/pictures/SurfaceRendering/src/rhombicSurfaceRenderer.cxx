#include "rhombicSurfaceRenderer.h"

#include "rhombicCameraFit.h"
#include "rhombicFailure.h"
#include "rhombicSceneActors.h"
#include "rhombicSceneCheck.h"
#include "vtkRhombicHeadlessRenderWindow.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkRenderer.h>
#include <vtkTextureObject.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <sstream>
#include <thread>

namespace rhombic
{
namespace
{

/** Held while a renderer works: all renderers of the process share VTK's message window and GLEW's table of functions.
 */
std::lock_guard<std::mutex>
TakeTurn()
{
  static std::mutex mutex;
  return std::lock_guard<std::mutex>(mutex);
}

/** VTK's message window while a renderer works. Messages of other threads go to the window before it. */
class MessageWindow : public vtkOutputWindow
{
public:
  static MessageWindow *
  New();

  void
  DisplayText(const char * text) override
  {
    if (std::this_thread::get_id() != m_Thread)
    {
      m_Previous->DisplayText(text);
    }
    else if (this->GetCurrentMessageType() == MESSAGE_TYPE_ERROR && m_FirstError.empty())
    {
      // VTK writes "ERROR: In <file>, line <n>\n<class> (<address>): <message>\n\n".
      std::istringstream lines(text);
      std::getline(lines, m_FirstError);
      std::getline(lines, m_FirstError);
      const auto start = m_FirstError.find("): ");
      m_FirstError.erase(0, start == std::string::npos ? 0 : start + 3);
    }
  }

  const vtkSmartPointer<vtkOutputWindow> m_Previous = vtkOutputWindow::GetInstance();
  const std::thread::id m_Thread = std::this_thread::get_id();
  std::string m_FirstError; ///< without file, line and class; empty if there is none
};

vtkStandardNewMacro(MessageWindow);

/** \class CaughtMessages
 * \brief Catches the messages of VTK on this thread during the lifetime of this object. VTK's log of errors on the
 * terminal is off for all threads meanwhile. */
class CaughtMessages
{
public:
  CaughtMessages()
  {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkOutputWindow::SetInstance(m_Window);
  }
  ~CaughtMessages()
  {
    vtkOutputWindow::SetInstance(m_Window->m_Previous);
    vtkLogger::SetStderrVerbosity(m_PreviousVerbosity);
  }

  CaughtMessages(const CaughtMessages &) = delete;
  CaughtMessages &
  operator=(const CaughtMessages &) = delete;

  /** Throws std::bad_alloc, or Failure(Display), if OpenGL or VTK has reported an error. */
  void
  CheckErrors(vtkRhombicHeadlessRenderWindow * window) const
  {
    window->CheckErrors();
    if (const std::string & message = m_Window->m_FirstError; !message.empty())
    {
      throw Failure(FailureKind::Display,
                    "Drawing failed: " + message +
                      "; try a smaller picture (rhombic doctor lists the ways to draw on this machine).");
    }
  }

private:
  const vtkLogger::Verbosity m_PreviousVerbosity = vtkLogger::GetCurrentVerbosityCutoff();
  const vtkSmartPointer<MessageWindow> m_Window = vtkSmartPointer<MessageWindow>::New();
};

/** Makes the context of a window current until the result is destroyed: then the caller's context is current again. */
std::shared_ptr<const void>
MakeCurrent(vtkOpenGLRenderWindow * window)
{
  window->PushContext();
  return std::shared_ptr<vtkOpenGLRenderWindow>(window, [](auto * pushed) { pushed->PopContext(); });
}

/** \class Canvas
 * \brief An offscreen window. Mesa frees the textures of a picture only when the window's context is destroyed. */
class Canvas
{
public:
  explicit Canvas(RenderBackend backend)
  {
    m_Window->SetBackend(backend);
    m_Window->SetMultiSamples(0); // the passes have samples of their own
    m_Window->SetAlphaBitPlanes(1);
    m_Window->SwapBuffersOff();
    if (!m_Window->SupportsOpenGL())
    {
      throw Failure(FailureKind::Display, m_Window->GetOpenGLSupportMessage());
    }
    const auto current = MakeCurrent(m_Window);
    largestSide = vtkTextureObject::GetMaximumTextureSize(m_Window);
  }

  ~Canvas()
  {
    const CaughtMessages messages;
    m_Window->Finalize();
  }

  Canvas(const Canvas &) = delete;
  Canvas &
  operator=(const Canvas &) = delete;

  void
  Draw(const Scene & scene,
       const RenderSettings & settings,
       const std::vector<Camera> & cameras,
       const std::function<void(RenderedView)> & take)
  {
    const CaughtMessages messages;
    const auto current = MakeCurrent(m_Window);
    messages.CheckErrors(m_Window);
    const auto renderer = MakeRenderer(scene, settings);
    m_Window->AddRenderer(renderer);
    for (const Camera & camera : cameras)
    {
      m_Window->SetSize(camera.width, camera.height);
      SetCamera(camera, scene, renderer);
      m_Window->Render();
      RenderedView view{ ReadPicture(settings),
                         settings.perspective ? std::nullopt : std::optional(camera.ToProjection()) };
      messages.CheckErrors(m_Window);
      take(std::move(view));
    }
    m_Window->RemoveRenderer(renderer);
  }

  /** Backend, renderer and OpenGL version. */
  std::string
  GetDescription() const
  {
    return m_Window->GetOpenGLSupportMessage();
  }

  int largestSide = 0; ///< samples

private:
  Picture
  ReadPicture(const RenderSettings & settings)
  {
    const bool hasAlpha = settings.style == PictureStyle::Transparent;
    const int width = m_Window->GetSize()[0];
    const int height = m_Window->GetSize()[1];
    const vtkNew<vtkUnsignedCharArray> pixels;
    if (hasAlpha)
    {
      m_Window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels);
    }
    else
    {
      m_Window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0);
    }
    Picture picture(width, height, hasAlpha ? 4 : 3);
    const std::size_t rowBytes = picture.pixels.size() / static_cast<std::size_t>(height);
    for (int row = 0; row < height; ++row) // VTK's begin at the bottom
    {
      std::copy_n(pixels->GetPointer(static_cast<vtkIdType>(rowBytes) * (height - 1 - row)),
                  rowBytes,
                  picture.pixels.begin() + static_cast<std::ptrdiff_t>(rowBytes) * row);
    }
    return picture;
  }

  const vtkNew<vtkRhombicHeadlessRenderWindow> m_Window;
};

} // namespace

struct SurfaceRenderer::Implementation
{
  RenderBackend backend;
  std::string description;
  int largestSide;                ///< samples
  std::unique_ptr<Canvas> canvas; ///< for the first picture
};

SurfaceRenderer::SurfaceRenderer(RenderBackend backend)
{
  const auto turn = TakeTurn();
  auto canvas = std::make_unique<Canvas>(backend);
  m_Implementation.reset(
    new Implementation{ backend, canvas->GetDescription(), canvas->largestSide, std::move(canvas) });
}

SurfaceRenderer::~SurfaceRenderer()
{
  const auto turn = TakeTurn();
  m_Implementation.reset();
}

std::vector<RenderedView>
SurfaceRenderer::Render(const Scene & scene, const RenderSettings & settings, const std::vector<View> & views)
{
  std::vector<RenderedView> rendered;
  this->Render(scene, settings, views, [&rendered](RenderedView view) { rendered.push_back(std::move(view)); });
  return rendered;
}

void
SurfaceRenderer::Render(const Scene & scene,
                        const RenderSettings & settings,
                        const std::vector<View> & views,
                        const std::function<void(RenderedView)> & take)
{
  const auto turn = TakeTurn();
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
    canvas->Draw(drawable, settings, cameras, take);
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
SurfaceRenderer::CheckMemory(const RenderSettings & settings, bool isTranslucent, double triangles)
{
  const auto count = static_cast<std::uintmax_t>(triangles);
  const std::uintmax_t held = MemoryToHold(count / 2, count);
  RequireMemoryToDraw(settings, isTranslucent, held);
  return MemoryToDraw(settings, isTranslucent, held);
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
  const auto turn = TakeTurn();
  return vtkRhombicHeadlessRenderWindow::ProbeBackends();
}

} // namespace rhombic
