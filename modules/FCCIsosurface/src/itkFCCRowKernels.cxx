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

/** All types of pixels, each with a name for its functions. */
#ifndef ITK_FCC_FOR_EACH_PIXEL_TYPE // this file includes itself
#define ITK_FCC_FOR_EACH_PIXEL_TYPE(Apply)                                                                             \
  Apply(Char, char) Apply(SignedChar, signed char) Apply(UnsignedChar, unsigned char) Apply(Short, short)              \
    Apply(UnsignedShort, unsigned short) Apply(Int, int) Apply(UnsignedInt, unsigned int) Apply(Long, long)            \
      Apply(UnsignedLong, unsigned long) Apply(LongLong, long long) Apply(UnsignedLongLong, unsigned long long)        \
        Apply(Float, float) Apply(Double, double)
#endif

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

/** Highway's type of lane for a type of pixel; char and long long are none. */
template <typename TPixel, bool VIsInteger = std::is_integral_v<TPixel>>
struct LaneOf
{
  using Type = TPixel;
};

template <typename TPixel>
struct LaneOf<TPixel, true>
{
  using Type = std::
    conditional_t<std::is_signed_v<TPixel>, hwy::SignedFromSize<sizeof(TPixel)>, hwy::UnsignedFromSize<sizeof(TPixel)>>;
};

/** The bits of 64 values. Highway orders integers by less-than alone; for them at-least is its complement. */
template <typename TPixel>
HWY_ATTR std::uint64_t
ClassifyWord(const TPixel * values, TPixel threshold, bool isBelow)
{
  using Lane = typename LaneOf<TPixel>::Type;
  const hn::ScalableTag<Lane> tag;
  const std::size_t lanes = hn::Lanes(tag);
  const auto limit = hn::Set(tag, static_cast<Lane>(threshold));
  std::uint64_t word = 0;
  for (std::size_t lane = 0; lane < 64; lane += lanes)
  {
    const auto value = hn::LoadU(tag, reinterpret_cast<const Lane *>(values + lane));
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

ITK_FCC_FOR_EACH_PIXEL_TYPE(ITK_FCC_PIXEL_KERNELS)
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

#define ITK_FCC_EXPORT_PIXEL_KERNELS(Name, Pixel)                                                                      \
  HWY_EXPORT(Classify##Name);                                                                                          \
  HWY_EXPORT(Subtract##Name);
ITK_FCC_FOR_EACH_PIXEL_TYPE(ITK_FCC_EXPORT_PIXEL_KERNELS)
#undef ITK_FCC_EXPORT_PIXEL_KERNELS
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
  if constexpr (std::is_integral_v<TPixel>)
  {
    const double next = std::ceil(isovalue);
    if (next >= std::ldexp(1.0, Limits::digits)) // one more than the greatest, which as a double might be rounded up
    {
      return false;
    }
    threshold = static_cast<TPixel>(next);
  }
  else
  {
    threshold = isovalue > static_cast<double>(Limits::max()) ? Limits::infinity() : static_cast<TPixel>(isovalue);
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

ITK_FCC_FOR_EACH_PIXEL_TYPE(ITK_FCC_PIXEL_KERNELS)
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
