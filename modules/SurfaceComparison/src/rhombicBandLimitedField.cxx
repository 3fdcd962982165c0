#include "rhombicBandLimitedField.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rhombic
{
namespace
{

constexpr double twoPi = 6.283185307179586;

/** Evenly distributed in [0, 1), from the generator's bits: the standard library's distributions are not the same
 * everywhere. */
double
Uniform(std::mt19937_64 & random)
{
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

/** sin(2 pi t) for |t| <= 1/4, by its Taylor series up to t^15. */
inline double
SineOfTurn(double t)
{
  const double x = twoPi * t;
  const double q = x * x;
  double sum = -1.0 / 1307674368000.0;
  sum = sum * q + 1.0 / 6227020800.0;
  sum = sum * q - 1.0 / 39916800.0;
  sum = sum * q + 1.0 / 362880.0;
  sum = sum * q - 1.0 / 5040.0;
  sum = sum * q + 1.0 / 120.0;
  sum = sum * q - 1.0 / 6.0;
  return x + x * q * sum;
}

/** The fraction of a turn in [-1/2, 1/2] that a number of turns ends at. */
inline double
FractionOfTurn(double turns)
{
  constexpr double shift = 0x1.8p52; // numbers of this size have no fraction: adding it rounds
  return turns - ((turns + shift) - shift);
}

} // namespace

BandLimitedField::BandLimitedField(double bandLimit, std::uint64_t seed, unsigned int numberOfWaves)
  : m_Waves((numberOfWaves + 1) / 2)
  , m_Amplitude(std::sqrt(1.0 / static_cast<double>(m_Waves.size())))
{
  std::mt19937_64 random(seed);
  const double radius = bandLimit / 2.0;
  for (WavePair & pair : m_Waves)
  {
    for (unsigned int lane = 0; lane < 2; ++lane)
    {
      Vector3 k;
      do
      {
        for (double & component : k)
        {
          component = 2.0 * Uniform(random) - 1.0;
        }
      } while (k[0] * k[0] + k[1] * k[1] + k[2] * k[2] > 1.0);
      pair.x[lane] = radius * k[0];
      pair.y[lane] = radius * k[1];
      pair.z[lane] = radius * k[2];
      pair.phase[lane] = Uniform(random);
    }
  }
}

double
BandLimitedField::Evaluate(const Vector3 & point) const
{
  double sum[2]{};
  for (const WavePair & pair : m_Waves)
  {
    for (unsigned int lane = 0; lane < 2; ++lane)
    {
      const double turns =
        pair.x[lane] * point[0] + pair.y[lane] * point[1] + pair.z[lane] * point[2] + pair.phase[lane];
      sum[lane] += SineOfTurn(0.25 - std::abs(FractionOfTurn(turns)));
    }
  }
  return m_Amplitude * (sum[0] + sum[1]);
}

double
BandLimitedField::Evaluate(const Vector3 & point, Vector3 & gradient) const
{
  double sum[2]{};
  double x[2]{};
  double y[2]{};
  double z[2]{};
  for (const WavePair & pair : m_Waves)
  {
    for (unsigned int lane = 0; lane < 2; ++lane)
    {
      const double turns =
        pair.x[lane] * point[0] + pair.y[lane] * point[1] + pair.z[lane] * point[2] + pair.phase[lane];
      const double fraction = FractionOfTurn(turns);
      const double size = std::abs(fraction);
      sum[lane] += SineOfTurn(0.25 - size);
      const double sine = SineOfTurn(std::copysign(std::min(size, 0.5 - size), fraction));
      x[lane] += sine * pair.x[lane];
      y[lane] += sine * pair.y[lane];
      z[lane] += sine * pair.z[lane];
    }
  }
  const double scale = -twoPi * m_Amplitude;
  gradient = { scale * (x[0] + x[1]), scale * (y[0] + y[1]), scale * (z[0] + z[1]) };
  return m_Amplitude * (sum[0] + sum[1]);
}

} // namespace rhombic
