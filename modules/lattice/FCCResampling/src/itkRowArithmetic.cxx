#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkRowArithmetic.cxx"
#include <hwy/foreach_target.h> // IWYU pragma: keep

#include "detail/itkRowArithmetic.h"

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#ifndef ITK_FOR_EACH_INTEGER_PIXEL // this file includes itself
#define ITK_FOR_EACH_INTEGER_PIXEL(Apply)                                                                              \
  Apply(std::uint8_t, UInt8) Apply(std::int16_t, Int16) Apply(std::uint16_t, UInt16) Apply(std::int32_t, Int32)
#endif

HWY_BEFORE_NAMESPACE();
namespace itk::RowArithmetic::HWY_NAMESPACE
{
namespace
{
namespace hn = hwy::HWY_NAMESPACE;

using RealTag = HWY_CAPPED(float, Granule);
using RealVector = hn::Vec<RealTag>;
constexpr RealTag Real;

template <typename TPixel>
RealVector
LoadAsReal(const TPixel * row)
{
  const hn::RebindToSigned<RealTag> whole;
  if constexpr (sizeof(TPixel) == sizeof(float))
  {
    return hn::ConvertTo(Real, hn::LoadU(whole, row));
  }
  else
  {
    return hn::ConvertTo(Real, hn::PromoteTo(whole, hn::LoadU(hn::Rebind<TPixel, RealTag>(), row)));
  }
}

template <typename TPixel>
void
ConvertRow(const TPixel * HWY_RESTRICT row, SizeValueType length, float * HWY_RESTRICT real)
{
  const SizeValueType lanes = hn::Lanes(Real);
  SizeValueType n = 0;
  for (; n + lanes <= length; n += lanes)
  {
    hn::StoreU(LoadAsReal(row + n), Real, real + n);
  }
  for (; n < length; ++n)
  {
    real[n] = static_cast<float>(row[n]);
  }
}

/** Rounds values that lie in the range of the pixel type half away from zero, as RoundAndClamp() does. */
template <typename TPixel>
hn::Vec<hn::RebindToSigned<RealTag>>
Round(RealVector value)
{
  const hn::RebindToSigned<RealTag> whole;
  const auto half = hn::Set(Real, 0.5f);
  if constexpr (sizeof(TPixel) < sizeof(float))
  {
    return hn::ConvertTo(whole, hn::Add(value, hn::CopySign(half, value)));
  }
  else
  {
    // Adding one half to a wide value would round; its fraction is exact.
    const auto truncated = hn::Trunc(value);
    const auto isAway = hn::Ge(hn::Abs(hn::Sub(value, truncated)), half);
    const auto step = hn::IfThenElseZero(isAway, hn::CopySign(hn::Set(Real, 1.0f), value));
    return hn::ConvertTo(whole, hn::Add(truncated, step));
  }
}

template <typename TPixel>
void
RoundRow(const float * HWY_RESTRICT real, SizeValueType length, TPixel * HWY_RESTRICT row)
{
  using Limits = std::numeric_limits<TPixel>;
  const auto lowest = hn::Set(Real, static_cast<float>(Limits::lowest()));
  const auto highest = hn::Set(Real, static_cast<float>(Limits::max()));
  const SizeValueType lanes = hn::Lanes(Real);
  SizeValueType n = 0;
  for (; n + lanes <= length; n += lanes)
  {
    const auto value = hn::LoadU(Real, real + n);
    // The comparisons are false for not-a-number, which becomes the lowest value.
    const auto floored = hn::IfThenElse(hn::Gt(value, lowest), value, lowest);
    const auto clamped = hn::IfThenElse(hn::Lt(floored, highest), floored, highest);
    const auto rounded = Round<TPixel>(clamped);
    if constexpr (sizeof(TPixel) < sizeof(float))
    {
      const hn::Rebind<TPixel, RealTag> pixels;
      hn::StoreU(hn::DemoteTo(pixels, rounded), pixels, row + n);
    }
    else
    {
      // float's highest is one more than the integer's
      const hn::RebindToSigned<RealTag> whole;
      const auto isHighest = hn::RebindMask(whole, hn::Ge(clamped, highest));
      hn::StoreU(hn::IfThenElse(isHighest, hn::Set(whole, Limits::max()), rounded), whole, row + n);
    }
  }
  for (; n < length; ++n)
  {
    row[n] = RoundAndClamp<TPixel>(real[n]);
  }
}

void
BlendRows(const float * const * HWY_RESTRICT rows,
          const float * HWY_RESTRICT weights,
          SizeValueType count,
          SizeValueType length,
          float * HWY_RESTRICT blend)
{
  const SizeValueType lanes = hn::Lanes(Real);
  SizeValueType n = 0;
  // Four vectors at a time share the look-up of a term's row and weight.
  for (; n + 4 * lanes <= length; n += 4 * lanes)
  {
    auto weight = hn::Set(Real, weights[0]);
    const float * row = rows[0] + n;
    auto sum0 = hn::Mul(weight, hn::LoadU(Real, row));
    auto sum1 = hn::Mul(weight, hn::LoadU(Real, row + lanes));
    auto sum2 = hn::Mul(weight, hn::LoadU(Real, row + 2 * lanes));
    auto sum3 = hn::Mul(weight, hn::LoadU(Real, row + 3 * lanes));
    for (SizeValueType term = 1; term < count; ++term)
    {
      weight = hn::Set(Real, weights[term]);
      row = rows[term] + n;
      sum0 = hn::Add(sum0, hn::Mul(weight, hn::LoadU(Real, row)));
      sum1 = hn::Add(sum1, hn::Mul(weight, hn::LoadU(Real, row + lanes)));
      sum2 = hn::Add(sum2, hn::Mul(weight, hn::LoadU(Real, row + 2 * lanes)));
      sum3 = hn::Add(sum3, hn::Mul(weight, hn::LoadU(Real, row + 3 * lanes)));
    }
    hn::StoreU(sum0, Real, blend + n);
    hn::StoreU(sum1, Real, blend + n + lanes);
    hn::StoreU(sum2, Real, blend + n + 2 * lanes);
    hn::StoreU(sum3, Real, blend + n + 3 * lanes);
  }
  for (; n < length; n += lanes)
  {
    auto sum = hn::Mul(hn::Set(Real, weights[0]), hn::LoadU(Real, rows[0] + n));
    for (SizeValueType term = 1; term < count; ++term)
    {
      sum = hn::Add(sum, hn::Mul(hn::Set(Real, weights[term]), hn::LoadU(Real, rows[term] + n)));
    }
    hn::StoreU(sum, Real, blend + n);
  }
}

/** Picks lanes out of two consecutive vectors: index 0 is the first lane of the low one. */
class PairLookup
{
public:
  using IndexVector = hn::Vec<hn::RebindToSigned<RealTag>>;

#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  explicit PairLookup(IndexVector indices)
    : m_Indices(indices)
  {}

  RealVector
  operator()(RealVector low, RealVector high) const
  {
    return RealVector{ _mm512_permutex2var_ps(low.raw, m_Indices.raw, high.raw) };
  }

private:
  IndexVector m_Indices;
#else
  explicit PairLookup(IndexVector indices)
    : m_IsHigh(hn::RebindMask(Real, hn::Gt(indices, hn::Set(Whole, static_cast<std::int32_t>(hn::Lanes(Real) - 1)))))
    , m_Lanes(
        hn::IndicesFromVec(Real, hn::And(indices, hn::Set(Whole, static_cast<std::int32_t>(hn::Lanes(Real) - 1)))))
  {}

  RealVector
  operator()(RealVector low, RealVector high) const
  {
    return hn::IfThenElse(m_IsHigh, hn::TableLookupLanes(high, m_Lanes), hn::TableLookupLanes(low, m_Lanes));
  }

private:
  static constexpr hn::RebindToSigned<RealTag> Whole{};
  hn::Mask<RealTag> m_IsHigh;
  decltype(hn::IndicesFromVec(Real, hn::Zero(hn::RebindToSigned<RealTag>()))) m_Lanes;
#endif
};

void
InterpolateRow(const float * HWY_RESTRICT row, const RowTaps & taps, float * HWY_RESTRICT values)
{
  const hn::RebindToSigned<RealTag> whole;
  const SizeValueType lanes = hn::Lanes(Real);
  const SizeValueType count = taps.GetNumberOfTaps();
  const SizeValueType stride = taps.GetPaddedLength();
  for (SizeValueType n = 0; n < taps.GetPaddedLength(); n += lanes)
  {
    const std::int32_t * const first = taps.GetFirst() + n;
    const float * const source = row + first[0];
    const float * weights = taps.GetWeights(0) + n;
    const auto offsets = hn::Sub(hn::LoadU(whole, first), hn::Set(whole, first[0]));
    auto sum = hn::Zero(Real);
    // Unless positions are more than two samples apart, all lanes find one tap's samples in two consecutive vectors.
    if (first[lanes - 1] - first[0] < static_cast<std::int32_t>(2 * lanes))
    {
      const PairLookup lookup(offsets);
      sum = hn::Mul(hn::LoadU(Real, weights), lookup(hn::LoadU(Real, source), hn::LoadU(Real, source + lanes)));
      for (SizeValueType tap = 1; tap < count; ++tap)
      {
        weights += stride;
        const float * const window = source + tap;
        const auto samples = lookup(hn::LoadU(Real, window), hn::LoadU(Real, window + lanes));
        sum = hn::Add(sum, hn::Mul(hn::LoadU(Real, weights), samples));
      }
    }
    else
    {
      sum = hn::Mul(hn::LoadU(Real, weights), hn::GatherIndex(Real, source, offsets));
      for (SizeValueType tap = 1; tap < count; ++tap)
      {
        weights += stride;
        sum = hn::Add(sum, hn::Mul(hn::LoadU(Real, weights), hn::GatherIndex(Real, source + tap, offsets)));
      }
    }
    hn::StoreU(sum, Real, values + n);
  }
}

// Exported by name, so not templates.
#define ITK_PIXEL_KERNELS(TPixel, Name)                                                                                \
  void Convert##Name(const TPixel * row, SizeValueType length, float * real)                                           \
  {                                                                                                                    \
    ConvertRow(row, length, real);                                                                                     \
  }                                                                                                                    \
  void Round##Name(const float * real, SizeValueType length, TPixel * row)                                             \
  {                                                                                                                    \
    RoundRow(real, length, row);                                                                                       \
  }
ITK_FOR_EACH_INTEGER_PIXEL(ITK_PIXEL_KERNELS)
#undef ITK_PIXEL_KERNELS

} // namespace
} // namespace itk::RowArithmetic::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk::RowArithmetic
{

#define ITK_PIXEL_FUNCTIONS(TPixel, Name)                                                                              \
  HWY_EXPORT(Convert##Name);                                                                                           \
  HWY_EXPORT(Round##Name);                                                                                             \
  void ConvertFrom(const TPixel * row, SizeValueType length, float * real)                                             \
  {                                                                                                                    \
    HWY_DYNAMIC_DISPATCH(Convert##Name)(row, length, real);                                                            \
  }                                                                                                                    \
  void RoundTo(const float * real, SizeValueType length, TPixel * row)                                                 \
  {                                                                                                                    \
    HWY_DYNAMIC_DISPATCH(Round##Name)(real, length, row);                                                              \
  }
ITK_FOR_EACH_INTEGER_PIXEL(ITK_PIXEL_FUNCTIONS)
#undef ITK_PIXEL_FUNCTIONS

HWY_EXPORT(BlendRows);
HWY_EXPORT(InterpolateRow);

void
Blend(const float * const * rows, const float * weights, SizeValueType count, SizeValueType length, float * blend)
{
  HWY_DYNAMIC_DISPATCH(BlendRows)(rows, weights, count, RoundUpToGranule(length), blend);
}

void
Interpolate(const float * row, const RowTaps & taps, float * values)
{
  HWY_DYNAMIC_DISPATCH(InterpolateRow)(row, taps, values);
}

RowTaps::RowTaps(const SeparableTaps & taps, SizeValueType numberOfPositions, SizeValueType origin)
  : m_NumberOfTaps(taps.GetNumberOfTaps())
  , m_First(RoundUpToGranule(numberOfPositions))
  , m_Weights(m_First.size() * m_NumberOfTaps)
{
  for (SizeValueType n = 0; n < m_First.size(); ++n)
  {
    m_First[n] = static_cast<std::int32_t>(taps.GetFirst(std::min(n, numberOfPositions - 1)) - origin);
  }
  for (SizeValueType n = 0; n < numberOfPositions; ++n)
  {
    for (SizeValueType tap = 0; tap < m_NumberOfTaps; ++tap)
    {
      m_Weights[tap * m_First.size() + n] = taps.GetWeights(n)[tap];
    }
  }
}

} // namespace itk::RowArithmetic
#endif // HWY_ONCE
