#ifndef rhombicColour_h
#define rhombicColour_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rhombic
{

/** Red, green and blue from 0 to 1, as sRGB encodes them. */
using Colour = std::array<double, 3>;

/** The value limited to 0 to 1; 0 for NaN. */
inline double
ToUnit(double value)
{
  return value > 0 ? std::min(value, 1.0) : 0.0;
}

/** A value from 0 to 1 as 0 to 255, limited and rounded. */
inline std::uint8_t
ToByte(double value)
{
  return static_cast<std::uint8_t>(std::lround(255 * ToUnit(value)));
}

/** The components as ToByte() makes them. */
inline std::array<std::uint8_t, 3>
ToBytes(const Colour & colour)
{
  return { ToByte(colour[0]), ToByte(colour[1]), ToByte(colour[2]) };
}

/** A component from sRGB to linear light (IEC 61966-2-1), limited to 0 to 1. */
inline double
SRGBToLinear(double component)
{
  const double encoded = ToUnit(component);
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/** A component from linear light to sRGB (IEC 61966-2-1), limited to 0 to 1. */
inline double
LinearToSRGB(double component)
{
  const double light = ToUnit(component);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

} // namespace rhombic

#endif
