#include "rhombicRenderAgreement.h"

#include "rhombicColourScale.h"
#include "rhombicFailure.h"
#include "rhombicLabelScan.h"
#include "rhombicPictureIO.h"
#include "rhombicScanWriter.h"
#include "rhombicSilhouette.h"
#include "rhombicTemporaryFolder.h"
#include "rhombicView.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

namespace
{

namespace fs = std::filesystem;
using namespace rhombic;
using rhombictest::Ball;
using rhombictest::LabelGrid;
using rhombictest::MakeLabelScan;
using rhombictest::TemporaryFolder;

/** The area in a closed line, in pixels; above 0 if the line turns clockwise, as rows run downwards. */
double
AreaIn(const ColouredOutline & outline)
{
  double area = 0.0;
  for (std::size_t n = 0; n < outline.points.size(); ++n)
  {
    const PicturePosition & a = outline.points[n];
    const PicturePosition & b = outline.points[(n + 1) % outline.points.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

SceneSurface
BallAt(const Vector3 & centre, double radius)
{
  SceneSurface item;
  item.surface = itk::example::MakeSphere(radius, 5, centre);
  return item;
}

Projection
AnteriorView()
{
  Projection projection;
  projection.width = 240;
  projection.height = 200;
  projection.centre = { 0, 0, 0 };
  projection.pixelSize = 0.5;
  projection.frame = StandardViews()[0].frame;
  return projection;
}

TEST(Silhouette, HasTheAreaThatAViewShowsOfEachBall)
{
  constexpr double pi = 3.14159265358979;
  const auto lines = FindSilhouettes({ BallAt({ 0, 0, 0 }, 20) }, AnteriorView(), { 0, 0, 0 });
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(std::abs(AreaIn(lines[0])), pi * 40 * 40, 0.01 * pi * 40 * 40);
  for (const PicturePosition & point : lines[0].points)
  {
    EXPECT_NEAR(std::hypot(point.x - 120, point.y - 100), 40.0, 1.0);
  }

  // A ball before another: what is hidden has no line.
  const auto both =
    FindSilhouettes({ BallAt({ 0, 0, 0 }, 20), BallAt({ 0, -40, 0 }, 10) }, AnteriorView(), { 0, 0, 0 });
  std::vector<double> areas;
  std::transform(both.begin(), both.end(), std::back_inserter(areas), AreaIn);
  ASSERT_EQ(areas.size(), 3U) << "the far ball has a hole";
  double sum = 0.0;
  for (const double area : areas)
  {
    sum += area;
  }
  EXPECT_NEAR(std::abs(sum), pi * 40 * 40, 0.01 * pi * 40 * 40) << "the near ball fills the hole";
}

TEST(Silhouette, IsCutAtThePicturesEdge)
{
  const auto lines = FindSilhouettes({ BallAt({ 0, 0, 0 }, 300) }, AnteriorView(), { 0, 0, 0 });
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(std::abs(AreaIn(lines[0])), 240 * 200, 2.0) << "but for the corners";
}

class RenderAgreementTest : public testing::Test
{
protected:
  /** Compares balls of two radii, and draws the page. */
  std::vector<MadeFile>
  Draw(double firstRadius, double secondRadius, const std::optional<double> & range)
  {
    const LabelGrid grid{ { { 60, 60, 60 } }, { 1, 1, 1 } };
    WriteScan(MakeLabelScan(grid, Ball(firstRadius)).image, m_Folder.Path() / "a.nii");
    WriteScan(MakeLabelScan(grid, Ball(secondRadius)).image, m_Folder.Path() / "b.nii");
    CompareLabelsSettings settings;
    settings.first.path = m_Folder.Path() / "a.nii";
    settings.second.path = m_Folder.Path() / "b.nii";
    settings.page = m_Page;
    settings.provenance.writesSidecars = false;
    CheckAgreementPage(settings, range);
    std::vector<MadeFile> made;
    const std::vector<LabelAgreement> labels = CompareLabels(settings, {}, made);
    EXPECT_TRUE(made.empty()) << "no table was asked for";
    return RenderAgreement(settings, labels, range, {});
  }

  TemporaryFolder m_Folder;
  fs::path m_Page = m_Folder.Path() / "page.png";
};

TEST_F(RenderAgreementTest, ColoursAreThoseOfTheDistance)
{
  ASSERT_EQ(this->Draw(20, 23, 4.0).size(), 1U);
  const Picture page = ReadPicture(m_Page);
  const auto expected = ToBytes(ColourOf({ "diverging", -4.0, 4.0, "" }, -3.0));
  std::map<std::array<int, 3>, int> counts;
  for (std::size_t n = 0; n < page.pixels.size(); n += static_cast<std::size_t>(page.channels))
  {
    ++counts[{ page.pixels[n], page.pixels[n + 1], page.pixels[n + 2] }];
  }
  int like = 0; // labels' surfaces are within 0.3 mm of a ball
  for (const auto & [colour, count] : counts)
  {
    const bool isLike = std::abs(colour[0] - expected[0]) < 25 && std::abs(colour[1] - expected[1]) < 25 &&
                        std::abs(colour[2] - expected[2]) < 25 && colour[2] > colour[0];
    like += isLike ? count : 0;
  }
  EXPECT_GT(like, 50'000) << "four views of a ball";
}

TEST_F(RenderAgreementTest, AnInteractivePageHasTheTableAndBothSurfaces)
{
  m_Page = m_Folder.Path() / "page.html";
  ASSERT_EQ(this->Draw(20, 23, 4.0).size(), 1U);
  std::ifstream file(m_Page);
  const std::string page{ std::istreambuf_iterator<char>(file), {} };
  for (const char * const words :
       { ">HD95 mm</th>", ">Dice</th>", "\"group\":\"A\"", "\"group\":\"B\",\"hidden\":true" })
  {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(page.find(">volume, ml</th>"), std::string::npos);
  const std::size_t row = page.find("<bdi>mask</bdi></th>");
  ASSERT_NE(row, std::string::npos);
  const std::string cells = page.substr(row, page.find("</tr>", row) - row);
  EXPECT_NE(cells.find(">33."), std::string::npos) << "ml of A: " << cells;
  EXPECT_NE(cells.find(">0.000<"), std::string::npos) << "no part is within the tolerance: " << cells;
}

TEST_F(RenderAgreementTest, PagesSayWhatBecameOfParts)
{
  m_Page = m_Folder.Path() / "page.html";
  const LabelGrid grid{ { { 60, 40, 40 } }, { 1, 1, 1 } };
  const auto balls = [](std::initializer_list<double> places) {
    return [centres = std::vector<double>(places)](const itk::Point<double, 3> & p) {
      return std::any_of(
               centres.begin(), centres.end(), [&](double x) { return std::hypot(p[0] - x, p[1], p[2]) < 5.0; })
               ? 1
               : 0;
    };
  };
  WriteScan(MakeLabelScan(grid, balls({ -20.0, 0.0 })).image, m_Folder.Path() / "a.nii");
  WriteScan(MakeLabelScan(grid, balls({ 0.0, 20.0 })).image, m_Folder.Path() / "b.nii");
  CompareLabelsSettings settings;
  settings.first.path = m_Folder.Path() / "a.nii";
  settings.second.path = m_Folder.Path() / "b.nii";
  settings.parts = { "*" };
  settings.page = m_Page;
  settings.provenance.writesSidecars = false;
  std::vector<MadeFile> made;
  RenderAgreement(settings, CompareLabels(settings, {}, made), std::nullopt, {});
  std::ifstream file(m_Page);
  const std::string page{ std::istreambuf_iterator<char>(file), {} };
  for (const char * const words : { "<bdi>mask 1</bdi>", "<bdi>mask 2 (gone)</bdi>", "<bdi>mask 3 (new)</bdi>" })
  {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
}

TEST_F(RenderAgreementTest, AnEmptySegmentationIsRefused)
{
  try
  {
    this->Draw(-1, 10, std::nullopt);
    FAIL();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Empty);
  }
  EXPECT_FALSE(fs::exists(m_Page));
}

TEST_F(RenderAgreementTest, ARangeMustBeAboveZero)
{
  EXPECT_THROW(this->Draw(20, 23, 0.0), Failure);
  m_Page.replace_extension(".docx");
  EXPECT_THROW(this->Draw(20, 23, 1.0), Failure);
}

} // namespace
