#include "rhombicDrawing.h"
#include "rhombicFailure.h"
#include "rhombicPdfText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace
{

using rhombic::Drawing;
using rhombic::Ink;
using rhombic::Picture;
using rhombic::TextStyle;

Picture
RandomPicture(int width, int height, int channels, unsigned int seed)
{
  Picture picture(width, height, channels);
  std::mt19937 random(seed);
  for (auto & component : picture.pixels)
  {
    component = static_cast<std::uint8_t>(random());
  }
  return picture;
}

/** The columns and rows in which a picture over black is not black. */
struct Extent
{
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
};

Extent
ExtentOf(const Picture & picture)
{
  Extent extent;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      if (picture.At(x, y)[0] > 0)
      {
        extent = {
          std::min(extent.left, x), std::max(extent.right, x), std::min(extent.top, y), std::max(extent.bottom, y)
        };
      }
    }
  }
  return extent;
}

const Ink White{ { 1.0, 1.0, 1.0 } };
const Ink Black{};

Picture
OverBlack(Drawing & drawing)
{
  return drawing.TakePictures(Black).at(0);
}

TEST(Drawing, NothingDrawnChangesNothing)
{
  for (const int channels : { 3, 4 })
  {
    const Picture before = RandomPicture(37, 23, channels, 1);
    Picture after = before;
    Drawing(37, 23).PutOnto(after);
    EXPECT_EQ(after.pixels, before.pixels);
  }
}

TEST(Drawing, FillsByTheFormulaOfStraightAlpha)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const int channels : { 3, 4 })
  {
    for (int trial = 0; trial < 50; ++trial)
    {
      const Ink ink{ { share(random), share(random), share(random) }, share(random) };
      const Picture before = RandomPicture(31, 17, channels, 3 + trial);
      Picture after = before;
      Drawing drawing(31, 17);
      drawing.Fill({ 0.0, 0.0, 31.0, 17.0 }, ink);
      drawing.PutOnto(after);
      for (int x = 0; x < 31; ++x)
      {
        const double under = channels == 4 ? before.At(x, 5)[3] / 255.0 : 1.0;
        const double alpha = ink.opacity + under * (1.0 - ink.opacity);
        for (int c = 0; c < 3; ++c)
        {
          const double expected =
            (ink.colour[c] * ink.opacity + before.At(x, 5)[c] / 255.0 * under * (1.0 - ink.opacity)) / alpha;
          EXPECT_NEAR(after.At(x, 5)[c], 255.0 * expected, 1.0 + 1.5 / alpha); // the layer has 8 bits
        }
        if (channels == 4)
        {
          EXPECT_NEAR(after.At(x, 5)[3], 255.0 * alpha, 1.5);
        }
      }
    }
  }
}

TEST(Drawing, PictureOfThePlacesSizeIsCopied)
{
  const Picture picture = RandomPicture(40, 30, 3, 4);
  Drawing drawing(100, 90);
  drawing.Place(picture, { 7.0, 11.0, 40.0, 30.0 });
  const Picture page = OverBlack(drawing);
  for (int y = 0; y < 30; ++y)
  {
    for (int x = 0; x < 40; ++x)
    {
      ASSERT_TRUE(std::equal(page.At(x + 7, y + 11), page.At(x + 7, y + 11) + 3, picture.At(x, y))) << x << ", " << y;
    }
  }
  for (const auto & [x, y] : { std::pair{ 6, 20 }, { 47, 20 }, { 20, 10 }, { 20, 41 } })
  {
    EXPECT_EQ(page.At(x, y)[0] + page.At(x, y)[1] + page.At(x, y)[2], 0);
  }
}

TEST(Drawing, ReducedPictureKeepsItsMean)
{
  Picture checks(400, 400);
  for (std::size_t i = 0; i < checks.pixels.size(); ++i)
  {
    checks.pixels[i] = (i / 3 % 400 + i / 1200) % 2 ? 255 : 0;
  }
  Drawing drawing(100, 100);
  drawing.Place(checks, { 0.0, 0.0, 100.0, 100.0 });
  const Picture page = OverBlack(drawing);
  EXPECT_NEAR(page.At(50, 50)[1], 127.5, 8.0);
  EXPECT_NEAR(page.At(31, 72)[1], 127.5, 8.0);
}

TEST(Drawing, TextLiesWhereItIsAligned)
{
  TextStyle style;
  style.size = 40.0;
  style.ink = White;
  for (const auto & [alignment, share] : { std::pair{ rhombic::Alignment::Left, 0.0 },
                                           { rhombic::Alignment::Centre, 0.5 },
                                           { rhombic::Alignment::Right, 1.0 } })
  {
    Drawing drawing(900, 100);
    style.alignment = alignment;
    const double width = drawing.WidthOf("HIERARCHIES", style);
    drawing.Text("HIERARCHIES", { 450.0, 70.0 }, style);
    const Extent extent = ExtentOf(OverBlack(drawing));
    EXPECT_NEAR(extent.left, 450.0 - share * width, 5.0); // letters have a little space on both sides
    EXPECT_NEAR(extent.right, 450.0 + (1.0 - share) * width, 5.0);
    EXPECT_NEAR(extent.bottom, 70.0, 1.0);
    EXPECT_NEAR(extent.top, 70.0 - 0.73 * 40.0, 2.0);
  }
}

TEST(Drawing, WidthsOfTextGrowWithItsSize)
{
  const Drawing drawing(100, 100);
  TextStyle style;
  style.size = 100.0;
  const std::string text = "urinary bladder, iliopsoas";
  const double width = drawing.WidthOf(text, style) / style.size;
  for (style.size = 7.0; style.size < 16.0; style.size += 0.3)
  {
    EXPECT_NEAR(drawing.WidthOf(text, style) / style.size, width, 0.01 * width) << style.size;
  }
}

TEST(Drawing, WideTextFitsItsWidth)
{
  TextStyle style;
  style.ink = White;
  const std::string name = "portal_vein_and_splenic_vein_of_the_patient";
  for (double width = 20.0; width < 500.0; width += 17.0)
  {
    Drawing drawing(600, 40);
    style.largestWidth = width;
    EXPECT_LE(drawing.WidthOf(name, style), width);
    drawing.Text(name, { 0.0, 30.0 }, style);
    EXPECT_LE(ExtentOf(OverBlack(drawing)).right, width + 1.0);
  }
}

TEST(Drawing, ParagraphBreaksLines)
{
  Drawing drawing(300, 300);
  TextStyle style;
  style.ink = White;
  const std::string text = "Surfaces of labels on the lattice with a density of 0.77, smoothed by 1.0 mm";
  const double oneLine = drawing.HeightOf(text, 2000.0, style);
  const double height = drawing.Paragraph(text, { 10.0, 10.0 }, 200.0, style);
  EXPECT_EQ(height, drawing.HeightOf(text, 200.0, style));
  EXPECT_NEAR(height / oneLine, std::round(height / oneLine), 0.05);
  EXPECT_GT(height, 2.5 * oneLine);
  const Extent extent = ExtentOf(OverBlack(drawing));
  EXPECT_GE(extent.left, 10);
  EXPECT_LE(extent.right, 210);
  EXPECT_GE(extent.top, 10);
  EXPECT_LE(extent.bottom, 10.0 + height);
}

TEST(Drawing, AnyBytesAreTextAndNothingIsPrinted)
{
  testing::internal::CaptureStderr();
  Drawing drawing(400, 300);
  TextStyle style;
  style.largestWidth = 300.0;
  for (const char * const text : { "", "\xff\xfe\x80", "two\nlines\ttab", "печень", "كبد", "肝臓", "\xe2\x82" })
  {
    drawing.Text(text, { 10.0, 30.0 }, style);
    drawing.Paragraph(text, { 10.0, 30.0 }, 50.0, style);
  }
  drawing.Line({}, {});
  drawing.Polygon({}, {});
  drawing.Ellipse({ 5.0, 5.0 }, { 0.0, 0.0 }, { 0.0, 0.0 }, {});
  OverBlack(drawing);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Drawing, LineHasItsWidthAndEllipseItsArea)
{
  Drawing lines(100, 100);
  rhombic::LineStyle style;
  style.width = 7.5;
  style.ink = White;
  lines.Line({ { -20.0, 50.0 }, { 120.0, 50.0 } }, style);
  const Picture page = OverBlack(lines);
  double covered = 0.0;
  for (int y = 0; y < 100; ++y)
  {
    covered += page.At(50, y)[0] / 255.0;
  }
  EXPECT_NEAR(covered, 7.5, 0.05);

  Drawing ellipses(200, 200);
  ellipses.Ellipse({ 100.0, 100.0 }, { 50.0, 20.0 }, { -10.0, 30.0 }, White);
  double area = 0.0;
  for (const std::uint8_t component : OverBlack(ellipses).pixels)
  {
    area += component / 255.0 / 3.0;
  }
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(area, pi * (50.0 * 30.0 + 20.0 * 10.0), 10.0);
}

TEST(Drawing, SvgHasItsSizeAndLines)
{
  Drawing drawing = Drawing::ForSvg(320, 200);
  drawing.Line({ { 10.0, 10.0 }, { 300.0, 150.0 } }, { 2.0, { { 1.0, 0.0, 0.0 } } });
  drawing.Text("text", { 20.0, 100.0 }, {});
  const std::string svg = drawing.TakeDocument();
  EXPECT_NE(svg.find("width=\"320px\" height=\"200px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("M 10 10 L 300 150"), std::string::npos);
  EXPECT_THROW(Drawing::ForSvg(0, 10), rhombic::Failure);
}

TEST(Drawing, PdfHasItsPagesAndNoDate)
{
  const auto make = [] {
    Drawing drawing(1654, 2339, 200.0, { "Title of pages", "rhombic test" });
    TextStyle style;
    drawing.Text("first", { 100.0, 100.0 }, style);
    drawing.Place(RandomPicture(20, 20, 4, 5), { 200.0, 200.0, 300.0, 300.0 });
    drawing.NextPage();
    drawing.Text("second", { 100.0, 100.0 }, style);
    EXPECT_EQ(drawing.GetNumberOfPages(), 2u);
    return drawing.TakeDocument();
  };
  const std::string pdf = make();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_EQ(pdf.find("Date"), std::string::npos);
  EXPECT_EQ(make(), pdf);
  const auto text = rhombictest::TextOfPdf(pdf);
  if (text)
  {
    EXPECT_LT(text->find("first"), text->find("second"));
    EXPECT_EQ(rhombictest::CountIn(*text, "\f"), 2u);
  }
}

TEST(Drawing, ImpossibleSizesAreUsage)
{
  for (const auto & [width, height] : { std::pair{ 0, 10 }, { 10, -1 }, { 40000, 10 } })
  {
    try
    {
      Drawing(width, height);
      ADD_FAILURE() << width << " x " << height;
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
    }
  }
}

TEST(DrawingDeathTest, MissingFontsNameThePackage)
{
  testing::GTEST_FLAG(death_test_style) = "threadsafe"; // fontconfig reads its configuration once
  const rhombictest::TemporaryFolder folder;
  const std::string empty = (folder.Path() / "fonts.conf").string();
  std::ofstream(empty) << "<fontconfig></fontconfig>";
  const auto draw = [&empty] {
    setenv("FONTCONFIG_FILE", empty.c_str(), 1);
    try
    {
      Drawing(10, 10);
    }
    catch (const rhombic::Failure & failure)
    {
      const bool isNamed = std::string(failure.GetDescription()).find("fonts-dejavu-core") != std::string::npos;
      std::exit(failure.GetKind() == rhombic::FailureKind::Display && isNamed ? 0 : 1);
    }
    std::exit(2);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(0), "");
}

} // namespace
