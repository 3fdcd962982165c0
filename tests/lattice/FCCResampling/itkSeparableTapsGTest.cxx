#include "itkSeparableTaps.h"

#include "itkMath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

std::vector<double>
PlaceSamples(std::size_t count, const std::function<double(std::size_t)> & step)
{
  std::vector<double> samples{ -3.0 };
  while (samples.size() < count)
  {
    samples.push_back(samples.back() + step(samples.size()));
  }
  return samples;
}

/** Positions in between, a few outside, and the samples themselves. */
std::vector<double>
PositionsAmong(const std::vector<double> & samples)
{
  std::vector<double> positions = samples;
  for (std::size_t n = 0; n + 1 < samples.size(); ++n)
  {
    for (const double part : { 0.1, 0.25, 0.5, 0.8 })
    {
      positions.push_back(samples[n] + part * (samples[n + 1] - samples[n]));
    }
  }
  positions.push_back(samples.front() - 2.0);
  positions.push_back(samples.back() + 2.0);
  return positions;
}

TEST(SeparableTaps, OfUnevenSamplesInterpolateAndReproduceLinesUpToTheEnds)
{
  for (const SeparableKernel kernel :
       { SeparableKernel::Linear, SeparableKernel::CubicBSpline, SeparableKernel::Lanczos4 })
  {
    for (const std::size_t count : { 1u, 2u, 3u, 4u, 9u, 10u, 11u, 40u })
    {
      const auto samples = PlaceSamples(count, [](std::size_t n) { return n % 11 == 5 ? 7.0 : 0.5 + 0.5 * (n % 3); });
      std::vector<double> noise;
      for (std::size_t n = 0; n < count; ++n)
      {
        noise.push_back(static_cast<double>((n * 7919) % 101));
      }
      const auto positions = PositionsAmong(samples);
      const SeparableTaps taps(kernel, samples, positions);
      for (std::size_t n = 0; n < positions.size(); ++n)
      {
        const double inside = std::clamp(positions[n], samples.front(), samples.back());
        ASSERT_NEAR(Evaluate(taps, samples, n), inside, 2e-5) << kernel << count;
        ASSERT_NEAR(Evaluate(taps, std::vector<double>(count, 1.0), n), 1.0, 1e-6);
        if (n < count)
        {
          ASSERT_NEAR(Evaluate(taps, noise, n), noise[n], 1e-4) << "a sample itself";
        }
      }
    }
  }
}

/** Root mean square error, over positions away from the ends, for a wave of root mean square 1. */
double
WaveError(const SeparableTaps & taps,
          const std::vector<double> & samples,
          const std::vector<double> & positions,
          double length)
{
  double squares = 0.0;
  int count = 0;
  for (const double phase : { 0.0, 0.3, 0.6, 0.9, 1.2, 1.5 })
  {
    const auto wave = [&](double x) { return std::sqrt(2.0) * std::cos(2.0 * itk::Math::pi * x / length + phase); };
    std::vector<double> values(samples.size());
    std::transform(samples.begin(), samples.end(), values.begin(), wave);
    for (std::size_t n = 0; n < positions.size(); ++n)
    {
      if (positions[n] > samples[12] && positions[n] < samples[samples.size() - 13])
      {
        const double error = Evaluate(taps, values, n) - wave(positions[n]);
        squares += error * error;
        ++count;
      }
    }
  }
  return std::sqrt(squares / count);
}

TEST(SeparableTaps, OfUnevenSamplesAreAboutAsAccurateAsOfEvenOnes)
{
  const auto even = PlaceSamples(80, [](std::size_t) { return 1.0; });
  const auto blocks = PlaceSamples(80, [](std::size_t n) { return n / 10 % 2 == 0 ? 1.0 : 0.5; });
  for (const double length : { 32.0, 16.0, 8.0, 4.0 })
  {
    const auto evenPositions = PositionsAmong(even);
    auto indices = evenPositions;
    std::transform(indices.begin(), indices.end(), indices.begin(), [](double x) { return x + 3.0; });
    const auto blockPositions = PositionsAmong(blocks);
    const SeparableTaps spline(SeparableKernel::CubicBSpline, even.size(), indices);
    const SeparableTaps natural(SeparableKernel::CubicBSpline, even, evenPositions);
    const SeparableTaps uneven(SeparableKernel::CubicBSpline, blocks, blockPositions);
    const SeparableTaps linear(SeparableKernel::Linear, blocks, blockPositions);
    const double errors[] = { WaveError(spline, even, evenPositions, length),
                              WaveError(natural, even, evenPositions, length),
                              WaveError(uneven, blocks, blockPositions, length),
                              WaveError(linear, blocks, blockPositions, length) };
    EXPECT_LT(errors[1], 1.6 * errors[0] + 1e-5) << length;
    EXPECT_LT(errors[2], 1.6 * errors[0] + 1e-5) << length;
    EXPECT_LT(errors[2], 0.1 * errors[3]) << length;
  }
}

} // namespace
