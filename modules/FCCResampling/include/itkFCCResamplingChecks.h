#ifndef itkFCCResamplingChecks_h
#define itkFCCResamplingChecks_h

#include "itkImageRegion.h"
#include "itkMatrix.h"
#include "itkVector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{

/** \file
 * What the resampling filters ask of geometries, and how they treat borders and rounding. The functions throw nothing.
 * Thread safety: they are pure. */

/** Whether a spacing is positive along all axes, or zero along all: to be derived. */
inline bool
IsSpacingOrUnset(const Vector<double, 3> & spacing)
{
  bool isPositive = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    isPositive = isPositive && spacing[axis] > 0.0 && std::isfinite(spacing[axis]);
  }
  return isPositive || spacing == Vector<double, 3>(0.0);
}

/** Cosine of the angle between axes that count as perpendicular. */
constexpr double AxesTolerance = 1e-6;

/** Whether the columns of an image's direction are perpendicular to each other. */
inline bool
AreAxesPerpendicular(const Matrix<double, 3, 3> & direction)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto column = direction.GetVnlMatrix().get_column(axis);
    const auto next = direction.GetVnlMatrix().get_column((axis + 1) % 3);
    if (std::abs(dot_product(column, next)) > AxesTolerance * column.magnitude() * next.magnitude())
    {
      return false;
    }
  }
  return true;
}

/** Whether so many samples along each axis can be counted and addressed. */
inline bool
IsCountable(const std::array<double, 3> & counts)
{
  constexpr double most = 1099511627776.0; // 2^40
  return counts[0] * counts[1] * counts[2] <= most;
}

/** Whether a position, 0 being the first sample, lies in the voxels of an axis of \a length samples. */
inline bool
IsInsideVoxels(double position, SizeValueType length)
{
  constexpr double tolerance = 1e-6; // against rounding
  return position >= -0.5 - tolerance && position <= static_cast<double>(length) - 0.5 + tolerance;
}

/** The sample of an axis that a sample beyond its ends is the mirror image of, about the first and last sample. */
inline OffsetValueType
MirroredSample(OffsetValueType sample, OffsetValueType length)
{
  if (sample >= 0 && sample < length)
  {
    return sample;
  }
  if (length == 1)
  {
    return 0;
  }
  const OffsetValueType period = 2 * (length - 1);
  const OffsetValueType folded = ((sample % period) + period) % period;
  return std::min(folded, period - folded);
}

/** Rounds half away from zero and clamps to the range of an integer type; not-a-number becomes its lowest value. */
template <typename TPixel, typename TReal>
TPixel
RoundAndClamp(TReal value)
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    static_assert(sizeof(TPixel) < 4 || std::is_same_v<TPixel, std::int32_t>,
                  "Pixels are integers of 8 or 16 bits, signed ones of 32, or real numbers");
    // Half more than a whole number must be exact: float does for 16 bits, double for 32.
    using RealType = std::conditional_t<sizeof(TPixel) < 4, TReal, double>;
    constexpr auto lowest = static_cast<RealType>(std::numeric_limits<TPixel>::lowest());
    constexpr auto highest = static_cast<RealType>(std::numeric_limits<TPixel>::max());
    const auto real = static_cast<RealType>(value);
    const RealType clamped = real > lowest ? (real < highest ? real : highest) : lowest;
    const RealType half = clamped < RealType(0) ? RealType(-0.5) : RealType(0.5);
    return static_cast<TPixel>(static_cast<std::int64_t>(clamped + half));
  }
  else
  {
    return static_cast<TPixel>(value);
  }
}

} // namespace itk

#endif
