#include "itkTriangleSurfaceMeasures.h"

#include "detail/itkPositionArithmetic.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <numeric>

namespace itk
{
namespace
{

/** A point relative to a point of the surface, so that volumes far from LPS 0 keep their digits. */
PositionType
Relative(const TriangleSurface & surface, std::uint32_t point, std::uint32_t origin = 0)
{
  return Subtract(ToPosition(surface.GetPoints()[point]), ToPosition(surface.GetPoints()[origin]));
}

/** Six times the signed volume of the tetrahedron between a triangle and a point of the surface. */
double
SixfoldVolume(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle, std::uint32_t origin = 0)
{
  return Dot(Relative(surface, triangle[0], origin),
             Cross(Relative(surface, triangle[1], origin), Relative(surface, triangle[2], origin)));
}

/** The sum of \a term(triangle) over all triangles: sums of blocks of fixed size, so that the number of threads does
 * not change it. */
template <typename TTerm>
double
SumOverTriangles(const TriangleSurface & surface, const TTerm & term)
{
  constexpr std::size_t blockSize = 65536;
  const auto & triangles = surface.GetTriangles();
  std::vector<double> sums((triangles.size() + blockSize - 1) / blockSize);
  rhombic::ForEachBlock(triangles.size(), blockSize, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t n = begin; n < end; ++n)
    {
      sum += term(triangles[n]);
    }
    sums[begin / blockSize] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

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
ComputeTriangleSurfaceArea(const TriangleSurface & surface)
{
  const double twice = SumOverTriangles(surface, [&](const auto & triangle) {
    return Length(
      AreaVector({ Relative(surface, triangle[0]), Relative(surface, triangle[1]), Relative(surface, triangle[2]) }));
  });
  return twice / 2.0;
}

double
ComputeTriangleSurfaceBending(const TriangleSurface & surface)
{
  using Side = std::array<std::uint32_t, 3>; // two points, ascending, and the triangle
  const auto & triangles = surface.GetTriangles();
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t id = 0; id < triangles.size(); ++id)
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax(triangles[id][corner], triangles[id][(corner + 1) % 3]);
      sides.push_back({ low, high, id });
    }
  }
  std::sort(sides.begin(), sides.end());
  double bending = 0.0;
  for (auto begin = sides.cbegin(); begin != sides.cend();)
  {
    const auto & [low, high, id] = *begin;
    const auto end = std::find_if(
      begin, sides.cend(), [low = low, high = high](const Side & side) { return side[0] != low || side[1] != high; });
    if (end - begin == 2)
    {
      const PositionType first = AreaVector(CornersOf(surface, triangles[id]));
      const PositionType second = AreaVector(CornersOf(surface, triangles[(*(begin + 1))[2]]));
      const double angle = std::atan2(Length(Cross(first, second)), Dot(first, second));
      bending += angle * Length(Relative(surface, low, high));
    }
    begin = end;
  }
  const double area = ComputeTriangleSurfaceArea(surface);
  return area > 0.0 ? bending / area : 0.0;
}

double
ComputeTriangleSurfaceVolume(const TriangleSurface & surface)
{
  return SumOverTriangles(surface, [&](const auto & triangle) { return SixfoldVolume(surface, triangle); }) / 6.0;
}

std::array<double, 3>
ComputeTriangleSurfaceCentroid(const TriangleSurface & surface)
{
  double sixfold = 0.0;
  PositionType moment{};
  for (const auto & triangle : surface.GetTriangles())
  {
    const double weight = SixfoldVolume(surface, triangle);
    sixfold += weight;
    for (const std::uint32_t point : triangle)
    {
      const PositionType corner = Relative(surface, point);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        moment[axis] += weight * corner[axis] / 4.0; // the fourth corner is the origin
      }
    }
  }
  PositionType centroid{};
  for (unsigned int axis = 0; axis < 3 && sixfold != 0.0; ++axis)
  {
    centroid[axis] = surface.GetPoints().front()[axis] + moment[axis] / sixfold;
  }
  return centroid;
}

std::vector<double>
ComputeTriangleSurfaceComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  const std::vector<std::uint32_t> origins = FindTriangleSurfaceFirstPoints(components);
  std::vector<double> volumes(components.count, 0.0);
  for (const auto & triangle : surface.GetTriangles())
  {
    const std::uint32_t component = components.ofPoint[triangle[0]];
    volumes[component] += SixfoldVolume(surface, triangle, origins[component]) / 6.0;
  }
  return volumes;
}

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
