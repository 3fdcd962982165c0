#ifndef itkSeparableTaps_h
#define itkSeparableTaps_h

#include "itkIntTypes.h"

#include <vector>

namespace itk
{

/** How CartesianToFCCImageFilter computes values between the samples of its input. */
enum class SeparableKernel : unsigned char
{
  Linear,
  CubicBSpline
};

/** \class SeparableTaps
 * \brief For each of a list of positions along one axis: the input samples its value is made of, and their weights.
 *
 * Every position has the same number of *taps*, consecutive samples from GetFirst() on. The weights depend on the
 * position and the axis' full length alone, not on which part of the axis is available, so any part of an output is the
 * same whether computed alone or with the rest.
 *
 * - Linear: two taps.
 * - CubicBSpline: interpolation with the cubic B-spline, prefilter included. The cardinal spline
 *   eta(x) = sum_m sqrt(3) z^|m| beta3(x - m), z = sqrt(3) - 2 (Unser, Aldroubi, Eden 1993), decays by 1 / 3.73 each
 *   sample; it is cut where it falls below float's resolution, to 24 taps, and normalised to a sum of 1. Samples beyond
 *   the ends are mirror images about the first and last one, as itk::BSplineInterpolateImageFunction has them.
 *
 * Positions outside the samples, [0, length - 1], are moved to the nearest end: the field is constant out there.
 *
 * Immutable after construction, so thread safe.
 *
 * \ingroup FCCResampling
 */
class SeparableTaps
{
public:
  /** \param kernel how values between samples are computed
   *  \param length number of samples on the whole axis, at least 1
   *  \param positions in units of samples; 0 is the first sample */
  SeparableTaps(SeparableKernel kernel, SizeValueType length, const std::vector<double> & positions);

  /** Taps of each position: 2 or 24, or all samples of a shorter axis. */
  SizeValueType
  GetNumberOfTaps() const
  {
    return m_NumberOfTaps;
  }

  /** Sample of the first tap of the \a n-th position. */
  SizeValueType
  GetFirst(SizeValueType n) const
  {
    return m_First[n];
  }

  /** Weights of the \a n-th position's taps. */
  const float *
  GetWeights(SizeValueType n) const
  {
    return m_Weights.data() + n * m_NumberOfTaps;
  }

private:
  SizeValueType m_NumberOfTaps;
  std::vector<SizeValueType> m_First;
  std::vector<float> m_Weights;
};

} // namespace itk

#endif
