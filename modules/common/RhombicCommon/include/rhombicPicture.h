#ifndef rhombicPicture_h
#define rhombicPicture_h

#include "rhombicColour.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class Picture
 * \brief An 8-bit sRGB picture: red, green, blue and perhaps alpha of each pixel, rows from the top, pixels from the
 * left. Alpha is straight: colours are not multiplied by it. */
struct Picture
{
  int width = 0;
  int height = 0;
  int channels = 3;                 ///< bytes of a pixel: 3, or 4 with alpha
  std::vector<std::uint8_t> pixels; ///< height * width * channels bytes

  Picture() = default;
  /** A black one, or with 4 channels a transparent one; neither side may be negative. */
  Picture(int w, int h, int c = 3)
    : width(w)
    , height(h)
    , channels(c)
    , pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c))
  {}

  /** The bytes of the pixel in column \a x and row \a y from the top left, which must be in the picture. */
  const std::uint8_t *
  At(int x, int y) const
  {
    return pixels.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
             static_cast<std::size_t>(channels);
  }
};

/** Pixels at the edges of a picture. */
struct Margins
{
  double left = 0.0;
  double right = 0.0;
  double top = 0.0;
  double bottom = 0.0;
};

} // namespace rhombic

#endif
