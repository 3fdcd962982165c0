#include "itkTriangleSurfaceInterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;
using Point = itk::Point<double, 3>;

/** Which samples are inside: 1 for each, planes x rows x columns. */
std::vector<int>
InteriorOf(const Surface & surface, const itk::SamplePlanes & planes)
{
  std::vector<int> inside(planes.origins.size() * planes.numberOfRows * planes.numberOfColumns, 0);
  FindTriangleSurfaceInteriorSamples(surface, planes, [&](auto plane, auto row, auto begin, auto end) {
    for (auto column = begin; column < end; ++column)
    {
      ++inside[(plane * planes.numberOfRows + row) * planes.numberOfColumns + column];
    }
  });
  return inside;
}

Point
SampleOf(const itk::SamplePlanes & planes, std::size_t n)
{
  const std::size_t column = n % planes.numberOfColumns;
  const std::size_t row = n / planes.numberOfColumns % planes.numberOfRows;
  return planes.origins[n / planes.numberOfColumns / planes.numberOfRows] +
         planes.columnStep * static_cast<double>(column) + planes.rowStep * static_cast<double>(row);
}

double
SixfoldVolume(const Point & a, const Point & b, const Point & c, const Point & d)
{
  return itk::CrossProduct(b - a, c - a) * (d - a);
}

/** The tetrahedron of four points of a list, facing outwards. */
Surface::Pointer
TetrahedronOf(const std::vector<Point> & points, std::array<std::uint32_t, 4> corners)
{
  if (SixfoldVolume(points[corners[0]], points[corners[1]], points[corners[2]], points[corners[3]]) < 0.0)
  {
    std::swap(corners[2], corners[3]);
  }
  const auto surface = Surface::New();
  for (const Point & point : points)
  {
    surface->GetPoints().push_back(
      { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
  }
  const auto [a, b, c, d] = corners;
  surface->GetTriangles() = { { a, c, b }, { a, b, d }, { b, c, d }, { c, a, d } };
  return surface;
}

/** Planes with sheared rows, tilted and unevenly spaced. */
itk::SamplePlanes
SlantedPlanes()
{
  itk::SamplePlanes planes;
  planes.columnStep[0] = 0.9;
  planes.columnStep[1] = 0.2;
  planes.rowStep[0] = 0.3;
  planes.rowStep[1] = -0.8;
  planes.rowStep[2] = 0.1;
  planes.numberOfColumns = 23;
  planes.numberOfRows = 25;
  const double heights[] = { -10.0, -9.0, -8.0, -6.5, -5.0, -3.5, -2.0, 0.0, 1.0, 2.0, 4.0, 7.5, 9.0 };
  for (const double height : heights)
  {
    Point origin;
    origin[0] = -12.0 + 0.2 * height;
    origin[1] = 8.0 + 0.1 * height;
    origin[2] = height;
    planes.origins.push_back(origin);
  }
  return planes;
}

std::vector<Point>
RandomPoints(std::mt19937 & random, std::size_t count)
{
  std::uniform_int_distribution<int> coordinate(-10, 10); // whole numbers: exact as float, and many special positions
  std::vector<Point> points(count);
  for (Point & point : points)
  {
    std::generate(point.Begin(), point.End(), [&] { return coordinate(random); });
  }
  return points;
}

TEST(TriangleSurfaceInterior, IsThatOfTheHalfSpacesOfTetrahedra)
{
  std::mt19937 random(1);
  const auto planes = SlantedPlanes();
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto p = RandomPoints(random, 4);
    const double whole = SixfoldVolume(p[0], p[1], p[2], p[3]);
    if (whole == 0.0)
    {
      continue;
    }
    const auto inside = InteriorOf(*TetrahedronOf(p, { 0, 1, 2, 3 }), planes);
    for (std::size_t n = 0; n < inside.size(); ++n)
    {
      const Point x = SampleOf(planes, n);
      const double least = std::min({ SixfoldVolume(x, p[1], p[2], p[3]) / whole,
                                      SixfoldVolume(p[0], x, p[2], p[3]) / whole,
                                      SixfoldVolume(p[0], p[1], x, p[3]) / whole,
                                      SixfoldVolume(p[0], p[1], p[2], x) / whole });
      if (std::abs(least) > 1e-9) // not on the surface itself
      {
        ASSERT_EQ(inside[n], least > 0.0 ? 1 : 0) << "trial " << trial << ", sample " << x;
      }
    }
  }
}

TEST(TriangleSurfaceInterior, NeighboursShareEverySampleOut)
{
  // The samples are whole numbers as the corners are, so many of them lie on faces, edges and corners.
  itk::SamplePlanes planes;
  planes.columnStep[0] = 1.0;
  planes.rowStep[1] = 1.0;
  planes.numberOfColumns = 25;
  planes.numberOfRows = 25;
  for (int z = -12; z <= 12; ++z)
  {
    Point origin(-12.0);
    origin[2] = z;
    planes.origins.push_back(origin);
  }
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    // A tetrahedron, cut into four by a point in it: their samples are its samples.
    auto points = RandomPoints(random, 4);
    for (Point & point : points)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = 4.0 * std::round(point[axis] / 4.0);
      }
    }
    Point middle;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      middle[axis] = (points[0][axis] + points[1][axis] + points[2][axis] + points[3][axis]) / 4.0;
    }
    points.push_back(middle);
    if (SixfoldVolume(points[0], points[1], points[2], points[3]) == 0.0)
    {
      continue;
    }
    auto parts = InteriorOf(*TetrahedronOf(points, { 4, 1, 2, 3 }), planes);
    for (const auto & corners : { std::array<std::uint32_t, 4>{ 0, 4, 2, 3 }, { 0, 1, 4, 3 }, { 0, 1, 2, 4 } })
    {
      const auto part = InteriorOf(*TetrahedronOf(points, corners), planes);
      std::transform(parts.begin(), parts.end(), part.begin(), parts.begin(), std::plus<>());
    }
    ASSERT_EQ(parts, InteriorOf(*TetrahedronOf(points, { 0, 1, 2, 3 }), planes)) << "trial " << trial;
  }
}

TEST(TriangleSurfaceInterior, NothingIsInsideNothing)
{
  const auto inside = InteriorOf(*Surface::New(), SlantedPlanes());
  EXPECT_EQ(std::count(inside.begin(), inside.end(), 0), static_cast<std::ptrdiff_t>(inside.size()));
  EXPECT_TRUE(InteriorOf(*Surface::New(), {}).empty());
}

} // namespace
