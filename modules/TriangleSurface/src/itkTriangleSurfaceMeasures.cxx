#include "itkTriangleSurfaceMeasures.h"

#include "detail/itkPositionArithmetic.h"

#include <cmath>

namespace itk
{
namespace
{

/** From the surface's first point, or a component's, so that a volume far from there does not drown in cancellation. */
PositionType
Relative(const TriangleSurface & surface, std::uint32_t point, std::uint32_t origin = 0)
{
  return Subtract(ToPosition(surface.GetPoints()[point]), ToPosition(surface.GetPoints()[origin]));
}

/** Six times the signed volume of the tetrahedron of a triangle and a point of the surface. */
double
SixfoldVolume(const TriangleSurface & surface, const TriangleSurface::TriangleType & triangle, std::uint32_t origin = 0)
{
  return Dot(Relative(surface, triangle[0], origin),
             Cross(Relative(surface, triangle[1], origin), Relative(surface, triangle[2], origin)));
}

} // namespace

double
ComputeArea(const TriangleSurface & surface)
{
  double twice = 0.0;
  for (const auto & triangle : surface.GetTriangles())
  {
    const PositionType a = Relative(surface, triangle[0]);
    const PositionType normal =
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
  PositionType moment{};
  for (const auto & triangle : surface.GetTriangles())
  {
    const double part = SixfoldVolume(surface, triangle); // of a tetrahedron whose fourth corner is the origin
    sixfold += part;
    for (const std::uint32_t point : triangle)
    {
      const PositionType corner = Relative(surface, point);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        moment[axis] += part * corner[axis] / 4.0;
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
ComputeComponentVolumes(const TriangleSurface & surface, const TriangleSurfaceComponents & components)
{
  const std::vector<std::uint32_t> origins = FindFirstPoints(components);
  std::vector<double> volumes(components.count, 0.0);
  for (const auto & triangle : surface.GetTriangles())
  {
    const std::uint32_t component = components.ofPoint[triangle[0]];
    volumes[component] += SixfoldVolume(surface, triangle, origins[component]) / 6.0;
  }
  return volumes;
}

} // namespace itk
