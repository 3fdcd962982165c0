#include "rhombicSurfaceErrors.h"

#include "detail/itkPositionArithmetic.h"

#include "rhombicForEachBlock.h"
#include "itkTriangleSurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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
constexpr std::size_t BlockSize = 256;

using itk::AreaVector;
using itk::CornersOf;
using itk::CornersType;
using itk::ToPosition;

Vector3
Centroid(const CornersType & corners)
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

/** A triangle in the box, and what is measured at it. */
struct JudgedTriangle
{
  itk::TriangleSurface::TriangleType ids;
  CornersType corners;
  double area;
  double quality;
  double facetNormalError;
  FieldProjection sides[3];
  FieldProjection centroid;
};

/** A distance in units, and its weight, an area. */
using WeightedDistance = std::pair<double, double>;

bool
IsInBox(const Vector3 & point, const SurfaceErrorSettings & settings)
{
  bool isInBox = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    isInBox = isInBox && point[axis] >= settings.lower[axis] && point[axis] <= settings.upper[axis];
  }
  return isInBox;
}

std::vector<JudgedTriangle>
SelectTriangles(const itk::TriangleSurface & surface, const SurfaceErrorSettings & settings)
{
  std::vector<JudgedTriangle> triangles;
  for (const auto & ids : surface.GetTriangles())
  {
    JudgedTriangle triangle{};
    triangle.ids = ids;
    triangle.corners = CornersOf(surface, ids);
    triangle.area = Length(AreaVector(triangle.corners)) / 2.0;
    if (IsInBox(Centroid(triangle.corners), settings))
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
              const FindNearest & findNearest)
{
  std::vector<FieldProjection> projections(pointAreas.size());
  ForEachInBlocks(projections.size(), BlockSize, [&](itk::SizeValueType point) {
    if (pointAreas[point] > 0.0)
    {
      projections[point] = findNearest(ToPosition(surface.GetPoints()[point]));
    }
  });
  return projections;
}

void
JudgeTriangles(std::vector<JudgedTriangle> & triangles, const FindNearest & findNearest)
{
  ForEachInBlocks(triangles.size(), BlockSize, [&](itk::SizeValueType n) {
    JudgedTriangle & triangle = triangles[n];
    const auto & [a, b, c] = triangle.corners;
    triangle.quality = itk::ComputeTriangleQuality(a, b, c);
    triangle.sides[0] = findNearest(Scaled(Add(a, b), 0.5));
    triangle.sides[1] = findNearest(Scaled(Add(b, c), 0.5));
    triangle.sides[2] = findNearest(Scaled(Add(c, a), 0.5));
    triangle.centroid = findNearest(Centroid(triangle.corners));
    triangle.facetNormalError = Angle(AreaVector(triangle.corners), triangle.centroid.normal);
  });
}

/** Sets all errors of distances and the area, from distances in units and their weights. */
void
SummariseDistances(std::vector<WeightedDistance> & distances, SurfaceErrors & errors)
{
  errors.area = 0.0;
  for (const auto & [distance, area] : distances)
  {
    errors.area += area;
    errors.meanDistance += distance * area;
    errors.rmsDistance += distance * distance * area;
    errors.maximumDistance = std::max(errors.maximumDistance, distance);
  }
  errors.meanDistance /= errors.area;
  errors.rmsDistance = std::sqrt(errors.rmsDistance / errors.area);

  std::sort(distances.begin(), distances.end());
  double fartherArea = 0.0;
  for (auto it = distances.rbegin(); it != distances.rend() && fartherArea <= 0.01 * errors.area; ++it)
  {
    errors.distance99 = it->first;
    fartherArea += it->second;
  }
}

/** The distances at seven points of each triangle, in units, with their weights. */
std::vector<WeightedDistance>
CollectDistances(const std::vector<JudgedTriangle> & triangles,
                 const std::vector<FieldProjection> & pointProjections,
                 double unit,
                 double & unresolvedArea)
{
  std::vector<WeightedDistance> distances;
  distances.reserve(7 * triangles.size());
  const auto add = [&](const FieldProjection & projection, double area) {
    if (area > 0.0)
    {
      distances.emplace_back(projection.distance / unit, area);
      unresolvedArea += projection.isResolved ? 0.0 : area;
    }
  };
  for (const JudgedTriangle & triangle : triangles)
  {
    for (unsigned int n = 0; n < 3; ++n)
    {
      add(pointProjections[triangle.ids[n]], cornerWeight * triangle.area);
      add(triangle.sides[n], sideWeight * triangle.area);
    }
    add(triangle.centroid, centroidWeight * triangle.area);
  }
  return distances;
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
      sum += pointAreas[point] * Angle(ToPosition(surface.GetNormals()[point]), pointProjections[point].normal);
    }
  }
  return sum / area;
}

/** For each point the sum of its triangles' normals, as long as their areas. */
std::vector<Vector3>
SumNormals(const itk::TriangleSurface & surface)
{
  std::vector<Vector3> normals(surface.GetNumberOfPoints());
  for (const auto & ids : surface.GetTriangles())
  {
    const Vector3 normal = AreaVector(CornersOf(surface, ids));
    for (const std::uint32_t id : ids)
    {
      normals[id] = Add(normals[id], normal);
    }
  }
  return normals;
}

} // namespace

FindNearest
NearestOnField(const ReferenceField & field, double unit)
{
  return [field, unit](const Vector3 & point) { return ProjectOntoField(field, point, unit); };
}

FindNearest
NearestOnMesh(const itk::TriangleTree & tree)
{
  return [&tree](const Vector3 & point) {
    FieldProjection projection;
    const auto closest = tree.FindClosestPoint(point);
    if (closest.triangle == itk::TriangleTree::None)
    {
      projection.distance = std::numeric_limits<double>::infinity();
      return projection;
    }
    const itk::TriangleSurface & surface = tree.GetSurface();
    const Vector3 normal = AreaVector(CornersOf(surface, surface.GetTriangles()[closest.triangle]));
    const double length = Length(normal);
    projection.point = closest.point;
    projection.distance = std::sqrt(closest.squaredDistance);
    projection.isResolved = true;
    if (length > 0.0)
    {
      projection.normal = { normal[0] / length, normal[1] / length, normal[2] / length };
    }
    return projection;
  };
}

SurfaceErrors
ComputeSurfaceErrors(const itk::TriangleSurface & surface,
                     const FindNearest & findNearest,
                     const SurfaceErrorSettings & settings)
{
  auto triangles = SelectTriangles(surface, settings);
  const auto pointAreas = SumPointAreas(triangles, surface.GetNumberOfPoints());
  const auto pointProjections = ProjectPoints(surface, pointAreas, findNearest);
  JudgeTriangles(triangles, findNearest);
  double unresolvedArea = 0.0;
  auto distances = CollectDistances(triangles, pointProjections, settings.unit, unresolvedArea);
  if (distances.empty())
  {
    return SurfaceErrors();
  }

  SurfaceErrors errors;
  SummariseDistances(distances, errors);
  errors.triangles = triangles.size();
  errors.unresolvedFraction = unresolvedArea / errors.area;
  double poor = 0.0;
  for (const JudgedTriangle & triangle : triangles)
  {
    errors.meanQuality += triangle.quality;
    errors.facetNormalError += triangle.facetNormalError * triangle.area;
    poor += triangle.quality < itk::TriangleSurfaceQuality::Poor ? 1.0 : 0.0;
  }
  errors.facetNormalError /= errors.area;
  errors.meanQuality /= static_cast<double>(errors.triangles);
  errors.poorFraction = poor / static_cast<double>(errors.triangles);
  errors.vertexNormalError = MeanVertexNormalError(surface, pointAreas, pointProjections, errors.area);
  errors.area /= settings.unit * settings.unit;
  return errors;
}

SurfaceErrors
ComputePointDistances(const itk::TriangleSurface & surface,
                      const FindNearest & findNearest,
                      const SurfaceErrorSettings & settings)
{
  const auto pointAreas = SumPointAreas(SelectTriangles(surface, settings), surface.GetNumberOfPoints());
  const auto projections = ProjectPoints(surface, pointAreas, findNearest);
  std::vector<WeightedDistance> distances;
  for (std::size_t point = 0; point < pointAreas.size(); ++point)
  {
    if (pointAreas[point] > 0.0)
    {
      distances.emplace_back(projections[point].distance / settings.unit, pointAreas[point]);
    }
  }
  SurfaceErrors errors;
  if (!distances.empty())
  {
    SummariseDistances(distances, errors);
    errors.area /= settings.unit * settings.unit;
  }
  return errors;
}

double
ComputeNormalPenalty(const itk::TriangleSurface & surface,
                     const itk::TriangleSurface & truth,
                     const SurfaceErrorSettings & settings)
{
  if (surface.GetTriangles().empty() || truth.GetTriangles().empty())
  {
    return 0.0;
  }
  const auto points = itk::TriangleSurface::New(); // those of the truth, each a triangle of one point
  points->Graft(&truth);
  points->RemoveUnusedPoints();
  const auto trueNormals = SumNormals(*points);
  points->GetTriangles().clear();
  for (std::uint32_t id = 0; id < points->GetNumberOfPoints(); ++id)
  {
    points->GetTriangles().push_back({ id, id, id });
  }
  const itk::TriangleTree tree(*points);
  const auto normals = SumNormals(surface);
  std::vector<std::uint32_t> judged;
  for (std::uint32_t point = 0; point < normals.size(); ++point)
  {
    if (IsInBox(ToPosition(surface.GetPoints()[point]), settings))
    {
      judged.push_back(point);
    }
  }
  std::vector<double> penalties(judged.size());
  ForEachInBlocks(judged.size(), BlockSize, [&](itk::SizeValueType n) {
    const std::uint32_t point = judged[n];
    const auto nearest = tree.FindClosestPoint(ToPosition(surface.GetPoints()[point])).triangle;
    const double product = Length(normals[point]) * Length(trueNormals[nearest]);
    const double cosine = product > 0.0 ? Dot(normals[point], trueNormals[nearest]) / product : 0.0;
    penalties[n] = 1.0 - std::clamp(cosine, 0.0, 1.0);
  });
  return judged.empty()
           ? 0.0
           : std::accumulate(penalties.begin(), penalties.end(), 0.0) / static_cast<double>(penalties.size());
}

} // namespace rhombic
