#ifndef rhombicPixelTypes_h
#define rhombicPixelTypes_h

#include "itkImage.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>

/** \file
 * The pixel types of scans and of lattice volumes: the one list of them. A variant of images is made from it,
 * and the filters are compiled once for each of its types. */

/** The list. The number of its entries is also in RHOMBIC_INSTANTIATE_FIVE. */
#define RHOMBIC_PIXEL_TYPES std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float

/** Instantiates a class template of images for each pixel type. \a declaration is `template class itk::SomeFilter`,
 * with `extern` before it in the header; \a image is a template of a pixel type. */
#define RHOMBIC_INSTANTIATE(declaration, image) RHOMBIC_INSTANTIATE_LIST(declaration, image, RHOMBIC_PIXEL_TYPES)
/** \cond */
#define RHOMBIC_INSTANTIATE_LIST(declaration, image, ...) RHOMBIC_INSTANTIATE_FIVE(declaration, image, __VA_ARGS__)
#define RHOMBIC_INSTANTIATE_FIVE(declaration, image, a, b, c, d, e)                                                    \
  declaration<image<a>>;                                                                                               \
  declaration<image<b>>;                                                                                               \
  declaration<image<c>>;                                                                                               \
  declaration<image<d>>;                                                                                               \
  declaration<image<e>>
/** \endcond */

namespace rhombic
{

/** A volume on a Cartesian grid. */
template <typename TPixel>
using CartesianImage = itk::Image<TPixel, 3>;

/** A list of pixel types, and a pointer to an image of any of them. */
template <typename... TPixels>
struct PixelTypeList
{
  template <template <typename> class TImage>
  using AnyImage = std::variant<typename TImage<TPixels>::Pointer...>;
};

using PixelTypes = PixelTypeList<RHOMBIC_PIXEL_TYPES>;

/** "uint8", "int16", "float" and so on. */
template <typename TPixel>
std::string
PixelTypeName()
{
  if constexpr (std::is_floating_point_v<TPixel>)
  {
    return "float";
  }
  else
  {
    return (std::is_signed_v<TPixel> ? "int" : "uint") + std::to_string(8 * sizeof(TPixel));
  }
}

/** \class Threshold
 * \brief The isovalue of a surface, and which values are inside. */
struct Threshold
{
  double isovalue = 0.0;      ///< in the volume's units
  bool insideIsBelow = false; ///< values below the isovalue are inside; otherwise values at or above it

  /** NaN is outside. */
  bool
  IsInside(double value) const
  {
    return insideIsBelow ? value < isovalue : value >= isovalue;
  }
};

} // namespace rhombic

#endif
