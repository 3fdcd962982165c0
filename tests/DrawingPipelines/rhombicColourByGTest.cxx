#include "rhombicColourBy.h"

#include "rhombicColourScale.h"
#include "rhombicFailure.h"
#include "rhombicLabelScan.h"
#include "rhombicPictureIO.h"
#include "rhombicRenderScan.h"
#include "rhombicScanWriter.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTemporaryFolder.h"

#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using itk::example::MakeSphere;
using rhombic::ColourBy;
using rhombic::ColourScale;
using rhombictest::At;
using rhombictest::MakeLabelScan;
using rhombictest::TemporaryFolder;

constexpr double Radius = 20.0;   // of the ball that is drawn, in mm
constexpr double PixelSize = 0.5; // mm
constexpr int Size = 400;         // pixels

/** \class ColoursOfABall
 * \brief A picture from the front of a ball around the origin, whose points have colours. */
class ColoursOfABall : public testing::Test
{
protected:
  void
  Write(const std::string & name, double radius, const std::array<double, 3> & centre) const
  {
    rhombic::WriteSurfaces({ { name, MakeSphere(radius, 7, centre) } }, m_Folder.Path() / (name + ".ply"));
  }

  /** Draws the ball, with a hollow if one is named. */
  rhombic::Picture
  Draw(const std::string & colourBy, double hollowRadius = 0.0, const std::array<double, 3> & hollow = {}) const
  {
    const auto ball = MakeSphere(Radius, 7);
    if (hollowRadius > 0.0)
    {
      const auto cavity = MakeSphere(hollowRadius, 7, hollow);
      itk::example::TurnInsideOut(*cavity);
      itk::example::Append(*ball, *cavity);
    }
    rhombic::WriteSurfaces({ { "ball", ball } }, m_Folder.Path() / "ball.ply");
    rhombic::RenderScanSettings settings;
    settings.source.surfaceFiles = { m_Folder.Path() / "ball.ply" };
    settings.picture = m_Folder.Path() / "ball.png";
    settings.colourBy = rhombic::ParseColourBy(colourBy);
    settings.render.width = settings.render.height = Size;
    settings.render.pixelSize = PixelSize;
    settings.render.centre = rhombic::Vector3{};
    settings.annotations.letters = settings.annotations.scaleBar = false;
    settings.provenance.writesSidecars = false;
    RenderScan(settings, {});
    return rhombic::ReadPicture(settings.picture);
  }

  /** Expects at 20 random places the colour of a function of the point there, within 2 of 255. The bar's column is at
   * the right of the scene, whose middle is found from the ball's pixels. */
  template <typename TFunction>
  void
  ExpectColours(const rhombic::Picture & picture, const ColourScale & scale, const TFunction & value) const
  {
    std::vector<int> columns, rows; // of the ball
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        const std::uint8_t * const pixel = picture.At(x, y);
        if (std::max({ pixel[0], pixel[1], pixel[2] }) > 8 && x < Size * 11 / 20)
        {
          columns.push_back(x);
          rows.push_back(y);
        }
      }
    }
    ASSERT_FALSE(columns.empty());
    const auto middleOf = [](const std::vector<int> & places) {
      const auto ends = std::minmax_element(places.begin(), places.end());
      return 0.5 * (*ends.first + *ends.second);
    };
    const double middleX = middleOf(columns), middleY = middleOf(rows);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(-0.8, 0.8);
    for (int n = 0; n < 20;)
    {
      const int column = static_cast<int>(std::lround(middleX + part(random) * Radius / PixelSize));
      const int row = static_cast<int>(std::lround(middleY + part(random) * Radius / PixelSize));
      const double x = (column - middleX) * PixelSize, z = (middleY - row) * PixelSize;
      if (std::hypot(x, z) > 0.85 * Radius)
      {
        continue;
      }
      ++n;
      const double y = -std::sqrt(Radius * Radius - x * x - z * z); // the front
      const auto expected = rhombic::ToBytes(ColourOf(scale, value(x, y, z)));
      for (int channel = 0; channel < 3; ++channel)
      {
        EXPECT_NEAR(picture.At(column, row)[channel], expected[static_cast<std::size_t>(channel)], 2)
          << column << ' ' << row << ' ' << channel;
      }
    }
  }

  TemporaryFolder m_Folder;
};

TEST_F(ColoursOfABall, AreThoseOfTheSignedDistance)
{
  this->Write("other", 21.0, { 2.0, -1.5, 1.0 });
  const auto picture = this->Draw("distance:" + (m_Folder.Path() / "other.ply").string() + ",-5,5");
  this->ExpectColours(picture, { "diverging", -5.0, 5.0, "" }, [](double x, double y, double z) {
    return std::sqrt((x - 2.0) * (x - 2.0) + (y + 1.5) * (y + 1.5) + (z - 1.0) * (z - 1.0)) - 21.0;
  });
}

/** A volume whose values rise along x and z, which linear interpolation gives exactly. */
TEST_F(ColoursOfABall, AreTheValuesOfAVolume)
{
  const auto value = [](double x, double, double z) { return 100.0 + 2.0 * x + 1.0 * z; };
  const auto scan = MakeLabelScan({ { { 50, 50, 50 } }, { 1.0, 1.0, 1.0 }, At(0.5, 0.5, 0.5) }, [&](const auto & p) {
    return static_cast<int>(std::lround(value(p[0], p[1], p[2])));
  });
  rhombic::WriteScan(scan.image, m_Folder.Path() / "volume.nrrd");
  const auto picture = this->Draw((m_Folder.Path() / "volume.nrrd").string() + ",50,150,viridis");
  this->ExpectColours(picture, { "viridis", 50.0, 150.0, "" }, value);
}

/** The values of the volume above fall or rise along the radius, so their mean is that of the middle of the way, and
 * the highest is that of one of its ends. */
TEST_F(ColoursOfABall, AreTheMeanAndTheHighestValueWithinADepth)
{
  const auto value = [](double x, double, double z) { return 100.0 + 2.0 * x + 1.0 * z; };
  const auto scan = MakeLabelScan({ { { 50, 50, 50 } }, { 1.0, 1.0, 1.0 }, At(0.5, 0.5, 0.5) }, [&](const auto & p) {
    return static_cast<int>(std::lround(value(p[0], p[1], p[2])));
  });
  const std::string volume = (m_Folder.Path() / "volume.nrrd").string();
  rhombic::WriteScan(scan.image, volume);
  constexpr double depth = 8.0;
  const auto within = [&](double share, double x, double y, double z) {
    const double factor = 1.0 - share * depth / Radius;
    return value(factor * x, factor * y, factor * z);
  };
  this->ExpectColours(this->Draw(volume + ",mean:8mm,50,150"),
                      { "viridis", 50.0, 150.0, "" },
                      [&](double x, double y, double z) { return within(0.5, x, y, z); });
  this->ExpectColours(
    this->Draw(volume + ",50,150,max:8"), { "viridis", 50.0, 150.0, "" }, [&](double x, double y, double z) {
      return std::max(within(0.0, x, y, z), within(1.0, x, y, z));
    });
}

/** A ball of radius r that touches the outer ball at p from inside, and the hollow of radius h around c from outside:
 * |p (1 - r / R) - c| = h + r. */
TEST_F(ColoursOfABall, AreTheDiametersOfTheLargestBallsInside)
{
  constexpr double hollowRadius = 9.0;
  constexpr double centreX = 4.0, centreY = 2.0, centreZ = -3.0;
  const auto picture = this->Draw("thickness,0,24,inferno", hollowRadius, { centreX, centreY, centreZ });
  this->ExpectColours(picture, { "inferno", 0.0, 24.0, "" }, [](double x, double y, double z) {
    const double along = (x * centreX + y * centreY + z * centreZ) / Radius;
    const double squared = centreX * centreX + centreY * centreY + centreZ * centreZ;
    return (Radius * Radius - 2.0 * Radius * along + squared - hollowRadius * hollowRadius) /
           (Radius + hollowRadius - along);
  });
}

TEST_F(ColoursOfABall, AreTheMeanCurvature)
{
  const auto picture = this->Draw("curvature:3mm,0,0.12,viridis");
  this->ExpectColours(picture, { "viridis", 0.0, 0.12, "" }, [](double, double, double) { return 1.0 / Radius; });
}

TEST_F(ColoursOfABall, SurfacesElsewhereAreRefused)
{
  this->Write("other", 5.0, { 100.0, 0.0, 0.0 });
  try
  {
    this->Draw("distance:" + (m_Folder.Path() / "other.ply").string());
    ADD_FAILURE();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Geometry);
    EXPECT_NE(std::string(failure.GetDescription()).find("75 mm apart"), std::string::npos) << failure.GetDescription();
  }
  EXPECT_THROW(this->Draw("missing.nii"), rhombic::Failure);
}

TEST_F(ColoursOfABall, VolumesElsewhereAreRefused)
{
  const auto scan =
    MakeLabelScan({ { { 5, 5, 5 } }, { 1.0, 1.0, 1.0 }, At(300.0, 0.0, 0.0) }, [](const auto &) { return 7; });
  rhombic::WriteScan(scan.image, m_Folder.Path() / "far.nrrd");
  try
  {
    this->Draw((m_Folder.Path() / "far.nrrd").string());
    ADD_FAILURE();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Geometry);
    EXPECT_NE(std::string(failure.GetDescription()).find("mm apart"), std::string::npos) << failure.GetDescription();
  }
}

TEST(ColourBy, IsParsed)
{
  const ColourBy volume = rhombic::ParseColourBy("pet.nii.gz,0,7,inferno");
  EXPECT_EQ(volume.kind, ColourBy::Kind::Volume);
  EXPECT_EQ(volume.file, "pet.nii.gz");
  EXPECT_EQ(volume.range, (std::pair{ 0.0, 7.0 }));
  EXPECT_EQ(volume.map, "inferno");
  const ColourBy distance = rhombic::ParseColourBy("distance:a.stl");
  EXPECT_EQ(distance.kind, ColourBy::Kind::Distance);
  EXPECT_EQ(distance.file, "a.stl");
  EXPECT_FALSE(distance.range);
  const ColourBy deep = rhombic::ParseColourBy("pet,0,7,max:5mm");
  EXPECT_EQ(deep.summary, ColourBy::Summary::Maximum);
  EXPECT_EQ(deep.depth, 5.0);
  EXPECT_EQ(rhombic::ParseColourBy("pet,mean:2.5").summary, ColourBy::Summary::Mean);
  EXPECT_EQ(rhombic::ParseColourBy("thickness,0,5").kind, ColourBy::Kind::Thickness);
  EXPECT_EQ(rhombic::ParseColourBy("curvature").kind, ColourBy::Kind::Curvature);
  EXPECT_EQ(rhombic::ParseColourBy("curvature:4mm,-0.2,0.2").radius, 4.0);
  EXPECT_EQ(rhombic::ParseColourBy("./thickness").kind, ColourBy::Kind::Volume);
  for (const char * const wrong : { "",
                                    "distance:",
                                    "a.nii,3",
                                    "a.nii,7,0",
                                    "a.nii,0,7,rainbow",
                                    "a.nii,max:",
                                    "a.nii,max:-2mm",
                                    "thickness,max:5mm",
                                    "distance:a.stl,mean:3mm",
                                    "curvature:x" })
  {
    EXPECT_THROW(rhombic::ParseColourBy(wrong), rhombic::Failure) << wrong;
  }
}

} // namespace
