#include "rhombicPairedTimes.h"

#include <algorithm>
#include <limits>

namespace rhombic
{

std::vector<double>
PairedTimes::GetRatios() const
{
  std::vector<double> ratios(std::min(reference.size(), candidate.size()));
  for (std::size_t i = 0; i < ratios.size(); ++i)
  {
    ratios[i] = reference[i] / candidate[i];
  }
  return ratios;
}

double
Median(std::vector<double> values)
{
  if (values.empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

} // namespace rhombic
