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
 * \brief A surface with its name, colour and opacity. Copies share the surface. */
struct SceneSurface
{
  std::string name; ///< in messages and files
  itk::TriangleSurface::ConstPointer surface;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0; ///< above 0, at most 1: share of the background that one wall hides where it is seen face on
};

} // namespace rhombic

#endif
