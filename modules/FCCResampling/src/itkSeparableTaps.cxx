#include "itkSeparableTaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace itk
{
namespace
{

/** Weights of the samples floor(position) - before ... of an axis without ends. */
struct Kernel
{
  OffsetValueType before;
  std::vector<double> weights;
};

Kernel
LinearKernel(double fraction)
{
  return { 0, { 1.0 - fraction, fraction } };
}

Kernel
CardinalCubicBSplineKernel(double fraction)
{
  constexpr OffsetValueType taps = 24;
  constexpr OffsetValueType before = taps / 2 - 1;
  const double pole = std::sqrt(3.0) - 2.0;
  const double t = fraction;
  const double u = 1.0 - fraction;
  const double spline[4] = {
    u * u * u / 6.0, 2.0 / 3.0 - t * t * (2.0 - t) / 2.0, 2.0 / 3.0 - u * u * (2.0 - u) / 2.0, t * t * t / 6.0
  };
  Kernel kernel{ before, std::vector<double>(taps) };
  for (OffsetValueType tap = 0; tap < taps; ++tap)
  {
    for (OffsetValueType knot = 0; knot < 4; ++knot)
    {
      const auto distance = static_cast<double>(std::abs((tap - before) - (knot - 1)));
      kernel.weights[static_cast<std::size_t>(tap)] += spline[knot] * std::sqrt(3.0) * std::pow(pole, distance);
    }
  }
  const double sum = std::accumulate(kernel.weights.begin(), kernel.weights.end(), 0.0);
  for (double & weight : kernel.weights)
  {
    weight /= sum;
  }
  return kernel;
}

Kernel
MakeKernel(SeparableKernel kernel, double fraction)
{
  return kernel == SeparableKernel::Linear ? LinearKernel(fraction) : CardinalCubicBSplineKernel(fraction);
}

/** The sample that a sample beyond the ends is the mirror image of. */
OffsetValueType
Mirror(OffsetValueType sample, OffsetValueType length)
{
  if (length == 1)
  {
    return 0;
  }
  const OffsetValueType period = 2 * (length - 1);
  const OffsetValueType folded = ((sample % period) + period) % period;
  return std::min(folded, period - folded);
}

} // namespace

SeparableTaps::SeparableTaps(SeparableKernel kernel, SizeValueType length, const std::vector<double> & positions)
  : m_NumberOfTaps(std::min<SizeValueType>(length, MakeKernel(kernel, 0.0).weights.size()))
  , m_First(positions.size())
  , m_Weights(positions.size() * m_NumberOfTaps)
{
  const auto last = static_cast<OffsetValueType>(length) - 1;
  const auto taps = static_cast<OffsetValueType>(m_NumberOfTaps);
  std::vector<double> sums(m_NumberOfTaps);
  for (std::size_t n = 0; n < positions.size(); ++n)
  {
    const double position = std::clamp(positions[n], 0.0, static_cast<double>(last));
    const auto sample = std::min(static_cast<OffsetValueType>(position), std::max<OffsetValueType>(last - 1, 0));
    const Kernel weights = MakeKernel(kernel, position - static_cast<double>(sample));
    const auto first = std::clamp<OffsetValueType>(sample - weights.before, 0, last + 1 - taps);

    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t tap = 0; tap < weights.weights.size(); ++tap)
    {
      const auto source = sample - weights.before + static_cast<OffsetValueType>(tap);
      sums[static_cast<std::size_t>(Mirror(source, last + 1) - first)] += weights.weights[tap];
    }
    m_First[n] = static_cast<SizeValueType>(first);
    std::transform(sums.begin(),
                   sums.end(),
                   m_Weights.begin() + static_cast<std::ptrdiff_t>(n * m_NumberOfTaps),
                   [](double w) { return static_cast<float>(w); });
  }
}

} // namespace itk
