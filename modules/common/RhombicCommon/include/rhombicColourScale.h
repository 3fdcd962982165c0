#ifndef rhombicColourScale_h
#define rhombicColourScale_h

#include "rhombicColour.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \class ColourScale
 * \brief Colours for numbers: a map of colours between two values. */
struct ColourScale
{
  std::string map = "viridis";    ///< one of GetColourMaps()
  double low = 0.0;               ///< the value of the map's first colour; lower values have it, too
  double high = 1.0;              ///< the value of the map's last colour; higher values have it, too
  std::string title;              ///< what the numbers are, with their unit: "distance, mm"
  std::vector<double> marks = {}; ///< values that lines across a bar of the colours mark, as a tolerance
};

/** The names of all maps: viridis and inferno, which grow lighter all the way, and diverging, which is lightest in the
 * middle. Colour-blind people can read all of them. */
std::vector<std::string>
GetColourMaps();

/** The numbers beside a bar of the scale's colours: five at equal distances, from its lower end to its upper end. */
std::vector<std::string>
NumbersOnBar(const ColourScale & scale);

/** The colour of a value; middle grey for NaN, which stands for no value. Between the map's fixed colours components of
 * sRGB are linear. Throws Failure(Usage) for an unknown map. */
Colour
ColourOf(const ColourScale & scale, double value);

} // namespace rhombic

#endif
