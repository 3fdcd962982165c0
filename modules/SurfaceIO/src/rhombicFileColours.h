#ifndef rhombicFileColours_h
#define rhombicFileColours_h

#include "rhombicSceneSurface.h"

#include <array>
#include <cstdint>

namespace rhombic
{

/** 0 to 1 as 0 to 255, rounded; what is outside becomes the nearest. */
std::uint8_t
ToByte(double value);

std::array<std::uint8_t, 3>
ToBytes(const Colour & colour);

Colour
FromBytes(const std::array<std::uint8_t, 3> & bytes);

/** From the numbers that files of pictures hold to those that are proportional to light, and back (IEC 61966-2-1). */
Colour
SRGBToLinear(const Colour & colour);

Colour
LinearToSRGB(const Colour & light);

} // namespace rhombic

#endif
