// Two triangles in different planes meet where the intervals overlap in which each of them meets the line common to
// both planes. The ends of the intervals are put in order by the signs of determinants of the corners themselves,
// without computing a point of the line: P. Guigue, O. Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using
// Orientation Predicates", Journal of Graphics Tools 8 (2003).
#include "itkTriangleSurfaceIntersections.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <limits>

namespace itk
{
namespace
{

using Contact = TriangleContact;
using MeshPoint = TriangleSurface::PointType;
using Corners = std::array<MeshPoint, 3>;
using Signs = std::array<int, 3>;

bool
AreAll(const Signs & signs, int sign)
{
  return signs[0] == sign && signs[1] == sign && signs[2] == sign;
}

bool
SpansPlane(const Corners & corners)
{
  return HasArea(corners[0], corners[1], corners[2]);
}

/** An axis along which a triangle with area does not project to a line. */
unsigned int
FindAxis(const Corners & corners)
{
  unsigned int axis = 0;
  while (axis < 2 && OrientationAlongAxis(corners[0], corners[1], corners[2], axis) == 0)
  {
    ++axis;
  }
  return axis;
}

/** Rotates the corners of both triangles until the shared corners come first; returns the number of shared corners. */
unsigned int
BringSharedFirst(TriangleSurface::TriangleType & first, TriangleSurface::TriangleType & second)
{
  const auto turn = [](TriangleSurface::TriangleType & triangle, const TriangleSurface::TriangleType & other) {
    const auto isShared = [&other](std::uint32_t point) {
      return std::find(other.begin(), other.end(), point) != other.end();
    };
    const auto shared = std::count_if(triangle.begin(), triangle.end(), isShared);
    while (shared > 0 && shared < 3 &&
           !(isShared(triangle[0]) && isShared(triangle[static_cast<std::size_t>(shared - 1)])))
    {
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    }
    return static_cast<unsigned int>(shared);
  };
  turn(second, first);
  return turn(first, second);
}

/** Triangles with a common edge meet elsewhere only if they are folded onto each other. */
Contact
FindContactAtEdge(const Corners & first, const Corners & second)
{
  if (OrientationInSpace(first[0], first[1], first[2], second[2]) != 0 || !SpansPlane(first) || !SpansPlane(second))
  {
    return Contact::Apart;
  }
  const unsigned int axis = FindAxis(first);
  const bool isFolded = OrientationAlongAxis(first[0], first[1], first[2], axis) ==
                        OrientationAlongAxis(first[0], first[1], second[2], axis);
  return isFolded ? Contact::Crossing : Contact::Apart;
}

/** Compares a triangle with the sides of another in the same plane, both projected along \a axis: Apart if it lies
 * beyond one of the sides, Touching if it lies beyond one but reaches it, else Crossing. */
Contact
ComparePlanarSides(const Corners & sided, const Corners & other, unsigned int axis)
{
  const int sense = OrientationAlongAxis(sided[0], sided[1], sided[2], axis);
  Contact contact = Contact::Crossing;
  for (unsigned int n = 0; n < 3; ++n)
  {
    int innermost = -1;
    for (const MeshPoint & corner : other)
    {
      innermost = std::max(innermost, sense * OrientationAlongAxis(sided[n], sided[(n + 1) % 3], corner, axis));
    }
    contact = innermost < 0 ? Contact::Apart : innermost == 0 ? std::min(contact, Contact::Touching) : contact;
    if (contact == Contact::Apart)
    {
      break;
    }
  }
  return contact;
}

/** Whether two triangles in one plane have sides that leave their common first corner in the same direction. */
bool
RunAlongEachOther(const Corners & first, const Corners & second, unsigned int axis)
{
  const auto direction = [](const MeshPoint & from, const MeshPoint & to, unsigned int u) {
    return (to[u] > from[u]) - (to[u] < from[u]);
  };
  for (unsigned int n = 1; n < 3; ++n)
  {
    for (unsigned int m = 1; m < 3; ++m)
    {
      bool isSame = OrientationAlongAxis(first[0], first[n], second[m], axis) == 0;
      for (unsigned int u = 0; u < 3; ++u)
      {
        isSame = isSame && direction(first[0], first[n], u) == direction(second[0], second[m], u);
      }
      if (isSame)
      {
        return true;
      }
    }
  }
  return false;
}

/** Two convex polygons in a plane are apart if a side of one of them separates them. */
Contact
FindContactInPlane(const Corners & first, const Corners & second, unsigned int shared)
{
  const unsigned int axis = FindAxis(first);
  const Contact contact = std::min(ComparePlanarSides(first, second, axis), ComparePlanarSides(second, first, axis));
  if (contact == Contact::Touching && shared == 1 && !RunAlongEachOther(first, second, axis))
  {
    return Contact::Apart;
  }
  return contact;
}

/** The sides of a triangle's plane on which the corners of another triangle lie; the first \a shared corners lie in it.
 */
Signs
FindSides(const Corners & plane, const Corners & corners, unsigned int shared)
{
  Signs sides{};
  for (unsigned int n = shared; n < 3; ++n)
  {
    sides[n] = OrientationInSpace(plane[0], plane[1], plane[2], corners[n]);
  }
  return sides;
}

bool
PassesThrough(const Signs & sides)
{
  return *std::min_element(sides.begin(), sides.end()) < 0 && *std::max_element(sides.begin(), sides.end()) > 0;
}

/** Whether the triangle meets the plane in more than one corner. */
bool
MeetsInLine(const Signs & sides)
{
  return PassesThrough(sides) || std::count(sides.begin(), sides.end(), 0) == 2;
}

/** Rotates the triangle until its first corner, the apex, is alone on one side of the plane; the other two are in the
 * plane or on its other side. Returns the apex's side. An apex in the plane gets the side without the other corners. */
int
BringApexFirst(Corners & corners, const Signs & sides)
{
  int apexSide = 0;
  for (const int side : { 1, -1 })
  {
    if (apexSide == 0 && std::count(sides.begin(), sides.end(), side) == 1)
    {
      apexSide = side;
    }
  }
  const auto apex = std::find(sides.begin(), sides.end(), apexSide);
  if (apexSide == 0)
  {
    apexSide = *std::max_element(sides.begin(), sides.end()) > 0 ? -1 : 1;
  }
  std::rotate(corners.begin(), corners.begin() + (apex - sides.begin()), corners.end());
  return apexSide;
}

/** The common line of the planes meets each triangle in an interval. With each apex in front of the other's plane, the
 * first triangle's interval begins at its side 0-2 and ends at 0-1, the second's begins at 0-1 and ends at 0-2. */
Contact
CompareIntervals(Corners first,
                 const Signs & firstSides,
                 Corners second,
                 const Signs & secondSides,
                 unsigned int shared)
{
  const int firstApexSide = BringApexFirst(first, firstSides);
  const int secondApexSide = BringApexFirst(second, secondSides);
  if (firstApexSide < 0)
  {
    std::swap(second[1], second[2]);
  }
  if (secondApexSide < 0)
  {
    std::swap(first[1], first[2]);
  }
  const int secondBeginsAfterFirst = OrientationInSpace(first[0], first[1], second[0], second[1]);
  const int firstBeginsAfterSecond = OrientationInSpace(first[0], first[2], second[2], second[0]);
  if (secondBeginsAfterFirst > 0 || firstBeginsAfterSecond > 0)
  {
    return Contact::Apart;
  }
  const bool haveLengthInCommon = secondBeginsAfterFirst < 0 && firstBeginsAfterSecond < 0;
  if (haveLengthInCommon && PassesThrough(firstSides) && PassesThrough(secondSides))
  {
    return Contact::Crossing;
  }
  // If the triangles share a corner, both intervals begin or end there.
  const bool meetBeyondShared = haveLengthInCommon && MeetsInLine(firstSides) && MeetsInLine(secondSides);
  return shared == 0 || meetBeyondShared ? Contact::Touching : Contact::Apart;
}

Contact
FindContact(const Corners & first, const Corners & second, unsigned int shared)
{
  const Signs firstSides = FindSides(second, first, shared);
  if (AreAll(firstSides, 0))
  {
    return SpansPlane(first) && SpansPlane(second) ? FindContactInPlane(first, second, shared) : Contact::Apart;
  }
  if (AreAll(firstSides, 1) || AreAll(firstSides, -1) || (shared == 1 && !MeetsInLine(firstSides)))
  {
    return Contact::Apart;
  }
  const Signs secondSides = FindSides(first, second, shared);
  if (AreAll(secondSides, 1) || AreAll(secondSides, -1) || (shared == 1 && !MeetsInLine(secondSides)) ||
      AreAll(secondSides, 0)) // then the first triangle has no area, as its corners are not all in the other's plane
  {
    return Contact::Apart;
  }
  return CompareIntervals(first, firstSides, second, secondSides, shared);
}

constexpr double RoundingOfProduct =
  1e-14; // of a product of three coordinates, over that of the vectors' lengths; generous

double
SumOfLengths(const PositionType & v)
{
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

/** A plane by floating-point numbers. */
struct RoundedPlane
{
  PositionType origin;
  PositionType normal;
  double bound; ///< of rounding, over the length of a point's offset from the origin
};

/** Between which heights above a plane the corners of a triangle are certain to lie that another triangle lacks: all
 * heights where a position is no number. */
std::array<double, 2>
FindHeights(const TriangleSurface::PointsContainer & points,
            const TriangleSurface::TriangleType & triangle,
            const TriangleSurface::TriangleType & other,
            const RoundedPlane & plane)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least = infinity, greatest = -infinity;
  bool areNumbers = true;
  for (const std::uint32_t corner : triangle)
  {
    const bool isShared = (corner == other[0]) | (corner == other[1]) | (corner == other[2]);
    const PositionType offset = Subtract(ToPosition(points[corner]), plane.origin);
    const double height = Dot(plane.normal, offset);
    const double bound = plane.bound * SumOfLengths(offset);
    least = isShared ? least : std::min(least, height - bound);
    greatest = isShared ? greatest : std::max(greatest, height + bound);
    areNumbers &= isShared | (height - bound <= height + bound);
  }
  return { areNumbers ? least : -infinity, areNumbers ? greatest : infinity };
}

/** Whether all corners of \a other that \a triangle lacks are certain to lie on one side of its plane. */
bool
IsBesidePlane(const TriangleSurface::PointsContainer & points,
              const TriangleSurface::TriangleType & triangle,
              const TriangleSurface::TriangleType & other)
{
  const PositionType origin = ToPosition(points[triangle[0]]);
  const PositionType u = Subtract(ToPosition(points[triangle[1]]), origin);
  const PositionType v = Subtract(ToPosition(points[triangle[2]]), origin);
  const auto [least, greatest] = FindHeights(
    points, other, triangle, { origin, Cross(u, v), RoundingOfProduct * SumOfLengths(u) * SumOfLengths(v) });
  return (least > 0.0) != (greatest < 0.0); // both if all corners are shared
}

/** Whether a plane across the way from one centre to the other is certain to part the triangles, but for a corner that
 * they share. */
bool
ArePartedBetweenCentres(const TriangleSurface::PointsContainer & points,
                        const TriangleSurface::TriangleType & first,
                        const TriangleSurface::TriangleType & second)
{
  PositionType way{};
  std::uint32_t origin = first[0];
  unsigned int shared = 0;
  for (std::size_t n = 0; n < 3; ++n)
  {
    way = Add(way, Subtract(ToPosition(points[second[n]]), ToPosition(points[first[n]])));
    const bool isShared = std::find(second.begin(), second.end(), first[n]) != second.end();
    origin = isShared ? first[n] : origin;
    shared += isShared ? 1 : 0;
  }
  const RoundedPlane plane{ ToPosition(points[origin]), way, RoundingOfProduct * SumOfLengths(way) };
  const double greatestOfFirst = FindHeights(points, first, second, plane)[1];
  const double leastOfSecond = FindHeights(points, second, first, plane)[0];
  return shared == 0 ? greatestOfFirst < leastOfSecond
                     : shared == 1 && greatestOfFirst < 0.0 && leastOfSecond > 0.0; // the plane holds the corner
}

} // namespace

Contact
FindContact(const TriangleSurface::PointsContainer & points,
            TriangleSurface::TriangleType first,
            TriangleSurface::TriangleType second)
{
  if (IsBesidePlane(points, first, second) || IsBesidePlane(points, second, first) ||
      ArePartedBetweenCentres(points, first, second))
  {
    return Contact::Apart;
  }
  const unsigned int shared = BringSharedFirst(first, second);
  const Corners firstCorners = { points[first[0]], points[first[1]], points[first[2]] };
  const Corners secondCorners = { points[second[0]], points[second[1]], points[second[2]] };
  switch (shared)
  {
    case 0:
    case 1:
      return FindContact(firstCorners, secondCorners, shared);
    case 2:
      return FindContactAtEdge(firstCorners, secondCorners);
    default:
      return SpansPlane(firstCorners) ? Contact::Crossing : Contact::Apart;
  }
}

} // namespace itk
