#ifndef rhombicBandLimitedField_h
#define rhombicBandLimitedField_h

#include "rhombicReferenceField.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class BandLimitedField
 * \brief An isotropic random field without detail finer than a given wavelength: the sum of plane waves
 *
 *   sqrt(2 / n) sum cos(2 pi (k . p + phase)),
 *
 * over n waves, whose wave vectors k are evenly distributed in a ball and whose phases are random. Its mean is 0 and
 * its variance 1, and with many waves its values are nearly Gaussian; the surface at 0 halves space. The same numbers
 * give the same field on every machine, up to rounding. The method is that of M. Shinozuka, "Simulation of multivariate
 * and multidimensional random processes", J. Acoust. Soc. Am. 49 (1971).
 */
class BandLimitedField : public ReferenceField
{
public:
  /** Default number of waves. */
  static constexpr unsigned int DefaultNumberOfWaves = 96;

  /** \param bandLimit length of the longest wave vector, in fractions of the Nyquist frequency of a Cartesian grid of
   *  spacing 1, which is half a wave per unit
   *  \param seed of the random numbers
   *  \param numberOfWaves rounded up to a multiple of 8 */
  BandLimitedField(double bandLimit, std::uint64_t seed, unsigned int numberOfWaves = DefaultNumberOfWaves);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  std::vector<double> m_X; ///< waves per unit along each axis
  std::vector<double> m_Y;
  std::vector<double> m_Z;
  std::vector<double> m_Phases; ///< in waves
  double m_Amplitude;
};

} // namespace rhombic

#endif
