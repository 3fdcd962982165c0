#ifndef rhombicGLContext_h
#define rhombicGLContext_h

#include "rhombicRenderBackend.h"

#include <memory>
#include <string>

namespace rhombic
{

/** \class GLContext
 * \brief An OpenGL 3.2 core context that belongs to no window. */
class GLContext
{
public:
  GLContext() = default;
  virtual ~GLContext() = default;

  GLContext(const GLContext &) = delete;
  GLContext &
  operator=(const GLContext &) = delete;

  /** Makes OpenGL calls of this thread go to this context. Throws Failure(Display). */
  virtual void
  MakeCurrent() = 0;

  /** Leaves this thread without a context. */
  virtual void
  Release() = 0;
};

/** \class CurrentGLContext
 * \brief Keeps a context current on this thread as long as it lives. */
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

/** One for each backend. Each throws Failure(Display) with the reason when the backend does not work here. */
std::unique_ptr<GLContext>
CreateDeviceContext();
std::unique_ptr<GLContext>
CreateSurfacelessContext();
std::unique_ptr<GLContext>
CreateXDisplayContext();

/** A context, and one line about it: backend, renderer and OpenGL version. */
struct DescribedGLContext
{
  std::unique_ptr<GLContext> context;
  std::string description;
};

/** The context of \a backend, proved to give OpenGL 3.2 or newer. Throws Failure(Display) with what to install. */
DescribedGLContext
CreateGLContext(RenderBackend backend);

/** Creates a context of every backend, one after the other. */
std::vector<BackendProbe>
ProbeGLContexts();

} // namespace rhombic

#endif
