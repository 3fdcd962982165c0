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

/** A share from 0 to 1 as a byte. */
std::uint8_t
ToByte(float share)
{
  const float inside = share > 0.0f ? std::min(share, 1.0f) : 0.0f;
  return static_cast<std::uint8_t>(std::lround(255.0f * inside));
}

} // namespace

std::vector<float>
ToLinearLight(const Picture & picture)
{
  static const auto table = MakeTable();
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::vector<float> linear(picture.pixels.size());
  for (std::size_t i = 0; i < linear.size(); ++i)
  {
    const std::size_t channel = i % channels;
    const float alpha = channels == 4 ? static_cast<float>(picture.pixels[i - channel + 3]) / 255.0f : 1.0f;
    linear[i] = channel == 3 ? alpha : alpha * table[picture.pixels[i]];
  }
  return linear;
}

std::vector<std::uint8_t>
FromLinearLight(const std::vector<float> & linear, int channels)
{
  const auto pixelSize = static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> encoded(linear.size());
  for (std::size_t i = 0; i < linear.size(); ++i)
  {
    const std::size_t channel = i % pixelSize;
    const float alpha = channels == 4 ? linear[i - channel + 3] : 1.0f;
    encoded[i] = channel == 3   ? ToByte(alpha)
                 : alpha > 0.0f ? ToByte(OIIO::linear_to_sRGB(std::max(linear[i], 0.0f) / alpha))
                                : 0;
  }
  return encoded;
}

} // namespace rhombic
