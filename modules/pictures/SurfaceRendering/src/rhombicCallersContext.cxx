#include "rhombicGLContext.h"

#include <EGL/egl.h>
#include <GL/glx.h> // defines macros such as None, so this file is compiled alone, see module-options.cmake

namespace rhombic
{
namespace
{

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

} // namespace rhombic
