#include "itkTriangleSurfaceIntersections.h"

#include "detail/itkPositionArithmetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace
{

using itk::OrientationAlongAxis;
using itk::OrientationInSpace;
using Contact = itk::TriangleContact;
using Point = itk::TriangleSurface::PointType;
using Points = itk::TriangleSurface::PointsContainer;
using Triangle = itk::TriangleSurface::TriangleType;
using Integer = __int128;
using Vector = std::array<Integer, 3>;

Vector
Exact(const Point & point)
{
  return { static_cast<Integer>(point[0]), static_cast<Integer>(point[1]), static_cast<Integer>(point[2]) };
}

Vector
operator-(const Vector & a, const Vector & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector
Cross(const Vector & a, const Vector & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Integer
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int
Sign(Integer value)
{
  return (value > 0) - (value < 0);
}

/** A fraction along a line. */
struct Fraction
{
  Integer numerator;
  Integer denominator; // > 0

  bool
  operator<(const Fraction & other) const
  {
    return numerator * other.denominator < other.numerator * denominator;
  }
};

/** All of a line's parameters t for which origin + t direction is strictly or weakly inside a triangle's prism: the
 * triangle clipped out of a line of its own plane by its three sides, in rational numbers. */
struct Interval
{
  Fraction begin;
  Fraction end;
  bool isEmpty = false;
};

Interval
ClipLine(const std::array<Vector, 3> & corners, const Vector & scaledOrigin, Integer scale, const Vector & direction)
{
  const Vector normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  Interval interval{ { -1000000000, 1 }, { 1000000000, 1 } };
  for (unsigned int n = 0; n < 3; ++n)
  {
    const Vector inwards = Cross(normal, corners[(n + 1) % 3] - corners[n]);
    const Vector scaledCorner{ corners[n][0] * scale, corners[n][1] * scale, corners[n][2] * scale };
    const Integer start = Dot(inwards, scaledOrigin - scaledCorner); // scaled by scale
    const Integer slope = Dot(inwards, direction) * scale;
    if (slope == 0)
    {
      interval.isEmpty = interval.isEmpty || start < 0;
    }
    else if (slope > 0)
    {
      interval.begin = std::max(interval.begin, Fraction{ -start, slope });
    }
    else
    {
      interval.end = std::min(interval.end, Fraction{ start, -slope });
    }
  }
  interval.isEmpty = interval.isEmpty || interval.end < interval.begin;
  return interval;
}

/** Contact of triangles with area in different planes, by clipping the planes' common line, where \a shared is the
 * index of the only shared corner, if there is one. Written for truth, not for speed. */
Contact
ContactAlongLine(const std::array<Vector, 3> & first, const std::array<Vector, 3> & second, bool hasShared)
{
  const Vector n1 = Cross(first[1] - first[0], first[2] - first[0]);
  const Vector n2 = Cross(second[1] - second[0], second[2] - second[0]);
  const Vector direction = Cross(n1, n2);
  const Integer d1 = Dot(n1, first[0]), d2 = Dot(n2, second[0]);
  // the point of both planes nearest to the origin, times |direction|^2
  const Vector a = Cross(n2, direction), b = Cross(direction, n1);
  const Vector origin{ d1 * a[0] + d2 * b[0], d1 * a[1] + d2 * b[1], d1 * a[2] + d2 * b[2] };
  const Integer scale = Dot(direction, direction);
  const Interval i = ClipLine(first, origin, scale, direction);
  const Interval j = ClipLine(second, origin, scale, direction);
  if (i.isEmpty || j.isEmpty || i.end < j.begin || j.end < i.begin)
  {
    return Contact::Apart;
  }
  const bool haveLength = i.begin < i.end && j.begin < j.end && i.begin < j.end && j.begin < i.end;
  const auto passes = [](const std::array<Vector, 3> & corners, const Vector & normal, Integer offset) {
    int least = 1, most = -1;
    for (const Vector & corner : corners)
    {
      least = std::min(least, Sign(Dot(normal, corner) - offset));
      most = std::max(most, Sign(Dot(normal, corner) - offset));
    }
    return least < 0 && most > 0;
  };
  if (haveLength && passes(first, n2, d2) && passes(second, n1, d1))
  {
    return Contact::Crossing;
  }
  return !hasShared || haveLength ? Contact::Touching : Contact::Apart;
}

/** Corners of the intersection of two triangles in a plane: corners of one in the other and crossings of sides, as
 * homogeneous points. */
std::vector<std::array<Integer, 4>>
IntersectInPlane(const std::array<Vector, 3> & first, const std::array<Vector, 3> & second, const Vector & normal)
{
  std::vector<std::array<Integer, 4>> found;
  const auto isInside = [&normal](const std::array<Vector, 3> & corners, const Vector & point) {
    const int sense = Sign(Dot(normal, Cross(corners[1] - corners[0], corners[2] - corners[0])));
    for (unsigned int n = 0; n < 3; ++n)
    {
      if (sense * Sign(Dot(normal, Cross(corners[(n + 1) % 3] - corners[n], point - corners[n]))) < 0)
      {
        return false;
      }
    }
    return true;
  };
  for (unsigned int n = 0; n < 3; ++n)
  {
    if (isInside(second, first[n]))
    {
      found.push_back({ first[n][0], first[n][1], first[n][2], 1 });
    }
    if (isInside(first, second[n]))
    {
      found.push_back({ second[n][0], second[n][1], second[n][2], 1 });
    }
    for (unsigned int m = 0; m < 3; ++m)
    {
      const Vector u = first[(n + 1) % 3] - first[n], v = second[(m + 1) % 3] - second[m], w = second[m] - first[n];
      Integer denominator = Dot(normal, Cross(u, v));
      if (denominator == 0)
      {
        continue; // parallel: corners tell
      }
      Integer s = Dot(normal, Cross(w, v)), t = Dot(normal, Cross(w, u));
      if (denominator < 0)
      {
        denominator = -denominator;
        s = -s;
        t = -t;
      }
      if (s >= 0 && s <= denominator && t >= 0 && t <= denominator)
      {
        found.push_back({ first[n][0] * denominator + s * u[0],
                          first[n][1] * denominator + s * u[1],
                          first[n][2] * denominator + s * u[2],
                          denominator });
      }
    }
  }
  return found;
}

/** The dimension of the hull of homogeneous points: -1 of none. */
int
Dimension(const std::vector<std::array<Integer, 4>> & points)
{
  const auto difference = [](const std::array<Integer, 4> & a, const std::array<Integer, 4> & b) {
    return Vector{ a[0] * b[3] - b[0] * a[3], a[1] * b[3] - b[1] * a[3], a[2] * b[3] - b[2] * a[3] };
  };
  if (points.empty())
  {
    return -1;
  }
  Vector direction{};
  for (const auto & point : points)
  {
    const Vector other = difference(point, points.front());
    if (direction == Vector{})
    {
      direction = other;
    }
    else if (Cross(direction, other) != Vector{})
    {
      return 2;
    }
  }
  return direction == Vector{} ? 0 : 1;
}

Contact
TrueContact(const Points & points, const Triangle & first, const Triangle & second)
{
  const std::array<Vector, 3> a{ Exact(points[first[0]]), Exact(points[first[1]]), Exact(points[first[2]]) };
  const std::array<Vector, 3> b{ Exact(points[second[0]]), Exact(points[second[1]]), Exact(points[second[2]]) };
  const auto shared = std::count_if(first.begin(), first.end(), [&second](std::uint32_t point) {
    return std::find(second.begin(), second.end(), point) != second.end();
  });
  const Vector n1 = Cross(a[1] - a[0], a[2] - a[0]);
  const Vector n2 = Cross(b[1] - b[0], b[2] - b[0]);
  if (n1 == Vector{} || n2 == Vector{})
  {
    return Contact::Apart;
  }
  if (Cross(n1, n2) != Vector{})
  {
    return shared == 2 ? Contact::Apart : ContactAlongLine(a, b, shared == 1);
  }
  if (Dot(n1, b[0] - a[0]) != 0)
  {
    return Contact::Apart;
  }
  const int dimension = Dimension(IntersectInPlane(a, b, n1));
  if (dimension == 2)
  {
    return Contact::Crossing;
  }
  return dimension + 1 > shared ? Contact::Touching : Contact::Apart;
}

/** Every pair of triangles on a small grid is degenerate in some way sooner or later: in one plane, with corners on
 * sides, sides through sides, collinear, repeated positions. */
TEST(TriangleContact, IsThatOfRationalArithmeticOnASmallGrid)
{
  std::mt19937 random(1);
  std::array<std::array<int, 3>, 4> found{};
  for (int trial = 0; trial < 400000; ++trial)
  {
    const int size = 1 + trial % 5;
    std::uniform_int_distribution<int> coordinate(-size, size);
    const bool isFlat = trial % 7 == 0;
    Points points(6);
    for (auto & point : points)
    {
      point = { float(coordinate(random)), float(coordinate(random)), isFlat ? 0.0f : float(coordinate(random)) };
    }
    const std::uint32_t shared = static_cast<std::uint32_t>(trial / 5 % 4);
    Triangle first{ 0, 1, 2 };
    Triangle second{ 3 - shared, 4 - shared, 5 - shared };
    std::shuffle(first.begin(), first.end(), random);
    std::shuffle(second.begin(), second.end(), random);
    const Contact expected = TrueContact(points, first, second);
    ASSERT_EQ(FindContact(points, first, second), expected) << "trial " << trial << ", " << shared << " shared";
    ASSERT_EQ(FindContact(points, second, first), expected) << "trial " << trial << ", " << shared << " shared";
    ++found[shared][static_cast<std::size_t>(expected)];
  }
  for (const std::uint32_t shared : { 0u, 1u })
  {
    EXPECT_GT(*std::min_element(found[shared].begin(), found[shared].end()), 1000) << "of " << shared << " shared";
  }
  EXPECT_GT(found[2][static_cast<std::size_t>(Contact::Crossing)], 1000);
  EXPECT_EQ(found[2][static_cast<std::size_t>(Contact::Touching)], 0);
}

/** A corner one unit in the last place off a slanted plane far from the origin is where double arithmetic fails. */
TEST(ExactOrientation, IsThatOfIntegersWhereDoubleIsNot)
{
  std::mt19937 random(2);
  std::uniform_int_distribution<int> far(-(1 << 24), 1 << 24);
  std::uniform_int_distribution<int> factor(-3, 3);
  std::uniform_int_distribution<int> off(-1, 1);
  int inPlane = 0;
  for (int trial = 0; trial < 200000; ++trial)
  {
    std::array<Vector, 4> exact;
    for (unsigned int n = 0; n < 3; ++n)
    {
      exact[n] = { far(random) / 8, far(random) / 8, far(random) / 8 };
    }
    const int u = factor(random), v = factor(random);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      exact[3][axis] = exact[0][axis] + u * (exact[1][axis] - exact[0][axis]) / 2 * 2 +
                       v * (exact[2][axis] - exact[0][axis]) + (trial % 2 == 0 ? off(random) : 0);
      exact[3][axis] = std::clamp<Integer>(exact[3][axis], -(1 << 24), 1 << 24);
    }
    std::array<Point, 4> points;
    const float scale = std::ldexp(1.0f, trial % 40 - 20);
    for (unsigned int n = 0; n < 4; ++n)
    {
      points[n] = { float(exact[n][0]) * scale, float(exact[n][1]) * scale, float(exact[n][2]) * scale };
    }
    const Vector normal = Cross(exact[1] - exact[0], exact[2] - exact[0]);
    const int expected = Sign(Dot(normal, exact[3] - exact[0]));
    inPlane += expected == 0;
    ASSERT_EQ(OrientationInSpace(points[0], points[1], points[2], points[3]), expected);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(OrientationAlongAxis(points[0], points[1], points[2], axis), Sign(normal[axis]));
    }
  }
  EXPECT_GT(inPlane, 1000);
}

/** The largest and the smallest float32 in one determinant: the plane x + y = 2^100 and points the least float beside
 * it or on it. */
TEST(ExactOrientation, SpansTheWholeRangeOfFloats)
{
  const float big = std::ldexp(1.0f, 100), least = std::ldexp(1.0f, -149);
  const Point a{ big, 0, 0 }, b{ 0, big, 0 }, c{ big, 0, big };
  EXPECT_EQ(OrientationInSpace(a, b, c, { 0, big, big }), 0);
  EXPECT_EQ(OrientationInSpace(a, b, c, { least, big, -3 }), -OrientationInSpace(a, b, c, { -least, big, -3 }));
  EXPECT_NE(OrientationInSpace(a, b, c, { least, big, -3 }), 0);
  EXPECT_EQ(OrientationInSpace(a, b, c, { 0, 0, 0 }), OrientationInSpace(a, b, c, { -least, big, least }));
  EXPECT_EQ(OrientationAlongAxis(a, b, { least, big, 0 }, 2), -OrientationAlongAxis(a, b, { 0, 0, 0 }, 2));
}

} // namespace
