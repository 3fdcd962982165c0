#ifndef rhombicRenderBackend_h
#define rhombicRenderBackend_h

#include <string>
#include <vector>

namespace rhombic
{

/** Where the OpenGL context comes from. */
enum class RenderBackend
{
  Automatic,   ///< the first of those below that works
  Device,      ///< a graphics card, through EGL, without a display
  Surfaceless, ///< Mesa, through EGL, without a display: in software, or on a card that Mesa drives
  XDisplay     ///< GLX on the X server that DISPLAY names
};

/** \class BackendProbe
 * \brief Whether a backend works on this machine.
 *
 * Thread safety: a value. */
struct BackendProbe
{
  RenderBackend backend;
  std::string name;
  bool usable;
  std::string detail; ///< the renderer and OpenGL version when usable, or else the reason why not
};

} // namespace rhombic

#endif
