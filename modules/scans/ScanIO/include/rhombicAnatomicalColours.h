#ifndef rhombicAnatomicalColours_h
#define rhombicAnatomicalColours_h

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace rhombic
{

/** Moves a colour (sRGB) towards white by a fraction, or towards black by a negative one. */
std::array<std::uint8_t, 3>
Lighten(std::array<std::uint8_t, 3> colour, double fraction);

/** The colour (sRGB) of an organ, bone, vessel, ... in anatomical illustrations, by its name in English or anatomical
 * Latin: "kidney_left", "Left-Kidney". The table is data/anatomical-colours.tsv. Left is lighter than right, and odd
 * vertebrae, ribs and teeth are darker than even ones. Nothing for other names. */
std::optional<std::array<std::uint8_t, 3>>
FindAnatomicalColour(const std::string & name);

/** FindAnatomicalColour(), or for other names a colour by \a value, different for each value. */
std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value);

} // namespace rhombic

#endif
