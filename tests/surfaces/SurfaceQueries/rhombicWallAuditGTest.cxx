#include "rhombicWallAudit.h"

#include <gtest/gtest.h>

namespace
{

/** A tetrahedron on the triangle (0,0,0), (1,0,0), (0,1,0), with its tip at a height. */
rhombic::SceneSurface
MakeTetrahedron(float height)
{
  const auto surface = itk::TriangleSurface::New();
  surface->GetPoints() = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, height } };
  surface->GetTriangles() = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
  for (auto & triangle : surface->GetTriangles())
  {
    if (height < 0)
    {
      std::swap(triangle[0], triangle[1]);
    }
  }
  rhombic::SceneSurface scene;
  scene.surface = surface;
  return scene;
}

TEST(WallAudit, FindsTheWallOfTwoTetrahedra)
{
  const auto audit = rhombic::AuditWalls({ MakeTetrahedron(1.0f), MakeTetrahedron(-1.0f) });
  EXPECT_EQ(audit.sharedTriangles, 1u);
  EXPECT_TRUE(audit.IsSound());
}

TEST(WallAudit, FindsWhatIsThereTwiceAndWhatCrosses)
{
  const auto twice = rhombic::AuditWalls({ MakeTetrahedron(1.0f), MakeTetrahedron(1.0f) });
  EXPECT_EQ(twice.repeatedTriangles, 4u);
  EXPECT_FALSE(twice.IsClosed());
  const auto turned = rhombic::AuditWalls({ MakeTetrahedron(1.0f), MakeTetrahedron(-1.0f), MakeTetrahedron(-2.0f) });
  EXPECT_FALSE(turned.IsClosed()) << "three surfaces share a triangle";
  rhombic::SceneSurface moved = MakeTetrahedron(1.0f);
  const auto points = itk::TriangleSurface::New();
  points->Graft(moved.surface);
  for (auto & point : points->GetPoints())
  {
    point = { point[0] + 0.1f, point[1] + 0.1f, point[2] + 0.1f };
  }
  moved.surface = points;
  const auto crossing = rhombic::AuditWalls({ MakeTetrahedron(1.0f), moved });
  EXPECT_TRUE(crossing.IsClosed());
  EXPECT_GT(crossing.intersections.crossingPairs, 0u);
  EXPECT_FALSE(crossing.IsSound());
}

TEST(WallAudit, AddsCounts)
{
  const auto one = rhombic::AuditWalls({ MakeTetrahedron(1.0f), MakeTetrahedron(-1.0f) });
  auto sum = one;
  sum.Add(one);
  EXPECT_EQ(sum.sharedTriangles, 2u);
  EXPECT_EQ(sum.intersections.testedTriangles, 2 * one.intersections.testedTriangles);
}

} // namespace
