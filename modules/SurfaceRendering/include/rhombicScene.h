#ifndef rhombicScene_h
#define rhombicScene_h

#include "rhombicSceneSurface.h"
#include "rhombicView.h"

#include <cstdint>

namespace rhombic
{

/** \class RenderSettings
 * \brief How a scene becomes a picture. A side can have 8192 samples: 4096 pixels with two samples each.
 *
 * SurfaceRenderer::CheckSettings() says what is out of range. Thread safety: a value. */
struct RenderSettings
{
  int width = 1200;  ///< pixels
  int height = 1200; ///< pixels
  View view = View::Anterior;
  bool perspective = false; ///< parallel rays otherwise, so that sizes can be compared
  Colour background{ 0.0, 0.0, 0.0 };
  int samples = 2;                  ///< along each side of a pixel, 1 to 4: 2 means four samples a pixel
  bool ambientOcclusion = true;     ///< darkens cavities of opaque surfaces
  bool orientationLabels = true;    ///< L, R, A, P, H, F at the picture's edges
  std::uintmax_t maximumMemory = 0; ///< for drawing, in bytes; 0: half of what is free
};

} // namespace rhombic

#endif
