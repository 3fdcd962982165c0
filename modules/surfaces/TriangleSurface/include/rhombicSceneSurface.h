#ifndef rhombicSceneSurface_h
#define rhombicSceneSurface_h

#include "itkTriangleSurface.h"
#include "rhombicPicture.h"

#include <cstdint>
#include <string>

namespace rhombic
{

/** \class SceneSurface
 * \brief A surface with its name and looks. Copies share the surface. */
struct SceneSurface
{
  std::string name; ///< in messages and files
  itk::TriangleSurface::ConstPointer surface;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0;   ///< above 0, at most 1: share of the background that one wall hides where it is seen face on
  bool isGlossy = false;  ///< shines as if it were wet; matte otherwise
  std::int32_t label = 0; ///< of the region in its label map; 0 for surfaces of no label
};

} // namespace rhombic

#endif
