#include "rhombicSurfaceErrors.h"

#include "detail/itkPositionArithmetic.h"

#include "rhombicFieldProjection.h"

#include "itkForEachBlock.h"
#include "itkTriangleSurfaceQuality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rhombic
{

using itk::Cross;
using itk::Dot;
using itk::Length;
using itk::Subtract;

namespace
{

constexpr double degreesPerRadian = 57.29577951308232;
constexpr double cornerWeight = 1.0 / 20.0;
constexpr double sideWeight = 2.0 / 15.0;
constexpr double centroidWeight = 9.0 / 20.0;
constexpr std::size_t BlockSize = 256;

/** The corners of a triangle. */
using Corners = std::array<Vector3, 3>;

/** A normal as long as twice the triangle's area, towards the side from which the corners are counter-clockwise. */
Vector3
AreaVector(const Corners & corners)
{
  return Cross(Subtract(corners[1], corners[0]), Subtract(corners[2], corners[0]));
}

Vector3
Middle(const Vector3 & a, const Vector3 & b)
{
  return { (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0 };
}

Vector3
Centroid(const Corners & corners)
{
  const auto & [a, b, c] = corners;
  return { (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 };
}

/** In degrees. Accurate for small angles too. */
double
Angle(const Vector3 & a, const Vector3 & b)
{
  return degreesPerRadian * std::atan2(Length(Cross(a, b)), Dot(a, b));
}

Vector3
ToVector(const std::array<float, 3> & values)
{
  return { values[0], values[1], values[2] };
}

/** A triangle in the box, and what is measured at it. */
struct JudgedTriangle
{
  itk::TriangleSurface::TriangleType ids;
  Corners corners;
  double area;
  double quality;
  double facetNormalError;
  FieldProjection sides[3];
  FieldProjection centroid;
};

/** A distance in units, and its weight, an area. */
using Distance = std::pair<double, double>;

std::vector<JudgedTriangle>
SelectTriangles(const itk::TriangleSurface & surface, const SurfaceErrorSettings & settings)
{
  std::vector<JudgedTriangle> triangles;
  for (const auto & ids : surface.GetTriangles())
  {
    JudgedTriangle triangle{};
    triangle.ids = ids;
    std::transform(ids.begin(), ids.end(), triangle.corners.begin(), [&](std::uint32_t id) {
      return ToVector(surface.GetPoints()[id]);
    });
    triangle.area = Length(AreaVector(triangle.corners)) / 2.0;
    const Vector3 centroid = Centroid(triangle.corners);
    bool isInBox = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isInBox = isInBox && centroid[axis] >= settings.lower[axis] && centroid[axis] <= settings.upper[axis];
    }
    if (isInBox)
    {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/** A third of the area of the judged triangles around each point. */
std::vector<double>
SumPointAreas(const std::vector<JudgedTriangle> & triangles, std::size_t numberOfPoints)
{
  std::vector<double> areas(numberOfPoints);
  for (const JudgedTriangle & triangle : triangles)
  {
    for (const std::uint32_t id : triangle.ids)
    {
      areas[id] += triangle.area / 3.0;
    }
  }
  return areas;
}

/** Projects the points of judged triangles. */
std::vector<FieldProjection>
ProjectPoints(const itk::TriangleSurface & surface,
              const std::vector<double> & pointAreas,
              const ReferenceField & field,
              double unit)
{
  std::vector<FieldProjection> projections(pointAreas.size());
  itk::ForEachInBlocks(projections.size(), BlockSize, [&](itk::SizeValueType point) {
    if (pointAreas[point] > 0.0)
    {
      projections[point] = ProjectOntoField(field, ToVector(surface.GetPoints()[point]), unit);
    }
  });
  return projections;
}

void
JudgeTriangles(std::vector<JudgedTriangle> & triangles, const ReferenceField & field, double unit)
{
  itk::ForEachInBlocks(triangles.size(), BlockSize, [&](itk::SizeValueType n) {
    JudgedTriangle & triangle = triangles[n];
    const auto & [a, b, c] = triangle.corners;
    triangle.quality = itk::ComputeTriangleQuality(a, b, c);
    triangle.sides[0] = ProjectOntoField(field, Middle(a, b), unit);
    triangle.sides[1] = ProjectOntoField(field, Middle(b, c), unit);
    triangle.sides[2] = ProjectOntoField(field, Middle(c, a), unit);
    triangle.centroid = ProjectOntoField(field, Centroid(triangle.corners), unit);
    triangle.facetNormalError = Angle(AreaVector(triangle.corners), triangle.centroid.normal);
  });
}

/** Sets all errors of distances. */
void
SummariseDistances(const std::vector<JudgedTriangle> & triangles,
                   const std::vector<double> & pointAreas,
                   const std::vector<FieldProjection> & pointProjections,
                   double unit,
                   SurfaceErrors & errors)
{
  std::vector<Distance> distances;
  distances.reserve(7 * triangles.size());
  double unresolvedArea = 0.0;
  const auto add = [&](const FieldProjection & projection, double area) {
    const double distance = projection.distance / unit;
    errors.meanDistance += distance * area;
    errors.rmsDistance += distance * distance * area;
    errors.maximumDistance = std::max(errors.maximumDistance, distance);
    unresolvedArea += projection.isResolved ? 0.0 : area;
    distances.emplace_back(distance, area);
  };
  for (const JudgedTriangle & triangle : triangles)
  {
    for (unsigned int n = 0; n < 3; ++n)
    {
      if (pointAreas[triangle.ids[n]] > 0.0)
      {
        add(pointProjections[triangle.ids[n]], cornerWeight * triangle.area);
      }
      add(triangle.sides[n], sideWeight * triangle.area);
    }
    add(triangle.centroid, centroidWeight * triangle.area);
  }
  errors.meanDistance /= errors.area;
  errors.rmsDistance = std::sqrt(errors.rmsDistance / errors.area);
  errors.unresolvedFraction = unresolvedArea / errors.area;

  std::sort(distances.begin(), distances.end());
  double fartherArea = 0.0;
  for (auto it = distances.rbegin(); it != distances.rend() && fartherArea <= 0.01 * errors.area; ++it)
  {
    errors.distance99 = it->first;
    fartherArea += it->second;
  }
}

/** Not a number if the surface has no normals. */
double
MeanVertexNormalError(const itk::TriangleSurface & surface,
                      const std::vector<double> & pointAreas,
                      const std::vector<FieldProjection> & pointProjections,
                      double area)
{
  if (!surface.HasNormals())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double sum = 0.0;
  for (std::size_t point = 0; point < pointAreas.size(); ++point)
  {
    if (pointAreas[point] > 0.0)
    {
      sum += pointAreas[point] * Angle(ToVector(surface.GetNormals()[point]), pointProjections[point].normal);
    }
  }
  return sum / area;
}

} // namespace

SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const ReferenceField & field,
                     const SurfaceErrorSettings & settings)
{
  auto triangles = SelectTriangles(surface, settings);
  const auto pointAreas = SumPointAreas(triangles, surface.GetNumberOfPoints());
  const auto pointProjections = ProjectPoints(surface, pointAreas, field, settings.unit);
  JudgeTriangles(triangles, field, settings.unit);

  SurfaceErrors errors;
  errors.triangles = triangles.size();
  double poor = 0.0;
  for (const JudgedTriangle & triangle : triangles)
  {
    errors.area += triangle.area;
    errors.meanQuality += triangle.quality;
    errors.facetNormalError += triangle.facetNormalError * triangle.area;
    poor += triangle.quality < itk::TriangleSurfaceQuality::Poor ? 1.0 : 0.0;
  }
  if (!(errors.area > 0.0))
  {
    return SurfaceErrors();
  }
  errors.facetNormalError /= errors.area;
  errors.meanQuality /= static_cast<double>(errors.triangles);
  errors.poorFraction = poor / static_cast<double>(errors.triangles);
  SummariseDistances(triangles, pointAreas, pointProjections, settings.unit, errors);
  errors.vertexNormalError = MeanVertexNormalError(surface, pointAreas, pointProjections, errors.area);
  errors.area /= settings.unit * settings.unit;
  return errors;
}

} // namespace rhombic
