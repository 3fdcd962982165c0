#include "rhombicSlicePicture.h"

#include "rhombicSlicePlane.h"
#include "rhombicSliceTestScans.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using rhombic::Dot;
using rhombic::FrameOf;
using rhombic::GreyWindow;
using rhombic::Picture;
using rhombic::Projection;
using rhombic::Scan;
using rhombic::SlicePlane;
using rhombic::Vector3;
using slicetest::RandomFrame;

/** A sheared or tilted stack, with uneven and shifted slices if asked, of a linear field. */
Scan
MakeSlantedScan(bool isUneven, const Vector3 & gradient)
{
  const auto image = slicetest::MakeImage<float>({ 40, 32, 12 });
  const double spacing[3] = { 0.9, 1.1, 2.5 };
  image->SetSpacing(spacing);
  itk::Image<float, 3>::DirectionType direction;
  direction.SetIdentity();
  const double tilt = 0.3;
  direction[1][2] = std::sin(tilt);
  direction[2][2] = std::cos(tilt);
  image->SetDirection(direction);
  Scan scan;
  std::mt19937 random(5);
  double z = 0.0;
  for (int n = 0; isUneven && n < 12; ++n)
  {
    const double origin[3] = { 0.05 * static_cast<double>(random() % 20), 0.3 * z, z };
    scan.sliceOrigins.emplace_back(origin);
    z += 1.0 + 0.25 * static_cast<double>(random() % 8);
  }
  slicetest::Fill(*image, scan.sliceOrigins, [&gradient](const auto &, const auto & p) {
    return gradient[0] * p[0] + gradient[1] * p[1] + gradient[2] * p[2];
  });
  scan.image = image;
  return scan;
}

// Tilts, shears and steps keep every sample where it is: a linear field is exact in any plane.
TEST(SlicePicture, LinearFieldsAreExactInObliquePlanesOfSlantedStacks)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vector3 gradient{ 1.0, -0.7, 2.0 };
    const Scan scan = MakeSlantedScan(trial % 2 == 0, gradient);
    const auto box = BoxOf(scan);
    const auto frame = RandomFrame(random);
    const Projection plane = SliceThrough(SpreadEvenly(box, frame, 1)[0], box, frame, 0.5);
    const GreyWindow window{ 200.0, 20.0 };
    const Picture picture = DrawSlice(scan, plane, window, { 0, 0, 0, 0 });
    ASSERT_EQ(picture.channels, 4);
    int checked = 0;
    for (int y = 0; y < plane.height; ++y)
    {
      for (int x = 0; x < plane.width; ++x)
      {
        // Between the centres of the outermost samples. The slices' origins are at y = 0.3 z or a little more.
        const Vector3 point = plane.PointAt({ x + 0.5, y + 0.5 });
        if (point[0] > 1.0 && point[0] < 35.0 && point[1] > 0.31 * point[2] && point[1] < 34.0 + 0.3 * point[2] &&
            point[2] > 0.0 && point[2] < 15.0)
        {
          ++checked;
          EXPECT_NEAR(picture.At(x, y)[0], window.GreyOf(Dot(gradient, point)), 1);
        }
      }
    }
    EXPECT_GT(checked, 500);
  }
}

template <typename TPixel>
class SlicePictureOf : public testing::Test
{};
using AllPixels = testing::Types<RHOMBIC_PIXEL_TYPES>;
TYPED_TEST_SUITE(SlicePictureOf, AllPixels);

TYPED_TEST(SlicePictureOf, VoxelsAreShownAsTheyAre)
{
  const auto image = slicetest::MakeImage<TypeParam>({ 19, 17, 9 });
  const double spacing[3] = { 0.7, 0.7, 2.0 };
  image->SetSpacing(spacing);
  slicetest::Fill(*image, {}, [](const auto & i, const auto &) { return (i[0] * 31 + i[1] * 17 + i[2] * 7) % 200; });
  Scan scan;
  scan.image = image;
  const Projection plane =
    SliceThrough(PointAtIndex(scan, SlicePlane::Axial, 5), BoxOf(scan), FrameOf(SlicePlane::Axial));
  const Picture picture = DrawSlice(scan, plane, { 255.0, 127.5 });
  ASSERT_EQ(picture.width, 19);
  ASSERT_EQ(picture.height, 17);
  ASSERT_EQ(picture.channels, 3);
  for (int y = 0; y < 17; ++y)
  {
    for (int x = 0; x < 19; ++x)
    {
      EXPECT_EQ(picture.At(x, y)[1], (x * 31 + y * 17 + 5 * 7) % 200);
    }
  }
}

/** The same voxels, stored along other axes: axis n of the copy is axis order[n], backwards where \a flips says so. */
Scan
Reorder(const itk::Image<std::int16_t, 3> & image, const std::array<unsigned int, 3> & order, unsigned int flips)
{
  using Image = itk::Image<std::int16_t, 3>;
  const auto size = image.GetBufferedRegion().GetSize();
  const auto copy = slicetest::MakeImage<std::int16_t>({ size[order[0]], size[order[1]], size[order[2]] });
  Image::DirectionType direction;
  Image::SpacingType spacing;
  Image::IndexType first{};
  direction.Fill(0.0);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const bool isFlipped = (flips >> axis & 1) != 0;
    direction[order[axis]][axis] = isFlipped ? -1.0 : 1.0;
    spacing[axis] = image.GetSpacing()[order[axis]];
    first[order[axis]] = isFlipped ? static_cast<long>(size[order[axis]]) - 1 : 0;
  }
  copy->SetDirection(direction);
  copy->SetSpacing(spacing);
  copy->SetOrigin(image.TransformIndexToPhysicalPoint<double>(first));
  slicetest::Fill(*copy, {}, [&](const auto & index, const auto &) {
    auto source = first;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      source[order[axis]] += (flips >> axis & 1) != 0 ? -index[axis] : index[axis];
    }
    return image.GetPixel(source);
  });
  Scan scan;
  scan.image = copy;
  return scan;
}

TEST(SlicePicture, The48WaysToStoreAVolumeGiveOnePicture)
{
  const auto image = slicetest::MakeImage<std::int16_t>({ 21, 16, 11 });
  const double spacing[3] = { 0.5, 0.75, 1.25 };
  const double origin[3] = { -3.0, 8.0, 40.0 };
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  std::mt19937 random(3);
  slicetest::Fill(*image, {}, [&random](const auto &, const auto &) { return random() % 256; });
  std::array<unsigned int, 3> order{ 0, 1, 2 };
  std::array<Picture, 3> expected;
  do
  {
    for (unsigned int flips = 0; flips < 8; ++flips)
    {
      const Scan scan = Reorder(*image, order, flips);
      const auto box = BoxOf(scan);
      for (const SlicePlane plane : { SlicePlane::Axial, SlicePlane::Coronal, SlicePlane::Sagittal })
      {
        const double position = plane == SlicePlane::Axial ? 46.3 : plane == SlicePlane::Coronal ? 12.1 : 2.2;
        const Picture picture =
          DrawSlice(scan, SliceThrough(PointAtPosition(box, plane, position), box, FrameOf(plane)), { 256.0, 128.0 });
        Picture & first = expected[static_cast<std::size_t>(plane)];
        if (first.width == 0)
        {
          first = picture;
        }
        ASSERT_EQ(picture.pixels.size(), first.pixels.size());
        for (std::size_t n = 0; n < first.pixels.size(); ++n)
        {
          ASSERT_NEAR(picture.pixels[n], first.pixels[n], 1);
        }
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SlicePicture, OutsideTheScanIsBackground)
{
  const auto image = slicetest::MakeImage<float>({ 4, 4, 1 });
  image->FillBuffer(10.0f);
  image->SetPixel({ { 1, 2, 0 } }, std::nanf(""));
  Scan scan;
  scan.image = image;
  Projection plane{ FrameOf(SlicePlane::Axial), { 1.5, 1.5, 0.0 }, 1.0, 8, 8 };
  const auto countBackground = [&] {
    const Picture picture = DrawSlice(scan, plane, { 2.0, 10.0 }, { 1, 2, 3, 255 });
    int count = 0;
    for (int n = 0; n < 64; ++n)
    {
      const std::uint8_t * const pixel = picture.At(n % 8, n / 8);
      const bool isBackground = pixel[0] == 1 && pixel[1] == 2 && pixel[2] == 3;
      EXPECT_TRUE(isBackground || (pixel[0] == 128 && pixel[2] == 128));
      count += isBackground ? 1 : 0;
    }
    return count;
  };
  // Next to a sample that is no number, values are none either: the weight 0 doesn't help.
  EXPECT_GE(countBackground(), 49);
  EXPECT_LE(countBackground(), 52);
  plane.centre[2] = 0.49; // one slice is as thick as its voxels
  EXPECT_LE(countBackground(), 52);
  plane.centre[2] = 0.51;
  EXPECT_EQ(countBackground(), 64);
}

TEST(SlicePicture, PlanesInTheOuterFacesAreInTheScan)
{
  std::mt19937 random(12);
  for (int trial = 0; trial < 60; ++trial)
  {
    const auto image = slicetest::MakeImage<float>({ 7, 5, 6 });
    image->FillBuffer(1.0f);
    const auto axes = RandomFrame(random);
    itk::Image<float, 3>::DirectionType direction;
    itk::Image<float, 3>::SpacingType spacing;
    for (unsigned int row = 0; row < 3; ++row)
    {
      direction[row][0] = axes.right[row];
      direction[row][1] = axes.up[row];
      direction[row][2] = axes.look[row];
      spacing[row] = 0.3 + 0.1 * static_cast<double>(random() % 30);
    }
    image->SetDirection(direction);
    image->SetSpacing(spacing);
    Scan scan;
    scan.image = image;
    const auto box = BoxOf(scan);
    const auto axis = static_cast<std::size_t>(trial % 3);
    const Vector3 & side = box.sides[axis];
    Vector3 point = box.corner;
    for (std::size_t row = 0; trial % 2 == 0 && row < 3; ++row)
    {
      point[row] += side[row];
    }
    const Projection face = SliceOfSize(9, 9, point, box, slicetest::FrameAlong(side, box.sides[(axis + 1) % 3]));
    EXPECT_EQ(DrawSlice(scan, face, { 2.0, 1.0 }).At(4, 4)[0], 128);
  }
}

/** A ramp of a smooth field between coarse samples: cubic curves are nearer to it than lines, by far. */
TEST(SlicePicture, SmoothFieldsAreFollowedBetweenSamples)
{
  const auto image = slicetest::MakeImage<float>({ 30, 30, 12 });
  const auto field = [](const Vector3 & p) { return 100.0 * std::sin(0.9 * p[0]) * std::cos(0.8 * p[1] + 0.7 * p[2]); };
  slicetest::Fill(*image, {}, [&field](const auto & i, const auto &) {
    return field({ static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2]) });
  });
  Scan scan;
  scan.image = image;
  const Projection plane{ FrameOf(SlicePlane::Axial), { 14.5, 14.5, 5.37 }, 0.1, 240, 240 };
  const GreyWindow window{ 256.0, 0.0 };
  const Picture picture = DrawSlice(scan, plane, window);
  double sum = 0.0;
  for (int n = 0; n < 240 * 240; ++n)
  {
    const double value = field(plane.PointAt({ n % 240 + 0.5, n / 240 + 0.5 }));
    sum += std::abs(picture.At(n % 240, n / 240)[0] - 255.0 * (value / 256.0 + 0.5));
  }
  EXPECT_LT(sum / (240 * 240), 3.0); // linear interpolation: 9
}

TEST(SlicePicture, EdgesHaveNoRims)
{
  const auto image = slicetest::MakeImage<std::int16_t>({ 16, 16, 8 });
  slicetest::Fill(*image, {}, [](const auto & i, const auto &) { return i[0] + i[1] + i[2] > 17 ? 100 : 20; });
  Scan scan;
  scan.image = image;
  const auto box = BoxOf(scan);
  for (const SlicePlane plane : { SlicePlane::Axial, SlicePlane::Coronal, SlicePlane::Sagittal })
  {
    const Picture picture =
      DrawSlice(scan, SliceThrough(PointAtPosition(box, plane, 3.4), box, FrameOf(plane), 0.13), { 255.0, 127.5 });
    const auto [least, most] = std::minmax_element(picture.pixels.begin(), picture.pixels.end());
    EXPECT_GE(*least, 20);
    EXPECT_LE(*most, 100);
  }
}

TEST(SlicePicture, TheNumberOfThreadsChangesNothing)
{
  const Scan scan = MakeSlantedScan(true, { 1.0, 2.0, 3.0 });
  std::mt19937 random(9);
  const auto frame = RandomFrame(random);
  const auto box = BoxOf(scan);
  const Projection plane = SliceThrough(SpreadEvenly(box, frame, 1)[0], box, frame, 0.2);
  const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  std::vector<std::uint8_t> expected;
  for (const itk::ThreadIdType threads : { 1, 2, 3, 8 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const Picture picture = DrawSlice(scan, plane, { 100.0, 50.0 });
    expected = expected.empty() ? picture.pixels : expected;
    EXPECT_EQ(picture.pixels, expected);
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
}

} // namespace
