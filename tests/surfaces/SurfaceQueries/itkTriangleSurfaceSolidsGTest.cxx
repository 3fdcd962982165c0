#include "itkTriangleSurfaceSolids.h"

#include "itkExampleSurfaces.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

namespace
{

using namespace itk::example;
using Surface = itk::TriangleSurface;

Surface::Pointer
MakeCavity(double radius, const std::array<double, 3> & centre = {})
{
  auto surface = MakeSphere(radius, 4, centre);
  TurnInsideOut(*surface);
  return surface;
}

/** A ball of radius 10 with a cavity of 8, in it a ball of 5 with a cavity of 2; beside it a ball of 3. */
Surface::Pointer
MakeNested()
{
  auto surface = MakeCavity(8.0);
  Append(*surface, *MakeSphere(3.0, 4, { 30, 0, 0 }));
  Append(*surface, *MakeSphere(5.0, 4));
  Append(*surface, *MakeCavity(2.0));
  Append(*surface, *MakeSphere(10.0, 4));
  return surface;
}

double
BallVolume(double radius)
{
  return ComputeTriangleSurfaceVolume(*MakeSphere(radius, 4));
}

void
ExpectRemoved(const itk::RemovedShells & removed, itk::SizeValueType solids, itk::SizeValueType cavities, double volume)
{
  EXPECT_EQ(removed.solids, solids);
  EXPECT_EQ(removed.cavities, cavities);
  EXPECT_NEAR(removed.volume, volume, 1e-3);
}

TEST(TriangleSurfaceSolids, LargestKeepsItsCavityAndNothingElse)
{
  const auto surface = MakeNested();
  ExpectRemoved(KeepLargestTriangleSurfaceSolid(*surface), 2, 1, BallVolume(5.0) - BallVolume(2.0) + BallVolume(3.0));
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), BallVolume(10.0) - BallVolume(8.0), 1e-3);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).components, 2u);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).unusedPoints, 0u);
  ExpectRemoved(KeepLargestTriangleSurfaceSolid(*surface), 0, 0, 0.0);
}

TEST(TriangleSurfaceSolids, SmallOnesGoWithTheirCavities)
{
  const auto surface = MakeNested();
  ExpectRemoved(
    RemoveSmallTriangleSurfaceSolids(*surface, 0.9 * BallVolume(3.0)), 0, 0, 0.0); // cavities stay, however small
  ExpectRemoved(RemoveSmallTriangleSurfaceSolids(*surface, 1.1 * BallVolume(3.0)), 1, 0, BallVolume(3.0));
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface),
              BallVolume(10.0) - BallVolume(8.0) + BallVolume(5.0) - BallVolume(2.0),
              1e-3);
  ExpectRemoved(
    RemoveSmallTriangleSurfaceSolids(*surface, 1.1 * BallVolume(5.0)), 1, 1, BallVolume(5.0) - BallVolume(2.0));
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), BallVolume(10.0) - BallVolume(8.0), 1e-3);
  ExpectRemoved(
    RemoveSmallTriangleSurfaceSolids(*surface, 1.1 * BallVolume(10.0)), 1, 1, BallVolume(10.0) - BallVolume(8.0));
  EXPECT_EQ(surface->GetNumberOfPoints(), 0u);
  ExpectRemoved(RemoveSmallTriangleSurfaceSolids(*surface, 1.0), 0, 0, 0.0); // nothing is left, and nothing happens
}

TEST(TriangleSurfaceSolids, FilledOnesHaveNothingInside)
{
  const auto surface = MakeNested();
  ExpectRemoved(FillTriangleSurfaceCavities(*surface), 1, 2, BallVolume(5.0) - BallVolume(8.0) - BallVolume(2.0));
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), BallVolume(10.0) + BallVolume(3.0), 1e-3);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*surface).IsWatertight());
  ExpectRemoved(FillTriangleSurfaceCavities(*surface), 0, 0, 0.0);
}

/** A torus does not enclose what is in its hole. */
TEST(TriangleSurfaceSolids, HolesOfATorusAreOutside)
{
  const auto surface = MakeTorus(10.0, 4.0, 40);
  Append(*surface, *MakeSphere(3.0, 3));
  Append(*surface, *MakeCavity(3.0, { 0, 10, 0 }));
  EXPECT_EQ(FillTriangleSurfaceCavities(*surface).cavities, 1u);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).components, 2u);
}

TEST(TriangleSurfaceSolids, InsideOutShellsWithNothingAroundAreSolids)
{
  const auto surface = MakeCavity(5.0);
  Append(*surface, *MakeSphere(3.0, 4, { 20, 0, 0 }));
  EXPECT_EQ(KeepLargestTriangleSurfaceSolid(*surface).solids, 1u);
  EXPECT_LT(ComputeTriangleSurfaceVolume(*surface), 0.0);
}

/** Noise: a hundred thousand specks around a ball with a cavity, and some in it. */
TEST(TriangleSurfaceSolids, AreToldApartAmongVeryMany)
{
  const auto surface = MakeSphere(40.0, 4);
  Append(*surface, *MakeCavity(30.0));
  itk::SizeValueType inside = 0;
  for (int n = 0; n < 47 * 47 * 47; ++n)
  {
    const Surface::PointType place{ float(n % 47 * 2 - 46), float(n / 47 % 47 * 2 - 46), float(n / 47 / 47 * 2 - 46) };
    const double radius = std::hypot(place[0], place[1], place[2]);
    if (radius < 28.0 || (radius > 32.0 && radius < 38.0) || radius > 42.0) // away from the walls
    {
      Append(*surface, *MakeTetrahedron(0.5f), place);
      inside += radius < 38.0;
    }
  }
  const auto filled = Surface::New();
  filled->Graft(surface);
  const itk::RemovedShells removed = FillTriangleSurfaceCavities(*filled);
  EXPECT_EQ(removed.solids, inside);
  EXPECT_EQ(removed.cavities, 1u);
  const auto large = Surface::New();
  large->Graft(surface);
  EXPECT_GT(RemoveSmallTriangleSurfaceSolids(*large, 1.0).solids, 80000u);
  EXPECT_EQ(ComputeTriangleSurfaceTopology(*large).components, 2u);
}

itk::SizeValueType
CountMisfacing(const Surface & surface)
{
  return CountTriangleSurfaceShells(surface).misfacing;
}

TEST(TriangleSurfaceSolids, FaceOutwardsAndTheirCavitiesInwards)
{
  const auto surface = MakeNested();
  EXPECT_EQ(CountMisfacing(*surface), 0u);
  const itk::ShellCounts shells = CountTriangleSurfaceShells(*surface);
  EXPECT_EQ(shells.solids, 3u);
  EXPECT_EQ(shells.cavities, 2u);
  EXPECT_EQ(CountMisfacing(*Surface::New()), 0u);
  TurnInsideOut(*surface);
  EXPECT_EQ(CountMisfacing(*surface), 5u);
}

TEST(TriangleSurfaceSolids, ShellsThatFaceTheWrongWayAreCounted)
{
  const auto beside = MakeSphere(10.0, 4);
  Append(*beside, *MakeCavity(3.0, { 20, 0, 0 }));
  EXPECT_EQ(CountMisfacing(*beside), 1u) << "a cavity in nothing, as no program fills it";
  const auto doubled = MakeSphere(10.0, 4);
  Append(*doubled, *MakeSphere(3.0, 4));
  EXPECT_EQ(CountMisfacing(*doubled), 1u) << "a solid in a solid";
  const auto inHole = MakeTorus(10.0, 4.0, 40);
  Append(*inHole, *MakeSphere(3.0, 3));
  EXPECT_EQ(CountMisfacing(*inHole), 0u) << "the hole of a torus is outside";
}

/** Components that touch in a point do not enclose each other, wherever that point is in their lists. */
TEST(TriangleSurfaceSolids, ThatTouchFaceAsTheyShould)
{
  for (const float side : { -1.0f, 4.0f }) // the small one's tip at the large one's corner, or its corner at the tip
  {
    const auto surface = MakeTetrahedron(4.0f);
    Append(*surface, *MakeTetrahedron(1.0f), { side, 0, 0 });
    EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).repeatedPositions, 1u) << side;
    EXPECT_EQ(CountMisfacing(*surface), 0u) << side;
  }
}

/** The sign of a speck's volume must not drown in the distance from the surface's first point. */
TEST(TriangleSurfaceSolids, SpecksFarAwayHaveTheirOwnSign)
{
  const auto surface = MakeTetrahedron(1.0f);
  for (int n = 1; n < 200; ++n)
  {
    Append(*surface, *MakeTetrahedron(0.0005f), { float(7 * n), float(11 * n), float(-13 * n) });
  }
  EXPECT_EQ(CountMisfacing(*surface), 0u);
  TurnInsideOut(*surface);
  EXPECT_EQ(CountMisfacing(*surface), 200u);
}

TEST(TriangleSurfaceSolids, MisfacingShellsAreTurnedWithTheirNormals)
{
  const auto surface = MakeNested();
  const double volume = ComputeTriangleSurfaceVolume(*surface);
  for (const auto & point : surface->GetPoints())
  {
    surface->GetNormals().push_back(point);
  }
  EXPECT_EQ(TurnMisfacingTriangleSurfaceShells(*surface), 0u);
  Append(*surface, *MakeCavity(1.0, { 0, 0, 40 }));
  surface->GetNormals().resize(surface->GetNumberOfPoints(), { 0, 0, 1 });
  EXPECT_EQ(TurnMisfacingTriangleSurfaceShells(*surface), 1u);
  EXPECT_EQ(CountMisfacing(*surface), 0u);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), volume + BallVolume(1.0), 1e-3);
  EXPECT_EQ(surface->GetNormals().front(), surface->GetPoints().front());
  EXPECT_EQ(surface->GetNormals().back(), (Surface::NormalType{ 0, 0, -1 }));
}

} // namespace
