#include "rhombicGLContext.h"

#include <EGL/egl.h>
#include <GL/glx.h> // defines macros such as None, so this file is compiled alone, see module-options.cmake

namespace rhombic
{

struct CallersContext::State
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
};

CallersContext::CallersContext()
  : m_State(std::make_unique<State>())
{
  if (m_State->glxContext != nullptr)
  {
    glXMakeContextCurrent(m_State->glxDisplay, None, None, nullptr);
  }
}

CallersContext::~CallersContext()
{
  if (m_State->context != EGL_NO_CONTEXT)
  {
    eglMakeCurrent(m_State->display, m_State->drawSurface, m_State->readSurface, m_State->context);
  }
  eglBindAPI(m_State->api);
  if (m_State->glxContext != nullptr)
  {
    glXMakeContextCurrent(m_State->glxDisplay, m_State->drawDrawable, m_State->readDrawable, m_State->glxContext);
  }
}

} // namespace rhombic
