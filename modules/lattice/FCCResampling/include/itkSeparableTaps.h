#ifndef itkSeparableTaps_h
#define itkSeparableTaps_h

#include "itkIntTypes.h"

#include <iosfwd>
#include <vector>

namespace itk
{

/** The kernels of interpolation of CartesianToFCCImageFilter: see SeparableTaps. */
enum class SeparableKernel : unsigned char
{
  Linear,
  CubicBSpline,
  Lanczos4
};

/** The kernel's name as in the enumeration. */
std::ostream &
operator<<(std::ostream & os, SeparableKernel kernel);

/** \class SeparableTaps
 * \brief The input samples, and their weights, that interpolated values at a list of positions along one axis are sums
 * of.
 *
 * Every position has the same number of *taps*, consecutive samples from GetFirst() on. The weights depend on the
 * position and the axis' full length alone, not on which part of the axis is available, so any part of an output is the
 * same whether computed alone or with the rest.
 *
 * - Linear: two taps.
 * - CubicBSpline: ten taps that stand for interpolation with the cubic B-spline, prefilter included (Unser, Aldroubi,
 *   Eden 1993). With the exact prefilter every sample has a weight, which falls by 1 / 3.73 with each sample; here the
 *   prefilter is cut to ten taps by least squares, such that the kernel still interpolates and still reproduces cubic
 *   polynomials. Root mean square
 *   errors at the sites of the default lattice, of waves equally distributed in the ball |k| <= K pi per sample, for a
 *   field of root mean square 1, and of the distance fields of a sphere (radius 13.3) and a torus (11, 4.7):
 *
 *     kernel                        taps   K = .25   K = .5   K = .75   sphere    torus
 *     linear                           2   3.5e-2    1.3e-1   2.8e-1    1.3e-2    2.0e-2
 *     exact cubic B-spline           all   2.3e-4    5.0e-3   4.0e-2    2.3e-6    5.2e-4
 *     CubicBSpline                    10   0.8e-4    5.0e-3   4.0e-2    1.6e-6    5.2e-4
 *     the same with                    8   7.9e-4    6.8e-3   4.0e-2    9.4e-6    5.6e-4
 *     B-splines, FIR prefilter        12   1.5e-4    5.0e-3   4.0e-2    2.6e-6    5.3e-4
 *     Lanczos4                         8   3.5e-3    7.5e-3   1.1e-2    1.0e-2    9.1e-3
 *
 * - Lanczos4: sinc(x) sinc(x / 4), eight taps, normalised to a sum of 1. It keeps more of the highest frequencies than
 *   the spline, but does not even reproduce linear fields exactly, hence its errors for smooth fields.
 *
 * Where samples are not at even steps, their true positions are given, and both higher kernels are the natural cubic
 * spline through the ten samples around the position. It reproduces linear fields exactly, up to the ends. Root mean
 * square errors for a wave of root mean square 1, by its length in samples:
 *
 *     samples                        kernel         32        16        8         4
 *     even                           CubicBSpline   2.6e-6    2.7e-5    3.2e-4    1.7e-2
 *     even                           spline         1.0e-5    2.8e-5    4.8e-4    1.7e-2
 *     blocks of ten, steps 1 and 1/2 spline         0.8e-5    2.7e-5    4.0e-4    1.2e-2
 *     the same                       Linear         2.4e-3    9.1e-3    3.7e-2    1.4e-1
 *
 * In a step more than 2.5 times as long as a step beside it (missing samples) the spline would overshoot an edge by
 * more than a third of its height, and the field is linear there. CubicBSpline, applied to samples as if they were
 * even, would bend a linear field by up to 8 % of the change of the step wherever that changes.
 *
 * Samples beyond the ends of evenly placed samples are mirror images about the first and last sample, as
 * itk::BSplineInterpolateImageFunction has them.
 *
 * Positions outside the samples, [0, length - 1], are moved to the nearest end: the field is constant beyond it.
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

  /** Taps for samples that are not evenly placed.
   *
   *  \param samples positions of the samples, increasing, at least one; in any unit
   *  \param positions in the same unit */
  SeparableTaps(SeparableKernel kernel, const std::vector<double> & samples, const std::vector<double> & positions);

  /** Number of taps of each position: 2, 10 or 8, or all samples of a shorter axis. */
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
