#include "itkTriangleSurfaceQuality.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>

namespace itk
{
namespace
{

/** Squared sides and area of a triangle in mm^2. */
struct TriangleShape
{
  std::array<double, 3> squaredSides; ///< ascending
  double twiceArea;

  TriangleShape(const PositionType & a, const PositionType & b, const PositionType & c)
  {
    const PositionType ab = Subtract(b, a);
    const PositionType bc = Subtract(c, b);
    const PositionType ca = Subtract(a, c);
    squaredSides = { Dot(ab, ab), Dot(bc, bc), Dot(ca, ca) };
    std::sort(squaredSides.begin(), squaredSides.end());
    twiceArea = Length(Cross(ab, ca));
  }

  double
  GetQuality() const
  {
    const double sum = squaredSides[0] + squaredSides[1] + squaredSides[2];
    return sum > 0.0 ? 2.0 * std::sqrt(3.0) * twiceArea / sum : 0.0;
  }

  /** Tangent of the smallest angle, which is opposite to the shortest side, by the law of cosines. */
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
ComputeTriangleSurfaceQuality(const TriangleSurface & surface)
{
  const auto & triangles = surface.GetTriangles();
  TriangleSurfaceQuality quality;
  if (triangles.empty())
  {
    return quality;
  }
  quality.minimum = 1.0;
  double smallestTangent = std::sqrt(3.0); // tangent of 60 degrees
  SizeValueType poor = 0;
  for (const auto & triangle : triangles)
  {
    const auto [a, b, c] = CornersOf(surface, triangle);
    const TriangleShape shape(a, b, c);
    const double value = shape.GetQuality();
    quality.mean += value;
    quality.minimum = std::min(quality.minimum, value);
    poor += value < TriangleSurfaceQuality::Poor ? 1 : 0;
    smallestTangent = std::min(smallestTangent, shape.GetSmallestTangent());
  }
  const auto count = static_cast<double>(triangles.size());
  quality.mean /= count;
  quality.poorFraction = static_cast<double>(poor) / count;
  quality.smallestAngle = std::atan(smallestTangent) * 180.0 / std::acos(-1.0);
  return quality;
}

} // namespace itk
