#ifndef rhombicAnatomicalColours_h
#define rhombicAnatomicalColours_h

#include <array>
#include <cstdint>
#include <string>

namespace rhombic
{

/** A colour (sRGB) as in anatomical illustrations for the name of an organ, bone, vessel, ... in English or anatomical
 * Latin: "kidney_left", "Left-Kidney". The table is data/anatomical-colours.tsv. Left is lighter than right, and odd
 * vertebrae, ribs and teeth are darker than even ones. Other names get a colour by \a value, different for each value.
 */
std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value);

} // namespace rhombic

#endif
