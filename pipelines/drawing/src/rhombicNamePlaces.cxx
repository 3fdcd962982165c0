#include "rhombicNamePlaces.h"

#include "rhombicHiding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int RaysAlongLongerSide = 600;
constexpr float Infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t NoSurface = std::numeric_limits<std::size_t>::max();
constexpr int SideStep = 3; // distances between pixels: 3 for each side, 4 for each corner (chamfer)
constexpr int CornerStep = 4;
constexpr int RoomForDot = 2 * SideStep; // three pixels wide

/** The number of a surface for each ray. */
struct SeenNumbers
{
  int width = 0;
  int height = 0;
  std::vector<std::size_t> numbers;

  std::size_t
  At(int x, int y) const
  {
    const bool isInside = x >= 0 && x < width && y >= 0 && y < height;
    return isInside ? numbers[this->IndexOf(x, y)] : NoSurface;
  }
  std::size_t
  IndexOf(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

Projection
RaysOf(Projection picture)
{
  const double scale = static_cast<double>(RaysAlongLongerSide) / std::max({ picture.width, picture.height, 1 });
  picture.pixelSize /= scale;
  picture.width = std::max(1, static_cast<int>(std::lround(scale * picture.width)));
  picture.height = std::max(1, static_cast<int>(std::lround(scale * picture.height)));
  return picture;
}

/** Where rays meet the opaque parts of the scene's planes first: slices and cut faces. */
std::vector<float>
FindPlaneDepths(const Scene & scene, const Projection & rays)
{
  std::vector<float> depths(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height), Infinity);
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
  std::vector<float> exits(planes.size(), Infinity);
  const auto isOnPlane = [&](std::size_t ray) {
    return planes[ray] < Infinity && nearest[ray] >= planes[ray] - tolerance;
  };
  for (std::size_t ray = 0; ray < planes.size(); ++ray)
  {
    seen.numbers[ray] = isOnPlane(ray) ? NoSurface : seen.numbers[ray];
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

SeenNumbers
FindSeenNumbers(const Scene & scene, const Projection & rays)
{
  SeenNumbers seen{ rays.width, rays.height, {} };
  const auto count = static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height);
  seen.numbers.assign(count, NoSurface);
  std::vector<float> nearest(count, Infinity); // of opaque surfaces
  std::vector<float> last(count, -Infinity);   // where translucent surfaces begin
  for (std::size_t n = 0; n < scene.surfaces.size(); ++n)
  {
    const bool isOpaque = scene.surfaces[n].opacity >= 1.0;
    const std::vector<float> depths = FindDepths(scene.surfaces[n], scene.cuts, rays);
    for (std::size_t ray = 0; ray < count; ++ray)
    {
      const bool isMet = depths[ray] < Infinity;
      if (isOpaque && depths[ray] < nearest[ray])
      {
        nearest[ray] = depths[ray];
        seen.numbers[ray] = n;
      }
      else if (!isOpaque && isMet && depths[ray] > last[ray] && !(nearest[ray] < Infinity))
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

/** For each ray, the distance to the nearest one of another number or outside of the picture. */
std::vector<int>
FindDistances(const SeenNumbers & seen)
{
  std::vector<int> distances(seen.numbers.size(), std::numeric_limits<int>::max());
  const auto visit = [&](int x, int y, int step) { // rays in the rows before, and in this row, as seen from the step
    const std::size_t here = seen.IndexOf(x, y);
    const auto take = [&](int dx, int dy, int far) {
      const int rest = seen.At(x + dx, y + dy) == seen.numbers[here] && seen.At(x + dx, y + dy) != NoSurface
                         ? distances[seen.IndexOf(x + dx, y + dy)]
                         : 0;
      distances[here] = std::min(distances[here], rest + far);
    };
    take(-step, 0, SideStep);
    take(0, -step, SideStep);
    take(-1, -step, CornerStep);
    take(1, -step, CornerStep);
  };
  for (int y = 0; y < seen.height; ++y)
  {
    for (int x = 0; x < seen.width; ++x)
    {
      visit(x, y, 1);
    }
  }
  for (int y = seen.height - 1; y >= 0; --y)
  {
    for (int x = seen.width - 1; x >= 0; --x)
    {
      visit(x, y, -1);
    }
  }
  return distances;
}

/** The rays of one surface. */
struct Region
{
  double rays = 0.0;
  double sumX = 0.0;
  double sumY = 0.0;
  int deepest = 0; ///< distance of the anchor
  double offCentre = 0.0;
  int x = 0; ///< of the anchor
  int y = 0;
  int left = std::numeric_limits<int>::max(); ///< first and last column
  int right = 0;
};

template <typename TVisit>
void
ForEachRay(const SeenNumbers & seen, std::vector<Region> & regions, const TVisit & visit)
{
  for (int y = 0; y < seen.height; ++y)
  {
    for (int x = 0; x < seen.width; ++x)
    {
      if (seen.At(x, y) != NoSurface)
      {
        visit(regions[seen.At(x, y)], x, y);
      }
    }
  }
}

} // namespace

std::vector<NamePlace>
FindNamePlaces(const Scene & scene, const Projection & projection)
{
  const Projection rays = RaysOf(projection);
  const SeenNumbers seen = FindSeenNumbers(scene, rays);
  const std::vector<int> distances = FindDistances(seen);
  std::vector<Region> regions(scene.surfaces.size());
  ForEachRay(seen, regions, [](Region & region, int x, int y) {
    region.rays += 1.0;
    region.sumX += x;
    region.sumY += y;
    region.left = std::min(region.left, x);
    region.right = std::max(region.right, x);
  });
  ForEachRay(seen, regions, [&](Region & region, int x, int y) { // of equally deep rays the one next to the centroid
    const int depth = distances[seen.IndexOf(x, y)];
    const double offCentre = std::hypot(x - region.sumX / region.rays, y - region.sumY / region.rays);
    if (depth > region.deepest || (depth == region.deepest && offCentre < region.offCentre))
    {
      region.deepest = depth;
      region.offCentre = offCentre;
      region.x = x;
      region.y = y;
    }
  });
  std::vector<NamePlace> places;
  for (std::size_t n = 0; n < regions.size(); ++n)
  {
    const Region & region = regions[n];
    if (region.deepest >= RoomForDot)
    {
      NamePlace place;
      place.surface = n;
      place.point = rays.PointAt({ region.x + 0.5, region.y + 0.5 });
      place.left = rays.PointAt({ region.left + 0.0, region.y + 0.5 });
      place.right = rays.PointAt({ region.right + 1.0, region.y + 0.5 });
      place.seen = region.rays / static_cast<double>(seen.numbers.size());
      places.push_back(place);
    }
  }
  return places;
}

} // namespace rhombic
