#include "vtkRhombicHeadlessRenderWindow.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <sstream>

#include <vtkAutoInit.h>
#include <vtkObjectFactory.h>
#include <vtkRendererCollection.h>
#include <vtk_glew.h>

#include <GL/glx.h> // defines macros such as None, so this file is compiled alone, see module-options.cmake

namespace rhombic
{
namespace
{

[[noreturn]] void
Fail(const std::string & reason)
{
  throw Failure(FailureKind::Display, reason);
}

/** Throws Failure(Display) unless a call of EGL has succeeded. */
void
Check(bool isSuccess, const char * call)
{
  if (!isSuccess)
  {
    std::ostringstream reason;
    reason << call << " failed with EGL error 0x" << std::hex << eglGetError();
    Fail(reason.str());
  }
}

bool
HasWord(const char * words, const std::string & word)
{
  const auto list = SplitWords(words ? words : "");
  return std::find(list.begin(), list.end(), word) != list.end();
}

/** A function of an extension of EGL. Throws Failure(Display) if EGL lacks the extension. */
template <typename TFunction>
TFunction
FindFunction(const char * name, const char * extension)
{
  if (!HasWord(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), extension))
  {
    Fail(std::string("EGL lacks ") + extension);
  }
  return reinterpret_cast<TFunction>(eglGetProcAddress(name));
}

/** Afterwards no context of EGL or GLX is current on this thread. */
void
ReleaseCurrentContext()
{
  if (eglGetCurrentContext() != EGL_NO_CONTEXT)
  {
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  if (glXGetCurrentContext() != nullptr)
  {
    glXMakeContextCurrent(glXGetCurrentDisplay(), None, None, nullptr);
  }
}

/** An OpenGL 4.3 core context of EGL. */
struct GLContext
{
  const EGLDisplay display;
  EGLSurface surface = EGL_NO_SURFACE;
  EGLContext context = EGL_NO_CONTEXT;

  /** Throws Failure(Display). */
  explicit GLContext(EGLDisplay aDisplay)
    : display(aDisplay)
  {
    constexpr EGLint configRules[] = {
      EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8,
      EGL_NONE
    };
    constexpr EGLint contextRules[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE
    };
    // VTK draws into its own buffers. Not every EGL supports a context without a surface, so there is one of 1 pixel.
    constexpr EGLint surfaceRules[] = { EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint configs = 0;
    Check(display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr), "eglInitialize");
    Check(eglBindAPI(EGL_OPENGL_API), "eglBindAPI");
    Check(eglChooseConfig(display, configRules, &config, 1, &configs) && configs == 1, "eglChooseConfig");
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, contextRules);
    if (context == EGL_NO_CONTEXT)
    {
      Fail("it has no OpenGL 4.3");
    }
    surface = eglCreatePbufferSurface(display, config, surfaceRules);
    if (surface == EGL_NO_SURFACE)
    {
      eglDestroyContext(display, context);
      Fail("eglCreatePbufferSurface failed");
    }
  }

  ~GLContext()
  {
    eglDestroyContext(display, context);
    eglDestroySurface(display, surface);
  }

  GLContext(const GLContext &) = delete;
  GLContext &
  operator=(const GLContext &) = delete;

  bool
  IsCurrent() const
  {
    return eglGetCurrentContext() == context;
  }

  /** Throws Failure(Display). */
  void
  MakeCurrent() const
  {
    if (!IsCurrent())
    {
      ReleaseCurrentContext();
      // The choice between OpenGL and OpenGL ES is a state of each thread.
      if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display, surface, surface, context))
      {
        Fail("The window's OpenGL context can't be made current on this thread; if another thread has drawn in the "
             "window, call ReleaseCurrent() there.");
      }
    }
  }
};

/** A context of one of the devices that EGL lists: of graphics cards, or of Mesa's software. Throws Failure(Display)
 * with the reason when none works. */
std::unique_ptr<GLContext>
CreateContextOfDevices(bool areSoftware)
{
  const auto getDisplay =
    FindFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT", "EGL_EXT_platform_device");
  const auto findDevices = FindFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT", "EGL_EXT_device_enumeration");
  const auto queryString =
    FindFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT", "EGL_EXT_device_query");
  std::array<EGLDeviceEXT, 64> devices{};
  EGLint count = 0;
  Check(findDevices(static_cast<EGLint>(devices.size()), devices.data(), &count), "eglQueryDevicesEXT");
  std::string reason =
    areSoftware ? "there is no software of Mesa that draws" : "there is no graphics card, or this user may not use it";
  for (EGLint n = 0; n < count; ++n)
  {
    if (HasWord(queryString(devices[n], EGL_EXTENSIONS), "EGL_MESA_device_software") != areSoftware)
    {
      continue;
    }
    try
    {
      return std::make_unique<GLContext>(getDisplay(EGL_PLATFORM_DEVICE_EXT, devices[n], nullptr));
    }
    catch (const Failure & failure)
    {
      reason = failure.GetDescription();
    }
  }
  Fail(reason);
}

std::unique_ptr<GLContext>
CreateDeviceContext()
{
  return CreateContextOfDevices(false);
}

/** Throws Failure(Display) with the reason when Mesa does not work without a display. */
std::unique_ptr<GLContext>
CreateSurfacelessContext()
{
  const auto getDisplay =
    FindFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT", "EGL_MESA_platform_surfaceless");
  try
  {
    return std::make_unique<GLContext>(getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  catch (const Failure &) // Mesa may have chosen an old graphics card
  {
    return CreateContextOfDevices(true);
  }
}

struct Backend
{
  RenderBackend backend;
  const char * name;
  std::unique_ptr<GLContext> (*create)();
};

constexpr std::array<Backend, 2> Backends{ {
  { RenderBackend::Device, "EGL device", CreateDeviceContext },
  { RenderBackend::Surfaceless, "EGL surfaceless Mesa", CreateSurfacelessContext },
} };

/** Renderer and version of the current context. */
std::string
DescribeCurrentContext()
{
  const auto * const renderer = reinterpret_cast<const char *>(glGetString(GL_RENDERER));
  const auto * const version = reinterpret_cast<const char *>(glGetString(GL_VERSION));
  int major = 0;
  int minor = 0;
  if (!renderer || !version || std::sscanf(version, "%d.%d", &major, &minor) != 2 || 10 * major + minor < 43)
  {
    Fail(std::string("it has OpenGL \"") + (version ? version : "") + "\", and 4.3 is needed");
  }
  return std::string(renderer) + ", OpenGL " + version;
}

/** Keeps the context of EGL or GLX that is current on this thread, and makes it current again when this object is
 * destroyed. Meanwhile the thread begins with no context. */
struct CallersContext
{
  CallersContext()
  {
    ReleaseCurrentContext();
  }

  ~CallersContext()
  {
    ReleaseCurrentContext();
    eglBindAPI(api);
    if (context != EGL_NO_CONTEXT)
    {
      eglMakeCurrent(display, drawSurface, readSurface, context);
    }
    if (glxContext != nullptr)
    {
      glXMakeContextCurrent(glxDisplay, glxDrawDrawable, glxReadDrawable, glxContext);
    }
  }

  const EGLenum api = eglQueryAPI();
  const EGLContext context = eglGetCurrentContext();
  const EGLDisplay display = eglGetCurrentDisplay();
  const EGLSurface drawSurface = eglGetCurrentSurface(EGL_DRAW);
  const EGLSurface readSurface = eglGetCurrentSurface(EGL_READ);

  const GLXContext glxContext = glXGetCurrentContext();
  Display * const glxDisplay = glXGetCurrentDisplay();
  const GLXDrawable glxDrawDrawable = glXGetCurrentDrawable();
  const GLXDrawable glxReadDrawable = glXGetCurrentReadDrawable();
};

/** A backend, and its context if it works. */
using Trial = std::pair<BackendProbe, std::unique_ptr<GLContext>>;

Trial
Try(const Backend & backend)
{
  const CallersContext caller;
  try
  {
    auto context = backend.create();
    context->MakeCurrent();
    return { BackendProbe{ backend.backend, backend.name, true, DescribeCurrentContext() }, std::move(context) };
  }
  catch (const Failure & failure)
  {
    return { BackendProbe{ backend.backend, backend.name, false, failure.GetDescription() }, nullptr };
  }
}

/** The first backend that works. Throws Failure(Display), naming the packages to install. */
Trial
FindBackend(RenderBackend wanted)
{
  std::string reasons;
  for (const Backend & backend : Backends)
  {
    if (wanted == RenderBackend::Automatic || wanted == backend.backend)
    {
      Trial trial = Try(backend);
      if (trial.second)
      {
        return trial;
      }
      reasons += (reasons.empty() ? "" : "; ") + trial.first.name + ": " + trial.first.detail;
    }
  }
  Fail("There is no way to draw on this machine (" + reasons +
       "); install the Debian packages libegl1 and libgl1-mesa-dri.");
}

} // namespace
} // namespace rhombic

VTK_MODULE_INIT(vtkRenderingOpenGL2) // so that vtkRenderer, vtkActor and more draw by OpenGL

struct vtkRhombicHeadlessRenderWindow::vtkInternals
{
  std::unique_ptr<rhombic::GLContext> Context;
  std::string Description;                                             ///< of backend, renderer and OpenGL version
  std::vector<std::unique_ptr<const rhombic::CallersContext>> Callers; ///< null where the window's context was current
};

vtkStandardNewMacro(vtkRhombicHeadlessRenderWindow);

vtkRhombicHeadlessRenderWindow::vtkRhombicHeadlessRenderWindow()
  : Internals(new vtkInternals)
{
  this->SetShowWindow(false);
  this->SetUseOffScreenBuffers(true);
  this->SetFrameBlitModeToNoBlit();
  this->ScreenSize[0] = 1920;
  this->ScreenSize[1] = 1080;
}

vtkRhombicHeadlessRenderWindow::~vtkRhombicHeadlessRenderWindow()
{
  this->Finalize();
  for (int n = this->Renderers->GetNumberOfItems(); n-- > 0;)
  {
    static_cast<vtkRenderer *>(this->Renderers->GetItemAsObject(n))->SetRenderWindow(nullptr);
  }
}

void
vtkRhombicHeadlessRenderWindow::PrintSelf(ostream & os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OpenGL: " << this->OpenGLSupportMessage << "\n";
}

std::vector<rhombic::BackendProbe>
vtkRhombicHeadlessRenderWindow::ProbeBackends()
{
  std::vector<rhombic::BackendProbe> probes;
  for (const rhombic::Backend & backend : rhombic::Backends)
  {
    probes.push_back(rhombic::Try(backend).first);
  }
  return probes;
}

bool
vtkRhombicHeadlessRenderWindow::Prepare()
{
  vtkInternals & internals = *this->Internals;
  try
  {
    if (!internals.Context)
    {
      auto [backend, context] = rhombic::FindBackend(this->Backend);
      internals.Context = std::move(context);
      internals.Description = backend.name + ", " + backend.detail;
    }
    internals.Context->MakeCurrent();
    if (!this->Initialized)
    {
      this->OpenGLInit();
    }
    if (!this->Initialized)
    {
      rhombic::Fail("GLEW finds no functions of OpenGL; install the Debian package libgl1.");
    }
    this->OpenGLSupportMessage = internals.Description;
    return true;
  }
  catch (const rhombic::Failure & failure)
  {
    this->OpenGLSupportMessage = failure.GetDescription();
    return false;
  }
}

int
vtkRhombicHeadlessRenderWindow::SupportsOpenGL()
{
  const rhombic::CallersContext caller;
  return this->Prepare() ? 1 : 0;
}

void
vtkRhombicHeadlessRenderWindow::Initialize()
{
  if (!this->Prepare())
  {
    vtkErrorMacro(<< this->OpenGLSupportMessage);
  }
}

void
vtkRhombicHeadlessRenderWindow::Finalize()
{
  if (this->Internals->Context)
  {
    this->PushContext();
    this->ReleaseGraphicsResources(this);
    this->ReleaseCurrent();
    this->Internals->Context.reset();
    this->PopContext();
  }
}

void
vtkRhombicHeadlessRenderWindow::Render()
{
  if (this->Prepare())
  {
    this->Superclass::Render();
  }
  else
  {
    vtkErrorMacro(<< this->OpenGLSupportMessage);
  }
}

void
vtkRhombicHeadlessRenderWindow::MakeCurrent()
{
  if (this->Internals->Context && !this->Prepare())
  {
    vtkErrorMacro(<< this->OpenGLSupportMessage);
  }
}

void
vtkRhombicHeadlessRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    rhombic::ReleaseCurrentContext();
  }
}

bool
vtkRhombicHeadlessRenderWindow::IsCurrent()
{
  return this->Internals->Context && this->Internals->Context->IsCurrent();
}

void
vtkRhombicHeadlessRenderWindow::PushContext()
{
  this->Internals->Callers.push_back(this->IsCurrent() ? nullptr : std::make_unique<rhombic::CallersContext>());
  this->MakeCurrent();
}

void
vtkRhombicHeadlessRenderWindow::PopContext()
{
  this->Internals->Callers.pop_back();
}

void
vtkRhombicHeadlessRenderWindow::CheckErrors()
{
  const GLenum error = glGetError();
  if (error == GL_OUT_OF_MEMORY)
  {
    throw std::bad_alloc();
  }
  if (error != GL_NO_ERROR)
  {
    vtkErrorMacro("OpenGL error " << error);
  }
}

void
vtkRhombicHeadlessRenderWindow::OpenGLInitContext()
{
  this->ContextCreationTime.Modified();
  if (this->Initialized)
  {
    return;
  }
  // GLEW looks up OpenGL's functions for VTK. Without a display it finds all but those of GLX, which nobody calls here,
  // and reports an error. Where the caller's program has called GLEW, its table stays as it is.
  const GLenum result = GLEW_VERSION_4_3 ? GLEW_OK : glewInit();
  this->GlewInitValid =
    result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY || result == GLEW_ERROR_GLX_VERSION_11_ONLY;
  this->Initialized = this->GlewInitValid;
  if (this->Initialized)
  {
    glActiveTexture(GL_TEXTURE0); // a new vtkOpenGLState takes this unit for active, and does not ask
  }
  GLfloat widths[2] = { 1.0f, 1.0f };
  glGetFloatv(this->LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, widths);
  this->MaximumHardwareLineWidth = widths[1];
}

int
vtkRhombicHeadlessRenderWindow::ReadPixels(const vtkRecti & rect,
                                           int front,
                                           int glFormat,
                                           int glType,
                                           void * data,
                                           int right)
{
  return this->Prepare() ? this->Superclass::ReadPixels(rect, front, glFormat, glType, data, right) : VTK_ERROR;
}

int
vtkRhombicHeadlessRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, float * z)
{
  return this->Prepare() ? this->Superclass::GetZbufferData(x1, y1, x2, y2, z) : VTK_ERROR;
}

const char *
vtkRhombicHeadlessRenderWindow::ReportCapabilities()
{
  return this->Prepare() ? this->Superclass::ReportCapabilities() : this->OpenGLSupportMessage.c_str();
}

void *
vtkRhombicHeadlessRenderWindow::GetGenericDisplayId()
{
  return this->Internals->Context ? this->Internals->Context->display : nullptr;
}

void *
vtkRhombicHeadlessRenderWindow::GetGenericContext()
{
  return this->Internals->Context ? this->Internals->Context->context : nullptr;
}
