#include "rhombicLinearLight.h"

#include <OpenImageIO/color.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rhombic
{
namespace
{

std::array<float, 256>
MakeTable()
{
  std::array<float, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    table[i] = OIIO::sRGB_to_linear(static_cast<float>(i) / 255.0f);
  }
  return table;
}

std::uint8_t
Encode(float linear)
{
  const float inside = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  return static_cast<std::uint8_t>(std::lround(255.0f * OIIO::linear_to_sRGB(inside)));
}

} // namespace

std::vector<float>
ToLinearLight(const std::vector<std::uint8_t> & encoded)
{
  static const auto table = MakeTable();
  std::vector<float> linear(encoded.size());
  std::transform(encoded.begin(), encoded.end(), linear.begin(), [](std::uint8_t value) { return table[value]; });
  return linear;
}

std::vector<std::uint8_t>
FromLinearLight(const std::vector<float> & linear)
{
  std::vector<std::uint8_t> encoded(linear.size());
  std::transform(linear.begin(), linear.end(), encoded.begin(), Encode);
  return encoded;
}

} // namespace rhombic
