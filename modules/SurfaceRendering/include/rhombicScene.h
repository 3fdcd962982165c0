#ifndef rhombicScene_h
#define rhombicScene_h

#include "rhombicSceneSurface.h"
#include "rhombicView.h"

#include <cstdint>

namespace rhombic
{

/** \class RenderSettings
 * \brief Size, view and effects of a picture. Each side has at most 8192 samples: 4096 pixels with two samples each.
 *
 * SurfaceRenderer::CheckSettings() throws for values out of range. */
struct RenderSettings
{
  int width = 1200;  ///< pixels
  int height = 1200; ///< pixels
  View view = View::Anterior;
  bool perspective = false; ///< parallel projection otherwise, in which sizes can be compared
  Colour background{ 0.0, 0.0, 0.0 };
  int samples = 2;                  ///< along each side of a pixel, 1 to 4; 2 gives four samples per pixel
  bool ambientOcclusion = true;     ///< darkens cavities of opaque surfaces
  bool orientationLabels = true;    ///< L, R, A, P, H, F at the picture's edges
  std::uintmax_t maximumMemory = 0; ///< for drawing, in bytes; 0: half of the free memory
};

} // namespace rhombic

#endif
