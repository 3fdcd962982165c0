#include "rhombicOcclusionLengths.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double Reach = 0.06;           // of the mean side of the box around the surfaces
constexpr double Detail = 0.6;           // of the triangles' mean edge
constexpr double MostDetail = 0.25;      // of the reach
constexpr std::size_t OneTriangleIn = 8; // is measured

double
MeanEdge(const Scene & scene)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const SceneSurface & item : scene.surfaces)
  {
    const auto & points = item.surface->GetPoints();
    const auto & triangles = item.surface->GetTriangles();
    for (std::size_t n = 0; n < triangles.size(); n += OneTriangleIn)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto & from = points[triangles[n][k]];
        const auto & to = points[triangles[n][(k + 1) % 3]];
        sum += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        ++count;
      }
    }
  }
  return sum / static_cast<double>(count);
}

} // namespace

OcclusionLengths
FindOcclusionLengths(const Scene & scene)
{
  if (scene.surfaces.empty())
  {
    return {};
  }
  const LPSBox box = BoxAround(scene.surfaces);
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    reach += Reach / 3.0 * (box.highest[axis] - box.lowest[axis]);
  }
  return { static_cast<float>(reach), static_cast<float>(std::min(Detail * MeanEdge(scene), MostDetail * reach)) };
}

} // namespace rhombic
