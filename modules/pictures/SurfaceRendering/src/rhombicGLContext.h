#ifndef rhombicGLContext_h
#define rhombicGLContext_h

#include "rhombicSurfaceRenderer.h"

#include <memory>
#include <string>

namespace rhombic
{

/** \class CallersContext
 * \brief Keeps what is current for OpenGL on this thread, of EGL or GLX, and makes it current again when destroyed.
 *
 * Meanwhile nothing of GLX is current, so that a context of EGL can be. */
class CallersContext
{
public:
  CallersContext();
  ~CallersContext();

  CallersContext(const CallersContext &) = delete;
  CallersContext &
  operator=(const CallersContext &) = delete;

private:
  struct State;
  std::unique_ptr<const State> m_State;
};

/** \class GLContext
 * \brief An OpenGL 3.2 core context of EGL, without a window. */
class GLContext
{
public:
  using EGLHandle = void *;

  /** Throws Failure(Display). All users of the display in this process share it, so it is never terminated. */
  explicit GLContext(EGLHandle display);
  ~GLContext();

  GLContext(const GLContext &) = delete;
  GLContext &
  operator=(const GLContext &) = delete;

  /** Makes this the context of OpenGL calls on this thread. Throws Failure(Display). */
  void
  MakeCurrent();

  /** Leaves this thread without a context. */
  void
  Release();

private:
  EGLHandle m_Display;
  EGLHandle m_Surface = nullptr;
  EGLHandle m_Context = nullptr;
};

/** \class CurrentGLContext
 * \brief Keeps a context current on this thread during the lifetime of this object. */
class CurrentGLContext
{
public:
  explicit CurrentGLContext(GLContext & context)
    : m_Context(context)
  {
    m_Context.MakeCurrent();
  }
  ~CurrentGLContext()
  {
    m_Context.Release();
  }

  CurrentGLContext(const CurrentGLContext &) = delete;
  CurrentGLContext &
  operator=(const CurrentGLContext &) = delete;

private:
  GLContext & m_Context;
};

/** A context, and a line with its backend, renderer and OpenGL version. */
struct DescribedGLContext
{
  std::unique_ptr<GLContext> context;
  std::string description;
};

/** Creates the context of \a backend and checks that it has OpenGL 3.2 or newer. Throws Failure(Display), naming the
 * packages to install. */
DescribedGLContext
CreateGLContext(RenderBackend backend);

/** Tries to create a context of every backend, one after the other. */
std::vector<BackendProbe>
ProbeGLContexts();

} // namespace rhombic

#endif
