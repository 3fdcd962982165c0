#include "itkTriangleTree.h"

#include "itkExampleSurfaces.h"
#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <set>

namespace
{

using Tree = itk::TriangleTree;
using namespace itk::example;

/** Winding number of the surface around a point: 1 inside an outward-facing surface, 0 outside and in cavities. */
int
WindingNumber(const Tree & tree, const Tree::PointType & point)
{
  int windings = 0;
  tree.VisitCrossings(point, [&windings](std::uint32_t, int turns) { windings += turns; });
  return windings;
}

/** Distance to a fine grid of the triangle's points, refined around the best one: independent of the tree's formula. */
double
SearchedSquaredDistance(const itk::TriangleSurface & surface,
                        std::uint32_t triangle,
                        const Tree::PositionType & position)
{
  const auto & corners = surface.GetTriangles()[triangle];
  const auto squaredDistance = [&](double u, double v) {
    double squared = 0.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double a = surface.GetPoints()[corners[0]][axis];
      const double difference = a + u * (surface.GetPoints()[corners[1]][axis] - a) +
                                v * (surface.GetPoints()[corners[2]][axis] - a) - position[axis];
      squared += difference * difference;
    }
    return squared;
  };
  double bestU = 0.0, bestV = 0.0;
  for (double step = 0.125; step > 1e-9; step *= 0.5)
  {
    const double centreU = bestU, centreV = bestV;
    for (int i = -8; i <= 8; ++i)
    {
      for (int j = -8; j <= 8; ++j)
      {
        const double u = std::max(0.0, centreU + i * step), v = std::max(0.0, centreV + j * step);
        const double shrink = std::max(1.0, u + v);
        if (squaredDistance(u / shrink, v / shrink) < squaredDistance(bestU, bestV))
        {
          bestU = u / shrink;
          bestV = v / shrink;
        }
      }
    }
  }
  return squaredDistance(bestU, bestV);
}

TEST(TriangleTree, FindsTheClosestPointThatATrialOfAllTrianglesFinds)
{
  const auto surface = MakeRandomTriangles(60, 10.0f, 4.0f, 1);
  const Tree tree(*surface);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-5.0, 19.0);
  for (int query = 0; query < 40; ++query)
  {
    const Tree::PositionType position{ place(random), place(random), place(random) };
    double searched = std::numeric_limits<double>::infinity();
    for (std::uint32_t triangle = 0; triangle < 60; ++triangle)
    {
      searched = std::min(searched, SearchedSquaredDistance(*surface, triangle, position));
    }
    const auto closest = tree.FindClosestPoint(position);
    ASSERT_NE(closest.triangle, Tree::None);
    EXPECT_NEAR(closest.squaredDistance, searched, 1e-6);
    EXPECT_NEAR(SearchedSquaredDistance(*surface, closest.triangle, closest.point), 0.0, 1e-10);
    EXPECT_EQ(tree.FindClosestPoint(position, 0.5 * closest.squaredDistance).triangle, Tree::None);
  }
}

TEST(TriangleTree, ClosestPointOfFacesAndCornersIsExact)
{
  const auto surface = MakeTetrahedron(4.0f);
  const Tree tree(*surface);
  const auto below = tree.FindClosestPoint({ 1.0, 1.0, -3.0 });
  EXPECT_EQ(below.point, (Tree::PositionType{ 1.0, 1.0, 0.0 }));
  EXPECT_EQ(below.squaredDistance, 9.0);
  const auto corner = tree.FindClosestPoint({ -1.0, -2.0, -2.0 });
  EXPECT_EQ(corner.point, (Tree::PositionType{}));
  EXPECT_EQ(corner.triangle, 0u); // the lowest of three that share the corner
}

TEST(TriangleTree, VisitsEachTriangleWhoseBoxOverlapsOnce)
{
  const auto surface = MakeRandomTriangles(3001, 50.0f, 3.0f, 3);
  const Tree tree(*surface);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-5.0f, 55.0f);
  for (int query = 0; query < 200; ++query)
  {
    Tree::Box box{ { place(random), place(random), place(random) }, {} };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.highest[axis] = box.lowest[axis] + std::abs(place(random)) * 0.2f;
    }
    std::multiset<std::uint32_t> visited, expected;
    tree.VisitTriangles(box, [&visited](std::uint32_t triangle) { visited.insert(triangle); });
    for (std::uint32_t triangle = 0; triangle < 3001; ++triangle)
    {
      if (tree.GetTriangleBox(triangle).Overlaps(box))
      {
        expected.insert(triangle);
      }
    }
    EXPECT_EQ(visited, expected);
  }
}

TEST(TriangleTree, EnlargedAndRefittedFindWhatANewOneFinds)
{
  const auto surface = MakeRandomTriangles(2000, 50.0f, 3.0f, 5);
  Tree enlarged(*surface);
  Tree refitted(*surface);
  std::mt19937 random(6);
  std::normal_distribution<float> move(0.0f, 4.0f);
  std::vector<Tree::Box> before;
  for (std::uint32_t triangle = 0; triangle < surface->GetNumberOfTriangles(); ++triangle)
  {
    before.push_back(enlarged.GetTriangleBox(triangle));
  }
  for (std::size_t point = 0; point < surface->GetNumberOfPoints(); point += 3)
  {
    for (float & coordinate : surface->GetPoints()[point])
    {
      coordinate += move(random);
    }
  }
  for (std::uint32_t triangle = 0; triangle < surface->GetNumberOfTriangles(); ++triangle)
  {
    enlarged.Enlarge(before[triangle], enlarged.GetTriangleBox(triangle));
  }
  refitted.Refit();
  const Tree made(*surface);
  std::uniform_real_distribution<double> place(-5.0, 55.0);
  for (int query = 0; query < 500; ++query)
  {
    const Tree::PositionType position{ place(random), place(random), place(random) };
    const auto expected = made.FindClosestPoint(position);
    for (const Tree * tree : { &enlarged, &refitted })
    {
      const auto found = tree->FindClosestPoint(position);
      EXPECT_EQ(found.triangle, expected.triangle);
      EXPECT_EQ(found.point, expected.point);
    }
  }
}

TEST(TriangleTree, WindsOnceInsideAndNotOutsideEvenAboveVerticesAndEdges)
{
  auto surface = MakeTorus(8.0, 3.0, 32);
  const auto cavity = MakeSphere(1.0, 2, { 8.0, 0.0, 0.0 });
  TurnInsideOut(*cavity);
  Append(*surface, *cavity);
  const Tree tree(*surface);
  for (const auto & point : surface->GetPoints()) // vertices are above and below of these
  {
    for (const float z : { -9.0f, 9.0f })
    {
      EXPECT_EQ(WindingNumber(tree, { point[0], point[1], z }), 0);
    }
    const double fromCircle = std::abs(std::hypot(point[0], point[1]) - 8.0);
    const double fromCavity = std::hypot(point[0] - 8.0, point[1]);
    if (fromCircle < 2.7 && (fromCavity < 0.8 || fromCavity > 1.001))
    {
      EXPECT_EQ(WindingNumber(tree, { point[0], point[1], 0.0f }), fromCavity < 1.0 ? 0 : 1);
    }
  }
  EXPECT_EQ(WindingNumber(tree, { 0, 0, 0 }), 0);
  EXPECT_EQ(WindingNumber(tree, { -8, 0, 0 }), 1);
  EXPECT_EQ(WindingNumber(tree, { 8, 0, 0 }), 0);
}

/** A point on the boundary of two bodies that share a wall is in exactly one of them. */
TEST(TriangleTree, PointsOnAWallAreOnOneSideOfIt)
{
  const auto lower = itk::TriangleSurface::New();
  lower->GetPoints() = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 },
                         { 0, 0, 4 }, { 4, 0, 4 }, { 4, 4, 4 }, { 0, 4, 4 } };
  lower->GetTriangles() = { { 0, 2, 1 }, { 0, 3, 2 }, { 4, 5, 6 }, { 4, 6, 7 }, { 0, 1, 5 }, { 0, 5, 4 },
                            { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 7 }, { 2, 7, 6 }, { 3, 0, 4 }, { 3, 4, 7 } };
  for (const itk::TriangleSurface::PointType & shift :
       { itk::TriangleSurface::PointType{ 4, 0, 0 }, { 0, 4, 0 }, { 0, 0, 4 } })
  {
    const auto upper = itk::TriangleSurface::New();
    Append(*upper, *lower, shift);
    const Tree lowerTree(*lower), upperTree(*upper);
    for (float u = 1; u < 4; ++u)
    {
      for (float v = 1; v < 4; ++v)
      {
        const itk::TriangleSurface::PointType wall{ shift[0] > 0 ? 4 : u,
                                                    shift[1] > 0   ? 4
                                                    : shift[0] > 0 ? u
                                                                   : v,
                                                    shift[2] > 0 ? 4 : v };
        EXPECT_EQ(WindingNumber(lowerTree, wall) + WindingNumber(upperTree, wall), 1);
      }
    }
  }
}

TEST(TriangleTree, EmptyAndBrokenSurfacesHaveNothingNear)
{
  const auto surface = itk::TriangleSurface::New();
  EXPECT_EQ(Tree(*surface).FindClosestPoint({ 0, 0, 0 }).triangle, Tree::None);
  EXPECT_EQ(WindingNumber(Tree(*surface), { 0, 0, 0 }), 0);
  surface->GetPoints() = { { 0, 0, 0 }, { std::numeric_limits<float>::quiet_NaN(), 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 } };
  surface->GetTriangles() = { { 0, 1, 2 }, { 0, 3, 2 } };
  const Tree tree(*surface);
  EXPECT_EQ(tree.GetNumberOfPlacedTriangles(), 1u);
  EXPECT_EQ(tree.FindClosestPoint({ 9, 9, 9 }).triangle, 1u);
}

TEST(TriangleTree, IsTheSameForAnyNumberOfThreads)
{
  const auto surface = MakeRandomTriangles(300000, 100.0f, 1.0f, 5);
  const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  const Tree alone(*surface);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(7);
  const Tree together(*surface);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
  ASSERT_EQ(alone.GetNumberOfLeaves(), together.GetNumberOfLeaves());
  for (std::size_t leaf = 0; leaf < alone.GetNumberOfLeaves(); ++leaf)
  {
    const auto one = alone.GetLeaf(leaf), other = together.GetLeaf(leaf);
    ASSERT_TRUE(std::equal(one.begin(), one.end(), other.begin(), other.end()));
  }
  EXPECT_LE(alone.GetMemorySize(), 30u * 300000u);
}

} // namespace
