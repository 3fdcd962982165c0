#ifndef rhombicAnatomicalColours_h
#define rhombicAnatomicalColours_h

#include <array>
#include <cstdint>
#include <string>

namespace rhombic
{

/** A colour (sRGB) as in anatomical illustrations for the name of an organ, bone, vessel, ... in English or anatomical
 * Latin, however its words are joined: "kidney_left", "Left-Kidney". Left is lighter than right, and odd vertebrae,
 * ribs and teeth are darker than even ones. Other names get colours that depend on \a value only and differ from
 * value to value. Thread safe. */
std::array<std::uint8_t, 3>
AnatomicalColour(const std::string & name, std::int32_t value);

} // namespace rhombic

#endif
