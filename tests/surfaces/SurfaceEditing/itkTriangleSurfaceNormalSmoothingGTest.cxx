#include "itkTriangleSurfaceForRendering.h"

#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;

constexpr double Radius = 20.0;

/** A sphere with normals; points and normals are moved by normally distributed steps, relative to the radius. */
Surface::Pointer
MakeSphereWithNormals(double pointNoise, double normalNoise, unsigned int seed)
{
  auto surface = itk::example::MakeSphere(Radius, 5);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (auto & point : surface->GetPoints())
  {
    std::array<double, 3> direction;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[axis] = point[axis] / Radius + normalNoise * normal(random);
    }
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    surface->GetNormals().push_back({ static_cast<float>(direction[0] / length),
                                      static_cast<float>(direction[1] / length),
                                      static_cast<float>(direction[2] / length) });
    const double factor = 1.0 + pointNoise * normal(random);
    for (float & coordinate : point)
    {
      coordinate = static_cast<float>(factor * coordinate);
    }
  }
  return surface;
}

/** The mean angle in degrees between the normals and the directions from the centre. */
double
MeanAngle(const Surface & surface)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < surface.GetNumberOfPoints(); ++n)
  {
    const auto & point = surface.GetPoints()[n];
    const auto & normal = surface.GetNormals()[n];
    const double dot = double{ point[0] } * normal[0] + double{ point[1] } * normal[1] + double{ point[2] } * normal[2];
    const double length = std::hypot(double{ point[0] }, double{ point[1] }, double{ point[2] });
    sum += std::acos(std::clamp(dot / length, -1.0, 1.0)) * 180.0 / std::acos(-1.0);
  }
  return sum / static_cast<double>(surface.GetNumberOfPoints());
}

TEST(TriangleSurfaceNormalSmoothing, HalvesTheErrorWhereTrianglesAreRough)
{
  for (const unsigned int seed : { 1u, 2u, 3u })
  {
    const auto surface = MakeSphereWithNormals(0.01, 0.15, seed);
    const auto points = surface->GetPoints();
    const double before = MeanAngle(*surface);
    itk::SmoothTriangleSurfaceNormals(*surface);
    EXPECT_LT(MeanAngle(*surface), 0.5 * before);
    EXPECT_EQ(surface->GetPoints(), points);
  }
}

TEST(TriangleSurfaceNormalSmoothing, LeavesAFineSphereAsItIs)
{
  const auto surface = MakeSphereWithNormals(0.0, 0.0, 1);
  const auto normals = surface->GetNormals();
  itk::SmoothTriangleSurfaceNormals(*surface);
  EXPECT_EQ(surface->GetNormals(), normals);
}

TEST(TriangleSurfaceNormalSmoothing, SameBytesForAnyNumberOfThreads)
{
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  const auto smoothed = [](unsigned int count) {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(count);
    const auto surface = MakeSphereWithNormals(0.01, 0.15, 1);
    itk::SmoothTriangleSurfaceNormals(*surface);
    return surface->GetNormals();
  };
  const auto normals = smoothed(1);
  for (const unsigned int count : { 2u, 3u, 8u })
  {
    EXPECT_EQ(smoothed(count), normals) << count << " threads";
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

TEST(TriangleSurfaceNormalSmoothing, TakesSurfacesWithoutNormalsOrTriangles)
{
  const auto empty = Surface::New();
  itk::SmoothTriangleSurfaceNormals(*empty);
  EXPECT_EQ(empty->GetNumberOfPoints(), 0u);

  const auto bare = itk::example::MakeSphere(Radius, 2);
  itk::SmoothTriangleSurfaceNormals(*bare);
  EXPECT_FALSE(bare->HasNormals());

  const auto single = Surface::New();
  single->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 5, 5 } };
  single->GetNormals() = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 1, 0, 0 } };
  single->GetTriangles() = { { 0, 1, 2 } };
  const auto normals = single->GetNormals();
  itk::SmoothTriangleSurfaceNormals(*single);
  EXPECT_EQ(single->GetNormals(), normals);
}

} // namespace
