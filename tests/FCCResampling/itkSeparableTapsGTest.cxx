#include "itkSeparableTaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using itk::SeparableKernel;
using itk::SeparableTaps;

double
Evaluate(const SeparableTaps & taps, const std::vector<double> & samples, itk::SizeValueType n = 0)
{
  double sum = 0.0;
  for (itk::SizeValueType tap = 0; tap < taps.GetNumberOfTaps(); ++tap)
  {
    sum += taps.GetWeights(n)[tap] * samples[taps.GetFirst(n) + tap];
  }
  return sum;
}

std::vector<double>
Sample(itk::SizeValueType length, double (*field)(double))
{
  std::vector<double> samples(length);
  for (itk::SizeValueType n = 0; n < length; ++n)
  {
    samples[n] = field(static_cast<double>(n));
  }
  return samples;
}

TEST(SeparableTaps, LinearIsExactForLinearFieldsAndConstantBeyondTheEnds)
{
  const auto samples = Sample(8, [](double x) { return 3.0 * x - 1.0; });
  for (const double x : { 0.0, 0.25, 3.5, 6.999, 7.0 })
  {
    EXPECT_NEAR(Evaluate(SeparableTaps(SeparableKernel::Linear, 8, { x }), samples), 3.0 * x - 1.0, 1e-5);
  }
  EXPECT_NEAR(Evaluate(SeparableTaps(SeparableKernel::Linear, 8, { -0.5 }), samples), -1.0, 1e-6);
  EXPECT_NEAR(Evaluate(SeparableTaps(SeparableKernel::Linear, 8, { 7.5 }), samples), 20.0, 1e-6);
}

TEST(SeparableTaps, CubicBSplineReproducesCubicsAwayFromTheEnds)
{
  const auto cubic = [](double x) { return 1e-3 * x * x * x - 0.1 * x * x + 2.0 * x - 5.0; };
  const auto samples = Sample(64, cubic);
  for (const double x : { 28.0, 30.25, 31.5, 35.9 })
  {
    EXPECT_NEAR(Evaluate(SeparableTaps(SeparableKernel::CubicBSpline, 64, { x }), samples), cubic(x), 3e-5);
  }
}

TEST(SeparableTaps, CubicBSplineInterpolatesItsSamples)
{
  std::vector<double> samples(40);
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    samples[n] = std::sin(37.0 * static_cast<double>(n * n)) * 100.0;
  }
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const SeparableTaps taps(SeparableKernel::CubicBSpline, samples.size(), { static_cast<double>(n) });
    EXPECT_NEAR(Evaluate(taps, samples), samples[n], 2e-4) << "at the ends, too";
  }
}

TEST(SeparableTaps, CubicBSplineIsNoWorseThanTheExactSplineForBandLimitedFields)
{
  constexpr itk::SizeValueType length = 62;
  for (const double band : { 0.25, 0.5, 0.75 })
  {
    double squares = 0.0;
    double squaresOfExact = 0.0;
    for (double part = 0.05; part < 1.0; part += 0.1)
    {
      const double density = 1.0 - part * part; // of one component of a wave vector in a ball
      const double w = part * band * std::acos(-1.0);
      for (const double phase : { 0.0, 0.5 * std::acos(-1.0) })
      {
        std::vector<double> samples(length);
        for (itk::SizeValueType n = 0; n < length; ++n)
        {
          samples[n] = std::cos(w * static_cast<double>(n) + phase);
        }
        for (double x = 30.0; x < 31.0; x += 0.05)
        {
          const double truth = std::cos(w * x + phase);
          const double value = Evaluate(SeparableTaps(SeparableKernel::CubicBSpline, length, { x }), samples);
          squares += density * (value - truth) * (value - truth);

          // A wave's coefficients are the wave divided by the B-spline's response.
          double exact = 0.0;
          for (double knot = std::floor(x) - 1.0; knot <= std::floor(x) + 2.0; ++knot)
          {
            const double d = std::min(std::abs(x - knot), 2.0);
            const double spline = d < 1.0 ? 2.0 / 3.0 - d * d * (2.0 - d) / 2.0 : std::pow(2.0 - d, 3) / 6.0;
            exact += spline * 3.0 / (2.0 + std::cos(w)) * std::cos(w * knot + phase);
          }
          squaresOfExact += density * (exact - truth) * (exact - truth);
        }
      }
    }
    EXPECT_LT(std::sqrt(squares), 1.03 * std::sqrt(squaresOfExact)) << band;
  }
}

TEST(SeparableTaps, Lanczos4IsTheNormalisedWindowedSinc)
{
  const double pi = std::acos(-1.0);
  const auto sinc = [pi](double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); };
  const auto samples = Sample(40, [](double x) { return std::sin(11.0 * x * x) * 100.0; });
  for (const double x : { 12.0, 17.3, 20.5, 24.99 })
  {
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
      const double d = x - static_cast<double>(n);
      const double weight = std::abs(d) < 4.0 ? sinc(d) * sinc(d / 4.0) : 0.0;
      sum += weight * samples[n];
      weights += weight;
    }
    EXPECT_NEAR(Evaluate(SeparableTaps(SeparableKernel::Lanczos4, 40, { x }), samples), sum / weights, 1e-4);
  }
}

TEST(SeparableTaps, WeightsSumToOneOnAxesOfAnyLength)
{
  for (const auto kernel : { SeparableKernel::Linear, SeparableKernel::CubicBSpline, SeparableKernel::Lanczos4 })
  {
    for (itk::SizeValueType length = 1; length < 60; ++length)
    {
      std::vector<double> positions;
      for (double x = -1.0; x < static_cast<double>(length) + 0.5; x += 0.37)
      {
        positions.push_back(x);
      }
      const SeparableTaps taps(kernel, length, positions);
      for (itk::SizeValueType n = 0; n < positions.size(); ++n)
      {
        ASSERT_LE(taps.GetFirst(n) + taps.GetNumberOfTaps(), length);
        ASSERT_NEAR(Evaluate(taps, std::vector<double>(length, 1.0), n), 1.0, 1e-6);
      }
    }
  }
}

} // namespace
