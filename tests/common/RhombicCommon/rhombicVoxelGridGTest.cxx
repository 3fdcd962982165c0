#include "rhombicVoxelGrid.h"

#include <gtest/gtest.h>

namespace
{

using PointType = itk::Point<double, 3>;

/** A grid of 2 x 3 x 4 voxels of 1 mm, 2 mm and 4 mm. */
itk::ImageBase<3>::Pointer
MakeGrid()
{
  const auto grid = itk::ImageBase<3>::New();
  grid->SetRegions(itk::Size<3>{ { 2, 3, 4 } });
  const double spacing[3] = { 1.0, 2.0, 4.0 };
  grid->SetSpacing(spacing);
  return grid;
}

PointType
At(double x, double z)
{
  const double coordinates[3] = { x, 0.0, z };
  return PointType(coordinates);
}

TEST(VoxelGrid, HasStepsAndAMeanSpacing)
{
  const auto grid = MakeGrid();
  EXPECT_EQ(rhombic::StepAlong(*grid, 1)[1], 2.0);
  EXPECT_EQ(rhombic::StepAlong(*grid, 1)[2], 0.0);
  EXPECT_DOUBLE_EQ(rhombic::MeanSpacingOf(*grid), 2.0);
}

TEST(VoxelGrid, VoxelsReachHalfwayToTheNextSlices)
{
  const auto grid = MakeGrid();
  EXPECT_EQ(rhombic::VoxelVolumesOf(*grid, {}), std::vector<double>(4, 8.0));
  const std::vector<double> volumes = rhombic::VoxelVolumesOf(*grid, { At(0, 0), At(0, 1), At(0, 3), At(0, 7) });
  EXPECT_EQ(volumes, (std::vector<double>{ 2.0, 3.0, 6.0, 8.0 }));
}

TEST(VoxelGrid, SlicesAreEvenOnALineOfEqualStepsWhichMayBeTilted)
{
  const auto isEven = [](const std::vector<PointType> & origins, double step) {
    return rhombic::DistanceFromEvenSlices(origins) <= rhombic::EvenSliceTolerance(step);
  };
  EXPECT_TRUE(isEven({ At(0, 0), At(0.5, 3), At(1, 6) }, 3.0));
  EXPECT_TRUE(isEven({ At(0, 0), At(0, 3.009), At(0, 6) }, 3.0));
  EXPECT_FALSE(isEven({ At(0, 0), At(0, 3.011), At(0, 6) }, 3.0));
  EXPECT_FALSE(isEven({ At(0, 0), At(0.011, 3), At(0, 6) }, 3.0));
  EXPECT_FALSE(isEven({ At(0, 0), At(0, 0.016), At(0, 0.02) }, 0.01)) << "thin slices: a tenth of a step";
  EXPECT_EQ(rhombic::DistanceFromEvenSlices({ At(0, 0) }), 0.0);
  EXPECT_EQ(rhombic::DistanceFromEvenSlices({}), 0.0);
}

} // namespace
