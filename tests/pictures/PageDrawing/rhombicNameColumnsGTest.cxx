#include "rhombicAnnotations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>

namespace
{

using namespace rhombic;

Projection
Front(int width, int height)
{
  Projection projection;
  projection.frame = { { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };
  projection.width = width;
  projection.height = height;
  return projection;
}

/** Names at any places of the scene, sizes from large to small in any order. */
Annotations
RandomNames(std::size_t count, const Projection & picture, std::mt19937 & random)
{
  Annotations annotations;
  annotations.figure = false;
  annotations.names.resize(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    annotations.names[n].name = std::string(3 + random() % 20, 'n') + std::to_string(n);
    annotations.names[n].seen = static_cast<double>(random() % 10000);
  }
  const Margins margins = MarginsOf(annotations, picture.width, picture.height, picture.frame);
  std::uniform_real_distribution<double> across(margins.left, picture.width - margins.right);
  std::uniform_real_distribution<double> down(margins.top, picture.height - margins.bottom);
  for (PointedName & name : annotations.names)
  {
    name.anchor = { across(random), down(random) };
    name.left = 0.5 * (margins.left + name.anchor.x);
    name.right = name.anchor.x;
  }
  return annotations;
}

double
SideOf(const PicturePosition & a, const PicturePosition & b, const PicturePosition & c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool
DoCross(const PlacedName & one, const PlacedName & other)
{
  for (std::size_t i = 0; i + 1 < one.line.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < other.line.size(); ++j)
    {
      const PicturePosition a = one.line[i], b = one.line[i + 1], c = other.line[j], d = other.line[j + 1];
      if (SideOf(a, b, c) * SideOf(a, b, d) < 0.0 && SideOf(c, d, a) * SideOf(c, d, b) < 0.0)
      {
        return true;
      }
    }
  }
  return false;
}

TEST(NameColumns, NamesDoNotOverlapAndLinesDoNotCross)
{
  std::mt19937 random(3);
  for (int turn = 0; turn < 60; ++turn)
  {
    const Projection picture = Front(300 + static_cast<int>(random() % 1200), 200 + static_cast<int>(random() % 1200));
    const Annotations annotations = RandomNames(1 + random() % 120, picture, random);
    const std::vector<PlacedName> placed = PlaceNames(picture, annotations);
    const Margins margins = MarginsOf(annotations, picture.width, picture.height, picture.frame);
    ASSERT_FALSE(placed.empty());
    std::set<std::size_t> numbers;
    double leastShown = 1e9;
    for (std::size_t n = 0; n < placed.size(); ++n)
    {
      const auto & [number, box, isLeft, line] = placed[n];
      EXPECT_TRUE(numbers.insert(number).second);
      leastShown = std::min(leastShown, annotations.names[number].seen);
      EXPECT_GE(box.left, 0.0);
      EXPECT_LE(box.Right(), picture.width);
      EXPECT_GE(box.top, margins.top - 1e-6);
      EXPECT_LE(box.Bottom(), picture.height - margins.bottom + 1e-6);
      for (const PointedName & name : annotations.names)
      {
        EXPECT_TRUE(isLeft ? box.Right() < name.left : box.left > name.right) << "beside the scene";
      }
      EXPECT_EQ(line[0].x, annotations.names[number].anchor.x);
      EXPECT_EQ(line[0].y, annotations.names[number].anchor.y);
      EXPECT_NEAR(line[2].y, box.top + 0.5 * box.height, 1e-6);
      for (std::size_t m = 0; m < n; ++m)
      {
        EXPECT_FALSE(DoCross(placed[n], placed[m]));
        const Rectangle & other = placed[m].box;
        EXPECT_TRUE(box.left >= other.Right() || box.Right() <= other.left || box.top >= other.Bottom() - 1e-6 ||
                    box.Bottom() <= other.top + 1e-6);
      }
    }
    for (std::size_t n = 0; n < annotations.names.size(); ++n)
    {
      EXPECT_TRUE(numbers.count(n) > 0 || annotations.names[n].seen <= leastShown) << "larger ones first";
    }
  }
}

TEST(NameColumns, FewNamesStandAtTheHeightsOfTheirAnchors)
{
  const Projection picture = Front(1000, 800);
  Annotations annotations;
  annotations.names = { { "liver", {}, { 400, 300 }, 1.0, 350, 500 }, { "spleen", {}, { 600, 500 }, 0.5, 500, 650 } };
  const std::vector<PlacedName> placed = PlaceNames(picture, annotations);
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].number, 0u);
  EXPECT_TRUE(placed[0].isLeft);
  EXPECT_DOUBLE_EQ(placed[0].line[1].y, 300);
  EXPECT_FALSE(placed[1].isLeft);
  EXPECT_DOUBLE_EQ(placed[1].line[1].y, 500);
  EXPECT_LT(placed[0].line[1].x, 350);
  EXPECT_NEAR(placed[0].box.Right(), 350, 60) << "not at the picture's edge";
  EXPECT_GT(placed[1].line[1].x, 650);
  EXPECT_NEAR(placed[1].box.left, 650, 60);
}

TEST(NameColumns, OnlyNamesChangeThePictureAndAlwaysAlike)
{
  std::mt19937 random(5);
  const Projection projection = Front(500, 400);
  Annotations annotations = RandomNames(20, projection, random);
  annotations.letters = annotations.scaleBar = false;
  const auto draw = [&] {
    Picture picture(500, 400);
    Annotate(picture, projection, annotations);
    return picture.pixels;
  };
  const auto first = draw();
  EXPECT_EQ(draw(), first);
  EXPECT_NE(first, Picture(500, 400).pixels);
  annotations.names.clear();
  EXPECT_EQ(draw(), Picture(500, 400).pixels);
}

} // namespace
