#include "rhombicAnnotations.h"
#include "rhombicPdfText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <thread>

namespace
{

using namespace rhombic;

const ViewFrame Anterior{ { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };

Annotations
OnlyScaleBar()
{
  Annotations annotations;
  annotations.letters = false;
  annotations.figure = false;
  return annotations;
}

/** "structure 017": no name is part of another. */
std::string
NameOf(std::size_t i)
{
  return "structure " + std::to_string(1000 + i).substr(1);
}

std::vector<LegendRow>
Legend(std::size_t count)
{
  std::vector<LegendRow> rows(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    rows[i].name = NameOf(i);
    rows[i].volume = 1000.0 / static_cast<double>(i + 1);
  }
  return rows;
}

ViewFrame
RandomFrame(std::mt19937 & random)
{
  std::normal_distribution<double> normal;
  const auto unit = [](Vector3 v) {
    const double length = std::sqrt(Dot(v, v));
    return Vector3{ v[0] / length, v[1] / length, v[2] / length };
  };
  ViewFrame frame;
  frame.look = unit({ normal(random), normal(random), normal(random) });
  frame.up = unit(Cross(frame.look, { normal(random), normal(random), normal(random) }));
  frame.right = Cross(frame.look, frame.up);
  return frame;
}

TEST(Annotations, ScaleBarLengthsAreOneTwoOrFive)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-3.0, 4.0);
  for (int trial = 0; trial < 10000; ++trial)
  {
    const double longest = std::pow(10.0, exponent(random));
    const double length = ScaleBarLength(longest);
    EXPECT_LE(length, longest);
    EXPECT_GT(2.5000001 * length, longest);
    const double digit = length / std::pow(10.0, std::floor(std::log10(length) + 1e-9));
    EXPECT_LT(std::min({ std::abs(digit - 1.0), std::abs(digit - 2.0), std::abs(digit - 5.0) }), 1e-9) << length;
  }
  EXPECT_EQ(FormatLength(50.0), "5 cm");
  EXPECT_EQ(FormatLength(10.0), "1 cm");
  EXPECT_EQ(FormatLength(5.0), "5 mm");
  EXPECT_EQ(FormatLength(0.5), "0.5 mm");
}

/** White on black without a halo that is seen: the bar's lowest row has its length in white. */
TEST(Annotations, ScaleBarHasItsLengthInPixels)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> size(0.05, 3.0);
  std::uniform_int_distribution<int> side(400, 1500);
  for (int trial = 0; trial < 40; ++trial)
  {
    Picture picture(side(random), side(random));
    const Projection projection{ Anterior, {}, size(random), picture.width, picture.height };
    Annotate(picture, projection, OnlyScaleBar());
    int bottom = picture.height - 1;
    while (*std::max_element(picture.At(0, bottom), picture.At(0, bottom) + 3 * picture.width) == 0)
    {
      --bottom;
    }
    int first = -1;
    double length = 0.0;
    const double white = *std::max_element(picture.At(0, bottom), picture.At(0, bottom) + 3 * picture.width);
    for (int x = 0; x < picture.width; ++x)
    {
      const int value = picture.At(x, bottom)[0];
      first = first < 0 && value > 0 ? x : first;
      length += value / white;
    }
    EXPECT_NEAR(picture.At(first, bottom)[0], white, 2.0); // begins at the edge of a pixel
    const double millimetres = length * projection.pixelSize;
    const double expected = ScaleBarLength(1.02 * millimetres);
    EXPECT_NEAR(length, expected / projection.pixelSize, 0.02) << expected << " mm";
  }
}

TEST(Annotations, MarginsLeaveTheSceneFree)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<int> side(512, 1400);
  std::uniform_int_distribution<std::size_t> rows(0, 80);
  for (int trial = 0; trial < 60; ++trial)
  {
    Annotations annotations;
    annotations.figure = false; // covers a corner
    annotations.letters = trial % 3 != 0;
    annotations.scaleBar = trial % 4 != 0;
    annotations.title = trial % 5 != 0 ? "Abdomen, portal venous phase" : "";
    annotations.footnote = trial % 2 != 0 ? "first line\nsecond line" : "";
    annotations.legend = Legend(trial % 7 != 0 ? rows(random) : 0);
    Picture picture(side(random), side(random), 4); // transparent
    annotations.background.opacity = 0.0;
    const Projection projection{ RandomFrame(random), {}, 0.5, picture.width, picture.height };
    const Margins margins = MarginsOf(annotations, picture.width, picture.height, projection.frame);
    EXPECT_GT(picture.width - margins.left - margins.right, 0.35 * picture.width);
    EXPECT_GT(picture.height - margins.top - margins.bottom, 0.6 * picture.height);
    Annotate(picture, projection, annotations);
    for (int y = static_cast<int>(std::ceil(margins.top)); y < picture.height - margins.bottom - 1.0; ++y)
    {
      for (int x = static_cast<int>(std::ceil(margins.left)); x < picture.width - margins.right - 1.0; ++x)
      {
        ASSERT_EQ(picture.At(x, y)[3], 0) << x << ", " << y << " of " << picture.width << " x " << picture.height;
      }
    }
  }
}

/** The letters at the edges, read from left to right in each line of text. */
TEST(Annotations, LettersAreThoseOfTheFrame)
{
  std::mt19937 random(4);
  for (int trial = 0; trial < 12; ++trial)
  {
    Annotations annotations;
    annotations.scaleBar = false;
    const Projection projection{ trial == 0 ? Anterior : RandomFrame(random), {}, 1.0, 800, 800 };
    Drawing drawing(800, 800, 100.0, {});
    DrawAnnotations(drawing, { 0.0, 0.0, 800.0, 800.0 }, projection, annotations);
    const auto text = rhombictest::TextOfPdf(drawing.TakeDocument());
    if (!text)
    {
      GTEST_SKIP() << "pdftotext is not installed";
    }
    std::string letters;
    std::copy_if(text->begin(), text->end(), std::back_inserter(letters), [](char c) { return std::isalpha(c) != 0; });
    const EdgeLetters expected = EdgeLettersOf(projection.frame);
    EXPECT_EQ(letters, expected.top + expected.left + expected.right + expected.bottom);
  }
}

TEST(Annotations, LegendShowsAllOrCountsTheRest)
{
  for (const auto & [side, count] :
       std::vector<std::pair<int, std::size_t>>{ { 512, 5 }, { 512, 62 }, { 1600, 62 }, { 1600, 200 }, { 8192, 200 } })
  {
    Annotations annotations = OnlyScaleBar();
    annotations.legend = Legend(count);
    Drawing drawing(side, side, 100.0, {});
    const double extent = side;
    DrawAnnotations(drawing, { 0.0, 0.0, extent, extent }, { Anterior, {}, 1.0, side, side }, annotations);
    const auto text = rhombictest::TextOfPdf(drawing.TakeDocument());
    if (!text)
    {
      GTEST_SKIP() << "pdftotext is not installed";
    }
    std::size_t shown = 0;
    while (shown < count && text->find(NameOf(shown)) != std::string::npos)
    {
      ++shown;
    }
    if (side == 512 && count == 62)
    {
      EXPECT_LT(shown, count);
      EXPECT_NE(text->find("and " + std::to_string(count - shown) + " more"), std::string::npos) << *text;
    }
    else if (count <= 62)
    {
      EXPECT_EQ(shown, count);
      EXPECT_EQ(text->find(" more"), std::string::npos);
    }
    else if (shown < count)
    {
      EXPECT_NE(text->find("and " + std::to_string(count - shown) + " more"), std::string::npos) << *text;
    }
  }
}

TEST(Annotations, LegendsHaveAColumnOfTheirOwnOfAFifthAtMost)
{
  for (const int width : { 300, 700, 1600 })
  {
    for (const std::size_t count : { 2, 12, 70 })
    {
      Annotations annotations = OnlyScaleBar();
      annotations.scaleBar = false;
      annotations.legend = Legend(count);
      annotations.legend[0].name = "a name that is longer than any other one by far";
      annotations.background = { { 0.2, 0.4, 0.6 } };
      const Margins margins = MarginsOf(annotations, width, 900, Anterior);
      EXPECT_LE(margins.right, 0.2 * width + 1e-9);
      Picture picture(width, 900);
      std::fill(picture.pixels.begin(), picture.pixels.end(), std::uint8_t{ 250 }); // a scene that fills the picture
      Annotate(picture, { Anterior, {}, 1.0, width, 900 }, annotations);
      const auto column = static_cast<int>(std::ceil(width - margins.right));
      EXPECT_EQ(picture.At(column - 1, 450)[0], 250);
      EXPECT_EQ(picture.At(column, 890)[2], 153);
      EXPECT_EQ(picture.At(width - 1, 450)[0], 51);
    }
  }
}

TEST(Annotations, LongLegendsHaveHeadingsOfGroups)
{
  for (const std::size_t count : { 9, 10 })
  {
    Annotations annotations = OnlyScaleBar();
    annotations.legend = Legend(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      annotations.legend[i].group = i % 3 == 0 ? "bones" : i % 3 == 1 ? "" : "vessels";
    }
    Drawing drawing(900, 900, 100.0, {});
    DrawAnnotations(drawing, { 0.0, 0.0, 900.0, 900.0 }, { Anterior, {}, 1.0, 900, 900 }, annotations);
    const auto text = rhombictest::TextOfPdf(drawing.TakeDocument());
    if (!text)
    {
      GTEST_SKIP() << "pdftotext is not installed";
    }
    const auto bones = text->find("bones");
    EXPECT_EQ(bones == std::string::npos, count == 9);
    if (count == 10)
    {
      EXPECT_LT(bones, text->find(NameOf(3)));
      EXPECT_LT(text->find(NameOf(9)), text->find("vessels"));
      EXPECT_LT(text->find("vessels"), text->find("other"));
      EXPECT_LT(text->find("other"), text->find(NameOf(1)));
    }
  }
}

/** CIE L*, a* and b* (D65). */
std::array<double, 3>
ToLab(const Colour & colour)
{
  const std::array<double, 3> rgb{ SRGBToLinear(colour[0]), SRGBToLinear(colour[1]), SRGBToLinear(colour[2]) };
  const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double x = f((0.4124564 * rgb[0] + 0.3575761 * rgb[1] + 0.1804375 * rgb[2]) / 0.95047);
  const double y = f(0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2]);
  const double z = f((0.0193339 * rgb[0] + 0.1191920 * rgb[1] + 0.9503041 * rgb[2]) / 1.08883);
  return { 116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z) };
}

TEST(Annotations, LinesOnDarkAreLightAndKeepTheirHue)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> component(0.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Colour colour{ component(random), component(random), component(random) };
    const Colour line = LineColourOnDark(colour);
    const auto before = ToLab(colour);
    const auto after = ToLab(line);
    EXPECT_GE(after[0], 65.0);
    if (before[0] > 65.2)
    {
      EXPECT_EQ(line, colour);
    }
    const double chroma = std::hypot(before[1], before[2]);
    EXPECT_LE(std::hypot(after[1], after[2]), chroma + 0.1);
    EXPECT_NEAR(before[1] * after[2] - before[2] * after[1], 0.0, 0.3 * chroma) << "the same hue";
    EXPECT_GE(before[1] * after[1] + before[2] * after[2], 0.0);
  }
  EXPECT_GE(ToLab(LineColourOnDark({ 0.0, 0.0, 0.0 }))[0], 65.0);
}

TEST(Annotations, VolumesAreWrittenWithOneDecimal)
{
  EXPECT_EQ(FormatVolume(1584.94), "1584.9");
  EXPECT_EQ(FormatVolume(0.05), "0.1");
  EXPECT_EQ(FormatVolume(0.049), "<0.1");
  EXPECT_EQ(FormatVolume(0.0), "0.0");
}

TEST(Annotations, TextContrastsWithTheBackground)
{
  EXPECT_GT(InkOn({ { 0.0, 0.0, 0.0 } }).colour[0], 0.8);
  EXPECT_LT(InkOn({ { 1.0, 1.0, 1.0 } }).colour[0], 0.2);
  EXPECT_LT(InkOn({ { 0.0, 0.0, 0.0 }, 0.0 }).colour[0], 0.2); // transparent: pages are mostly white
}

TEST(Annotations, OutlinesLieWhereThePictureHasThem)
{
  const Projection projection{ Anterior, { 3.0, 4.0, 5.0 }, 0.5, 700, 600 };
  Annotations annotations = OnlyScaleBar();
  annotations.scaleBar = false;
  ColouredOutline outline;
  for (const Vector3 & point : { Vector3{ -60.0, 0.0, 55.0 }, { 60.0, 0.0, 55.0 }, { 60.0, 0.0, -45.0 } })
  {
    outline.points.push_back(projection.PositionOf(point));
  }
  outline.colour = { 1.0, 1.0, 0.0 };
  outline.isClosed = false;
  annotations.outlines.push_back(outline);
  for (const int scale : { 1, 2 }) // drawn larger than it is
  {
    Drawing drawing(700 * scale, 600 * scale);
    DrawAnnotations(drawing, { 0.0, 0.0, 700.0 * scale, 600.0 * scale }, projection, annotations);
    const Picture picture = drawing.TakePictures({})[0];
    double sumX = 0.0; // of the yellow pixels of one row, and of one column
    double weightX = 0.0;
    double sumY = 0.0;
    double weightY = 0.0;
    for (int x = 0; x < picture.width; ++x)
    {
      sumX += (x + 0.5) * picture.At(x, 300 * scale)[0];
      weightX += picture.At(x, 300 * scale)[0];
    }
    for (int y = 0; y < picture.height; ++y)
    {
      sumY += (y + 0.5) * picture.At(350 * scale, y)[0];
      weightY += picture.At(350 * scale, y)[0];
    }
    EXPECT_NEAR(sumX / weightX, scale * (350.0 + (60.0 - 3.0) / 0.5), 0.05);
    EXPECT_NEAR(sumY / weightY, scale * (300.0 - (55.0 - 5.0) / 0.5), 0.05);
  }
}

TEST(Annotations, ThreadsDrawTheSame)
{
  const auto draw = [](Picture & picture) {
    Annotations annotations;
    annotations.title = "Title";
    annotations.legend = Legend(20);
    Annotate(picture, { Anterior, {}, 0.7, picture.width, picture.height }, annotations);
  };
  Picture alone(700, 600);
  draw(alone);
  std::array<Picture, 4> pictures;
  std::vector<std::thread> threads;
  for (Picture & picture : pictures)
  {
    picture = Picture(700, 600);
    threads.emplace_back(draw, std::ref(picture));
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
  for (const Picture & picture : pictures)
  {
    EXPECT_EQ(picture.pixels, alone.pixels);
  }
}

} // namespace
