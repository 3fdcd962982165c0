#ifndef rhombicGLContext_h
#define rhombicGLContext_h

#include "rhombicSurfaceRenderer.h"

#include <memory>
#include <string>

namespace rhombic
{

/** Keeps the context of EGL or GLX that is current on this thread, and makes the context current again when the result
 * is destroyed. Meanwhile no context of GLX is current, so that a context of EGL can be. */
std::shared_ptr<const void>
KeepCallersContext();

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

  /** Makes this the context of OpenGL calls on this thread, until the result is destroyed: then the thread has none.
   * Throws Failure(Display). */
  std::shared_ptr<const void>
  MakeCurrent();

private:
  EGLHandle m_Display;
  EGLHandle m_Surface = nullptr;
  EGLHandle m_Context = nullptr;
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
