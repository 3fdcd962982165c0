#ifndef rhombicScene_h
#define rhombicScene_h

#include "itkTriangleSurface.h"
#include "rhombicView.h"

#include <array>
#include <string>

namespace rhombic
{

/** Red, green and blue from 0 to 1, as sRGB encodes them. */
using Colour = std::array<double, 3>;

/** A surface and how it looks. */
struct SceneSurface
{
  std::string name; ///< as messages call it
  itk::TriangleSurface::ConstPointer surface;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0; ///< above 0, at most 1: what one wall, seen squarely, covers
};

/** How a scene becomes a picture. A side can have 8192 samples: 4096 pixels with two samples each. */
struct RenderSettings
{
  int width = 1200;  ///< pixels
  int height = 1200; ///< pixels
  View view = View::Anterior;
  bool perspective = false; ///< parallel rays otherwise, so that sizes can be compared
  Colour background{ 0.0, 0.0, 0.0 };
  int samples = 2;               ///< along each side of a pixel, 1 to 4: 2 means four samples a pixel
  bool ambientOcclusion = true;  ///< darkens cavities of opaque surfaces
  bool orientationLabels = true; ///< L, R, A, P, H, F at the picture's edges
};

} // namespace rhombic

#endif
