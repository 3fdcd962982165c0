#include "itkTriangleSurfaceMeasures.h"

#include <cmath>

namespace itk
{
namespace
{

using Vector3 = std::array<double, 3>;

/** From the surface's first point, so that a volume far from the world's origin does not drown in cancellation. */
Vector3
Relative(const TriangleSurface & surface, std::uint32_t point)
{
  const auto & origin = surface.GetPoints().front();
  const auto & position = surface.GetPoints()[point];
  return { static_cast<double>(position[0]) - origin[0],
           static_cast<double>(position[1]) - origin[1],
           static_cast<double>(position[2]) - origin[2] };
}

Vector3
Subtract(const Vector3 & a, const Vector3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector3
Cross(const Vector3 & a, const Vector3 & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Six times the signed volume of the tetrahedron of a triangle and the surface's first point. */
double
SixfoldVolume(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle)
{
  return Dot(Relative(surface, triangle[0]), Cross(Relative(surface, triangle[1]), Relative(surface, triangle[2])));
}

} // namespace

double
ComputeArea(const TriangleSurface & surface)
{
  double twice = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const Vector3 a = Relative(surface, triangle[0]);
    const Vector3 normal =
      Cross(Subtract(Relative(surface, triangle[1]), a), Subtract(Relative(surface, triangle[2]), a));
    twice += std::sqrt(Dot(normal, normal));
  }
  return twice / 2.0;
}

double
ComputeVolume(const TriangleSurface & surface)
{
  double sixfold = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    sixfold += SixfoldVolume(surface, triangle);
  }
  return sixfold / 6.0;
}

std::array<double, 3>
ComputeCentroid(const TriangleSurface & surface)
{
  double sixfold = 0.0;
  Vector3 moment{};
  for (const auto & triangle : surface.GetTriangles())
  {
    const double part = SixfoldVolume(surface, triangle); // of a tetrahedron whose fourth corner is the origin
    sixfold += part;
    for (const std::uint32_t point : triangle)
    {
      const Vector3 corner = Relative(surface, point);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        moment[axis] += part * corner[axis] / 4.0;
      }
    }
  }
  Vector3 centroid{};
  for (unsigned int axis = 0; axis < 3 && sixfold != 0.0; ++axis)
  {
    centroid[axis] = surface.GetPoints().front()[axis] + moment[axis] / sixfold;
  }
  return centroid;
}

std::vector<double>
ComputeComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  std::vector<double> volumes(components.count, 0.0);
  for (const auto & triangle : surface.GetTriangles())
  {
    volumes[components.ofPoint[triangle[0]]] += SixfoldVolume(surface, triangle) / 6.0;
  }
  return volumes;
}

} // namespace itk
