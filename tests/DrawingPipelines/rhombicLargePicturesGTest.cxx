#include "rhombicLabelScan.h"
#include "rhombicMemoryRefusal.h"
#include "rhombicPictureIO.h"
#include "rhombicPictureSteps.h"
#include "rhombicRenderScan.h"
#include "rhombicScanWriter.h"
#include "rhombicTemporaryFolder.h"

#include "itkImageRegionIterator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

/** Pictures of surfaces that are larger than the memory allowed. */

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t Plenty = std::uintmax_t{ 1 } << 31;
constexpr std::uintmax_t Little = 10'000'000;

std::string
ReadFile(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class LargePictures : public testing::Test
{
protected:
  void
  SetUp() override
  {
    if (const std::string obstacle = rhombic::FindObstacle({ m_Folder.Path(), {} }, Plenty); !obstacle.empty())
    {
      GTEST_SKIP() << obstacle;
    }
  }

  /** Four labels that touch, in a ball. */
  rhombic::RenderScanSettings
  PicturesOfLabels(std::uintmax_t memory) const
  {
    const auto label = [](const itk::Point<double, 3> & point) {
      const bool isInside = std::hypot(point[0], point[1], point[2]) < 33.0;
      return isInside ? 1 + (point[0] > 3.0 ? 1 : 0) + (point[1] > -2.0 ? 2 : 0) : 0;
    };
    const fs::path path = m_Folder.Path() / "labels.nii";
    rhombic::WriteScan(rhombictest::MakeLabelScan({ { { 70, 70, 70 } }, { 1.0, 1.0, 1.0 } }, label).image, path);
    rhombic::RenderScanSettings settings = this->PicturesOf(path, memory);
    settings.source.surfaces.labels.emplace();
    return settings;
  }

  /** Noise, whose isosurface has 0.4 million triangles. */
  rhombic::RenderScanSettings
  PicturesOfNoise(std::uintmax_t memory) const
  {
    constexpr std::size_t edge = 50;
    const auto image = itk::Image<std::uint8_t, 3>::New();
    image->SetRegions(itk::Size<3>{ { edge, edge, edge } });
    image->Allocate();
    std::mt19937 random(7);
    std::generate_n(
      image->GetBufferPointer(), edge * edge * edge, [&random] { return static_cast<std::uint8_t>(random() % 256); });
    const fs::path path = m_Folder.Path() / "noise.nii";
    rhombic::WriteScan(rhombic::ScanImage(image), path);
    rhombic::RenderScanSettings settings = this->PicturesOf(path, memory);
    rhombic::SurfaceRequest request;
    request.name = "noise";
    request.isovalue = 127.5;
    settings.source.surfaces.requests = { request };
    return settings;
  }

  rhombic::RenderScanSettings
  PicturesOf(const fs::path & path, std::uintmax_t memory) const
  {
    rhombic::RenderScanSettings settings;
    settings.source.scan.path = path;
    settings.source.scan.read.maximumMemory = settings.source.scan.lattice.maximumMemory = memory;
    settings.source.scan.read.temporaryFolder = m_Folder.Path();
    settings.render.width = settings.render.height = 300;
    settings.views = {};
    settings.slices = { { rhombic::SlicePlane::Axial, "" }, { rhombic::SlicePlane::Coronal, "" } };
    settings.picture = m_Folder.Path() / "picture.png";
    settings.provenance.writesSidecars = false;
    return settings;
  }

  /** The bytes of all pictures, and the notes. */
  std::pair<std::string, std::string>
  Draw(const rhombic::RenderScanSettings & settings) const
  {
    rhombic::Events events;
    std::string notes;
    events.note = [&notes](const std::string & note) { notes += note + '\n'; };
    std::string bytes;
    for (const rhombic::MadeFile & made : RenderScan(settings, events))
    {
      bytes += ReadFile(made.path);
    }
    return { bytes, notes };
  }

  /** Expects the same bytes of pictures in temporary files, and that the plan says so. */
  void
  ExpectSame(const std::string & what, rhombic::RenderScanSettings settings) const
  {
    SCOPED_TRACE(what);
    rhombic::ScanSource & scan = settings.source.scan;
    scan.lattice.maximumMemory = Plenty;
    const auto whole = this->Draw(settings);
    EXPECT_EQ(whole.second.find("temporary files"), std::string::npos) << whole.second;
    scan.lattice.maximumMemory = Little;
    const std::string plan = PlanRenderScan(settings, {});
    EXPECT_NE(plan.find(" in temporary files in " + m_Folder.Path().string()), std::string::npos) << plan;
    const auto files = this->Draw(settings);
    EXPECT_NE(files.second.find("are put into temporary files of some"), std::string::npos) << files.second;
    EXPECT_EQ(files.first == whole.first, true);
  }

  rhombictest::TemporaryFolder m_Folder;
};

} // namespace

TEST_F(LargePictures, SlicesAreTheSameByTemporaryFiles)
{
  rhombic::RenderScanSettings labels = this->PicturesOfLabels(Little);
  this->ExpectSame("labels", labels);
  labels.source.finish.keepsLargestPart = true;
  this->ExpectSame("the largest parts of labels", labels);
  labels.slice.lightbox = 4;
  this->ExpectSame("a lightbox", labels);
  rhombic::RenderScanSettings noise = this->PicturesOfNoise(Little);
  this->ExpectSame("an isosurface", noise);
  noise.source.finish.minimumVolume = 0.001;
  noise.source.finish.smoothing.spacings = 0.3;
  this->ExpectSame("its parts, smoothed", noise);
}

TEST_F(LargePictures, ScenesAreTheSameByTemporaryFiles)
{
  for (const bool areLabels : { true, false })
  {
    const auto make = [&](std::uintmax_t memory) {
      const auto settings = areLabels ? this->PicturesOfLabels(memory) : this->PicturesOfNoise(memory);
      rhombic::SceneUse use;
      use.keepsScan = true;
      auto scene = MakePictureScene(settings.source, std::nullopt, use, {});
      EXPECT_EQ(scene.inFiles->IsUsed(), memory == Little);
      return scene;
    };
    const rhombic::PictureScene whole = make(Plenty);
    const rhombic::PictureScene files = make(Little);
    EXPECT_EQ(whole.report.dump(), files.report.dump());
    ASSERT_EQ(whole.surfaces.size(), areLabels ? 4u : 1u);
    for (std::size_t n = 0; n < whole.surfaces.size(); ++n)
    {
      EXPECT_TRUE(whole.surfaces[n].surface->GetPoints() == files.surfaces[n].surface->GetPoints());
      EXPECT_TRUE(whole.surfaces[n].surface->GetNormals() == files.surfaces[n].surface->GetNormals());
      EXPECT_TRUE(whole.surfaces[n].surface->GetTriangles() == files.surfaces[n].surface->GetTriangles());
    }
  }
}

TEST_F(LargePictures, LesionsAreInFrontOfTheOrgansThatTheyAreIn)
{
  for (const bool isLesionFirst : { false, true }) // of the names, so of the labels
  {
    const fs::path masks = m_Folder.Path() / (isLesionFirst ? "lesion-first" : "organ-first");
    fs::create_directory(masks);
    const auto write = [&masks](const std::string & name, itk::SizeValueType edge) {
      const auto image = itk::Image<std::uint8_t, 3>::New();
      image->SetRegions(itk::Size<3>{ { 16, 16, 16 } });
      image->Allocate(true);
      itk::ImageRegion<3> cube({ { 2, 2, 2 } }, { { edge, edge, edge } });
      for (itk::ImageRegionIterator<itk::Image<std::uint8_t, 3>> it(image, cube); !it.IsAtEnd(); ++it)
      {
        it.Set(1);
      }
      rhombic::WriteScan(rhombic::ScanImage(image), masks / (name + ".nii"));
    };
    const std::string organ = isLesionFirst ? "b" : "a", lesion = isLesionFirst ? "a" : "b";
    write(organ, 12);
    write(lesion, 5); // in a corner of the organ
    rhombic::RenderScanSettings settings = this->PicturesOf(masks, Plenty);
    settings.source.surfaces.labels.emplace();
    const rhombic::PictureScene scene = MakePictureScene(settings.source, std::nullopt, {}, {});
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[isLesionFirst ? 0 : 1].name, lesion);
    EXPECT_EQ(scene.surfaces[isLesionFirst ? 0 : 1].layer, 0u);
    EXPECT_EQ(scene.surfaces[isLesionFirst ? 1 : 0].layer, 1u);

    settings.source.surfaces.rules.rules = { rhombic::ParseSceneRule(organ + "=#00ff00,1"),
                                             rhombic::ParseSceneRule(lesion + "=#ff0000,1") };
    settings.cuts = { rhombic::ParseCutRequest("y<4") }; // through both
    settings.views = { {} };
    settings.slices = {};
    this->Draw(settings);
    const rhombic::Picture picture = rhombic::ReadPicture(settings.picture);
    double red = 0.0, green = 0.0;
    for (int n = 0; n < picture.width * picture.height; ++n)
    {
      const auto * const pixel = picture.At(n % picture.width, n / picture.width);
      red += pixel[0] > 2 * pixel[1];
      green += pixel[1] > 2 * pixel[0];
    }
    EXPECT_NEAR(red / (red + green), 25.0 / 144.0, 0.03) << isLesionFirst;
  }
}

TEST_F(LargePictures, WhatDoesNotFitIsRefusedBeforeTheWork)
{
  for (const bool areLabels : { true, false })
  {
    rhombic::RenderScanSettings settings = areLabels ? this->PicturesOfLabels(Little) : this->PicturesOfNoise(Little);
    const auto plan = [&settings] { PlanRenderScan(settings, {}); };
    settings.views = { {} };
    std::string sentence = rhombictest::MemoryRefusal(plan);
    EXPECT_EQ(sentence.rfind("A picture of 300 x 300 pixels would need", 0), 0u) << sentence;
    settings.views = {};
    settings.source.scan.read.temporaryFolder = m_Folder.Path() / "none";
    sentence = rhombictest::MemoryRefusal(plan);
    EXPECT_NE(sentence.find("their arrays are too large for the memory"), std::string::npos) << sentence;
    EXPECT_EQ(rhombictest::MemoryRefusal([&] { this->Draw(settings); }), sentence);
    EXPECT_FALSE(fs::exists(settings.picture));
  }
}

TEST_F(LargePictures, PlansTellWhatDrawingTakes)
{
  rhombic::RenderScanSettings settings = this->PicturesOfNoise(Plenty);
  EXPECT_EQ(PlanRenderScan(settings, {}).find("to draw them"), std::string::npos);
  settings.views = { {} };
  const auto mebibytesToDraw = [&settings] {
    const std::string plan = PlanRenderScan(settings, {});
    const std::size_t end = plan.find(" MiB to draw them");
    EXPECT_NE(end, std::string::npos) << plan;
    return std::stod(plan.substr(plan.rfind(' ', end - 1)));
  };
  const double small = mebibytesToDraw();
  settings.render.width = settings.render.height = 1200;
  const double large = mebibytesToDraw();
  EXPECT_GT(large, small + 1.0);
  settings.render.width = settings.render.height = 0; // then 1200 pixels
  EXPECT_EQ(mebibytesToDraw(), large);
  settings.source.finish.keepsLargestPart = true; // may leave few triangles
  EXPECT_EQ(PlanRenderScan(settings, {}).find("may be refused"), std::string::npos);
  settings.source.scan.lattice.maximumMemory = static_cast<std::uintmax_t>(std::ldexp(large - 1.0, 20));
  EXPECT_NE(PlanRenderScan(settings, {}).find("may be refused"), std::string::npos);
}
