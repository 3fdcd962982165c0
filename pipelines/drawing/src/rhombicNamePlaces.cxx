#include "rhombicNamePlaces.h"

#include "rhombicSeenNumbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

constexpr int RaysAlongLongerSide = 600;
constexpr int SideStep = 3; // distances between pixels: 3 for each side, 4 for each corner (chamfer)
constexpr int CornerStep = 4;
constexpr int RoomForDot = 2 * SideStep; // three pixels wide

Projection
RaysOf(Projection picture)
{
  const double scale = static_cast<double>(RaysAlongLongerSide) / std::max({ picture.width, picture.height, 1 });
  picture.pixelSize /= scale;
  picture.width = std::max(1, static_cast<int>(std::lround(scale * picture.width)));
  picture.height = std::max(1, static_cast<int>(std::lround(scale * picture.height)));
  return picture;
}

/** For each ray, the distance to the nearest one of another number or outside of the picture. */
std::vector<int>
FindDistances(const SeenNumbers & seen)
{
  std::vector<int> distances(seen.numbers.size(), std::numeric_limits<int>::max());
  const auto visit = [&](int x, int y, int step) { // rays in the rows before, and in this row, as seen from the step
    const std::size_t here = seen.IndexOf(x, y);
    const auto take = [&](int dx, int dy, int far) {
      const int rest = seen.At(x + dx, y + dy) == seen.numbers[here] && seen.At(x + dx, y + dy) != SeenNumbers::None
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
      if (seen.At(x, y) != SeenNumbers::None)
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
