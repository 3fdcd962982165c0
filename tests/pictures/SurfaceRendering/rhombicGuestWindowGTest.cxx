#include "rhombicStockScenes.h"
#include "rhombicTestScenes.h"
#include "vtkRhombicHeadlessRenderWindow.h"

#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtk_glew.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2) // vtkRenderer and more draw by OpenGL

namespace
{

using namespace rhombic;
using namespace rhombic::test;

/** What is current on this thread for EGL. */
struct Current
{
  EGLenum api = eglQueryAPI();
  EGLContext context = eglGetCurrentContext();
  EGLDisplay display = eglGetCurrentDisplay();
  EGLSurface drawSurface = eglGetCurrentSurface(EGL_DRAW);
  EGLSurface readSurface = eglGetCurrentSurface(EGL_READ);

  bool
  operator==(const Current & other) const
  {
    return api == other.api && context == other.context && display == other.display &&
           drawSurface == other.drawSurface && readSurface == other.readSurface;
  }
};

/** A context of EGL that another part of the program has made current. */
class GuestContext
{
public:
  GuestContext()
    : m_Display(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr))
  {
    EXPECT_TRUE(eglInitialize(m_Display, nullptr, nullptr));
    EXPECT_TRUE(eglBindAPI(EGL_OPENGL_API));
    constexpr EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint count = 0;
    EXPECT_TRUE(eglChooseConfig(m_Display, wanted, &config, 1, &count) && count == 1);
    constexpr EGLint version[] = { EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE };
    m_Context = eglCreateContext(m_Display, config, EGL_NO_CONTEXT, version);
    constexpr EGLint size[] = { EGL_WIDTH, 8, EGL_HEIGHT, 8, EGL_NONE };
    for (EGLSurface & surface : m_Surfaces)
    {
      surface = eglCreatePbufferSurface(m_Display, config, size);
    }
    EXPECT_TRUE(eglMakeCurrent(m_Display, m_Surfaces[0], m_Surfaces[1], m_Context));
  }

  ~GuestContext()
  {
    eglMakeCurrent(m_Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(m_Display, m_Surfaces[0]);
    eglDestroySurface(m_Display, m_Surfaces[1]);
    eglDestroyContext(m_Display, m_Context);
  }

private:
  EGLDisplay m_Display;
  EGLContext m_Context = EGL_NO_CONTEXT;
  std::array<EGLSurface, 2> m_Surfaces{}; ///< to draw into and to read from
};

/** A window of VTK in a context of EGL. */
class GuestWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static GuestWindow *
  New();

  void
  OpenGLInitContext() override
  {
    const GLenum result = glewInit();
    EXPECT_TRUE(result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY) << result;
    this->GlewInitValid = true;
    this->Initialized = true;
  }

  /** A red sphere on blue. */
  void
  Show()
  {
    this->SetReadyForRendering(true);
    this->SetIsCurrent(true);
    this->SetSupportsOpenGL(1);
    this->SetUseOffScreenBuffers(true);
    this->SetShowWindow(false);
    this->SetSize(120, 90);
    vtkNew<vtkSphereSource> sphere;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    renderer->SetBackground(0.0, 0.0, 1.0);
    this->AddRenderer(renderer);
    this->Render();
  }

  std::vector<unsigned char>
  Read()
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    this->GetPixelData(0, 0, 119, 89, 0, pixels, 0);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }
};

vtkStandardNewMacro(GuestWindow);

TEST(GuestWindow, HasTheSamePixelsAfterEachCallOfARenderer)
{
  const GuestContext context;
  const Current current;
  vtkNew<GuestWindow> window;
  window->Show();
  const auto before = window->Read();
  ASSERT_EQ(before.size(), 120u * 90u * 3u);
  EXPECT_EQ(before[2], 255) << "the background is blue";
  const auto expectUnchanged = [&](const char * after) {
    EXPECT_TRUE(Current() == current) << after;
    EXPECT_EQ(window->Read(), before) << after;
    window->Render();
    EXPECT_EQ(window->Read(), before) << after << ", drawn again";
  };
  Picture picture;
  {
    SurfaceRenderer renderer;
    expectUnchanged("construction");
    picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 40), Green) }, Small());
    expectUnchanged("drawing");
    EXPECT_THROW(renderer.Render({}, Small(), { View() }), Failure);
    expectUnchanged("a failure");
    EXPECT_EQ(Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 40), Green) }, Small()).pixels, picture.pixels);
    expectUnchanged("drawing again");
  }
  expectUnchanged("destruction");
  SurfaceRenderer::ProbeBackends();
  expectUnchanged("a probe");
  window->Finalize();
}

TEST(GuestWindow, DoesNotChangeThePictureOfARenderer)
{
  const std::vector<SceneSurface> scene{ Item(Sphere({ 0, 0, 0 }, 40), Green, 0.5) };
  SurfaceRenderer alone;
  const Picture expected = Draw(alone, scene, Small());
  EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
  const GuestContext context;
  vtkNew<GuestWindow> window;
  window->Show();
  SurfaceRenderer beside;
  EXPECT_EQ(Draw(beside, scene, Small()).pixels, expected.pixels);
  window->Finalize();
}

TEST(GuestWindow, IsCurrentAgainAfterAHeadlessWindow)
{
  const GuestContext context;
  const Current current;
  vtkNew<GuestWindow> guest;
  guest->Show();
  const auto before = guest->Read();
  {
    vtkNew<vtkRhombicHeadlessRenderWindow> window;
    EXPECT_EQ(window->SupportsOpenGL(), 1);
    EXPECT_TRUE(Current() == current) << "after SupportsOpenGL()";
    window->PushContext();
    EXPECT_TRUE(window->IsCurrent());
    DrawStockScene(window, StockScenes[0]);
    window->PopContext();
    EXPECT_TRUE(Current() == current) << "after PopContext()";
    EXPECT_EQ(guest->Read(), before);
    vtkRhombicHeadlessRenderWindow::ProbeBackends();
    EXPECT_TRUE(Current() == current) << "after ProbeBackends()";
    window->Finalize();
    EXPECT_TRUE(Current() == current) << "after Finalize()";
    window->PushContext();
    window->PopContext();
    window->SupportsOpenGL();
  }
  EXPECT_TRUE(Current() == current) << "after the destructor";
  guest->Render();
  EXPECT_EQ(guest->Read(), before);
  guest->Finalize();
}

TEST(GuestWindow, MayBeAHeadlessWindowThatIsCurrent)
{
  vtkNew<vtkRhombicHeadlessRenderWindow> window;
  DrawStockScene(window, StockScenes[0]);
  ASSERT_TRUE(window->IsCurrent());
  const Current current;
  SurfaceRenderer renderer;
  const std::vector<SceneSurface> scene{ Item(Sphere({ 0, 0, 0 }, 40), Green, 0.5) };
  const Picture picture = Draw(renderer, scene, Small());
  EXPECT_TRUE(Current() == current);
  window->Render();
  EXPECT_EQ(Draw(renderer, scene, Small()).pixels, picture.pixels);
  window->Finalize();
  EXPECT_EQ(Draw(renderer, scene, Small()).pixels, picture.pixels);
}

TEST(GuestWindow, KeepsItsChoiceOfOpenGLES)
{
  ASSERT_TRUE(eglBindAPI(EGL_OPENGL_ES_API));
  SurfaceRenderer renderer;
  EXPECT_EQ(eglQueryAPI(), static_cast<EGLenum>(EGL_OPENGL_ES_API));
  eglBindAPI(EGL_OPENGL_API);
}

} // namespace
