#include "itkTriangleSurfaceQuality.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

/** What the shape of a triangle is computed from, in mm^2. */
struct TriangleShape
{
  std::array<double, 3> squaredSides; ///< in growing order
  double twiceArea;

  TriangleShape(const PositionType & a, const PositionType & b, const PositionType & c)
  {
    const PositionType ab = Subtract(b, a);
    const PositionType bc = Subtract(c, b);
    const PositionType ca = Subtract(a, c);
    const PositionType normal = Cross(ab, ca);
    squaredSides = { Dot(ab, ab), Dot(bc, bc), Dot(ca, ca) };
    std::sort(squaredSides.begin(), squaredSides.end());
    twiceArea = std::sqrt(Dot(normal, normal));
  }

  double
  GetQuality() const
  {
    const double sum = squaredSides[0] + squaredSides[1] + squaredSides[2];
    return sum > 0.0 ? 2.0 * std::sqrt(3.0) * twiceArea / sum : 0.0;
  }

  /** The tangent of the smallest angle, by the law of cosines, as the shortest side is opposite to it. */
  double
  GetSmallestTangent() const
  {
    const double twiceDot = squaredSides[1] + squaredSides[2] - squaredSides[0];
    return twiceDot > 0.0 ? 2.0 * twiceArea / twiceDot : 0.0;
  }
};

} // namespace

double
ComputeTriangleQuality(const PositionType & a, const PositionType & b, const PositionType & c)
{
  return TriangleShape(a, b, c).GetQuality();
}

TriangleSurfaceQuality
ComputeQuality(const TriangleSurface & surface)
{
  const auto & points = surface.GetPoints();
  const auto & triangles = surface.GetTriangles();
  TriangleSurfaceQuality quality;
  if (triangles.empty())
  {
    return quality;
  }
  quality.minimum = 1.0;
  double smallestTangent = std::sqrt(3.0); // of 60 degrees
  SizeValueType poor = 0;
  for (const auto & corners : triangles)
  {
    const TriangleShape shape(
      ToPosition(points[corners[0]]), ToPosition(points[corners[1]]), ToPosition(points[corners[2]]));
    const double one = shape.GetQuality();
    quality.mean += one;
    quality.minimum = std::min(quality.minimum, one);
    poor += one < TriangleSurfaceQuality::Poor ? 1 : 0;
    smallestTangent = std::min(smallestTangent, shape.GetSmallestTangent());
  }
  const auto count = static_cast<double>(triangles.size());
  quality.mean /= count;
  quality.poorFraction = static_cast<double>(poor) / count;
  quality.smallestAngle = std::atan(smallestTangent) * 180.0 / std::acos(-1.0);
  return quality;
}

} // namespace itk
