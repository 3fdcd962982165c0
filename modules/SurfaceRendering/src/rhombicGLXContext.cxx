#include "rhombicFailure.h"
#include "rhombicGLContext.h"

#include <cstdlib>

// Xlib defines Bool, None, Status and more as macros, so no header includes it.
#include <GL/glx.h>
#include <X11/Xlib.h>

namespace rhombic
{
namespace
{

[[noreturn]] void
Fail(const std::string & reason)
{
  throw Failure(FailureKind::Display, reason);
}

struct DisplayCloser
{
  void
  operator()(Display * display) const
  {
    XCloseDisplay(display);
  }
};
using DisplayPointer = std::unique_ptr<Display, DisplayCloser>;

DisplayPointer
OpenDisplay()
{
  const char * const name = std::getenv("DISPLAY");
  if (!name || !*name)
  {
    Fail("DISPLAY is not set");
  }
  DisplayPointer display(XOpenDisplay(nullptr));
  if (!display)
  {
    Fail("the X server " + std::string(name) + " can't be reached");
  }
  return display;
}

/** \class XErrorTrap
 * \brief Counts X errors, which would end the process, during the lifetime of this object. */
class XErrorTrap
{
public:
  explicit XErrorTrap(Display * display)
    : m_Display(display)
  {
    XSync(m_Display, False);
    s_Errors = 0;
    m_Previous = XSetErrorHandler([](Display *, XErrorEvent *) { return ++s_Errors; });
  }
  ~XErrorTrap()
  {
    XSync(m_Display, False);
    XSetErrorHandler(m_Previous);
  }

  XErrorTrap(const XErrorTrap &) = delete;
  XErrorTrap &
  operator=(const XErrorTrap &) = delete;

  bool
  Caught() const
  {
    XSync(m_Display, False);
    return s_Errors != 0;
  }

private:
  Display * m_Display;
  XErrorHandler m_Previous;
  static int s_Errors;
};

int XErrorTrap::s_Errors = 0;

class GLXContextOfDisplay : public GLContext
{
public:
  explicit GLXContextOfDisplay(DisplayPointer display)
    : m_Display(std::move(display))
  {
    int major = 0;
    int minor = 0;
    if (!glXQueryExtension(m_Display.get(), nullptr, nullptr) || !glXQueryVersion(m_Display.get(), &major, &minor) ||
        major != 1 || minor < 3)
    {
      Fail("the X server lacks GLX 1.3");
    }
    const XErrorTrap trap(m_Display.get());
    const GLXFBConfig config = ChooseConfig();
    constexpr int surfaceAttributes[] = { GLX_PBUFFER_WIDTH, 1, GLX_PBUFFER_HEIGHT, 1, None };
    m_Surface = glXCreatePbuffer(m_Display.get(), config, surfaceAttributes);
    m_Context = CreateContext(config);
    if (trap.Caught() || m_Surface == None || !m_Context)
    {
      Destroy();
      Fail("the X server gives no OpenGL 3.2 context");
    }
  }

  ~GLXContextOfDisplay() override
  {
    Destroy();
  }

  void
  MakeCurrent() override
  {
    const XErrorTrap trap(m_Display.get());
    if (!glXMakeContextCurrent(m_Display.get(), m_Surface, m_Surface, m_Context) || trap.Caught())
    {
      Fail("glXMakeContextCurrent failed");
    }
  }

  void
  Release() override
  {
    glXMakeContextCurrent(m_Display.get(), None, None, nullptr);
  }

private:
  GLXFBConfig
  ChooseConfig() const
  {
    constexpr int attributes[] = { GLX_DRAWABLE_TYPE,
                                   GLX_PBUFFER_BIT,
                                   GLX_RENDER_TYPE,
                                   GLX_RGBA_BIT,
                                   GLX_RED_SIZE,
                                   8,
                                   GLX_GREEN_SIZE,
                                   8,
                                   GLX_BLUE_SIZE,
                                   8,
                                   None };
    int count = 0;
    GLXFBConfig * const configs =
      glXChooseFBConfig(m_Display.get(), DefaultScreen(m_Display.get()), attributes, &count);
    if (!configs || count == 0)
    {
      Fail("the X server has no format to draw in");
    }
    const GLXFBConfig first = configs[0];
    XFree(configs);
    return first;
  }

  GLXContext
  CreateContext(GLXFBConfig config) const
  {
    const auto create = reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(
      glXGetProcAddressARB(reinterpret_cast<const GLubyte *>("glXCreateContextAttribsARB")));
    if (!create)
    {
      return nullptr;
    }
    constexpr int attributes[] = {
      GLX_CONTEXT_MAJOR_VERSION_ARB,    3,   GLX_CONTEXT_MINOR_VERSION_ARB, 2, GLX_CONTEXT_PROFILE_MASK_ARB,
      GLX_CONTEXT_CORE_PROFILE_BIT_ARB, None
    };
    return create(m_Display.get(), config, nullptr, True, attributes);
  }

  void
  Destroy()
  {
    if (m_Context)
    {
      glXDestroyContext(m_Display.get(), m_Context);
    }
    if (m_Surface != None)
    {
      glXDestroyPbuffer(m_Display.get(), m_Surface);
    }
  }

  DisplayPointer m_Display;
  GLXPbuffer m_Surface = None;
  GLXContext m_Context = nullptr;
};

} // namespace

std::unique_ptr<GLContext>
CreateXDisplayContext()
{
  return std::make_unique<GLXContextOfDisplay>(OpenDisplay());
}

} // namespace rhombic
