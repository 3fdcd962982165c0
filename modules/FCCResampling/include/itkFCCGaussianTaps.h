#ifndef itkFCCGaussianTaps_h
#define itkFCCGaussianTaps_h

#include "itkIntTypes.h"

#include <array>
#include <vector>

namespace itk
{

/** \class FCCGaussianTaps
 * \brief A Gaussian on the sites of the face-centered cubic lattice, as a product of one factor per axis.
 *
 * A site at (x, y, z) from the middle gets the weight g0(x) g1(y) g2(z), where x + y + z is even. Each factor is a
 * sampled Gaussian, exp(-n^2 / 2q), cut off behind four standard deviations. Its q is not the variance asked for but
 * the one that makes the *second moments of the weights on the lattice* equal to it: a sampled Gaussian's own are wrong
 * where the standard deviation is under about 0.7 units, and the points that are no sites are missing. With a factor's
 * sums
 *
 *   m = sum n^2 g(n),   A = sum (-1)^n g(n),   B = sum (-1)^n n^2 g(n)
 *
 * the weights' sum over the lattice is (1 + A0 A1 A2) / 2 and the second moment along axis 0 is
 * (m0 + B0 A1 A2) / (1 + A0 A1 A2), from the factors' Fourier series at 0 and at the corner (pi, pi, pi), which are one
 * frequency to the lattice.
 *
 * Immutable, so thread safe.
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

  /** The most lattice units between the middle and the last tap. */
  static constexpr double MaximumReach = 4096.0;

  /** \param variances along the axes, in lattice units squared; at least 0, so that the reach, four times their root,
   * is at most MaximumReach. At 0 there is nothing but the middle along that axis. */
  explicit FCCGaussianTaps(const std::array<double, 3> & variances);

  /** The last tap's distance from the middle in lattice units; at least 1, if only with a weight of 0. */
  OffsetValueType
  GetReach(unsigned int axis) const
  {
    return m_Reach[axis];
  }

  /** The even (0) or odd (1) taps of an axis; never none. Of all three axes, those products whose parities have an even
   * sum add up to 1. */
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
