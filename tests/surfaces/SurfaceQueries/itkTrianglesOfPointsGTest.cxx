#include "detail/itkTrianglesOfPoints.h"

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace
{

using Ids = std::vector<std::uint32_t>;

constexpr std::uint32_t Points = 300000; // several blocks of points

/** Triangles of points that are near each other, as in surfaces of lattices, or anywhere. */
itk::TriangleSurface::Pointer
MakeTriangles(std::uint32_t distance, std::uint32_t count, bool isShuffled, std::mt19937 & random)
{
  const auto surface = itk::TriangleSurface::New();
  surface->GetPoints().resize(Points);
  std::uniform_int_distribution<std::uint32_t> offsets(0, distance);
  for (std::uint32_t n = 0; n < count; ++n)
  {
    const auto first = static_cast<std::uint32_t>(std::uint64_t{ n } * (Points - distance) / count);
    surface->GetTriangles().push_back({ first + offsets(random), first + offsets(random), first + offsets(random) });
  }
  if (isShuffled)
  {
    std::shuffle(surface->GetTriangles().begin(), surface->GetTriangles().end(), random);
  }
  return surface;
}

/** The components by a search from one point to the next. */
Ids
FindComponents(const itk::TriangleSurface & surface, const itk::TrianglesOfPoints & fans)
{
  Ids ofPoint(surface.GetNumberOfPoints(), itk::TriangleSurfaceComponents::None);
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < ofPoint.size(); ++first)
  {
    if (fans.GetNumberOfTriangles(first) == 0 || ofPoint[first] != itk::TriangleSurfaceComponents::None)
    {
      continue;
    }
    ofPoint[first] = count;
    for (Ids next{ first }; !next.empty();)
    {
      const std::uint32_t point = next.back();
      next.pop_back();
      fans.VisitTriangles(point, [&](std::uint32_t triangle) {
        for (const std::uint32_t corner : surface.GetTriangles()[triangle])
        {
          if (ofPoint[corner] == itk::TriangleSurfaceComponents::None)
          {
            ofPoint[corner] = count;
            next.push_back(corner);
          }
        }
      });
    }
    ++count;
  }
  return ofPoint;
}

TEST(TrianglesOfPoints, AndComponentsAreThoseOfASearchForAnyOrderOfTriangles)
{
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(4); // on one core, too
  std::mt19937 random(41);
  for (const std::uint32_t distance : { 2u, 60u, Points - 1 })
  {
    for (const std::uint32_t count : { 0u, 5u, 50000u, 200000u })
    {
      for (const bool isShuffled : { false, true })
      {
        const auto surface = MakeTriangles(distance, count, isShuffled, random);
        std::vector<Ids> expected(Points);
        for (std::uint32_t id = 0; id < count; ++id)
        {
          for (const std::uint32_t point : surface->GetTriangles()[id])
          {
            expected[point].push_back(id);
          }
        }
        const itk::TrianglesOfPoints fans(*surface);
        for (std::uint32_t point = 0; point < Points; ++point)
        {
          Ids found;
          fans.VisitTriangles(point, [&](std::uint32_t id) { found.push_back(id); });
          ASSERT_EQ(found, expected[point]) << "point " << point << ", distance " << distance << ", " << count;
        }
        const auto components = itk::FindTriangleSurfaceComponents(*surface);
        EXPECT_EQ(Ids(components.ofPoint.begin(), components.ofPoint.end()), FindComponents(*surface, fans))
          << "distance " << distance << ", " << count << " triangles";
      }
    }
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

} // namespace
