#ifndef rhombicBandLimitedField_h
#define rhombicBandLimitedField_h

#include "rhombicReferenceField.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class BandLimitedField
 * \brief An isotropic random field without any detail finer than a given wavelength: the sum of plane waves
 *
 *   sqrt(2 / n) sum cos(2 pi (k . p + phase)),
 *
 * whose wave vectors k are evenly distributed in a ball and whose phases are random. Its mean is 0 and its variance 1,
 * and with many waves its values are nearly Gaussian; the surface at 0 halves space. The same numbers give the same
 * field on every machine.
 *
 * Sines are computed to 1e-10.
 */
class BandLimitedField : public ReferenceField
{
public:
  /** Waves of a field if nothing else is asked for. */
  static constexpr unsigned int DefaultNumberOfWaves = 96;

  /** \param bandLimit length of the longest wave vector, in fractions of the Nyquist frequency of a Cartesian grid of
   *  spacing 1, which is half a wave per unit
   *  \param seed of the random numbers
   *  \param numberOfWaves rounded up to an even number */
  BandLimitedField(double bandLimit, std::uint64_t seed, unsigned int numberOfWaves = DefaultNumberOfWaves);

  double
  Evaluate(const Vector3 & point) const override;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  /** Two waves side by side, as the processor computes them. */
  struct WavePair
  {
    double x[2]; ///< waves per unit along each axis
    double y[2];
    double z[2];
    double phase[2]; ///< in waves
  };

  std::vector<WavePair> m_Waves;
  double m_Amplitude;
};

} // namespace rhombic

#endif
