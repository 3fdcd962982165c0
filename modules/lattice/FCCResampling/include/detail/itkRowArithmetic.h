#ifndef itkRowArithmetic_h
#define itkRowArithmetic_h

#include "itkFCCResamplingChecks.h"
#include "itkSeparableTaps.h"

#include <cstdint>
#include <vector>

namespace itk
{

/** Arithmetic on rows of float samples: the inner loops of the resampling filters.
 *
 * SIMD code is chosen for the processor at run time. Every result is one sum, from the first
 * term to the last, of products that are rounded before they are added. Lanes hold different results and are never
 * added up, so the bytes are the same for every processor. The functions throw nothing. */
namespace RowArithmetic
{

/** Blend() and Interpolate() work on rows in multiples of so many samples, and may read twice as many beyond that. */
constexpr SizeValueType Granule = 16;

/** \a length rounded up to a multiple of Granule. */
constexpr SizeValueType
RoundUpToGranule(SizeValueType length)
{
  return (length + Granule - 1) / Granule * Granule;
}

/** Samples to allocate for a row of \a length samples. They must be initialised. */
constexpr SizeValueType
PaddedLength(SizeValueType length)
{
  return RoundUpToGranule(length) + 2 * Granule;
}

/** real[n] = row[n], for n < length. */
template <typename TPixel>
void
ConvertFrom(const TPixel * row, SizeValueType length, float * real)
{
  for (SizeValueType n = 0; n < length; ++n)
  {
    real[n] = static_cast<float>(row[n]);
  }
}
void
ConvertFrom(const std::uint8_t * row, SizeValueType length, float * real);
void
ConvertFrom(const std::int16_t * row, SizeValueType length, float * real);
void
ConvertFrom(const std::uint16_t * row, SizeValueType length, float * real);
void
ConvertFrom(const std::int32_t * row, SizeValueType length, float * real);

/** row[n] = RoundAndClamp(real[n]), for n < length. */
template <typename TPixel>
void
RoundTo(const float * real, SizeValueType length, TPixel * row)
{
  for (SizeValueType n = 0; n < length; ++n)
  {
    row[n] = RoundAndClamp<TPixel>(real[n]);
  }
}
void
RoundTo(const float * real, SizeValueType length, std::uint8_t * row);
void
RoundTo(const float * real, SizeValueType length, std::int16_t * row);
void
RoundTo(const float * real, SizeValueType length, std::uint16_t * row);
void
RoundTo(const float * real, SizeValueType length, std::int32_t * row);

/** blend[n] = weights[0] rows[0][n] + weights[1] rows[1][n] + ..., for n < length rounded up to Granule; \a count is
 * the number of rows, at least one. */
void
Blend(const float * const * rows, const float * weights, SizeValueType count, SizeValueType length, float * blend);

/** The taps of all positions along one row, tap by tap. */
class RowTaps
{
public:
  /** \param taps of positions that do not decrease
   *  \param numberOfPositions how many of them, at least one
   *  \param origin sample of the axis at which the rows to interpolate begin */
  RowTaps(const SeparableTaps & taps, SizeValueType numberOfPositions, SizeValueType origin);

  SizeValueType
  GetNumberOfTaps() const
  {
    return m_NumberOfTaps;
  }

  /** Number of positions rounded up to Granule; the additional positions have weights of zero. */
  SizeValueType
  GetPaddedLength() const
  {
    return m_First.size();
  }

  /** Sample of the first tap, by position. */
  const std::int32_t *
  GetFirst() const
  {
    return m_First.data();
  }

  /** Weight of one tap, by position. */
  const float *
  GetWeights(SizeValueType tap) const
  {
    return m_Weights.data() + tap * m_First.size();
  }

private:
  SizeValueType m_NumberOfTaps;
  std::vector<std::int32_t> m_First;
  std::vector<float> m_Weights;
};

/** values[n] = sum over the taps of position n of weight times sample, for n < taps.GetPaddedLength(). The row must
 * have PaddedLength(). */
void
Interpolate(const float * row, const RowTaps & taps, float * values);

} // namespace RowArithmetic
} // namespace itk

#endif
