#include "rhombicScan.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace rhombic
{
namespace
{

template <typename TPixel>
std::pair<double, double>
RangeOf(const itk::Image<TPixel, 3> & image)
{
  TPixel lowest = std::numeric_limits<TPixel>::max();
  TPixel highest = std::numeric_limits<TPixel>::lowest();
  bool found = false;

  const TPixel * const begin = image.GetBufferPointer();
  const TPixel * const end = begin + image.GetBufferedRegion().GetNumberOfPixels();
  for (const TPixel * pixel = begin; pixel != end; ++pixel)
  {
    if constexpr (std::is_floating_point_v<TPixel>)
    {
      if (!std::isfinite(*pixel))
      {
        continue;
      }
    }
    found = true;
    lowest = *pixel < lowest ? *pixel : lowest;
    highest = *pixel > highest ? *pixel : highest;
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return found ? std::pair<double, double>(lowest, highest) : std::pair<double, double>(none, none);
}

} // namespace

const itk::ImageBase<3> &
GeometryOf(const ScanImage & image)
{
  return std::visit([](const auto & pointer) -> const itk::ImageBase<3> & { return *pointer; }, image);
}

const char *
PixelTypeName(const ScanImage & image)
{
  constexpr std::array<const char *, std::variant_size_v<ScanImage>> names{
    "uint8", "int16", "uint16", "int32", "float"
  };
  return names[image.index()];
}

std::pair<double, double>
ComputeIntensityRange(const ScanImage & image)
{
  return std::visit([](const auto & pointer) { return RangeOf(*pointer); }, image);
}

} // namespace rhombic
