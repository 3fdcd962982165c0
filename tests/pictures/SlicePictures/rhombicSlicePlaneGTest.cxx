#include "rhombicSlicePlane.h"

#include "rhombicFailure.h"
#include "rhombicSliceTestScans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using rhombic::Dot;
using rhombic::FrameOf;
using rhombic::Projection;
using rhombic::SliceBox;
using rhombic::SliceConvention;
using rhombic::SlicePlane;
using rhombic::Vector3;

constexpr std::array<SlicePlane, 3> AllPlanes{ SlicePlane::Axial, SlicePlane::Coronal, SlicePlane::Sagittal };

std::string
Letters(SlicePlane plane, SliceConvention convention)
{
  const auto letters = rhombic::EdgeLettersOf(FrameOf(plane, convention));
  return letters.left + letters.right + letters.top + letters.bottom;
}

TEST(SlicePlane, PicturesLieAsRadiologistsAndNeurologistsExpect)
{
  EXPECT_EQ(Letters(SlicePlane::Axial, SliceConvention::Radiological), "RLAP");
  EXPECT_EQ(Letters(SlicePlane::Coronal, SliceConvention::Radiological), "RLHF");
  EXPECT_EQ(Letters(SlicePlane::Sagittal, SliceConvention::Radiological), "APHF");
  EXPECT_EQ(Letters(SlicePlane::Axial, SliceConvention::Neurological), "LRAP");
  EXPECT_EQ(Letters(SlicePlane::Coronal, SliceConvention::Neurological), "LRHF");
  EXPECT_EQ(Letters(SlicePlane::Sagittal, SliceConvention::Neurological), "APHF");
}

TEST(SlicePlane, NamesAreReadBack)
{
  for (const SlicePlane plane : AllPlanes)
  {
    EXPECT_EQ(rhombic::SlicePlaneFromName(NameOf(plane)), plane);
  }
  EXPECT_EQ(rhombic::SlicePlaneFromName("Coronal"), SlicePlane::Coronal);
  EXPECT_THROW(rhombic::SlicePlaneFromName("axail"), rhombic::Failure);
}

/** A scan of random size and spacing, turned, and half of the time with tilted and uneven slices. */
rhombic::Scan
MakeRandomScan(std::mt19937 & random)
{
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto image = slicetest::MakeImage<std::int16_t>({ 5 + random() % 30, 5 + random() % 30, 3 + random() % 10 });
  const double spacing[3] = { 0.5 + uniform(random), 0.5 + uniform(random), 0.5 + 3 * uniform(random) };
  image->SetSpacing(spacing);
  itk::Matrix<double, 3, 3> direction;
  const auto axes = slicetest::RandomFrame(random);
  for (unsigned int row = 0; row < 3; ++row)
  {
    direction[row][0] = axes.right[row];
    direction[row][1] = axes.up[row];
    direction[row][2] = axes.look[row];
  }
  image->SetDirection(direction);
  rhombic::Scan scan;
  if (random() % 2 == 0)
  {
    itk::Point<double, 3> origin = image->GetOrigin();
    for (std::size_t n = 0; n < image->GetBufferedRegion().GetSize(2); ++n)
    {
      scan.sliceOrigins.push_back(origin);
      for (unsigned int row = 0; row < 3; ++row)
      {
        origin[row] += (1.0 + uniform(random)) * direction[row][2] + 0.4 * uniform(random) * direction[row][1];
      }
    }
  }
  scan.image = image;
  return scan;
}

/** The smallest rectangle of a picture around points. */
struct Bounds
{
  rhombic::PicturePosition lowest{ 1e9, 1e9 };
  rhombic::PicturePosition highest{ -1e9, -1e9 };

  void
  Add(const rhombic::PicturePosition & position)
  {
    lowest = { std::min(lowest.x, position.x), std::min(lowest.y, position.y) };
    highest = { std::max(highest.x, position.x), std::max(highest.y, position.y) };
  }
};

Bounds
BoundsOfBox(const SliceBox & box, const Projection & slice)
{
  Bounds bounds;
  for (unsigned int n = 0; n < 8; ++n)
  {
    Vector3 corner = box.corner;
    for (std::size_t row = 0; row < 3; ++row)
    {
      corner[row] += (n & 1) * box.sides[0][row] + (n >> 1 & 1) * box.sides[1][row] + (n >> 2) * box.sides[2][row];
    }
    bounds.Add(slice.PositionOf(corner));
  }
  return bounds;
}

/** The first and last voxels of the first and last rows of all slices. */
Bounds
BoundsOfVoxels(const rhombic::Scan & scan, const Projection & slice)
{
  const auto & grid = rhombic::GeometryOf(scan.image);
  const auto last = grid.GetLargestPossibleRegion().GetUpperIndex();
  Bounds bounds;
  for (long n = 0; n <= last[2]; ++n)
  {
    for (const long row : { 0L, static_cast<long>(last[1]) })
    {
      for (const long column : { 0L, static_cast<long>(last[0]) })
      {
        auto voxel = grid.TransformIndexToPhysicalPoint<double>({ { column, row, n } });
        if (!scan.sliceOrigins.empty())
        {
          voxel += scan.sliceOrigins[static_cast<std::size_t>(n)] -
                   grid.TransformIndexToPhysicalPoint<double>({ { 0, 0, n } });
        }
        bounds.Add(slice.PositionOf({ voxel[0], voxel[1], voxel[2] }));
      }
    }
  }
  return bounds;
}

TEST(SlicePlane, TheBoxHoldsAllVoxelsAndThePictureTheBox)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial)
  {
    const rhombic::Scan scan = MakeRandomScan(random);
    const SliceBox box = BoxOf(scan);
    const auto frame = trial % 4 == 3 ? slicetest::RandomFrame(random) : FrameOf(AllPlanes[trial % 3]);
    const Vector3 middle = SpreadEvenly(box, frame, 1)[0];
    for (const Projection & slice : { SliceThrough(middle, box, frame), SliceOfSize(200, 100, middle, box, frame) })
    {
      const Bounds boxBounds = BoundsOfBox(box, slice);
      constexpr double rounding = 1e-5;
      EXPECT_GE(boxBounds.lowest.x, -rounding);
      EXPECT_GE(boxBounds.lowest.y, -rounding);
      EXPECT_LE(boxBounds.highest.x, slice.width + rounding);
      EXPECT_LE(boxBounds.highest.y, slice.height + rounding);
      const double emptyColumns = slice.width - (boxBounds.highest.x - boxBounds.lowest.x);
      const double emptyRows = slice.height - (boxBounds.highest.y - boxBounds.lowest.y);
      EXPECT_LT(std::min(emptyColumns, emptyRows), 1.0); // no larger than it must be

      const Bounds voxelBounds = BoundsOfVoxels(scan, slice);
      EXPECT_GT(voxelBounds.lowest.x, boxBounds.lowest.x);
      EXPECT_GT(voxelBounds.lowest.y, boxBounds.lowest.y);
      EXPECT_LT(voxelBounds.highest.x, boxBounds.highest.x);
      EXPECT_LT(voxelBounds.highest.y, boxBounds.highest.y);
    }
  }
}

rhombic::Scan
MakeAxialScan()
{
  const auto image = slicetest::MakeImage<std::int16_t>({ 40, 30, 10 });
  const double spacing[3] = { 0.8, 0.8, 3.0 };
  const double origin[3] = { -10.0, 20.0, 100.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  rhombic::Scan scan;
  scan.image = image;
  return scan;
}

TEST(SlicePlane, PixelsOfAxialSlicesAreVoxels)
{
  const rhombic::Scan scan = MakeAxialScan();
  const SliceBox box = BoxOf(scan);
  const Projection axial = SliceThrough(PointAtIndex(scan, SlicePlane::Axial, 4), box, FrameOf(SlicePlane::Axial));
  EXPECT_EQ(axial.width, 40);
  EXPECT_EQ(axial.height, 30);
  EXPECT_DOUBLE_EQ(axial.pixelSize, 0.8);
  const Vector3 firstVoxel = axial.PointAt({ 0.5, 0.5 });
  EXPECT_NEAR(firstVoxel[0], -10.0, 1e-9);
  EXPECT_NEAR(firstVoxel[1], 20.0, 1e-9);
  EXPECT_NEAR(firstVoxel[2], 112.0, 1e-9);
  const Projection coronal =
    SliceThrough(PointAtPosition(box, SlicePlane::Coronal, 31.5), box, FrameOf(SlicePlane::Coronal));
  EXPECT_EQ(coronal.width, 40);
  EXPECT_EQ(coronal.height, 38); // 10 * 3.0 / 0.8, rounded up: the aspect is true
  EXPECT_DOUBLE_EQ(coronal.centre[1], 31.5);
}

TEST(SlicePlane, ImpossibleSlicesAreRefused)
{
  const rhombic::Scan scan = MakeAxialScan();
  const SliceBox box = BoxOf(scan);
  const auto frame = FrameOf(SlicePlane::Axial);
  EXPECT_NO_THROW(SliceThrough(PointAtPosition(box, SlicePlane::Axial, 98.5), box, frame)); // the outer face
  EXPECT_THROW(SliceThrough(PointAtPosition(box, SlicePlane::Axial, 98.4), box, frame), rhombic::Failure);
  EXPECT_THROW(SliceThrough(PointAtPosition(box, SlicePlane::Axial, std::nan("")), box, frame), rhombic::Failure);
  EXPECT_THROW(PointAtIndex(scan, SlicePlane::Axial, 10), rhombic::Failure);
  EXPECT_THROW(PointAtIndex(scan, SlicePlane::Sagittal, 40), rhombic::Failure);
  const Vector3 inside = PointAtPosition(box, SlicePlane::Axial, 110.0);
  EXPECT_THROW(SliceThrough(inside, box, frame, 1e-9), rhombic::Failure);
  EXPECT_THROW(SliceThrough(inside, box, frame, -1.0), rhombic::Failure);
}

TEST(SlicePlane, TheIndexFollowsUnevenSlices)
{
  rhombic::Scan scan = MakeAxialScan();
  for (int n = 0; n < 10; ++n)
  {
    const double origin[3] = { -10.0, 20.0 + 0.5 * n, 100.0 + n * n };
    scan.sliceOrigins.emplace_back(origin);
  }
  const Vector3 point = PointAtIndex(scan, SlicePlane::Axial, 7);
  EXPECT_NEAR(point[0], -10.0 + 0.8 * 19.5, 1e-9);
  EXPECT_NEAR(point[1], 23.5 + 0.8 * 14.5, 1e-9);
  EXPECT_NEAR(point[2], 149.0, 1e-9);
}

TEST(SlicePlane, SlicesLieBetweenMargins)
{
  const SliceBox box = rhombic::BoxOf({ 0, 0, 10 }, { 50, 60, 110 }, { 1, 1, 1 });
  for (const SlicePlane plane : { SlicePlane::Axial, SlicePlane::Coronal, SlicePlane::Sagittal })
  {
    const rhombic::Margins margins{ 11.0, 40.0, 25.0, 5.0 };
    const auto frame = FrameOf(plane);
    const Projection slice = rhombic::SliceOfSize(300, 200, { 20, 30, 50 }, box, frame, margins);
    double left = 1e9;
    double right = -1e9;
    double top = 1e9;
    double bottom = -1e9;
    for (int corner = 0; corner < 8; ++corner)
    {
      const auto position =
        slice.PositionOf({ corner & 1 ? 50.0 : 0.0, corner & 2 ? 60.0 : 0.0, corner & 4 ? 110.0 : 10.0 });
      left = std::min(left, position.x);
      right = std::max(right, position.x);
      top = std::min(top, position.y);
      bottom = std::max(bottom, position.y);
    }
    EXPECT_NEAR(left - 11.0, 260.0 - right, 1e-9);
    EXPECT_NEAR(top - 25.0, 195.0 - bottom, 1e-9);
    EXPECT_NEAR(std::min(left - 11.0, top - 25.0), 0.0, 1e-9);
  }
}

TEST(SlicePlane, SlicesOfALightboxDivideTheBoxEvenly)
{
  const SliceBox box = rhombic::BoxOf({ 0, 0, 10 }, { 50, 60, 110 }, { 1, 1, 1 });
  const auto points = SpreadEvenly(box, FrameOf(SlicePlane::Axial), 4);
  ASSERT_EQ(points.size(), 4U);
  for (std::size_t n = 0; n < 4; ++n)
  {
    EXPECT_DOUBLE_EQ(points[n][2], 22.5 + 25.0 * static_cast<double>(n)); // seen from the feet: these come first
    EXPECT_NO_THROW(SliceThrough(points[n], box, FrameOf(SlicePlane::Axial)));
  }
  EXPECT_DOUBLE_EQ(SpreadEvenly(box, FrameOf(SlicePlane::Sagittal), 1)[0][0], 25.0);
}

} // namespace
