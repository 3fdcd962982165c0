#ifndef rhombicNamePlaces_h
#define rhombicNamePlaces_h

#include "rhombicScene.h"

#include <cstddef>
#include <vector>

namespace rhombic
{

/** Where the line from a name to a surface ends in a view. */
struct NamePlace
{
  std::size_t surface = 0; ///< its number in the scene
  Vector3 point{};         ///< that is seen there, in the plane through the projection's centre
  Vector3 left{};          ///< as the point, but of the surface's left and right end
  Vector3 right{};
  double seen = 0.0; ///< share of the picture in which the surface is seen
};

/** For each surface that is seen in a view, the middle of the largest disk, nearly, in which it alone is seen. A pixel
 * is of the opaque surface in front; if there is none, of the translucent one that begins last: an organ in its skin.
 * On the pictures of planes, as on cut faces, it is of the innermost surface that is cut there. Surfaces without a
 * place for a dot are left out, and so are those seen only behind or before others. Time is linear in the triangles,
 * and does not depend on the size of the picture. */
std::vector<NamePlace>
FindNamePlaces(const Scene & scene, const Projection & projection);

} // namespace rhombic

#endif
