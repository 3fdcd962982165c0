#ifndef rhombicFileColours_h
#define rhombicFileColours_h

#include "rhombicSceneSurface.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rhombic
{

/** The value limited to 0 to 1; 0 for NaN. */
inline double
ToUnit(double value)
{
  return value > 0 ? std::min(value, 1.0) : 0.0;
}

/** A value from 0 to 1 as 0 to 255, limited and rounded. */
std::uint8_t
ToByte(double value);

std::array<std::uint8_t, 3>
ToBytes(const Colour & colour);

/** From sRGB to linear light and back (IEC 61966-2-1). */
Colour
SRGBToLinear(const Colour & colour);

Colour
LinearToSRGB(const Colour & light);

} // namespace rhombic

#endif
