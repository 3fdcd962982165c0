#include "rhombicFileColours.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

std::uint8_t
ToByte(double value)
{
  return static_cast<std::uint8_t>(std::lround(255 * ToUnit(value)));
}

std::array<std::uint8_t, 3>
ToBytes(const Colour & colour)
{
  return { ToByte(colour[0]), ToByte(colour[1]), ToByte(colour[2]) };
}

Colour
SRGBToLinear(const Colour & colour)
{
  Colour light;
  std::transform(colour.begin(), colour.end(), light.begin(), [](double value) {
    value = ToUnit(value);
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  });
  return light;
}

Colour
LinearToSRGB(const Colour & light)
{
  Colour colour;
  std::transform(light.begin(), light.end(), colour.begin(), [](double value) {
    value = ToUnit(value);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  });
  return colour;
}

} // namespace rhombic
