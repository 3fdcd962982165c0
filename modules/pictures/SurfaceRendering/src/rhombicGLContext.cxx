#include "rhombicGLContext.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

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

[[noreturn]] void
FailCall(const char * call)
{
  std::ostringstream reason;
  reason << call << " failed with EGL error 0x" << std::hex << eglGetError();
  Fail(reason.str());
}

bool
HasWord(const char * words, const std::string & word)
{
  const auto list = SplitWords(words ? words : "");
  return std::find(list.begin(), list.end(), word) != list.end();
}

void
RequireClientExtension(const std::string & extension)
{
  if (!HasWord(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), extension))
  {
    Fail("EGL lacks " + extension);
  }
}

template <typename TFunction>
TFunction
FindFunction(const char * name)
{
  const auto function = reinterpret_cast<TFunction>(eglGetProcAddress(name));
  if (!function)
  {
    Fail(std::string("EGL lacks ") + name);
  }
  return function;
}

EGLConfig
ChooseConfig(EGLDisplay display)
{
  constexpr EGLint attributes[] = { EGL_SURFACE_TYPE,
                                    EGL_PBUFFER_BIT,
                                    EGL_RENDERABLE_TYPE,
                                    EGL_OPENGL_BIT,
                                    EGL_RED_SIZE,
                                    8,
                                    EGL_GREEN_SIZE,
                                    8,
                                    EGL_BLUE_SIZE,
                                    8,
                                    EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, attributes, &config, 1, &count) || count == 0)
  {
    FailCall("eglChooseConfig");
  }
  return config;
}

std::vector<EGLDeviceEXT>
FindDevices()
{
  RequireClientExtension("EGL_EXT_device_enumeration");
  const auto query = FindFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (!query(0, nullptr, &count))
  {
    FailCall("eglQueryDevicesEXT");
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (!query(count, devices.data(), &count))
  {
    FailCall("eglQueryDevicesEXT");
  }
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

/** Throws Failure(Display) with the reason when no graphics card works. */
std::unique_ptr<GLContext>
CreateDeviceContext()
{
  RequireClientExtension("EGL_EXT_platform_device");
  const auto getDisplay = FindFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const auto queryString = FindFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  std::string reason = "there is no graphics card, or this user may not use it";
  for (EGLDeviceEXT device : FindDevices())
  {
    if (HasWord(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
    {
      continue;
    }
    try
    {
      return std::make_unique<GLContext>(getDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    catch (const Failure & failure)
    {
      reason = failure.GetDescription();
    }
  }
  Fail(reason);
}

/** Throws Failure(Display) with the reason when Mesa does not work without a display. */
std::unique_ptr<GLContext>
CreateSurfacelessContext()
{
  RequireClientExtension("EGL_MESA_platform_surfaceless");
  const auto getDisplay = FindFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return std::make_unique<GLContext>(getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
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

std::string
GLString(GLenum name)
{
  const auto * const text = reinterpret_cast<const char *>(glGetString(name));
  return text ? text : "";
}

/** Renderer and version of the current context. */
std::string
DescribeCurrentContext()
{
  const std::string version = GLString(GL_VERSION);
  int major = 0;
  int minor = 0;
  if (std::sscanf(version.c_str(), "%d.%d", &major, &minor) != 2 || major < 3 || (major == 3 && minor < 2))
  {
    throw Failure(FailureKind::Display, "it has OpenGL \"" + version + "\", and 3.2 is needed");
  }
  return GLString(GL_RENDERER) + ", OpenGL " + version;
}

DescribedGLContext
CreateAndDescribe(const Backend & backend)
{
  DescribedGLContext result{ backend.create(), {} };
  const auto current = result.context->MakeCurrent();
  result.description = DescribeCurrentContext();
  return result;
}

struct CallersContext
{
  EGLenum api = eglQueryAPI();
  EGLContext context = eglGetCurrentContext();
  EGLDisplay display = eglGetCurrentDisplay();
  EGLSurface drawSurface = eglGetCurrentSurface(EGL_DRAW);
  EGLSurface readSurface = eglGetCurrentSurface(EGL_READ);

  GLXContext glxContext = glXGetCurrentContext();
  Display * glxDisplay = glXGetCurrentDisplay();
  GLXDrawable drawDrawable = glXGetCurrentDrawable();
  GLXDrawable readDrawable = glXGetCurrentReadDrawable();

  ~CallersContext()
  {
    if (context != EGL_NO_CONTEXT)
    {
      eglMakeCurrent(display, drawSurface, readSurface, context);
    }
    eglBindAPI(api);
    if (glxContext != nullptr)
    {
      glXMakeContextCurrent(glxDisplay, drawDrawable, readDrawable, glxContext);
    }
  }
};

} // namespace

std::shared_ptr<const void>
KeepCallersContext()
{
  auto caller = std::make_shared<const CallersContext>();
  if (caller->glxContext != nullptr)
  {
    glXMakeContextCurrent(caller->glxDisplay, None, None, nullptr);
  }
  return caller;
}

GLContext::GLContext(EGLHandle display)
  : m_Display(display)
{
  if (m_Display == EGL_NO_DISPLAY || !eglInitialize(m_Display, nullptr, nullptr))
  {
    FailCall("eglInitialize");
  }
  if (!eglBindAPI(EGL_OPENGL_API))
  {
    FailCall("eglBindAPI");
  }
  const EGLConfig config = ChooseConfig(m_Display);
  constexpr EGLint contextAttributes[] = {
    EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE
  };
  m_Context = eglCreateContext(m_Display, config, EGL_NO_CONTEXT, contextAttributes);
  if (m_Context == EGL_NO_CONTEXT)
  {
    FailCall("eglCreateContext");
  }
  // VTK draws into its own buffers. Not every EGL supports a context without a surface, so there is one of 1 pixel.
  constexpr EGLint surfaceAttributes[] = { EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
  m_Surface = eglCreatePbufferSurface(m_Display, config, surfaceAttributes);
  if (m_Surface == EGL_NO_SURFACE)
  {
    eglDestroyContext(m_Display, m_Context);
    Fail("eglCreatePbufferSurface failed");
  }
}

GLContext::~GLContext()
{
  eglDestroyContext(m_Display, m_Context);
  eglDestroySurface(m_Display, m_Surface);
}

std::shared_ptr<const void>
GLContext::MakeCurrent()
{
  // The choice between OpenGL and OpenGL ES is a state of each thread.
  if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(m_Display, m_Surface, m_Surface, m_Context))
  {
    FailCall("eglMakeCurrent");
  }
  return { m_Context, [display = m_Display](const void *) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
          } };
}

DescribedGLContext
CreateGLContext(RenderBackend wanted)
{
  std::string reasons;
  for (const Backend & backend : Backends)
  {
    if (wanted != RenderBackend::Automatic && wanted != backend.backend)
    {
      continue;
    }
    try
    {
      DescribedGLContext result = CreateAndDescribe(backend);
      result.description = std::string(backend.name) + ", " + result.description;
      return result;
    }
    catch (const Failure & failure)
    {
      reasons += (reasons.empty() ? "" : "; ") + std::string(backend.name) + ": " + failure.GetDescription();
    }
  }
  throw Failure(FailureKind::Display,
                "There is no way to draw on this machine (" + reasons +
                  "); install the Debian packages libegl1 and libgl1-mesa-dri.");
}

std::vector<BackendProbe>
ProbeGLContexts()
{
  std::vector<BackendProbe> probes;
  for (const Backend & backend : Backends)
  {
    BackendProbe probe{ backend.backend, backend.name, true, {} };
    try
    {
      probe.detail = CreateAndDescribe(backend).description;
    }
    catch (const Failure & failure)
    {
      probe.usable = false;
      probe.detail = failure.GetDescription();
    }
    probes.push_back(probe);
  }
  return probes;
}

} // namespace rhombic
