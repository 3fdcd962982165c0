#include "rhombicSeenNumbers.h"

#include "rhombicHiding.h"

#include <cmath>
#include <limits>
#include <vector>

namespace rhombic
{
namespace
{

constexpr float Never = std::numeric_limits<float>::infinity(); // depth of rays that meet nothing

/** Where rays meet the opaque parts of the scene's planes first: slices and cut faces. */
std::vector<float>
FindPlaneDepths(const Scene & scene, const Projection & rays)
{
  std::vector<float> depths(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height), Never);
  for (const ScenePlane & plane : scene.planes)
  {
    const Vector3 & normal = plane.projection.frame.look;
    const double slope = Dot(rays.frame.look, normal);
    constexpr double edgeOn = 1e-6;
    for (std::size_t ray = 0; std::abs(slope) > edgeOn && ray < depths.size(); ++ray)
    {
      const auto width = static_cast<std::size_t>(rays.width);
      const Vector3 start =
        rays.PointAt({ static_cast<double>(ray % width) + 0.5, static_cast<double>(ray / width) + 0.5 });
      const double depth = Dot(Subtract(plane.projection.centre, start), normal) / slope;
      const PicturePosition position = plane.projection.PositionOf(Along(start, rays.frame.look, depth));
      const bool isInside =
        position.x >= 0.0 && position.x < plane.picture.width && position.y >= 0.0 && position.y < plane.picture.height;
      constexpr int half = 128;
      if (isInside && (plane.picture.channels < 4 ||
                       plane.picture.At(static_cast<int>(position.x), static_cast<int>(position.y))[3] >= half))
      {
        depths[ray] = std::min(depths[ray], static_cast<float>(depth));
      }
    }
  }
  return depths;
}

/** The surface with only those triangles that face the viewer, or only the others. */
SceneSurface
SideOfSurface(const SceneSurface & item, const Vector3 & look, bool facesViewer)
{
  const auto & points = item.surface->GetPoints();
  const auto side = itk::TriangleSurface::New();
  side->GetPoints() = points;
  for (const auto & triangle : item.surface->GetTriangles())
  {
    const auto corner = [&](std::size_t n) {
      const auto & point = points[triangle[n]];
      return Vector3{ point[0], point[1], point[2] };
    };
    const Vector3 normal = Cross(Subtract(corner(1), corner(0)), Subtract(corner(2), corner(0)));
    if ((Dot(normal, look) < 0.0) == facesViewer)
    {
      side->GetTriangles().push_back(triangle);
    }
  }
  SceneSurface part = item;
  part.surface = side;
  return part;
}

/** Gives the rays that end on planes the innermost surface that they are inside of there, which they leave first. */
void
FindNumbersOnPlanes(const Scene & scene,
                    const Projection & rays,
                    const std::vector<float> & planes,
                    const std::vector<float> & nearest,
                    SeenNumbers & seen)
{
  constexpr float tolerance = 0.05f; // mm
  std::vector<float> exits(planes.size(), Never);
  const auto isOnPlane = [&](std::size_t ray) {
    return planes[ray] < Never && nearest[ray] >= planes[ray] - tolerance;
  };
  for (std::size_t ray = 0; ray < planes.size(); ++ray)
  {
    seen.numbers[ray] = isOnPlane(ray) ? SeenNumbers::None : seen.numbers[ray];
  }
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    const auto depthsOf = [&](bool facesViewer) {
      return FindDepths(SideOfSurface(scene.surfaces[n], rays.frame.look, facesViewer), scene.cuts, rays);
    };
    const std::vector<float> entries = depthsOf(true);
    const std::vector<float> leaves = depthsOf(false);
    for (std::size_t ray = 0; ray < planes.size(); ++ray)
    {
      const bool isInside = leaves[ray] < entries[ray] && leaves[ray] > planes[ray] - tolerance;
      if (isOnPlane(ray) && isInside && leaves[ray] < exits[ray])
      {
        exits[ray] = leaves[ray];
        seen.numbers[ray] = n;
      }
    }
  }
}

} // namespace

SeenNumbers
FindSeenNumbers(const Scene & scene, const Projection & rays)
{
  SeenNumbers seen{ rays.width, rays.height, {} };
  const auto count = static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height);
  seen.numbers.assign(count, SeenNumbers::None);
  std::vector<float> nearest(count, Never); // of opaque surfaces
  std::vector<float> last(count, -Never);   // where translucent surfaces begin
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    const bool isOpaque = scene.surfaces[n].opacity >= 1.0;
    const std::vector<float> depths = FindDepths(scene.surfaces[n], scene.cuts, rays);
    for (std::size_t ray = 0; ray < count; ++ray)
    {
      const bool isMet = depths[ray] < Never;
      if (isOpaque && depths[ray] < nearest[ray])
      {
        nearest[ray] = depths[ray];
        seen.numbers[ray] = n;
      }
      else if (!isOpaque && isMet && depths[ray] > last[ray] && !(nearest[ray] < Never))
      {
        last[ray] = depths[ray];
        seen.numbers[ray] = n;
      }
    }
  }
  if (!scene.planes.empty())
  {
    FindNumbersOnPlanes(scene, rays, FindPlaneDepths(scene, rays), nearest, seen);
  }
  return seen;
}

} // namespace rhombic
