#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rhombicWaveSum.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rhombicWaveSum.h"

HWY_BEFORE_NAMESPACE();
namespace rhombic
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

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

HWY_ATTR WaveSums
SumWavesOnTarget(const double * wavesX,
                 const double * wavesY,
                 const double * wavesZ,
                 const double * phases,
                 std::size_t count,
                 const Vector3 & point)
{
  const hn::CappedTag<double, waveBatch> tag;
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
    const auto x = hn::LoadU(tag, wavesX + i);
    const auto y = hn::LoadU(tag, wavesY + i);
    const auto z = hn::LoadU(tag, wavesZ + i);
    const auto turns = hn::MulAdd(x, pointX, hn::MulAdd(y, pointY, hn::MulAdd(z, pointZ, hn::LoadU(tag, phases + i))));
    const auto fraction = hn::Sub(turns, hn::Round(turns)); // -1/2 to 1/2
    const auto size = hn::Abs(fraction);
    cosine = hn::Add(cosine, SineOfTurn(tag, hn::Sub(quarter, size)));
    const auto sine = SineOfTurn(tag, hn::CopySign(hn::Min(size, hn::Sub(half, size)), fraction));
    sineX = hn::MulAdd(sine, x, sineX);
    sineY = hn::MulAdd(sine, y, sineY);
    sineZ = hn::MulAdd(sine, z, sineZ);
  }
  WaveSums sums;
  sums.cosine = hn::GetLane(hn::SumOfLanes(tag, cosine));
  sums.sine = { hn::GetLane(hn::SumOfLanes(tag, sineX)),
                hn::GetLane(hn::SumOfLanes(tag, sineY)),
                hn::GetLane(hn::SumOfLanes(tag, sineZ)) };
  return sums;
}

} // namespace HWY_NAMESPACE
} // namespace rhombic
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhombic
{

HWY_EXPORT(SumWavesOnTarget);

WaveSums
SumWaves(const double * wavesX,
         const double * wavesY,
         const double * wavesZ,
         const double * phases,
         std::size_t count,
         const Vector3 & point)
{
  return HWY_DYNAMIC_DISPATCH(SumWavesOnTarget)(wavesX, wavesY, wavesZ, phases, count, point);
}

} // namespace rhombic
#endif
