#ifndef rhombicShapeFields_h
#define rhombicShapeFields_h

#include "rhombicReferenceField.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** \class SphereField
 * \brief The signed distance to a sphere, radius - |p - center|. Its gradient is 0 at the center, where it has none. */
class SphereField : public ReferenceField
{
public:
  SphereField(const Vector3 & center, double radius);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  Vector3 m_Center;
  double m_Radius;
};

/** \class TorusField
 * \brief The signed distance to a torus: minor - the distance to its circle, of radius major, about an axis through the
 * center. Its gradient is 0 on the axis and on the circle, where it has none. */
class TorusField : public ReferenceField
{
public:
  /** \param center of the circle
   *  \param axis normal of the circle's plane, of any length but 0
   *  \param major radius of the circle
   *  \param minor radius of the tube, below major */
  TorusField(const Vector3 & center, const Vector3 & axis, double major, double minor);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  Vector3 m_Center;
  Vector3 m_Axis; ///< unit vector
  double m_Major;
  double m_Minor;
};

/** \class GyroidField
 * \brief sin x cos y + sin y cos z + sin z cos x, with x, y, z in units of period / 2 pi: a surface that fills any
 * volume evenly, in all directions (A. H. Schoen 1970). */
class GyroidField : public ReferenceField
{
public:
  /** \param period along each axis, above 0 */
  explicit GyroidField(double period);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  double m_WaveNumber; ///< 2 pi / period
};

/** \class MarschnerLobbField
 * \brief The test signal of S. Marschner, R. Lobb, "An evaluation of reconstruction filters for volume rendering"
 * (1994), in the cube from -1 to 1, minus its middle value 0.5: a wave along z and rings about z whose wavelength
 * shrinks to 1/12 of the cube's edge. */
class MarschnerLobbField : public ReferenceField
{
public:
  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;
};

/** \class CornerField
 * \brief level - max(x, y, z): the surface is three planes at right angles. */
class CornerField : public ReferenceField
{
public:
  explicit CornerField(double level);

  using ReferenceField::Evaluate;

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const override;

private:
  double m_Level;
};

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
  /** Numbers of waves are multiples of this, the largest number that a processor computes at once. */
  static constexpr std::size_t WaveBatch = 8;

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
