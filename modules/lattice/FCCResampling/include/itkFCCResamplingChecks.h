#ifndef itkFCCResamplingChecks_h
#define itkFCCResamplingChecks_h

#include "itkSlicePlacement.h"

#include "itkImageRegion.h"
#include "itkVector.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{

/** \file
 * Checks of geometries, and rounding. The functions throw nothing. */

/** Whether a spacing is positive along all axes, or zero along all axes, which means that it is not set. */
inline bool
IsFCCSpacingOrUnset(const Vector<double, 3> & spacing)
{
  bool isPositive = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    isPositive = isPositive && spacing[axis] > 0.0 && std::isfinite(spacing[axis]);
  }
  return isPositive || spacing == Vector<double, 3>(0.0);
}

/** Whether an image with these numbers of samples along its axes has at most 2^40 samples. */
inline bool
IsFCCSizeCountable(const std::array<double, 3> & counts)
{
  constexpr double most = 0x1p40;
  return counts[0] * counts[1] * counts[2] <= most;
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
    const RealType floored = real > lowest ? real : lowest; // also where real is not a number
    const RealType clamped = floored < highest ? floored : highest;
    return static_cast<TPixel>(static_cast<std::int32_t>(clamped + std::copysign(RealType(0.5), clamped)));
  }
  else
  {
    return static_cast<TPixel>(value);
  }
}

} // namespace itk

#endif
