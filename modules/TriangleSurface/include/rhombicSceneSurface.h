#ifndef rhombicSceneSurface_h
#define rhombicSceneSurface_h

#include "itkTriangleSurface.h"

#include <array>
#include <string>

namespace rhombic
{

/** Red, green and blue from 0 to 1, as sRGB encodes them. */
using Colour = std::array<double, 3>;

/** \class SceneSurface
 * \brief A surface and how it looks.
 *
 * Thread safety: a value, whose copies share the surface. */
struct SceneSurface
{
  std::string name; ///< as messages and files call it
  itk::TriangleSurface::ConstPointer surface;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0; ///< above 0, at most 1: what one wall, seen squarely, covers
};

} // namespace rhombic

#endif
