#include "rhombicLabelOverlap.h"

#include "rhombicLabelScan.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::AffineMap;
using rhombic::LabelOverlap;
using rhombic::Scan;
using rhombictest::At;
using rhombictest::LabelFunction;
using rhombictest::LabelGrid;
using rhombictest::LabelImage;
using rhombictest::MakeLabelScan;
using PointType = itk::Point<double, 3>;

/** A label for the points of a box. */
LabelFunction
Box(int label, const PointType & low, const PointType & high)
{
  return [=](const PointType & point) {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (point[axis] < low[axis] || point[axis] > high[axis])
      {
        return 0;
      }
    }
    return label;
  };
}

const LabelGrid Fine{ { { 40, 40, 40 } }, { 1.0, 1.0, 1.0 } }; // voxels are centred at halves

TEST(LabelOverlap, VolumesAndCentroidsOfBoxes)
{
  const Scan map = MakeLabelScan({ { { 30, 40, 20 } }, { 0.5, 1.0, 2.0 }, At(7.0, 8.0, 9.0) },
                                 Box(3, At(5.0, 2.0, 1.0), At(7.0, 10.0, 9.0)));
  const auto moments = ComputeLabelMoments(map);
  ASSERT_EQ(moments.size(), 1u);
  EXPECT_NEAR(moments.at(3).volume, 2.0 * 8.0 * 8.0, 1e-9);
  EXPECT_NEAR(moments.at(3).centroid.EuclideanDistanceTo(At(6.0, 6.0, 5.0)), 0.0, 1e-9);
  EXPECT_EQ(moments.at(3).region.GetSize(), (itk::Size<3>{ { 4, 8, 4 } }));
  LabelImage & image = *std::get<LabelImage::Pointer>(map.image);
  for (const auto & index : { moments.at(3).region.GetIndex(), moments.at(3).region.GetUpperIndex() })
  {
    EXPECT_EQ(image.GetPixel(index), 3);
  }
}

TEST(LabelOverlap, CentroidOfUnevenSlices)
{
  Scan map = MakeLabelScan({ { { 2, 2, 3 } }, { 1.0, 1.0, 1.0 } }, [](const PointType &) { return 1; });
  const PointType first = rhombic::GeometryOf(map.image).GetOrigin();
  map.sliceOrigins = { first,
                       first + At(0.0, 0.0, 1.0).GetVectorFromOrigin(),
                       first + At(0.0, 0.0, 5.0).GetVectorFromOrigin() };
  const auto moments = ComputeLabelMoments(map);
  EXPECT_NEAR(moments.at(1).volume, 4.0 * (1.0 + 2.5 + 4.0), 1e-9);
  EXPECT_NEAR(moments.at(1).centroid[2] - first[2], (2.5 * 1.0 + 4.0 * 5.0) / 7.5, 1e-9);
}

TEST(LabelOverlap, BoxesThatShareAThird)
{
  const Scan first = MakeLabelScan(Fine, Box(1, At(-10.0, -10.0, -10.0), At(10.0, 10.0, 10.0)));
  const Scan second = MakeLabelScan(Fine, Box(7, At(0.0, -10.0, -10.0), At(20.0, 10.0, 10.0)));
  const LabelOverlap overlap = ComputeLabelOverlap(first, second);
  EXPECT_NEAR(overlap.first.at(1), 8000.0, 1e-9);
  EXPECT_NEAR(overlap.second.at(7), 8000.0, 1e-9);
  EXPECT_NEAR(overlap.GetDice(1, 7), 0.5, 1e-12);
  EXPECT_NEAR(overlap.GetIoU(1, 7), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(overlap.GetDice(1, 5), 0.0);
  EXPECT_EQ(overlap.GetDice(8, 9), 1.0) << "there is neither";
}

/** The second grid has twice the voxels along x, in the opposite direction, and is turned: its voxels are those of the
 * first in halves. */
TEST(LabelOverlap, OtherGridsOfTheSameSpace)
{
  itk::Matrix<double, 3, 3> turned; // columns along -x, rows along z, slices along y
  turned[0][0] = -1.0;
  turned[2][1] = 1.0;
  turned[1][2] = 1.0;
  const LabelFunction box = Box(2, At(-7.0, -3.0, -12.0), At(5.0, 11.0, 4.0));
  const Scan first = MakeLabelScan(Fine, box);
  const Scan second = MakeLabelScan({ { { 80, 40, 40 } }, { 0.5, 1.0, 1.0 }, {}, turned }, box);
  EXPECT_EQ(ComputeLabelOverlap(first, second).GetDice(2, 2), 1.0);
  EXPECT_NEAR(ComputeLabelMoments(second).at(2).volume, 12.0 * 14.0 * 16.0, 1e-9);
}

TEST(LabelOverlap, TransformsMapPointsOfTheFirst)
{
  const auto map = AffineMap::New();
  AffineMap::MatrixType quarter; // x to y, y to -x
  quarter[1][0] = 1.0;
  quarter[0][1] = -1.0;
  quarter[2][2] = 1.0;
  map->SetMatrix(quarter);
  map->SetOffset(At(3.0, 0.0, 2.0).GetVectorFromOrigin());
  const Scan first = MakeLabelScan(Fine, Box(1, At(1.0, 2.0, 3.0), At(6.0, 12.0, 5.0)));
  const Scan second = MakeLabelScan(Fine, Box(1, At(-9.0, 1.0, 5.0), At(1.0, 6.0, 7.0)));
  EXPECT_EQ(ComputeLabelOverlap(first, second, map).GetDice(1, 1), 1.0);
  EXPECT_LT(ComputeLabelOverlap(first, second).GetDice(1, 1), 0.1);
}

TEST(LabelOverlap, UnevenSlicesAreFoundByTheirPlaces)
{
  Scan second =
    MakeLabelScan({ { { 40, 40, 3 } }, { 1.0, 1.0, 1.0 } }, Box(1, At(-20.0, -20.0, -0.4), At(20.0, 20.0, 0.4)));
  const PointType first = rhombic::GeometryOf(second.image).GetOrigin();
  second.sliceOrigins = { first,
                          first + At(0.0, 0.0, 1.0).GetVectorFromOrigin(),
                          first + At(0.0, 0.0, 9.0).GetVectorFromOrigin() };
  // The middle slice, at z = 0, is nearest for z from -0.5 to 4.
  const Scan map = MakeLabelScan(Fine, Box(1, At(-20.0, -20.0, -0.5), At(20.0, 20.0, 4.0)));
  const LabelOverlap overlap = ComputeLabelOverlap(map, second);
  EXPECT_NEAR(overlap.second.at(1), 1600.0 * 4.0, 1600.0) << "z = -0.5 is half way to the slice before";
  EXPECT_GT(overlap.GetDice(1, 1), 0.88);
}

TEST(LabelOverlap, LayersCountEachVoxelOnce)
{
  Scan first = MakeLabelScan(Fine, Box(1, At(-10.0, -10.0, -10.0), At(10.0, 10.0, 10.0)));
  first.furtherLayers = { MakeLabelScan(Fine, Box(2, At(-5.0, -5.0, -5.0), At(5.0, 5.0, 5.0))).image };
  const Scan second = MakeLabelScan(Fine, Box(2, At(-5.0, -5.0, -5.0), At(5.0, 5.0, 5.0)));
  const LabelOverlap overlap = ComputeLabelOverlap(first, second);
  EXPECT_NEAR(overlap.first.at(1), 8000.0, 1e-9);
  EXPECT_NEAR(overlap.first.at(2), 1000.0, 1e-9);
  EXPECT_NEAR(overlap.second.at(2), 1000.0, 1e-9);
  EXPECT_EQ(overlap.GetDice(2, 2), 1.0);
  EXPECT_NEAR(overlap.GetDice(1, 2), 2000.0 / 9000.0, 1e-12);
}

} // namespace
