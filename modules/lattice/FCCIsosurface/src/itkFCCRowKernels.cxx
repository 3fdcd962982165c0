#include "itkFCCRowKernels.h"

#include "detail/itkFCCBitRows.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace itk
{
namespace
{

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

/** Writes isInside(value) for each value. */
template <typename TPixel, typename TIsInside>
void
ClassifyRow(const TPixel * values, SizeValueType count, const TIsInside & isInside, std::uint64_t * words)
{
  SizeValueType first = 0;
  for (; first + FCCBits::WordBits <= count; first += FCCBits::WordBits)
  {
    *words++ = FCCBits::Pack([&](SizeValueType n) { return isInside(values[first + n]); });
  }
  if (first < count)
  {
    *words = 0;
    for (SizeValueType i = first; i < count; ++i)
    {
      *words |= static_cast<std::uint64_t>(isInside(values[i])) << (i - first);
    }
  }
}

} // namespace

template <typename TPixel>
void
FCCRowKernels::Classify(const TPixel * values,
                        SizeValueType count,
                        double isovalue,
                        bool isBelow,
                        std::uint64_t * words)
{
  TPixel threshold{};
  if (!FindThreshold(isovalue, threshold))
  {
    ClassifyRow(
      values, count, [isBelow](TPixel) { return isBelow; }, words);
  }
  else if (isBelow)
  {
    ClassifyRow(
      values, count, [threshold](TPixel value) { return value < threshold; }, words);
  }
  else
  {
    ClassifyRow(
      values, count, [threshold](TPixel value) { return value >= threshold; }, words);
  }
}

template <typename TPixel>
void
FCCRowKernels::Subtract(const TPixel * values, SizeValueType count, double isovalue, float * differences)
{
  for (SizeValueType i = 0; i < count; ++i)
  {
    differences[i] = static_cast<float>(static_cast<double>(values[i]) - isovalue);
  }
}

#define ITK_FCC_COMPILE_FOR(Pixel)                                                                                     \
  template void FCCRowKernels::Classify(const Pixel *, SizeValueType, double, bool, std::uint64_t *);                  \
  template void FCCRowKernels::Subtract(const Pixel *, SizeValueType, double, float *);
ITK_FCC_COMPILE_FOR(char)
ITK_FCC_COMPILE_FOR(signed char)
ITK_FCC_COMPILE_FOR(unsigned char)
ITK_FCC_COMPILE_FOR(short)
ITK_FCC_COMPILE_FOR(unsigned short)
ITK_FCC_COMPILE_FOR(int)
ITK_FCC_COMPILE_FOR(unsigned int)
ITK_FCC_COMPILE_FOR(long)
ITK_FCC_COMPILE_FOR(unsigned long)
ITK_FCC_COMPILE_FOR(long long)
ITK_FCC_COMPILE_FOR(unsigned long long)
ITK_FCC_COMPILE_FOR(float)
ITK_FCC_COMPILE_FOR(double)
#undef ITK_FCC_COMPILE_FOR

} // namespace itk
