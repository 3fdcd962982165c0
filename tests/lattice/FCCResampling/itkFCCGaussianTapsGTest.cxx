#include "detail/itkFCCGaussianTaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Taps = itk::FCCGaussianTaps;

/** Sum of the weights over the lattice, or, with an axis, of weight x coordinate^2 along it. */
double
Moment(const Taps & taps, int momentAxis = -1)
{
  double sum = 0.0;
  for (unsigned int odd = 0; odd < 4; ++odd) // parities of x and y; that of z follows
  {
    const unsigned int parities[3] = { odd & 1, odd >> 1, (odd ^ odd >> 1) & 1 };
    double product = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto & factor = taps.GetFactor(static_cast<unsigned int>(axis), parities[axis]);
      double factorSum = 0.0;
      for (std::size_t n = 0; n < factor.steps.size(); ++n)
      {
        const auto step = static_cast<double>(factor.steps[n]);
        factorSum += static_cast<double>(factor.weights[n]) * (axis == momentAxis ? step * step : 1.0);
      }
      product *= factorSum;
    }
    sum += product;
  }
  return sum;
}

void
ExpectMoments(const std::array<double, 3> & variances)
{
  const Taps taps(variances);
  EXPECT_NEAR(Moment(taps), 1.0, 1e-6);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double variance = variances[static_cast<unsigned int>(axis)];
    EXPECT_NEAR(Moment(taps, axis), variance, 1e-6 * variance)
      << "axis " << axis << " of " << variances[0] << ", " << variances[1] << ", " << variances[2];
  }
}

TEST(FCCGaussianTaps, HaveTheVariancesOnTheLatticeWhateverTheSpacing)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-3.0, 2.0);
  for (unsigned int trial = 0; trial < 200; ++trial)
  {
    ExpectMoments(
      { std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random)) });
  }
}

TEST(FCCGaussianTaps, LeaveOutAxesWithoutVariance)
{
  ExpectMoments({ 0.0, 0.0, 0.0 });
  ExpectMoments({ 1.7, 0.0, 0.0 });
  ExpectMoments({ 0.02, 0.0, 0.0 });
  ExpectMoments({ 1.7, 0.4, 0.0 });
  ExpectMoments({ 0.01, 0.0, 0.02 });
}

TEST(FCCGaussianTaps, AreATrueGaussianWhereTheLatticeCanHoldOne)
{
  for (const double sigma : { 0.8, 1.0, 1.7, 3.0 })
  {
    const double variance = sigma * sigma;
    const Taps taps({ variance, variance, variance });
    const auto & even = taps.GetFactor(1, 0);
    const auto & odd = taps.GetFactor(1, 1);
    const double middle = static_cast<double>(even.weights[even.weights.size() / 2]);
    for (const auto * const factor : { &even, &odd })
    {
      for (std::size_t n = 0; n < factor->steps.size(); ++n)
      {
        const auto step = static_cast<double>(factor->steps[n]);
        EXPECT_NEAR(static_cast<double>(factor->weights[n]) / middle, std::exp(-step * step / (2.0 * variance)), 2e-3);
      }
    }
  }
}

TEST(FCCGaussianTaps, AreSymmetricAndPositive)
{
  const Taps taps({ 2.0, 0.3, 0.05 });
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (unsigned int parity = 0; parity < 2; ++parity)
    {
      const auto & factor = taps.GetFactor(axis, parity);
      for (std::size_t n = 0; n < factor.steps.size(); ++n)
      {
        EXPECT_GT(factor.weights[n], 0.0f);
        EXPECT_EQ(factor.weights[n], factor.weights[factor.weights.size() - 1 - n]);
        EXPECT_EQ(factor.steps[n], -factor.steps[factor.steps.size() - 1 - n]);
        EXPECT_LE(std::abs(factor.steps[n]), taps.GetReach(axis));
      }
    }
  }
}

} // namespace
