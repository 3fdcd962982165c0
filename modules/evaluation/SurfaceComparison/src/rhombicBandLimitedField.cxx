// From the module's folder of headers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "../src/rhombicBandLimitedField.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rhombicShapeFields.h"

#include <random>

HWY_BEFORE_NAMESPACE();
namespace rhombic
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t WaveBatch = 8; // the largest number of waves that a processor computes at once

/** sin(2 pi t) for |t| <= 1/4, by its Taylor series up to t^15. */
template <typename TTag, typename TVector>
HWY_ATTR TVector
SineOfTurn(TTag tag, TVector t)
{
  const auto x = hn::Mul(hn::Set(tag, 6.283185307179586), t);
  const auto q = hn::Mul(x, x);
  auto sum = hn::Set(tag, -1.0 / 1307674368000.0);
  sum = hn::MulAdd(sum, q, hn::Set(tag, 1.0 / 6227020800.0));
  sum = hn::MulAdd(sum, q, hn::Set(tag, -1.0 / 39916800.0));
  sum = hn::MulAdd(sum, q, hn::Set(tag, 1.0 / 362880.0));
  sum = hn::MulAdd(sum, q, hn::Set(tag, -1.0 / 5040.0));
  sum = hn::MulAdd(sum, q, hn::Set(tag, 1.0 / 120.0));
  sum = hn::MulAdd(sum, q, hn::Set(tag, -1.0 / 6.0));
  return hn::MulAdd(hn::Mul(x, q), sum, x);
}

/** Sums over plane waves k at a point, with t = k . p + phase, in waves: those of cos(2 pi t), and of sin(2 pi t) k
 * along x, y and z. \a waves has the arrays of k along x, y and z and of phases, each of \a count numbers, a multiple
 * of WaveBatch.
 *
 * Sines are computed to 1e-11, in SIMD code chosen for the processor at run time; the last bits differ between
 * processors. Nearly all time of an accuracy experiment is spent here: the compiler's own loops take 1.5 times as long
 * for AVX2, and 3.4 times as long for the oldest processors that it supports. */
HWY_ATTR std::array<double, 4>
SumWaves(const std::array<const double *, 4> & waves, std::size_t count, const Vector3 & point)
{
  const hn::CappedTag<double, WaveBatch> tag;
  const auto pointX = hn::Set(tag, point[0]);
  const auto pointY = hn::Set(tag, point[1]);
  const auto pointZ = hn::Set(tag, point[2]);
  const auto half = hn::Set(tag, 0.5);
  const auto quarter = hn::Set(tag, 0.25);
  auto cosine = hn::Zero(tag);
  auto sineX = hn::Zero(tag);
  auto sineY = hn::Zero(tag);
  auto sineZ = hn::Zero(tag);
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag))
  {
    const auto x = hn::LoadU(tag, waves[0] + i);
    const auto y = hn::LoadU(tag, waves[1] + i);
    const auto z = hn::LoadU(tag, waves[2] + i);
    const auto phase = hn::LoadU(tag, waves[3] + i);
    const auto turns = hn::MulAdd(x, pointX, hn::MulAdd(y, pointY, hn::MulAdd(z, pointZ, phase)));
    const auto fraction = hn::Sub(turns, hn::Round(turns)); // -1/2 to 1/2
    const auto size = hn::Abs(fraction);
    cosine = hn::Add(cosine, SineOfTurn(tag, hn::Sub(quarter, size)));
    const auto sine = SineOfTurn(tag, hn::CopySign(hn::Min(size, hn::Sub(half, size)), fraction));
    sineX = hn::MulAdd(sine, x, sineX);
    sineY = hn::MulAdd(sine, y, sineY);
    sineZ = hn::MulAdd(sine, z, sineZ);
  }
  const auto sum = [tag](auto lanes) { return hn::GetLane(hn::SumOfLanes(tag, lanes)); };
  return { sum(cosine), sum(sineX), sum(sineY), sum(sineZ) };
}

} // namespace HWY_NAMESPACE
} // namespace rhombic
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhombic
{
namespace
{

HWY_EXPORT(SumWaves);

/** A random number evenly distributed in [0, 1). The standard library's own distributions differ between
 * implementations. */
double
Uniform(std::mt19937_64 & random)
{
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

} // namespace

ReferenceField
MakeBandLimitedField(double bandLimit, std::uint64_t seed)
{
  constexpr std::size_t count = 96;
  static_assert(count % HWY_NAMESPACE::WaveBatch == 0);
  std::mt19937_64 random(seed);
  const double radius = bandLimit / 2.0;
  std::array<std::vector<double>, 4> waves; // waves per unit along each axis, and phases in waves
  for (std::size_t i = 0; i < count; ++i)
  {
    Vector3 k;
    do
    {
      for (double & component : k)
      {
        component = 2.0 * Uniform(random) - 1.0;
      }
    } while (Dot(k, k) > 1.0);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      waves[axis].push_back(radius * k[axis]);
    }
    waves[3].push_back(Uniform(random));
  }
  const double amplitude = std::sqrt(2.0 / static_cast<double>(count));
  return ReferenceField([waves = std::move(waves), amplitude](const Vector3 & point, Vector3 & gradient) {
    constexpr double twoPi = 6.283185307179586;
    const auto [cosine, sineX, sineY, sineZ] = HWY_DYNAMIC_DISPATCH(SumWaves)(
      { waves[0].data(), waves[1].data(), waves[2].data(), waves[3].data() }, waves[0].size(), point);
    gradient = Scaled({ sineX, sineY, sineZ }, -twoPi * amplitude);
    return amplitude * cosine;
  });
}

} // namespace rhombic
#endif
