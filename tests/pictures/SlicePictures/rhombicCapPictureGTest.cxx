#include "rhombicSlicePicture.h"

#include "itkMultiThreaderBase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using rhombic::CapSurface;
using rhombic::DrawCap;
using rhombic::Outline;
using rhombic::Picture;
using rhombic::PicturePosition;

constexpr int Width = 40;
constexpr int Height = 30;

/** A slice of random greys. */
Picture
MakeSlice()
{
  Picture slice(Width, Height);
  std::mt19937 random(1);
  for (std::size_t n = 0; n < slice.pixels.size(); ++n)
  {
    slice.pixels[n] = n % 3 == 0 ? static_cast<std::uint8_t>(random() % 256) : slice.pixels[n - 1];
  }
  return slice;
}

/** Clockwise in the picture. */
Outline
Rectangle(double left, double top, double right, double bottom)
{
  return { { { left, top }, { right, top }, { right, bottom }, { left, bottom } }, true };
}

TEST(CapPicture, AlphaIsTheShareOfThePixelInside)
{
  const Picture slice = MakeSlice();
  const Picture cap = DrawCap(slice, { { { Rectangle(5.25, 6.5, 9.5, 8.0) } } });
  ASSERT_EQ(cap.channels, 4);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const double across = std::max(0.0, std::min(x + 1.0, 9.5) - std::max(x + 0.0, 5.25));
      const double down = std::max(0.0, std::min(y + 1.0, 8.0) - std::max(y + 0.0, 6.5));
      EXPECT_NEAR(cap.At(x, y)[3], 255.0 * across * down, 0.51);
      if (across * down > 0.0)
      {
        EXPECT_EQ(cap.At(x, y)[0], slice.At(x, y)[0]);
      }
    }
  }
}

/** The winding number of a polygon around a point. */
int
WindingOf(const Outline & outline, double x, double y)
{
  int winding = 0;
  for (std::size_t n = 0; n < outline.points.size(); ++n)
  {
    const PicturePosition & a = outline.points[n];
    const PicturePosition & b = outline.points[(n + 1) % outline.points.size()];
    if ((a.y <= y) != (b.y <= y) && a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) < x)
    {
      winding += a.y < b.y ? -1 : 1;
    }
  }
  return winding;
}

TEST(CapPicture, TrianglesInAndBesideThePictureHaveTheRightAreaInEachPixel)
{
  const Picture slice = MakeSlice();
  std::mt19937 random(2);
  for (int trial = 0; trial < 40; ++trial)
  {
    std::uniform_real_distribution<double> position(trial % 2 == 0 ? 0.0 : -60.0, trial % 2 == 0 ? 30.0 : 100.0);
    Outline outline;
    for (int n = 0; n < 3; ++n)
    {
      outline.points.push_back({ position(random), position(random) });
    }
    const Picture cap = DrawCap(slice, { { { outline } } });
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        constexpr int samples = 12;
        double inside = 0.0;
        for (int n = 0; n < samples * samples; ++n)
        {
          inside += std::abs(WindingOf(outline, x + (n % samples + 0.5) / samples, y + (n / samples + 0.5) / samples));
        }
        EXPECT_NEAR(cap.At(x, y)[3], 255.0 * inside / (samples * samples), 16.0);
      }
    }
  }
}

TEST(CapPicture, HolesAreTransparentAndOpenCurvesHaveNoInside)
{
  const Picture slice = MakeSlice();
  Outline hole = Rectangle(10.0, 10.0, 20.0, 20.0);
  std::swap(hole.points[1], hole.points[3]);
  Outline open = Rectangle(30.0, 5.0, 35.0, 15.0);
  open.isClosed = false;
  const Picture cap = DrawCap(slice, { { { Rectangle(5.0, 5.0, 25.0, 25.0), hole, open } } });
  EXPECT_EQ(cap.At(7, 7)[3], 255);
  EXPECT_EQ(cap.At(15, 15)[3], 0);
  EXPECT_EQ(cap.At(22, 15)[3], 255);
  EXPECT_EQ(cap.At(32, 10)[3], 0);
  EXPECT_EQ(cap.At(39, 15)[3], 0);
}

TEST(CapPicture, NeighboursLeaveNoGapAndTheLaterTintIsSeen)
{
  const Picture slice = MakeSlice();
  const rhombic::Colour red{ 1.0, 0.0, 0.0 };
  const rhombic::Colour blue{ 0.0, 0.0, 1.0 };
  const Outline left{ { { 5.0, 5.0 }, { 20.3, 5.0 }, { 14.7, 25.0 }, { 5.0, 25.0 } }, true };
  const Outline right{ { { 20.3, 5.0 }, { 35.0, 5.0 }, { 35.0, 25.0 }, { 14.7, 25.0 } }, true };
  const Picture neighbours = DrawCap(slice, { { { left }, red, 0.5 }, { { right }, blue, 0.5 } });
  for (int y = 5; y < 25; ++y)
  {
    for (int x = 5; x < 35; ++x)
    {
      EXPECT_GE(neighbours.At(x, y)[3], 254);
    }
  }
  const double grey = slice.At(7, 7)[0];
  EXPECT_NEAR(neighbours.At(7, 7)[0], 0.5 * grey + 127.5, 1.0);
  EXPECT_NEAR(neighbours.At(7, 7)[2], 0.5 * grey, 1.0);

  const Picture nested =
    DrawCap(slice, { { { Rectangle(5, 5, 35, 25) }, red, 1.0 }, { { Rectangle(10.5, 10, 30, 20) }, blue, 1.0 } });
  EXPECT_EQ(nested.At(7, 7)[0], 255);
  EXPECT_EQ(nested.At(7, 7)[2], 0);
  EXPECT_EQ(nested.At(20, 15)[0], 0);
  EXPECT_EQ(nested.At(20, 15)[2], 255);
  EXPECT_NEAR(nested.At(10, 15)[0], 127.5, 1.0);
  EXPECT_NEAR(nested.At(10, 15)[2], 127.5, 1.0);
  EXPECT_EQ(nested.At(10, 15)[3], 255);
}

TEST(CapPicture, TheNumberOfThreadsChangesNothing)
{
  const Picture slice = MakeSlice();
  const auto before = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  std::vector<std::uint8_t> expected;
  for (const itk::ThreadIdType threads : { 1, 2, 3, 8 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    const Picture cap =
      DrawCap(slice, { { { Rectangle(3.3, 2.2, 30.1, 28.8) } }, { { Rectangle(1.0, 9.0, 9.3, 30.9) } } });
    expected = expected.empty() ? cap.pixels : expected;
    EXPECT_EQ(cap.pixels, expected);
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(before);
  EXPECT_EQ(DrawCap(slice, {}).pixels, Picture(Width, Height, 4).pixels);
}

} // namespace
