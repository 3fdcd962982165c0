#ifndef rhombicColourBar_h
#define rhombicColourBar_h

#include "rhombicColourScale.h"
#include "rhombicDrawing.h"

#include <string>
#include <vector>

namespace rhombic
{

/** A bar of a scale's colours with its numbers, upright, the highest at the top, under its title. */
struct ColourBarLayout
{
  std::vector<std::string> numbers; ///< from the lowest to the highest, at equal distances
  double width = 0.0;               ///< pixels, of the bar and its numbers; at least that of the title
};

/** \param style of the numbers */
ColourBarLayout
FitColourBar(const Drawing & drawing, const ColourScale & scale, const TextStyle & style);

/** Draws a bar with its title from the top left corner of \a place. The bar has at most 20 lines of text in height. */
void
DrawColourBar(Drawing & drawing,
              const ColourScale & scale,
              const ColourBarLayout & layout,
              const Rectangle & place,
              const TextStyle & style);

} // namespace rhombic

#endif
