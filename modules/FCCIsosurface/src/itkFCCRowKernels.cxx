#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCRowKernels.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCLattice.h"
#include "itkFCCRowKernels.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

/** The bits of 64 values. Highway orders integers by less-than alone; for them at-least is its complement. */
template <typename TPixel>
HWY_ATTR std::uint64_t
ClassifyWord(const TPixel * values, TPixel threshold, bool isBelow)
{
  const hn::ScalableTag<TPixel> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto limit = hn::Set(tag, threshold);
  std::uint64_t word = 0;
  for (std::size_t lane = 0; lane < 64; lane += lanes)
  {
    const auto value = hn::LoadU(tag, values + lane);
    auto mask = hn::Lt(value, limit);
    if constexpr (!std::is_integral_v<TPixel>)
    {
      if (!isBelow)
      {
        mask = hn::Ge(value, limit);
      }
    }
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(tag, mask, bytes);
    std::uint64_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    word |= bits << lane;
  }
  return std::is_integral_v<TPixel> && !isBelow ? ~word : word;
}

template <typename TPixel>
HWY_ATTR void
ClassifyRow(const TPixel * values, std::size_t count, TPixel threshold, bool isBelow, std::uint64_t * words)
{
  std::size_t first = 0;
  for (; first + 64 <= count; first += 64)
  {
    *words++ = ClassifyWord(values + first, threshold, isBelow);
  }
  std::uint64_t last = 0;
  for (std::size_t i = first; i < count; ++i)
  {
    const bool inside = isBelow ? values[i] < threshold : values[i] >= threshold;
    last |= static_cast<std::uint64_t>(inside) << (i - first);
  }
  if (first < count)
  {
    *words = last;
  }
}

template <typename TPixel>
HWY_ATTR void
SubtractRow(const TPixel * values, std::size_t count, double isovalue, float * HWY_RESTRICT differences)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    differences[i] = static_cast<float>(static_cast<double>(values[i]) - isovalue);
  }
}

#define ITK_FCC_PIXEL_KERNELS(Name, Pixel)                                                                             \
  HWY_ATTR void Classify##Name(                                                                                        \
    const Pixel * values, std::size_t count, Pixel threshold, bool isBelow, std::uint64_t * words)                     \
  {                                                                                                                    \
    ClassifyRow(values, count, threshold, isBelow, words);                                                             \
  }                                                                                                                    \
  HWY_ATTR void Subtract##Name(const Pixel * values, std::size_t count, double isovalue, float * differences)          \
  {                                                                                                                    \
    SubtractRow(values, count, isovalue, differences);                                                                 \
  }

ITK_FCC_PIXEL_KERNELS(UInt8, std::uint8_t)
ITK_FCC_PIXEL_KERNELS(Int16, std::int16_t)
ITK_FCC_PIXEL_KERNELS(UInt16, std::uint16_t)
ITK_FCC_PIXEL_KERNELS(Int32, std::int32_t)
ITK_FCC_PIXEL_KERNELS(Float, float)
#undef ITK_FCC_PIXEL_KERNELS

HWY_ATTR void
QuasiInterpolateRow(const float * values, const float * const * n, std::size_t count, float * HWY_RESTRICT coefficients)
{
  constexpr float largest = std::numeric_limits<float>::max();
  for (std::size_t first = 0; first < count; first += FCCRowKernels::Block)
  {
    for (std::size_t i = first; i < first + FCCRowKernels::Block; ++i)
    {
      const float sum = ((n[0][i] + n[6][i]) + (n[1][i] + n[7][i])) + ((n[2][i] + n[8][i]) + (n[3][i] + n[9][i])) +
                        ((n[4][i] + n[10][i]) + (n[5][i] + n[11][i]));
      const float coefficient = 1.5f * values[i] - sum * (1.0f / 24.0f);
      coefficients[i] = coefficient >= -largest && coefficient <= largest ? coefficient : values[i];
    }
  }
}

HWY_ATTR void
GradientBlock(const float * const * n, std::size_t first, float * HWY_RESTRICT gradients)
{
  const hn::CappedTag<float, FCCRowKernels::Block> tag;
  const auto eighth = hn::Set(tag, 0.125f);
  for (std::size_t i = first; i < first + FCCRowKernels::Block; i += hn::Lanes(tag))
  {
    const auto differenceAlong = [&](unsigned int neighbor) HWY_ATTR {
      return hn::Sub(hn::LoadU(tag, n[neighbor] + i), hn::LoadU(tag, n[neighbor + 6] + i));
    };
    const auto a = differenceAlong(0); // (1, 1, 0)
    const auto b = differenceAlong(1); // (-1, 1, 0)
    const auto c = differenceAlong(2); // (1, 0, 1)
    const auto d = differenceAlong(3); // (-1, 0, 1)
    const auto e = differenceAlong(4); // (0, 1, 1)
    const auto f = differenceAlong(5); // (0, -1, 1)
    hn::StoreInterleaved4(hn::Mul(eighth, hn::Add(hn::Sub(a, b), hn::Sub(c, d))),
                          hn::Mul(eighth, hn::Add(hn::Add(a, b), hn::Sub(e, f))),
                          hn::Mul(eighth, hn::Add(hn::Add(c, d), hn::Add(e, f))),
                          hn::Zero(tag),
                          tag,
                          gradients + 4 * i);
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{

HWY_EXPORT(ClassifyUInt8);
HWY_EXPORT(ClassifyInt16);
HWY_EXPORT(ClassifyUInt16);
HWY_EXPORT(ClassifyInt32);
HWY_EXPORT(ClassifyFloat);
HWY_EXPORT(SubtractUInt8);
HWY_EXPORT(SubtractInt16);
HWY_EXPORT(SubtractUInt16);
HWY_EXPORT(SubtractInt32);
HWY_EXPORT(SubtractFloat);
HWY_EXPORT(QuasiInterpolateRow);
HWY_EXPORT(GradientBlock);

/** The smallest value of the pixel type that is at least the isovalue; false if there is none. */
template <typename TPixel>
bool
FindThreshold(double isovalue, TPixel & threshold)
{
  using Limits = std::numeric_limits<TPixel>;
  if (isovalue <= static_cast<double>(Limits::lowest()))
  {
    threshold = Limits::lowest();
    return true;
  }
  if (isovalue > static_cast<double>(Limits::max()))
  {
    threshold = Limits::infinity();
    return Limits::has_infinity;
  }
  if constexpr (std::is_integral_v<TPixel>)
  {
    threshold = static_cast<TPixel>(std::ceil(isovalue));
  }
  else
  {
    threshold = static_cast<TPixel>(isovalue);
    if (static_cast<double>(threshold) < isovalue)
    {
      threshold = std::nextafter(threshold, Limits::infinity());
    }
  }
  return true;
}

/** Every value is on the same side. */
void
ClassifyAll(SizeValueType count, bool inside, std::uint64_t * words)
{
  for (SizeValueType first = 0; first < count; first += 64)
  {
    const std::uint64_t all = count - first >= 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << (count - first)) - 1;
    *words++ = inside ? all : 0;
  }
}

} // namespace

#define ITK_FCC_PIXEL_KERNELS(Name, Pixel)                                                                             \
  template <>                                                                                                          \
  void FCCRowKernels::Classify(                                                                                        \
    const Pixel * values, SizeValueType count, double isovalue, bool isBelow, std::uint64_t * words)                   \
  {                                                                                                                    \
    Pixel threshold{};                                                                                                 \
    if (FindThreshold(isovalue, threshold))                                                                            \
    {                                                                                                                  \
      HWY_DYNAMIC_DISPATCH(Classify##Name)(values, count, threshold, isBelow, words);                                  \
    }                                                                                                                  \
    else                                                                                                               \
    {                                                                                                                  \
      ClassifyAll(count, isBelow, words);                                                                              \
    }                                                                                                                  \
  }                                                                                                                    \
  template <>                                                                                                          \
  void FCCRowKernels::Subtract(const Pixel * values, SizeValueType count, double isovalue, float * differences)        \
  {                                                                                                                    \
    HWY_DYNAMIC_DISPATCH(Subtract##Name)(values, count, isovalue, differences);                                        \
  }

ITK_FCC_PIXEL_KERNELS(UInt8, std::uint8_t)
ITK_FCC_PIXEL_KERNELS(Int16, std::int16_t)
ITK_FCC_PIXEL_KERNELS(UInt16, std::uint16_t)
ITK_FCC_PIXEL_KERNELS(Int32, std::int32_t)
ITK_FCC_PIXEL_KERNELS(Float, float)
#undef ITK_FCC_PIXEL_KERNELS

void
FCCRowKernels::QuasiInterpolate(const float * values,
                                const NeighborRows & neighbors,
                                SizeValueType count,
                                float * coefficients)
{
  HWY_DYNAMIC_DISPATCH(QuasiInterpolateRow)(values, neighbors, count, coefficients);
}

void
FCCRowKernels::Gradient(const NeighborRows & neighbors, SizeValueType first, float * gradients)
{
  HWY_DYNAMIC_DISPATCH(GradientBlock)(neighbors, first, gradients);
}

} // namespace itk
#endif
