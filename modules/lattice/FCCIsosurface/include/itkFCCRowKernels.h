#ifndef itkFCCRowKernels_h
#define itkFCCRowKernels_h

#include "itkIntTypes.h"

#include <cstdint>

namespace itk
{

/** \class FCCRowKernels
 * \brief The loops over rows of pixels, compiled in the library for all integers from char to unsigned long long, for
 * float and for double.
 *
 * \ingroup FCCIsosurface
 */
struct FCCRowKernels
{
  /** Writes one bit for each value, from bit 0 of the first word on: is it at least \a isovalue, which is finite, or
   * with \a isBelow, less than that? The answer is exact for all types. Not-a-number is neither. Bits past the last
   * value are zero. */
  template <typename TPixel>
  static void
  Classify(const TPixel * values, SizeValueType count, double isovalue, bool isBelow, std::uint64_t * words);

  /** differences[i] = values[i] - isovalue, computed in float64 and rounded to float32: so integers of more than 53
   * bits are rounded before. */
  template <typename TPixel>
  static void
  Subtract(const TPixel * values, SizeValueType count, double isovalue, float * differences);
};

} // namespace itk

#endif
