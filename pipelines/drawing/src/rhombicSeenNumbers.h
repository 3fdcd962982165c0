#ifndef rhombicSeenNumbers_h
#define rhombicSeenNumbers_h

#include "rhombicScene.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace rhombic
{

/** The number of the surface that each ray of a view sees. */
struct SeenNumbers
{
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  int width = 0;
  int height = 0;
  std::vector<std::size_t> numbers; ///< in rows from the top

  std::size_t
  At(int x, int y) const
  {
    const bool isInside = x >= 0 && x < width && y >= 0 && y < height;
    return isInside ? numbers[this->IndexOf(x, y)] : None;
  }
  std::size_t
  IndexOf(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/** A ray sees the opaque surface in front; if there is none, the translucent one that begins last: an organ in its
 * skin. On the pictures of planes, as on cut faces, it sees the innermost surface that is cut there. */
SeenNumbers
FindSeenNumbers(const Scene & scene, const Projection & rays);

} // namespace rhombic

#endif
