#include "itkTriangleSurfaceForRendering.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTrianglesOfPoints.h"
#include "rhombicForEachBlock.h"
#include "rhombicSparseBulk.h"
#include "itkMath.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace itk
{
namespace
{

using PointId = std::uint32_t;

constexpr SizeValueType NormalsBlock = 4096;
constexpr unsigned int Passes = 6;
constexpr double AngleOfNone = 4.0; // degrees
constexpr double AngleOfAll = 8.0;  // degrees
constexpr double RatioOfNone = 0.6;
constexpr double RatioOfAll = 0.9;

/** Working memory of meshoptimizer. */
void *
AllocateForOptimizer(std::size_t bytes)
{
  return rhombic::AllocateSparseBulk(bytes, false);
}

/** Set once, before anything can be allocated; in temporary files then, where a surface is. */
[[maybe_unused]] const bool IsOptimizerInBulk = (meshopt_setAllocator(AllocateForOptimizer, rhombic::FreeBulk), true);

/** Quantities that are averaged over the neighbourhood of a point. */
struct NormalSample
{
  PositionType normal{};     ///< of the surface, times area
  PositionType areaVector{}; ///< of the triangles
  double area = 0.0;         ///< of the triangles
  double disagreement = 0.0; ///< 1 - cosine of the angle between triangles and normals, times area
};

/** The vector of length 1, or 0. */
PositionType
Normalized(const PositionType & a)
{
  const double length = Length(a);
  return length > 0.0 ? Scaled(a, 1.0 / length) : PositionType{};
}

NormalSample
SampleAt(const TriangleSurface & surface, const TrianglesOfPoints & fans, SizeValueType point)
{
  const auto & normals = surface.GetNormals();
  NormalSample sample;
  fans.VisitTriangles(point, [&](std::uint32_t id) {
    const auto & triangle = surface.GetTriangles()[id];
    const PositionType areaVector = AreaVector(CornersOf(surface, triangle));
    const PositionType mean = Normalized(
      Add(Add(ToPosition(normals[triangle[0]]), ToPosition(normals[triangle[1]])), ToPosition(normals[triangle[2]])));
    const double length = Length(areaVector);
    sample.areaVector = Add(sample.areaVector, areaVector);
    sample.area += length;
    sample.disagreement += length - Dot(areaVector, mean);
  });
  sample.normal = Scaled(ToPosition(normals[point]), sample.area);
  return sample;
}

NormalSample
SumWithNeighbours(const BulkVector<NormalSample> & samples, const TrianglesOfPoints & fans, SizeValueType point)
{
  NormalSample sum = samples[point];
  fans.VisitNeighbours(point, [&](PointId next, PointId) {
    sum.normal = Add(sum.normal, samples[next].normal);
    sum.areaVector = Add(sum.areaVector, samples[next].areaVector);
    sum.area += samples[next].area;
    sum.disagreement += samples[next].disagreement;
  });
  return sum;
}

double
ShareBetween(double value, double none, double all)
{
  return std::clamp((value - none) / (all - none), 0.0, 1.0);
}

/** How much of the sum of normals counts. */
double
ShareOf(const NormalSample & sum)
{
  const double spread = sum.area - Length(sum.normal);
  if (!(sum.disagreement > 0.0))
  {
    return 0.0;
  }
  const double angle = std::sqrt(2.0 * sum.disagreement / sum.area) * 180.0 / Math::pi;
  const double ratio = spread > 0.0 ? std::sqrt(sum.disagreement / spread) : RatioOfAll;
  return ShareBetween(angle, AngleOfNone, AngleOfAll) * ShareBetween(ratio, RatioOfNone, RatioOfAll);
}

template <typename TContainer>
void
Reorder(TContainer & container, const BulkVector<unsigned int> & newIds, std::size_t newSize)
{
  TContainer ordered(newSize);
  meshopt_remapVertexBuffer(
    ordered.data(), container.data(), container.size(), sizeof(typename TContainer::value_type), newIds.data());
  container.swap(ordered);
}

} // namespace

void
SmoothTriangleSurfaceNormals(TriangleSurface & surface)
{
  if (!surface.HasNormals())
  {
    return;
  }
  const TrianglesOfPoints fans(surface);
  BulkVector<NormalSample> samples(surface.GetNumberOfPoints());
  BulkVector<NormalSample> next(samples.size());
  rhombic::ForEachInBlocks(
    samples.size(), NormalsBlock, [&](SizeValueType point) { samples[point] = SampleAt(surface, fans, point); });
  for (unsigned int pass = 0; pass < Passes; ++pass)
  {
    rhombic::ForEachInBlocks(samples.size(), NormalsBlock, [&](SizeValueType point) {
      next[point] = SumWithNeighbours(samples, fans, point);
    });
    samples.swap(next);
  }
  auto & normals = surface.GetNormals();
  rhombic::ForEachInBlocks(samples.size(), NormalsBlock, [&](SizeValueType point) {
    const double share = ShareOf(samples[point]);
    auto & normal = normals[point];
    const PositionType smooth = Normalized(Add(samples[point].normal, samples[point].areaVector));
    const PositionType blend = Normalized(Add(Scaled(ToPosition(normal), 1.0 - share), Scaled(smooth, share)));
    if (share > 0.0 && Length(blend) > 0.0)
    {
      normal = ToPoint(blend);
    }
  });
  surface.Modified();
}

void
OptimizeTriangleSurfaceForRendering(TriangleSurface & surface)
{
  if (surface.GetTriangles().empty())
  {
    surface.RemoveUnusedPoints();
    return;
  }
  const std::size_t numberOfPoints = surface.GetNumberOfPoints();
  const std::size_t numberOfIndices = 3 * surface.GetNumberOfTriangles();
  TriangleSurface::TrianglesContainer triangles(surface.GetNumberOfTriangles());
  unsigned int * const indices = triangles.front().data();
  meshopt_optimizeVertexCache(indices, surface.GetTriangles().front().data(), numberOfIndices, numberOfPoints);

  BulkVector<unsigned int> newIds(numberOfPoints);
  const std::size_t used = meshopt_optimizeVertexFetchRemap(newIds.data(), indices, numberOfIndices, numberOfPoints);
  meshopt_remapIndexBuffer(indices, indices, numberOfIndices, newIds.data());
  if (surface.HasNormals())
  {
    Reorder(surface.GetNormals(), newIds, used);
  }
  Reorder(surface.GetPoints(), newIds, used);
  surface.GetTriangles().swap(triangles);
  surface.Modified();
}

TriangleSurface::TrianglesContainer
SimplifySheetForRendering(const TriangleSurface::PointsContainer & points,
                          const TriangleSurface::TrianglesContainer & triangles,
                          double distance,
                          SizeValueType least)
{
  if (triangles.empty())
  {
    return {};
  }
  PointId first = triangles.front()[0];
  PointId last = first;
  for (const auto & triangle : triangles)
  {
    const auto [lowest, highest] = std::minmax_element(triangle.begin(), triangle.end());
    first = std::min(first, *lowest);
    last = std::max(last, *highest);
  }
  constexpr PointId none = std::numeric_limits<PointId>::max();
  BulkVector<PointId> numbers(last - first + 1, none); // of the sheet's points, ascending
  for (const auto & triangle : triangles)
  {
    for (const PointId point : triangle)
    {
      numbers[point - first] = 0;
    }
  }
  BulkVector<PointId> ids;
  TriangleSurface::PointsContainer places; // from the first, which keeps digits
  const PositionType origin = ToPosition(points[first]);
  for (PointId & number : numbers)
  {
    if (number != none)
    {
      number = static_cast<PointId>(ids.size());
      ids.push_back(first + static_cast<PointId>(&number - numbers.data()));
      places.push_back(ToPoint(Subtract(ToPosition(points[ids.back()]), origin)));
    }
  }
  BulkVector<PointId> corners;
  corners.reserve(3 * triangles.size());
  for (const auto & triangle : triangles)
  {
    for (const PointId point : triangle)
    {
      corners.push_back(numbers[point - first]);
    }
  }
  constexpr std::size_t bytes = sizeof(TriangleSurface::PointType);
  const float * const coordinates = places.front().data();
  const float scale = meshopt_simplifyScale(coordinates, places.size(), bytes);
  TriangleSurface::TrianglesContainer fewer(triangles.size());
  const std::size_t size = meshopt_simplify(fewer.front().data(),
                                            corners.data(),
                                            corners.size(),
                                            coordinates,
                                            places.size(),
                                            bytes,
                                            3 * least,
                                            static_cast<float>(distance) / scale,
                                            meshopt_SimplifyLockBorder,
                                            nullptr);
  fewer.resize(size / 3);
  for (auto & triangle : fewer)
  {
    for (PointId & point : triangle)
    {
      point = ids[point];
    }
  }
  return fewer;
}

} // namespace itk
