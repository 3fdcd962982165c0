#include "rhombicScanValues.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

std::vector<double>
TakeScanValues(const Scan & scan)
{
  return std::visit(
    [](const auto & image) {
      constexpr std::size_t most = std::size_t(1) << 18;
      const std::size_t size = image->GetLargestPossibleRegion().GetNumberOfPixels();
      const std::size_t step = (size / most) | 1; // odd, so that not all values are from the same columns
      std::vector<double> values;
      for (std::size_t n = 0; n < size; n += step)
      {
        const auto value = static_cast<double>(image->GetBufferPointer()[n]);
        if (std::isfinite(value))
        {
          values.push_back(value);
        }
      }
      return values;
    },
    scan.image);
}

bool
IsInHounsfieldUnits(const Scan & scan)
{
  constexpr double nearAir = -900.0;
  constexpr double belowFat = -200.0; // CTs of the inside of a body have no air
  const std::vector<double> values = TakeScanValues(scan);
  const double lowest = values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
  return scan.modality == "CT" ? lowest < belowFat : scan.modality.empty() && lowest < nearAir;
}

} // namespace rhombic
