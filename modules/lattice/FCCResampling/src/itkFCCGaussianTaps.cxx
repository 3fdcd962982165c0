#include "detail/itkFCCGaussianTaps.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

/** A symmetric factor: its weights from the middle on, and its sums (see FCCGaussianTaps). */
struct HalfFactor
{
  std::vector<double> weights;
  double secondMoment = 0.0;      // m
  double alternatingSum = 0.0;    // A
  double alternatingMoment = 0.0; // B
};

/** The sampled Gaussian in which weights fall by \a decay = exp(-1 / 2q) from the middle to the first step. */
HalfFactor
SampleGaussian(double decay, OffsetValueType reach)
{
  HalfFactor factor;
  double sum = 0.0;
  for (OffsetValueType n = 0; n <= reach; ++n)
  {
    const auto square = static_cast<double>(n * n);
    factor.weights.push_back(std::pow(decay, square));
    const double both = (n == 0 ? 1.0 : 2.0) * factor.weights.back();
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    sum += both;
    factor.secondMoment += square * both;
    factor.alternatingSum += sign * both;
    factor.alternatingMoment += sign * square * both;
  }
  for (double * const value : { &factor.secondMoment, &factor.alternatingSum, &factor.alternatingMoment })
  {
    *value /= sum;
  }
  for (double & weight : factor.weights)
  {
    weight /= sum;
  }
  return factor;
}

/** The sampled Gaussian with the given second moment, which grows with the decay. */
HalfFactor
FindGaussian(double secondMoment, OffsetValueType reach)
{
  double low = 0.0;
  double high = 1.0;
  for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high))
  {
    (SampleGaussian(middle, reach).secondMoment < secondMoment ? low : high) = middle;
  }
  return SampleGaussian(low, reach);
}

/** The factors whose product has the given variances on the lattice, by damped fixed-point iteration. Damping is needed
 * because with small variances along one axis alone, moments on the lattice grow with the fourth power of the factor's.
 */
std::array<HalfFactor, 3>
FindFactors(const std::array<double, 3> & variances, const std::array<OffsetValueType, 3> & reach)
{
  constexpr unsigned int mostRounds = 1000;
  constexpr double tolerance = 1e-10;
  constexpr double damping = 0.25;
  std::array<HalfFactor, 3> factors;
  std::array<double, 3> moments = variances;
  double worst = 1.0;
  for (unsigned int round = 0; round < mostRounds && worst > tolerance; ++round)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      factors[axis] = FindGaussian(moments[axis], reach[axis]);
    }
    worst = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double others = factors[(axis + 1) % 3].alternatingSum * factors[(axis + 2) % 3].alternatingSum;
      const double onLattice = (factors[axis].secondMoment + factors[axis].alternatingMoment * others) /
                               (1.0 + factors[axis].alternatingSum * others);
      if (variances[axis] > 0.0)
      {
        worst = std::max(worst, std::abs(onLattice / variances[axis] - 1.0));
        moments[axis] *= std::pow(variances[axis] / onLattice, damping);
      }
    }
  }
  return factors;
}

} // namespace

FCCGaussianTaps::FCCGaussianTaps(const std::array<double, 3> & variances)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    // A step along one axis alone is of two units.
    const auto reach = static_cast<OffsetValueType>(std::ceil(4.0 * std::sqrt(variances[axis])));
    m_Reach[axis] = variances[axis] > 0.0 ? std::max<OffsetValueType>(2, reach) : 1;
  }
  const auto factors = FindFactors(variances, m_Reach);
  const double sum = 0.5 * (1.0 + factors[0].alternatingSum * factors[1].alternatingSum * factors[2].alternatingSum);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double scale = axis == 0 ? 1.0 / sum : 1.0;
    for (OffsetValueType step = -m_Reach[axis]; step <= m_Reach[axis]; ++step)
    {
      const auto distance = static_cast<std::size_t>(std::abs(step));
      Factor & factor = m_Factors[axis][distance % 2];
      factor.steps.push_back(step);
      factor.weights.push_back(static_cast<float>(scale * factors[axis].weights[distance]));
    }
  }
}

ImageRegion<3>
FCCGaussianTaps::AddReach(const ImageRegion<3> & region, const ImageRegion<3> & whole) const
{
  ImageRegion<3> wider = region;
  wider.PadByRadius({ { static_cast<SizeValueType>(m_Reach[0] / 2 + 1),
                        static_cast<SizeValueType>(m_Reach[1]),
                        static_cast<SizeValueType>(m_Reach[2]) } });
  wider.Crop(whole);
  return wider;
}

} // namespace itk
