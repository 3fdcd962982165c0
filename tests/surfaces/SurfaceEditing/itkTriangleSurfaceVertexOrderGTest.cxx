#include "itkTriangleSurfaceForRendering.h"
#include "itkTriangleSurfaceTopology.h"
#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <meshoptimizer.h>

#include <algorithm>
#include <random>

namespace
{

using Surface = itk::TriangleSurface;

/** The triangles by their positions, each from its least corner on, in order. */
std::vector<std::array<Surface::PointType, 3>>
SortedTriangles(const Surface & surface)
{
  std::vector<std::array<Surface::PointType, 3>> triangles;
  for (const auto & triangle : surface.GetTriangles())
  {
    std::array<Surface::PointType, 3> positions{ surface.GetPoints()[triangle[0]],
                                                 surface.GetPoints()[triangle[1]],
                                                 surface.GetPoints()[triangle[2]] };
    std::rotate(positions.begin(), std::min_element(positions.begin(), positions.end()), positions.end());
    triangles.push_back(positions);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/** 0.5 at best, 3 at worst, for a cache of 16 points. */
double
TransformsPerTriangle(const Surface & surface)
{
  const unsigned int * const indices = surface.GetTriangles().front().data();
  return meshopt_analyzeVertexCache(indices, 3 * surface.GetNumberOfTriangles(), surface.GetNumberOfPoints(), 16, 0, 0)
    .acmr;
}

/** Bytes fetched over bytes of points and normals; 1 at best. */
double
Overfetch(const Surface & surface)
{
  const unsigned int * const indices = surface.GetTriangles().front().data();
  return meshopt_analyzeVertexFetch(
           indices, 3 * surface.GetNumberOfTriangles(), surface.GetNumberOfPoints(), 6 * sizeof(float))
    .overfetch;
}

TEST(TriangleSurfaceVertexOrder, IsBetterAfterwardsAndTheTrianglesAreTheSame)
{
  const auto surface = itk::example::MakeTorus(10.0, 4.0, 100);
  std::mt19937 random(7);
  std::shuffle(surface->GetTriangles().begin(), surface->GetTriangles().end(), random);
  surface->GetPoints().push_back({ 99, 99, 99 }); // of no triangle
  surface->GetNormals().resize(surface->GetPoints().size());
  for (std::size_t point = 0; point < surface->GetPoints().size(); ++point)
  {
    surface->GetNormals()[point] = surface->GetPoints()[point]; // recognisable
  }
  const auto triangles = SortedTriangles(*surface);
  EXPECT_GT(TransformsPerTriangle(*surface), 2.5);
  EXPECT_GT(Overfetch(*surface), 5.0);

  OptimizeTriangleSurfaceForRendering(*surface);

  EXPECT_EQ(SortedTriangles(*surface), triangles);
  EXPECT_EQ(surface->GetNormals(), Surface::NormalsContainer(surface->GetPoints()));
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).unusedPoints, 0u);
  EXPECT_LT(TransformsPerTriangle(*surface), 0.75);
  EXPECT_LT(Overfetch(*surface), 1.2);
  for (std::uint32_t point = 0, id = 0; id < surface->GetTriangles().size(); ++id)
  {
    for (const auto corner : surface->GetTriangles()[id])
    {
      ASSERT_LE(corner, point) << "points come in the order of first use";
      point = std::max(point, corner + 1);
    }
  }
}

TEST(TriangleSurfaceVertexOrder, OfNothingIsNothing)
{
  const auto surface = Surface::New();
  surface->GetPoints().push_back({ 1, 2, 3 });
  OptimizeTriangleSurfaceForRendering(*surface);
  EXPECT_EQ(surface->GetNumberOfPoints(), 0u);
}

} // namespace
