#include "rhombicFailure.h"
#include "rhombicLightbox.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using rhombic::LightboxColumns;
using rhombic::MakeLightbox;
using rhombic::Picture;

Picture
Plain(int width, int height, int channels, std::uint8_t value)
{
  Picture picture(width, height, channels);
  std::fill(picture.pixels.begin(), picture.pixels.end(), value);
  return picture;
}

TEST(Lightbox, ColumnsFollowTheAspect)
{
  EXPECT_EQ(LightboxColumns(1, 10, 10), 1);
  EXPECT_EQ(LightboxColumns(12, 100, 100), 4);      // 4 x 3 squares
  EXPECT_EQ(LightboxColumns(16, 100, 100, 1.0), 4); // square
  EXPECT_GE(LightboxColumns(12, 50, 200), 6);       // narrow tiles
  EXPECT_LT(LightboxColumns(12, 400, 100), 3);      // wide tiles
  for (int count = 1; count < 200; ++count)
  {
    const int columns = LightboxColumns(count, 100, 100);
    const int rows = (count + columns - 1) / columns;
    EXPECT_GE(columns * rows, count);
    EXPECT_LT((columns - 1) * rows, count) << "an empty column";
  }
}

TEST(Lightbox, EachPixelIsWhereItBelongs)
{
  std::vector<Picture> pictures;
  for (int i = 0; i < 7; ++i)
  {
    pictures.push_back(Plain(20, 30, 3, static_cast<std::uint8_t>(10 + i)));
  }
  const Picture page = MakeLightbox(pictures, 4, { 1.0, 0.0, 0.0 }, 3);
  ASSERT_EQ(page.width, 4 + 3 * 24);
  ASSERT_EQ(page.height, 4 + 3 * 34);
  for (int y = 0; y < page.height; ++y)
  {
    for (int x = 0; x < page.width; ++x)
    {
      const int column = x / 24;
      const int row = y / 34;
      const int i = 3 * row + column;
      const bool isPicture = x % 24 >= 4 && y % 34 >= 4 && i < 7;
      ASSERT_EQ(page.At(x, y)[0], isPicture ? 10 + i : 255) << x << ", " << y;
      ASSERT_EQ(page.At(x, y)[1], isPicture ? 10 + i : 0) << x << ", " << y;
    }
  }
}

TEST(Lightbox, SmallerPicturesLieInTheMiddleAndAlphaIsKept)
{
  const Picture page = MakeLightbox({ Plain(20, 20, 3, 50), Plain(10, 10, 4, 77) }, 0, {}, 2);
  ASSERT_EQ(page.channels, 4);
  EXPECT_EQ(page.At(5, 5)[3], 255);
  EXPECT_EQ(page.At(5, 5)[0], 50);
  EXPECT_EQ(page.At(22, 10)[3], 0);
  EXPECT_EQ(page.At(25, 5)[3], 77);
  EXPECT_EQ(page.At(34, 14)[3], 77);
  EXPECT_EQ(page.At(35, 15)[3], 0);
}

TEST(Lightbox, HasTheSizeThatIsGivenAndEvenGaps)
{
  const std::vector<Picture> pictures(6, Plain(20, 20, 3, 50));
  for (int more = 0; more < 12; ++more)
  {
    const Picture page = MakeLightbox(pictures, 4, {}, 3, 76 + more, 52 + more);
    ASSERT_EQ(page.width, 76 + more);
    ASSERT_EQ(page.height, 52 + more);
    std::vector<int> gaps{ 0 };
    for (int x = 0; x < page.width; ++x)
    {
      const bool isGap = page.At(x, 4 + more / 4)[0] == 0;
      gaps.back() += isGap ? 1 : 0;
      if (!isGap && gaps.back() > 0)
      {
        gaps.push_back(0);
      }
    }
    ASSERT_EQ(gaps.size(), 4u);
    for (const int gap : gaps)
    {
      EXPECT_GE(gap, 4);
      EXPECT_LE(gap, 4 + more / 3 + 1);
    }
  }
}

TEST(Lightbox, NoPictureIsUsage)
{
  EXPECT_THROW(MakeLightbox({}, 4, {}), rhombic::Failure);
}

} // namespace
