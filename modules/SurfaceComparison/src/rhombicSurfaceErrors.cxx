#include "rhombicSurfaceErrors.h"

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
namespace
{

constexpr double degreesPerRadian = 57.29577951308232;
constexpr double cornerWeight = 1.0 / 20.0;
constexpr double sideWeight = 2.0 / 15.0;
constexpr double centroidWeight = 9.0 / 20.0;

Vector3
Difference(const Vector3 & a, const Vector3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3
Cross(const Vector3 & a, const Vector3 & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/** Twice the area, pointing to where the corners are seen counter-clockwise. */
Vector3
AreaVector(const Vector3 & a, const Vector3 & b, const Vector3 & c)
{
  return Cross(Difference(b, a), Difference(c, a));
}

Vector3
Middle(const Vector3 & a, const Vector3 & b)
{
  return { (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0 };
}

/** In degrees. Accurate for small angles too. */
double
Angle(const Vector3 & a, const Vector3 & b)
{
  const Vector3 cross = Cross(a, b);
  return degreesPerRadian * std::atan2(std::sqrt(Dot(cross, cross)), Dot(a, b));
}

Vector3
ToVector(const std::array<float, 3> & values)
{
  return { values[0], values[1], values[2] };
}

/** One triangle that is judged. */
struct Judged
{
  itk::TriangleSurface::TriangleType corners;
  double area;
  double quality;
  double facetNormalError;
  FieldProjection sides[3];
  FieldProjection centroid;
};

constexpr std::size_t BlockSize = 256;

} // namespace

SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const ReferenceField & field,
                     const SurfaceErrorSettings & settings)
{
  const auto & points = surface.GetPoints();
  const auto position = [&points](std::uint32_t id) { return ToVector(points[id]); };

  std::vector<Judged> triangles;
  std::vector<double> pointWeights(points.size()); // a third of the area around a point; 0 where nothing is judged
  for (const auto & corners : surface.GetTriangles())
  {
    const Vector3 a = position(corners[0]);
    const Vector3 b = position(corners[1]);
    const Vector3 c = position(corners[2]);
    bool isJudged = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double centroid = (a[axis] + b[axis] + c[axis]) / 3.0;
      isJudged = isJudged && centroid >= settings.lower[axis] && centroid <= settings.upper[axis];
    }
    if (isJudged)
    {
      const Vector3 area = AreaVector(a, b, c);
      Judged judged{};
      judged.corners = corners;
      judged.area = std::sqrt(Dot(area, area)) / 2.0;
      for (const std::uint32_t corner : corners)
      {
        pointWeights[corner] += judged.area / 3.0;
      }
      triangles.push_back(judged);
    }
  }

  std::vector<FieldProjection> projections(points.size());
  itk::ForEachInBlocks(points.size(), BlockSize, [&](itk::SizeValueType i) {
    if (pointWeights[i] > 0.0)
    {
      projections[i] = ProjectOntoField(field, ToVector(points[i]), settings.unit);
    }
  });
  itk::ForEachInBlocks(triangles.size(), BlockSize, [&](itk::SizeValueType i) {
    Judged & judged = triangles[i];
    const Vector3 a = position(judged.corners[0]);
    const Vector3 b = position(judged.corners[1]);
    const Vector3 c = position(judged.corners[2]);
    judged.quality = itk::ComputeTriangleQuality(a, b, c);
    judged.sides[0] = ProjectOntoField(field, Middle(a, b), settings.unit);
    judged.sides[1] = ProjectOntoField(field, Middle(b, c), settings.unit);
    judged.sides[2] = ProjectOntoField(field, Middle(c, a), settings.unit);
    judged.centroid = ProjectOntoField(
      field, { (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 }, settings.unit);
    judged.facetNormalError = Angle(AreaVector(a, b, c), judged.centroid.normal);
  });

  SurfaceErrors errors;
  errors.triangles = triangles.size();
  std::vector<std::pair<double, double>> distances; // with the area they stand for
  distances.reserve(7 * triangles.size());
  double unresolvedArea = 0.0;
  const auto add = [&](const FieldProjection & projection, double area) {
    const double distance = projection.distance / settings.unit;
    errors.meanDistance += distance * area;
    errors.rmsDistance += distance * distance * area;
    errors.maximumDistance = std::max(errors.maximumDistance, distance);
    unresolvedArea += projection.isResolved ? 0.0 : area;
    distances.emplace_back(distance, area);
  };
  itk::SizeValueType poor = 0;
  for (const Judged & judged : triangles)
  {
    errors.area += judged.area;
    errors.meanQuality += judged.quality;
    poor += judged.quality < itk::TriangleSurfaceQuality::Poor ? 1 : 0;
    errors.facetNormalError += judged.facetNormalError * judged.area;
    for (unsigned int i = 0; i < 3; ++i)
    {
      if (pointWeights[judged.corners[i]] > 0.0)
      {
        add(projections[judged.corners[i]], cornerWeight * judged.area);
      }
      add(judged.sides[i], sideWeight * judged.area);
    }
    add(judged.centroid, centroidWeight * judged.area);
  }
  if (!(errors.area > 0.0))
  {
    return SurfaceErrors();
  }

  errors.meanDistance /= errors.area;
  errors.rmsDistance = std::sqrt(errors.rmsDistance / errors.area);
  errors.facetNormalError /= errors.area;
  errors.meanQuality /= static_cast<double>(errors.triangles);
  errors.poorFraction = static_cast<double>(poor) / static_cast<double>(errors.triangles);
  errors.unresolvedFraction = unresolvedArea / errors.area;

  std::sort(distances.begin(), distances.end());
  double farther = 0.0;
  for (auto it = distances.rbegin(); it != distances.rend() && farther <= 0.01 * errors.area; ++it)
  {
    errors.distance99 = it->first;
    farther += it->second;
  }

  errors.vertexNormalError = std::numeric_limits<double>::quiet_NaN();
  if (surface.HasNormals())
  {
    double sum = 0.0;
    for (itk::SizeValueType i = 0; i < points.size(); ++i)
    {
      if (pointWeights[i] > 0.0)
      {
        sum += pointWeights[i] * Angle(ToVector(surface.GetNormals()[i]), projections[i].normal);
      }
    }
    errors.vertexNormalError = sum / errors.area;
  }
  errors.area /= settings.unit * settings.unit;
  return errors;
}

} // namespace rhombic
