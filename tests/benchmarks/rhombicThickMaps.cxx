#include "rhombicThickMaps.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rhombic
{
namespace
{

using MapImage = itk::Image<std::uint16_t, 3>;

constexpr double Pixel = 0.78125; // mm

/** A pseudo-random number in [0, 1) for some integers. */
double
Hash(std::uint64_t seed, std::int64_t a, std::int64_t b, std::int64_t c)
{
  std::uint64_t state = seed;
  for (const std::int64_t number : { a, b, c })
  {
    state = (state ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u; // as splitmix64 mixes bits
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
    state ^= state >> 31;
  }
  return static_cast<double>(state >> 11) * 0x1p-53;
}

/** The distance of a point from an ellipsoid with its centre at 0 and its axes along x, y and z, negative outside: by
 * bisection of t, where the nearest point is semi^2 p / (semi^2 + t). */
double
DepthInEllipsoid(const Vector3 & p, const Vector3 & semi)
{
  const auto nearestAt = [&](double t) {
    Vector3 nearest;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      nearest[axis] = semi[axis] * semi[axis] * p[axis] / (semi[axis] * semi[axis] + t);
    }
    return nearest;
  };
  const auto levelAt = [&](const Vector3 & q) { return std::hypot(q[0] / semi[0], q[1] / semi[1], q[2] / semi[2]); };
  const double shortest = std::min({ semi[0], semi[1], semi[2] });
  double low = -shortest * shortest * (1.0 - 1e-12);
  double high = Length(p) * std::max({ semi[0], semi[1], semi[2] });
  for (int n = 0; n < 60; ++n)
  {
    const double middle = 0.5 * (low + high);
    (levelAt(nearestAt(middle)) > 1.0 ? low : high) = middle;
  }
  const double distance = Distance(p, nearestAt(high));
  return levelAt(p) <= 1.0 ? distance : -distance;
}

ThickStructure
Ellipsoid(const std::string & name, const Vector3 & centre, const Vector3 & semi, bool standsAlone)
{
  return { name,
           [centre, semi](const Vector3 & p) { return DepthInEllipsoid(Subtract(p, centre), semi); },
           { Subtract(centre, semi), Add(centre, semi) },
           standsAlone,
           false };
}

/** A tube of a radius around a polyline. */
ThickStructure
Tube(const std::string & name, const std::vector<Vector3> & line, double radius, bool standsAlone, bool isVessel)
{
  ThickStructure tube{ name, {}, { line.front(), line.front() }, standsAlone, isVessel };
  for (const Vector3 & p : line)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      tube.box[0][axis] = std::min(tube.box[0][axis], p[axis] - radius);
      tube.box[1][axis] = std::max(tube.box[1][axis], p[axis] + radius);
    }
  }
  tube.depth = [line, radius](const Vector3 & p) {
    double nearest = HUGE_VAL;
    for (std::size_t n = 1; n < line.size(); ++n)
    {
      const Vector3 way = Subtract(line[n], line[n - 1]);
      const double share = std::clamp(Dot(Subtract(p, line[n - 1]), way) / Dot(way, way), 0.0, 1.0);
      nearest = std::min(nearest, SquaredDistance(p, Along(line[n - 1], way, share)));
    }
    return radius - std::sqrt(nearest);
  };
  return tube;
}

/** A line from z = -length / 2 to length / 2 that winds around (x, y). */
std::vector<Vector3>
MakeWindingLine(double x, double y, double length, double amplitude, double period)
{
  std::vector<Vector3> line;
  constexpr int parts = 40;
  for (int n = 0; n <= parts; ++n)
  {
    const double z = length * (static_cast<double>(n) / parts - 0.5);
    const double angle = 2.0 * 3.14159265358979 * z / period;
    line.push_back({ x + amplitude * std::sin(angle), y + amplitude * std::cos(angle), z });
  }
  return line;
}

/** The shift of a slice's borders at a place along one axis, from -1 to 1: numbers at the corners of squares of 8 mm,
 * blended smoothly. */
double
FindSway(const ThickMapSettings & settings, const Vector3 & p, std::int64_t slice, unsigned int axis)
{
  constexpr double square = 8.0;
  const double u = std::floor(p[0] / square);
  const double v = std::floor(p[1] / square);
  const auto blend = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double s = blend(p[0] / square - u);
  const double t = blend(p[1] / square - v);
  const auto numberAt = [&](int du, int dv) {
    const auto column = static_cast<std::int64_t>(u) + du;
    const auto row = static_cast<std::int64_t>(v) + dv;
    return 2.0 * Hash(settings.seed, 2 * slice + axis, column, row) - 1.0;
  };
  return (1.0 - t) * ((1.0 - s) * numberAt(0, 0) + s * numberAt(1, 0)) +
         t * ((1.0 - s) * numberAt(0, 1) + s * numberAt(1, 1));
}

/** The label of the structure that is deepest at a point. */
std::uint16_t
FindLabel(const std::vector<ThickStructure> & structures, const Vector3 & p)
{
  std::uint16_t label = 0;
  double deepest = 0.0;
  for (std::size_t n = 0; n < structures.size(); ++n)
  {
    const auto & [low, high] = structures[n].box;
    bool isNear = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isNear &= p[axis] >= low[axis] && p[axis] <= high[axis];
    }
    const double depth = isNear ? structures[n].depth(p) : -1.0;
    if (depth > deepest)
    {
      deepest = depth;
      label = static_cast<std::uint16_t>(n + 1);
    }
  }
  return label;
}

/** Gives some pixels at borders in slices the label of a pixel beside them, unless one of both is of a vessel. */
void
FlipPixels(const std::vector<ThickStructure> & structures, const ThickMapSettings & settings, MapImage & map)
{
  const auto size = map.GetBufferedRegion().GetSize();
  const std::vector<std::uint16_t> drawn(map.GetBufferPointer(),
                                         map.GetBufferPointer() + map.GetBufferedRegion().GetNumberOfPixels());
  const auto isVessel = [&](std::uint16_t label) { return label > 0 && structures[label - 1].isVessel; };
  for (itk::ImageRegionIteratorWithIndex<MapImage> it(&map, map.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(size[0]);
    const std::uint16_t * const here = drawn.data() + map.ComputeOffset(index);
    constexpr int directions[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
    for (const auto & [x, y] : directions)
    {
      const bool isInside = index[0] + x >= 0 && index[0] + x < row && index[1] + y >= 0 &&
                            index[1] + y < static_cast<itk::IndexValueType>(size[1]);
      const std::uint16_t other = isInside ? here[x + y * row] : *here;
      if (other != *here && !isVessel(other) && !isVessel(*here))
      {
        const double number = Hash(settings.seed + 1000, index[0], index[1], index[2]);
        it.Set(number < settings.flippedShare ? other : *here);
        break;
      }
    }
  }
}

} // namespace

std::vector<ThickStructure>
MakeThickStructures()
{
  return {
    Ellipsoid("liver", { -62.0, -30.0, 70.0 }, { 75.0, 65.0, 70.0 }, true),
    Ellipsoid("spleen", { 98.0, 30.0, 80.0 }, { 28.0, 42.0, 50.0 }, true),
    Ellipsoid("kidney_left", { 62.0, 62.0, -20.0 }, { 25.0, 30.0, 56.0 }, true),
    Ellipsoid("kidney_right", { -62.0, 64.0, -40.0 }, { 24.0, 29.0, 54.0 }, true),
    Tube("aorta", MakeWindingLine(12.0, 92.0, 360.0, 4.0, 300.0), 10.0, true, false),
    Tube("vessel_1", MakeWindingLine(-112.0, 60.0, 240.0, 3.0, 220.0), 0.71 * Pixel, true, true),
    Tube("vessel_2", MakeWindingLine(-112.0, 85.0, 240.0, 3.0, 180.0), 1.0 * Pixel, true, true),
    Tube("vessel_3", MakeWindingLine(-112.0, 110.0, 240.0, 4.0, 160.0), 1.5 * Pixel, true, true),
    Ellipsoid("stomach", { 70.0, -60.0, 40.0 }, { 45.0, 38.0, 55.0 }, false),
    Ellipsoid("pancreas", { 60.0, -40.0, -30.0 }, { 55.0, 18.0, 28.0 }, false),
    Tube("duodenum", { { 10.0, -50.0, -70.0 }, { 28.0, -52.0, -30.0 }, { 40.0, -60.0, 0.0 } }, 13.0, false, false)
  };
}

MapImage::Pointer
MakeThickMap(const std::vector<ThickStructure> & structures, const ThickMapSettings & settings)
{
  const auto map = MapImage::New();
  MapImage::SizeType size;
  MapImage::SpacingType spacing;
  MapImage::PointType origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = settings.size[axis];
    spacing[axis] = settings.spacing[axis];
    origin[axis] = -0.5 * spacing[axis] * (static_cast<double>(size[axis]) - 1.0);
  }
  map->SetRegions(size);
  map->SetSpacing(spacing);
  map->SetOrigin(origin);
  map->Allocate();
  for (itk::ImageRegionIteratorWithIndex<MapImage> it(map, map->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    const auto centre = map->TransformIndexToPhysicalPoint<double>(index);
    Vector3 p{ centre[0], centre[1], centre[2] };
    const Vector3 steady = p;
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      p[axis] += settings.sway * spacing[axis] * FindSway(settings, steady, index[2], axis);
    }
    it.Set(FindLabel(structures, p));
  }
  FlipPixels(structures, settings, *map);
  return map;
}

} // namespace rhombic
