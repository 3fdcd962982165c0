#ifndef itkFCCGaussianTaps_h
#define itkFCCGaussianTaps_h

#include "itkImageRegion.h"

#include <array>
#include <vector>

namespace itk
{

/** \class FCCGaussianTaps
 * \brief A Gaussian on the sites of the face-centered cubic lattice, as a product of one factor per axis.
 *
 * A site at (x, y, z) from the middle gets the weight g0(x) g1(y) g2(z), where x + y + z is even. Each factor is a
 * sampled Gaussian, exp(-n^2 / 2q), cut off beyond four standard deviations. Its q is not the variance asked for but
 * the value that makes the *second moments of the weights on the lattice* equal to it: a sampled Gaussian's own moments
 * are wrong where the standard deviation is under about 0.7 units, and the points that are no sites are missing. With a
 * factor's sums
 *
 *   m = sum n^2 g(n),   A = sum (-1)^n g(n),   B = sum (-1)^n n^2 g(n)
 *
 * the weights' sum over the lattice is (1 + A0 A1 A2) / 2 and the second moment along axis 0 is
 * (m0 + B0 A1 A2) / (1 + A0 A1 A2), from the factors' Fourier series at 0 and at the corner (pi, pi, pi), which are one
 * frequency to the lattice.
 *
 * \ingroup FCCResampling
 */
class FCCGaussianTaps
{
public:
  /** The taps of one factor that lead to lattice points of the same parity. */
  struct Factor
  {
    std::vector<OffsetValueType> steps; ///< in lattice units, increasing
    std::vector<float> weights;
  };

  /** The largest possible distance of the last tap from the middle, in lattice units. */
  static constexpr double MaximumReach = 4096.0;

  /** \param variances along the axes, in lattice units squared, from 0 to (MaximumReach / 4)^2. At 0 nothing is
   * smoothed along that axis. */
  explicit FCCGaussianTaps(const std::array<double, 3> & variances);

  /** Distance of the last tap from the middle in lattice units; at least 1, where that tap's weight may be 0. */
  OffsetValueType
  GetReach(unsigned int axis) const
  {
    return m_Reach[axis];
  }

  /** The part of the image \a whole that smoothing \a region needs. */
  ImageRegion<3>
  AddReach(const ImageRegion<3> & region, const ImageRegion<3> & whole) const;

  /** The even (0) or odd (1) taps of an axis, at least one. The products of three weights, one for each axis, whose
   * steps have an even sum add up to 1. */
  const Factor &
  GetFactor(unsigned int axis, unsigned int parity) const
  {
    return m_Factors[axis][parity];
  }

private:
  std::array<OffsetValueType, 3> m_Reach{};
  std::array<std::array<Factor, 2>, 3> m_Factors;
};

} // namespace itk

#endif
