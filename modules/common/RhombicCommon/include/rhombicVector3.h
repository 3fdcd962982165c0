#ifndef rhombicVector3_h
#define rhombicVector3_h

#include <array>
#include <cmath>

namespace rhombic
{

/** \file
 * Arithmetic of points and vectors in double precision. */

/** A point, in LPS mm where nothing else is said, or a direction. */
using Vector3 = std::array<double, 3>;

/** a + b */
inline Vector3
Add(const Vector3 & a, const Vector3 & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

/** a - b */
inline Vector3
Subtract(const Vector3 & a, const Vector3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** factor * a */
inline Vector3
Scaled(const Vector3 & a, double factor)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

/** from + share * way */
inline Vector3
Along(const Vector3 & from, const Vector3 & way, double share)
{
  return { from[0] + share * way[0], from[1] + share * way[1], from[2] + share * way[2] };
}

/** The point between two others; share 0 is \a a. */
inline Vector3
Mix(const Vector3 & a, const Vector3 & b, double share)
{
  return Along(a, Subtract(b, a), share);
}

/** The scalar product. */
inline double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The vector product a x b. */
inline Vector3
Cross(const Vector3 & a, const Vector3 & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/** The Euclidean length. */
inline double
Length(const Vector3 & a)
{
  return std::sqrt(Dot(a, a));
}

/** The square of the distance of two points. */
inline double
SquaredDistance(const Vector3 & a, const Vector3 & b)
{
  const Vector3 difference = Subtract(a, b);
  return Dot(difference, difference);
}

/** The distance of two points. */
inline double
Distance(const Vector3 & a, const Vector3 & b)
{
  return std::sqrt(SquaredDistance(a, b));
}

} // namespace rhombic

#endif
