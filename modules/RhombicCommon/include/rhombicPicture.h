#ifndef rhombicPicture_h
#define rhombicPicture_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class Picture
 * \brief An 8-bit sRGB picture: three bytes (red, green, blue) a pixel, rows from the top, pixels from the left. */
struct Picture
{
  static constexpr int Channels = 3;

  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels; ///< height * width * Channels bytes

  Picture() = default;
  /** A black one; neither side may be negative. */
  Picture(int w, int h)
    : width(w)
    , height(h)
    , pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * Channels)
  {}

  /** The three bytes of the pixel in column \a x and row \a y from the top left, which must be in the picture. */
  const std::uint8_t *
  At(int x, int y) const
  {
    return pixels.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * Channels;
  }
};

} // namespace rhombic

#endif
