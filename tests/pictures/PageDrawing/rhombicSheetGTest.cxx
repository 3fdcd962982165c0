#include "rhombicFailure.h"
#include "rhombicPdfText.h"
#include "rhombicPictureIO.h"
#include "rhombicSheet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace rhombic;

const ViewFrame Anterior{ { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 } };

std::string
RowName(std::size_t i)
{
  return "structure " + std::to_string(1000 + i).substr(1);
}

/** A gradient with a disc. */
Picture
Gradient(const Rectangle & place)
{
  Picture picture(static_cast<int>(place.width), static_cast<int>(place.height));
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      std::uint8_t * const pixel = picture.pixels.data() + (y * picture.width + x) * 3;
      const bool isInDisc = std::hypot(x - 0.5 * picture.width, y - 0.5 * picture.height) < 0.3 * picture.height;
      pixel[0] = static_cast<std::uint8_t>(x % 256);
      pixel[1] = static_cast<std::uint8_t>(y % 256);
      pixel[2] = isInDisc ? 200 : 20;
    }
  }
  return picture;
}

Sheet
MakeSheet(std::size_t rows, bool isLandscape, bool isDark, double viewAspect = 1.3)
{
  Sheet sheet;
  sheet.title = "Phantom";
  sheet.isLandscape = isLandscape;
  sheet.isDark = isDark;
  sheet.viewAspect = viewAspect;
  sheet.meanUnit = "HU";
  sheet.provenance = { "lattice: face-centered cubic", "program: rhombic test" };
  for (std::size_t i = 0; i < rows; ++i)
  {
    sheet.rows.push_back({ RowName(i), { 0.9, 0.3, 0.2 }, 10.0 + static_cast<double>(i), 5.0, -70.0, "" });
  }
  sheet.views.resize(4);
  sheet.slices.resize(3);
  return sheet;
}

void
AddPictures(Sheet & sheet)
{
  const SheetPlaces places = PlacesOn(sheet);
  for (std::size_t i = 0; i < sheet.views.size(); ++i)
  {
    sheet.views[i].picture = Gradient(places.views[i]);
  }
  for (std::size_t i = 0; i < sheet.slices.size(); ++i)
  {
    sheet.slices[i].picture = Gradient(places.slices[i]);
  }
  for (auto * const pictures : { &sheet.views, &sheet.slices })
  {
    for (SheetPicture & picture : *pictures)
    {
      picture.projection = { Anterior, {}, 0.5, picture.picture.width, picture.picture.height };
    }
  }
}

bool
Overlap(const Rectangle & a, const Rectangle & b)
{
  return a.left < b.Right() && b.left < a.Right() && a.top < b.Bottom() && b.top < a.Bottom();
}

TEST(Sheet, PlacesLieApartOnThePage)
{
  for (const bool isLandscape : { false, true })
  {
    for (const double aspect : { 0.5, 1.0, 1.3, 2.0, 4.0 })
    {
      for (const std::size_t rows : { 0, 1, 5, 9, 10, 62, 200 })
      {
        const SheetPlaces places = PlacesOn(MakeSheet(rows, isLandscape, false, aspect));
        EXPECT_EQ(places.width, isLandscape ? 2339 : 1654);
        EXPECT_EQ(places.height, isLandscape ? 1654 : 2339);
        std::vector<Rectangle> all = places.views;
        all.insert(all.end(), places.slices.begin(), places.slices.end());
        ASSERT_EQ(all.size(), 7u);
        const Rectangle page{ 80.0, 160.0, places.width - 160.0, places.height - 240.0 };
        for (std::size_t i = 0; i < all.size(); ++i)
        {
          EXPECT_GE(all[i].width, 200.0);
          EXPECT_GE(all[i].height, 150.0);
          EXPECT_TRUE(all[i].left >= page.left && all[i].Right() <= page.Right() && all[i].top >= page.top &&
                      all[i].Bottom() <= page.Bottom())
            << "place " << i << ", " << rows << " rows, aspect " << aspect;
          for (std::size_t j = 0; j < i; ++j)
          {
            EXPECT_FALSE(Overlap(all[i], all[j])) << i << " and " << j;
          }
        }
      }
    }
  }
}

TEST(Sheet, PagesGoOnUntilAllRowsAreThere)
{
  for (const bool isLandscape : { false, true })
  {
    for (const std::size_t rows : { 0, 1, 5, 9, 10, 62, 200, 700 })
    {
      Sheet sheet = MakeSheet(rows, isLandscape, rows % 2 == 0);
      const PdfPages pdf = DrawSheetPdf(sheet, "rhombic test");
      EXPECT_EQ(pdf.bytes, DrawSheetPdf(sheet, "rhombic test").bytes);
      if (rows <= 62 && !isLandscape)
      {
        EXPECT_EQ(pdf.count, rows < 20 ? 1u : 2u);
      }
      const auto text = rhombictest::TextOfPdf(pdf.bytes);
      if (!text)
      {
        GTEST_SKIP() << "pdftotext is not installed";
      }
      EXPECT_EQ(rhombictest::CountIn(*text, "\f"), pdf.count);
      for (std::size_t i = 0; i < rows; ++i)
      {
        EXPECT_EQ(rhombictest::CountIn(*text, RowName(i)), 1u) << RowName(i);
      }
      for (const char * const word : { "face-centered cubic", "rhombic test" })
      {
        EXPECT_EQ(rhombictest::CountIn(*text, word), 1u) << word;
      }
    }
  }
}

TEST(Sheet, PicturesAreCopiedToTheirPlaces)
{
  for (const bool isLandscape : { false, true })
  {
    Sheet sheet = MakeSheet(30, isLandscape, isLandscape);
    AddPictures(sheet);
    const std::vector<Picture> pages = DrawSheet(sheet);
    const SheetPlaces places = PlacesOn(sheet);
    const auto compare = [&pages](const Picture & picture, const Rectangle & place) {
      const int x = picture.width / 2;
      const int y = picture.height / 2;
      const auto * const pixel = pages[0].At(static_cast<int>(place.left) + x, static_cast<int>(place.top) + y);
      EXPECT_TRUE(std::equal(pixel, pixel + 3, picture.At(x, y)));
    };
    for (std::size_t i = 0; i < sheet.views.size(); ++i)
    {
      compare(sheet.views[i].picture, places.views[i]);
    }
    for (std::size_t i = 0; i < sheet.slices.size(); ++i)
    {
      compare(sheet.slices[i].picture, places.slices[i]);
    }
    EXPECT_EQ(pages[0].pixels, DrawSheet(sheet)[0].pixels);
  }
}

TEST(Sheet, OutlinesLieOnTheirPixels)
{
  Sheet sheet = MakeSheet(3, false, false);
  AddPictures(sheet);
  const Rectangle place = PlacesOn(sheet).slices[1];
  ColouredOutline outline;
  outline.points = { { 100.5, 100.5 }, { 300.5, 100.5 }, { 300.5, 250.5 }, { 100.5, 250.5 } };
  outline.colour = { 1.0, 1.0, 0.0 };
  sheet.slices[1].outlines.push_back(outline);
  const Picture page = DrawSheet(sheet)[0];
  for (const auto & [x, y] : { std::pair{ 200, 100 }, { 200, 250 }, { 100, 200 }, { 300, 200 } })
  {
    const auto * const pixel = page.At(static_cast<int>(place.left) + x, static_cast<int>(place.top) + y);
    EXPECT_GE(pixel[0], 250) << x << ", " << y;
    EXPECT_GE(pixel[1], 250) << x << ", " << y;
    EXPECT_LE(pixel[2], 5) << x << ", " << y;
  }
}

TEST(Sheet, PagesBecomeFiles)
{
  const rhombictest::TemporaryFolder folder;
  Sheet sheet = MakeSheet(200, false, false);
  AddPictures(sheet);
  const PdfPages pdf = DrawSheetPdf(sheet, "rhombic test");
  StagedFiles staged;
  StagePdf(pdf.bytes, pdf.count, folder.Path() / "page.pdf", staged);
  const std::vector<Picture> pages = DrawSheet(sheet);
  PictureMetadata metadata;
  metadata.pixelsPerInch = sheet.pixelsPerInch;
  StagePages(pages, folder.Path() / "page.tif", staged, metadata);
  staged.Commit();
  EXPECT_EQ(std::filesystem::file_size(folder.Path() / "page.pdf"), pdf.bytes.size());
  const std::vector<Picture> read = ReadPictures(folder.Path() / "page.tif");
  ASSERT_EQ(read.size(), pdf.count);
  EXPECT_EQ(read.back().pixels, pages.back().pixels);
}

TEST(Sheet, LongTablesLeaveTheFirstPageToThePictures)
{
  const Sheet sheet = MakeSheet(61, false, false);
  for (const Rectangle & view : PlacesOn(sheet).views)
  {
    EXPECT_GE(view.height, 80.0 * sheet.pixelsPerInch / 25.4);
  }
}

TEST(Sheet, SlicesOfKnownSizeHaveOneScaleAndRoomForLetters)
{
  for (const bool isLandscape : { false, true })
  {
    for (const std::size_t rows : { 2, 40 })
    {
      for (const Vector3 & box : { Vector3{ 300, 300, 300 }, { 452, 452, 1009 }, { 300, 250, 15 }, { 20, 30, 40 } })
      {
        Sheet sheet = MakeSheet(rows, isLandscape, false);
        const double sizes[3][2] = { { box[0], box[1] }, { box[0], box[2] }, { box[1], box[2] } };
        for (std::size_t n = 0; n < 3; ++n)
        {
          sheet.slices[n].width = sizes[n][0];
          sheet.slices[n].height = sizes[n][1];
        }
        const SheetPlaces places = PlacesOn(sheet);
        const double letters = 6.9 * sheet.pixelsPerInch / 25.4;
        ASSERT_GT(places.sliceScale, 0.0);
        for (std::size_t n = 0; n < 3; ++n)
        {
          EXPECT_GE(places.slices[n].width, places.sliceScale * sizes[n][0] + 2.0 * letters);
          EXPECT_GE(places.slices[n].height, places.sliceScale * sizes[n][1] + 2.0 * letters);
          EXPECT_LE(places.slices[n].Right(), places.width);
          EXPECT_LE(places.slices[n].Bottom(), places.height);
          for (const Rectangle & view : places.views)
          {
            EXPECT_FALSE(Overlap(places.slices[n], view));
            EXPECT_GE(view.height, 39.0 * sheet.pixelsPerInch / 25.4);
          }
        }
      }
    }
  }
}

TEST(Sheet, TooManyPicturesAreUsage)
{
  Sheet sheet = MakeSheet(1, false, false);
  sheet.views.resize(5);
  EXPECT_THROW(DrawSheet(sheet), Failure);
}

} // namespace
