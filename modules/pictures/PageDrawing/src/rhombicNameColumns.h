#ifndef rhombicNameColumns_h
#define rhombicNameColumns_h

#include "rhombicAnnotations.h"

#include <vector>

namespace rhombic
{

/** The columns of names at both sides of a scene, and how their text is set. */
struct NameColumns
{
  Rectangle left;
  Rectangle right;
  TextStyle text;
  double pitch = 0.0; ///< between the middles of two names, pixels
};

/** Takes columns for names from the sides of \a scene: as wide as the longest name, but not more than 0.22 of \a width.
 * \param style of the picture's texts */
NameColumns
TakeNameColumns(const Drawing & drawing,
                const std::vector<PointedName> & names,
                const TextStyle & style,
                double width,
                Rectangle & scene);

/** Places as many names as fit, those that are seen most, in columns that are moved to what is named. Names whose
 * anchors are in the left half are at the left, as far as there is room. */
std::vector<PlacedName>
PlaceInColumns(const Drawing & drawing, const std::vector<PointedName> & names, NameColumns columns);

/** Draws all lines over the halos of all, then the names. */
void
DrawNames(Drawing & drawing,
          const std::vector<PointedName> & names,
          const std::vector<PlacedName> & placed,
          const TextStyle & text,
          bool isDark);

} // namespace rhombic

#endif
