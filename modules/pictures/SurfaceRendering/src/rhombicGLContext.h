#ifndef rhombicGLContext_h
#define rhombicGLContext_h

#include "rhombicRenderBackend.h"

#include <memory>
#include <string>

namespace rhombic
{

/** \class GLContext
 * \brief An OpenGL 3.2 core context without a window. */
class GLContext
{
public:
  GLContext() = default;
  virtual ~GLContext() = default;

  GLContext(const GLContext &) = delete;
  GLContext &
  operator=(const GLContext &) = delete;

  /** Makes this the context of OpenGL calls on this thread. Throws Failure(Display). */
  virtual void
  MakeCurrent() = 0;

  /** Leaves this thread without a context. */
  virtual void
  Release() = 0;
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

/** The contexts of the backends. Each function throws Failure(Display) with the reason when its backend does not work
 * on this machine. */
std::unique_ptr<GLContext>
CreateDeviceContext();
std::unique_ptr<GLContext>
CreateSurfacelessContext();

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
