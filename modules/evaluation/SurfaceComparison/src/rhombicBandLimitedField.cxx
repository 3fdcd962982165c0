#include "rhombicBandLimitedField.h"

#include "rhombicWaveSum.h"

#include <cmath>
#include <random>

namespace rhombic
{
namespace
{

/** A random number evenly distributed in [0, 1). The standard library's own distributions differ between
 * implementations. */
double
Uniform(std::mt19937_64 & random)
{
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

} // namespace

BandLimitedField::BandLimitedField(double bandLimit, std::uint64_t seed, unsigned int numberOfWaves)
{
  const std::size_t count = (numberOfWaves + waveBatch - 1) / waveBatch * waveBatch;
  m_Amplitude = std::sqrt(2.0 / static_cast<double>(count));
  std::mt19937_64 random(seed);
  const double radius = bandLimit / 2.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    Vector3 k;
    do
    {
      for (double & component : k)
      {
        component = 2.0 * Uniform(random) - 1.0;
      }
    } while (k[0] * k[0] + k[1] * k[1] + k[2] * k[2] > 1.0);
    m_X.push_back(radius * k[0]);
    m_Y.push_back(radius * k[1]);
    m_Z.push_back(radius * k[2]);
    m_Phases.push_back(Uniform(random));
  }
}

double
BandLimitedField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  constexpr double twoPi = 6.283185307179586;
  const WaveSums sums = SumWaves(m_X.data(), m_Y.data(), m_Z.data(), m_Phases.data(), m_X.size(), point);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    gradient[axis] = -twoPi * m_Amplitude * sums.sine[axis];
  }
  return m_Amplitude * sums.cosine;
}

} // namespace rhombic
