#include "rhombicFailure.h"
#include "rhombicPictureComparison.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using rhombic::ComparePictures;
using rhombic::Picture;

TEST(PictureComparison, IdenticalPicturesDoNotDiffer)
{
  const Picture picture(20, 10);
  const auto difference = ComparePictures(picture, picture, 0.0);
  EXPECT_EQ(difference.meanError, 0.0);
  EXPECT_EQ(difference.rmsError, 0.0);
  EXPECT_EQ(difference.maxError, 0.0);
  EXPECT_EQ(difference.differingPixels, 0u);
}

TEST(PictureComparison, FindsOneChangedPixel)
{
  const Picture a(20, 10);
  Picture b(20, 10);
  b.pixels[(7 * 20 + 3) * 3 + 1] = 51;
  const auto difference = ComparePictures(a, b, 0.1);
  EXPECT_EQ(difference.differingPixels, 1u);
  EXPECT_NEAR(difference.maxError, 0.2, 1e-6);
  EXPECT_NEAR(difference.meanError, 0.2 / 600.0, 1e-8);
  EXPECT_NEAR(difference.rmsError, 0.2 / std::sqrt(600.0), 1e-7);
  EXPECT_EQ(difference.worstX, 3);
  EXPECT_EQ(difference.worstY, 7);
}

TEST(PictureComparison, ThresholdIsAllowed)
{
  const Picture a(20, 10);
  Picture b(20, 10);
  b.pixels[0] = 51;
  EXPECT_EQ(ComparePictures(a, b, 0.21).differingPixels, 0u);
  EXPECT_EQ(ComparePictures(a, b, 0.19).differingPixels, 1u);
}

TEST(PictureComparison, OtherSizeIsAFailure)
{
  EXPECT_THROW(ComparePictures(Picture(20, 10), Picture(10, 20), 0.0), rhombic::Failure);
  EXPECT_THROW(ComparePictures(Picture(20, 10), Picture(20, 11), 0.0), rhombic::Failure);
  EXPECT_THROW(ComparePictures(Picture(), Picture(), 0.0), rhombic::Failure);
}

} // namespace
