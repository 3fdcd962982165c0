#include "rhombicVoxelSurface.h"

#include "rhombicLabelScan.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using rhombictest::At;
using rhombictest::Ball;
using rhombictest::LabelGrid;
using rhombictest::MakeLabelScan;

itk::ImageRegion<3>
AllOf(const rhombic::Scan & scan)
{
  return rhombic::GeometryOf(scan.image).GetLargestPossibleRegion();
}

TEST(VoxelSurface, OneVoxelIsABox)
{
  const auto scan =
    MakeLabelScan({ { { 1, 1, 1 } }, { 2.0, 3.0, 5.0 }, At(10.0, 20.0, 30.0) }, [](const auto &) { return 4; });
  const auto surface = rhombic::ExtractVoxelSurface(scan, 4, AllOf(scan));
  EXPECT_EQ(surface->GetNumberOfPoints(), 8u);
  EXPECT_EQ(surface->GetNumberOfTriangles(), 12u);
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 30.0, 1e-5);
  EXPECT_NEAR(ComputeTriangleSurfaceArea(*surface), 2.0 * (6.0 + 10.0 + 15.0), 1e-5);
  EXPECT_EQ(surface->GetBounds(), (std::array<double, 6>{ 9.0, 11.0, 18.5, 21.5, 27.5, 32.5 }));
  EXPECT_EQ(rhombic::ExtractVoxelSurface(scan, 3, AllOf(scan))->GetNumberOfTriangles(), 0u);
}

/** Also in grids that are mirrored: the volume is positive. */
TEST(VoxelSurface, EnclosesTheVolumeOfTheVoxels)
{
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round)
  {
    LabelGrid grid{ { { 9, 8, 7 } }, { 0.7, 1.1, 3.0 } };
    const int mirrored = round % 4;
    for (int axis = 0; axis < 3; ++axis)
    {
      grid.direction[axis][axis] = axis < mirrored ? -1.0 : 1.0;
    }
    std::size_t voxels = 0;
    const auto scan = MakeLabelScan(grid, [&](const auto &) {
      const bool isInside = random() % 3 == 0;
      voxels += isInside ? 1 : 0;
      return isInside ? 1 : 0;
    });
    const auto surface = rhombic::ExtractVoxelSurface(scan, 1, AllOf(scan));
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), static_cast<double>(voxels) * 0.7 * 1.1 * 3.0, 1e-3);
    EXPECT_EQ(ComputeTriangleSurfaceTopology(*surface).boundaryEdges, 0u);
  }
}

TEST(VoxelSurface, UnevenSlicesMeetHalfWay)
{
  auto scan = MakeLabelScan({ { { 2, 2, 3 } }, { 1.0, 1.0, 1.0 } }, [](const auto &) { return 1; });
  const auto first = rhombic::GeometryOf(scan.image).GetOrigin();
  scan.sliceOrigins = { first,
                        first + At(0.0, 0.0, 1.0).GetVectorFromOrigin(),
                        first + At(0.0, 0.0, 5.0).GetVectorFromOrigin() };
  const auto surface = rhombic::ExtractVoxelSurface(scan, 1, AllOf(scan));
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*surface), 4.0 * (1.0 + 2.5 + 4.0), 1e-5);
}

TEST(VoxelSurface, RegionHoldsTheLabelAlone)
{
  const auto scan = MakeLabelScan({ { { 30, 30, 30 } }, { 1.0, 1.0, 1.0 } }, Ball(5.0, At(4.0, 3.0, 2.0)));
  itk::ImageRegion<3> region = AllOf(scan);
  const auto whole = rhombic::ExtractVoxelSurface(scan, 1, region);
  region.SetIndex({ { 12, 11, 10 } });
  region.SetSize({ { 14, 14, 14 } });
  const auto part = rhombic::ExtractVoxelSurface(scan, 1, region);
  EXPECT_EQ(part->GetPoints(), whole->GetPoints());
  EXPECT_EQ(part->GetTriangles(), whole->GetTriangles());
}

} // namespace
