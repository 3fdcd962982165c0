#include "rhombicFailure.h"
#include "rhombicGLContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <sstream>
#include <vector>

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
  std::istringstream stream(words ? words : "");
  for (std::string candidate; stream >> candidate;)
  {
    if (candidate == word)
    {
      return true;
    }
  }
  return false;
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

class EGLContextOfDisplay : public GLContext
{
public:
  /** All users of the display in this process share it, so it is never terminated. */
  explicit EGLContextOfDisplay(EGLDisplay display)
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
    const EGLConfig config = ChooseConfig();
    CreateContext(config);
    CreateSurface(config);
  }

  ~EGLContextOfDisplay() override
  {
    eglDestroyContext(m_Display, m_Context);
    eglDestroySurface(m_Display, m_Surface);
  }

  void
  MakeCurrent() override
  {
    // The choice between OpenGL and OpenGL ES is a state of each thread.
    if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(m_Display, m_Surface, m_Surface, m_Context))
    {
      FailCall("eglMakeCurrent");
    }
  }

  void
  Release() override
  {
    eglMakeCurrent(m_Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

private:
  EGLConfig
  ChooseConfig() const
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
    if (!eglChooseConfig(m_Display, attributes, &config, 1, &count) || count == 0)
    {
      FailCall("eglChooseConfig");
    }
    return config;
  }

  /** VTK draws into its own buffers. Not every EGL supports a context without a surface, so there is one of 1 pixel. */
  void
  CreateSurface(EGLConfig config)
  {
    constexpr EGLint attributes[] = { EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
    m_Surface = eglCreatePbufferSurface(m_Display, config, attributes);
    if (m_Surface == EGL_NO_SURFACE)
    {
      eglDestroyContext(m_Display, m_Context);
      Fail("eglCreatePbufferSurface failed");
    }
  }

  void
  CreateContext(EGLConfig config)
  {
    constexpr EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE
    };
    m_Context = eglCreateContext(m_Display, config, EGL_NO_CONTEXT, attributes);
    if (m_Context == EGL_NO_CONTEXT)
    {
      FailCall("eglCreateContext");
    }
  }

  EGLDisplay m_Display;
  EGLSurface m_Surface = EGL_NO_SURFACE;
  EGLContext m_Context = EGL_NO_CONTEXT;
};

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

} // namespace

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
      return std::make_unique<EGLContextOfDisplay>(getDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    catch (const Failure & failure)
    {
      reason = failure.GetDescription();
    }
  }
  Fail(reason);
}

std::unique_ptr<GLContext>
CreateSurfacelessContext()
{
  RequireClientExtension("EGL_MESA_platform_surfaceless");
  const auto getDisplay = FindFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  return std::make_unique<EGLContextOfDisplay>(getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
}

} // namespace rhombic
