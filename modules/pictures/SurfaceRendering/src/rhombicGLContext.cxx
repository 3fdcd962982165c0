#include "rhombicGLContext.h"

#include "rhombicFailure.h"

#include <array>
#include <cstdio>

#include <vtk_glew.h>

namespace rhombic
{
namespace
{

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
  const CurrentGLContext current(*result.context);
  result.description = DescribeCurrentContext();
  return result;
}

} // namespace

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
