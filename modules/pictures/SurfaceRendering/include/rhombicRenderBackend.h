#ifndef rhombicRenderBackend_h
#define rhombicRenderBackend_h

#include <string>

namespace rhombic
{

/** Where an OpenGL context without a display comes from. */
enum class RenderBackend
{
  Automatic,  ///< the first backend in the order below that works
  Device,     ///< a graphics card, through EGL, without a display
  Surfaceless ///< Mesa through EGL, without a display: software, or a card with a Mesa driver
};

/** \class BackendProbe
 * \brief Whether a backend works on this machine. */
struct BackendProbe
{
  RenderBackend backend;
  std::string name;
  bool usable;
  std::string detail; ///< renderer and OpenGL version if usable, otherwise the reason why not
};

} // namespace rhombic

#endif
