#ifndef rhombicShapeFields_h
#define rhombicShapeFields_h

#include "rhombicReferenceField.h"

#include "itkImage.h"
#include "itkTriangleSurface.h"

#include <cstdint>
#include <vector>

namespace rhombic
{

/** The signed distance to a sphere, radius - |p - center|. Its gradient is 0 at the center, where it has none. */
ReferenceField
MakeSphereField(const Vector3 & center, double radius);

/** The signed distance to a torus: minor - the distance to its circle, of radius major, about an axis through the
 * center. Its gradient is 0 on the axis and on the circle, where it has none.
 * \param center of the circle
 * \param axis normal of the circle's plane, of any length but 0
 * \param major radius of the circle
 * \param minor radius of the tube, below major */
ReferenceField
MakeTorusField(const Vector3 & center, const Vector3 & axis, double major, double minor);

/** sin x cos y + sin y cos z + sin z cos x, with x, y, z in units of period / 2 pi: a surface that fills any volume
 * evenly, in all directions (A. H. Schoen 1970).
 * \param period along each axis, above 0 */
ReferenceField
MakeGyroidField(double period);

/** The test signal of S. Marschner, R. Lobb, "An evaluation of reconstruction filters for volume rendering" (1994), in
 * the cube from -1 to 1, minus its middle value 0.5: a wave along z and rings about z whose wavelength shrinks to 1/12
 * of the cube's edge. */
ReferenceField
MakeMarschnerLobbField();

/** level - max(x, y, z): the surface is three planes at right angles. */
ReferenceField
MakeCornerField(double level);

/** An isotropic random field without detail finer than a given wavelength: the sum of plane waves
 *
 *   sqrt(2 / n) sum cos(2 pi (k . p + phase)),
 *
 * over n = 96 waves, whose wave vectors k are evenly distributed in a ball and whose phases are random. Its mean is 0
 * and its variance 1, and with many waves its values are nearly Gaussian; the surface at 0 halves space. The same
 * numbers give the same field on every machine, up to rounding. The method is that of M. Shinozuka, "Simulation of
 * multivariate and multidimensional random processes", J. Acoust. Soc. Am. 49 (1971).
 * \param bandLimit length of the longest wave vector, in fractions of the Nyquist frequency of a Cartesian grid of
 * spacing 1, which is half a wave per unit
 * \param seed of the random numbers */
ReferenceField
MakeBandLimitedField(double bandLimit, std::uint64_t seed);

/** The cubic B-spline through the samples of a volume, mirrored at its border. */
ReferenceField
MakeInterpolatedField(const itk::Image<float, 3> * volume);

/** An upright hand, 2 units high, with the palm to -y: a closed body. The gap between the fourth and the fifth finger
 * widens evenly from the palm to 0.1. */
ReferenceField
MakeHand();

/** A point in the middle of a gap. */
struct GapPoint
{
  Vector3 point;
  double width; ///< of the gap there
};

/** Points along the gap of MakeHand(), from its narrow end. */
std::vector<GapPoint>
PointsInGapOfHand();

/** A four-legged animal with ears, trunk and tail, 1.2 units high, that looks to +x: a closed body. */
ReferenceField
MakeQuadruped();

/** The field of Y. Sahillioglu (2017): the smallest value, over 72 pictures of an object, 5 degrees apart about the z
 * axis, of the bilinear interpolation at a point's projection, minus 0.5. A picture is 1 where its parallel projection
 * shows the object, 0 elsewhere. The surface is the object's visual hull, up to a pixel. Values rise from -0.5 to 0.5
 * within a pixel, so that a grid much coarser than the pixels sees hardly more than inside or outside.
 * \param object a closed surface
 * \param rows pixels along the object's height; pixels are square */
ReferenceField
MakeSilhouetteField(const itk::TriangleSurface & object, unsigned int rows);

} // namespace rhombic

#endif
