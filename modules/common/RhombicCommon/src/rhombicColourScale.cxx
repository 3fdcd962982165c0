#include "rhombicColourScale.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace rhombic
{
namespace
{

/** Colours at equal distances, as 0xrrggbb. Viridis and inferno are van der Walt's and Smith's maps for matplotlib
 * (CC0), at nine and ten places. */
const std::map<std::string, std::vector<std::uint32_t>> &
GetMaps()
{
  static const std::map<std::string, std::vector<std::uint32_t>> maps{
    { "diverging", { 0x24549c, 0x4f88c4, 0x9cc3e0, 0xe9e9e6, 0xf3b98d, 0xd9733b, 0xa63a14 } },
    { "inferno",
      { 0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60, 0xcf4446, 0xed6925, 0xfb9b06, 0xf7d13d, 0xfcffa4 } },
    { "viridis", { 0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725 } }
  };
  return maps;
}

double
ComponentOf(std::uint32_t colour, unsigned int channel)
{
  return static_cast<double>(colour >> (16 - 8 * channel) & 0xff) / 255.0;
}

} // namespace

std::vector<std::string>
GetColourMaps()
{
  std::vector<std::string> names;
  for (const auto & [name, colours] : GetMaps())
  {
    names.push_back(name);
  }
  return names;
}

std::vector<std::string>
NumbersOnBar(const ColourScale & scale)
{
  constexpr int count = 5;
  std::vector<std::string> numbers;
  for (int n = 0; n < count; ++n)
  {
    const double value = scale.low + (scale.high - scale.low) * n / (count - 1);
    const double nearZero = 1e-9 * std::max(std::abs(scale.low), std::abs(scale.high));
    numbers.push_back(FormatNumber(std::abs(value) < nearZero ? 0.0 : value, 3));
  }
  return numbers;
}

Colour
ColourOf(const ColourScale & scale, double value)
{
  constexpr Colour none{ 0.5, 0.5, 0.5 };
  const auto found = GetMaps().find(scale.map);
  if (found == GetMaps().end())
  {
    throw Failure(FailureKind::Usage,
                  DescribeUnknown("colour map", scale.map, GetColourMaps(), "use " + Enumerate(GetColourMaps())));
  }
  if (std::isnan(value))
  {
    return none;
  }
  const std::vector<std::uint32_t> & colours = found->second;
  const double range = scale.high - scale.low;
  const double share = ToUnit(range > 0.0 ? (value - scale.low) / range : 0.5);
  const double place = share * static_cast<double>(colours.size() - 1);
  const std::size_t before = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  const double weight = place - static_cast<double>(before);
  Colour colour;
  for (unsigned int channel = 0; channel < 3; ++channel)
  {
    colour[channel] =
      (1.0 - weight) * ComponentOf(colours[before], channel) + weight * ComponentOf(colours[before + 1], channel);
  }
  return colour;
}

} // namespace rhombic
