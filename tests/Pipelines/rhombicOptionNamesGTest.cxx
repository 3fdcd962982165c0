#include "rhombicOptionNames.h"

#include "rhombicDenoising.h"
#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSurfaceFinish.h"

#include <gtest/gtest.h>

#include <functional>

using rhombic::NameOptions;

namespace
{

/** What the program says of a module's failure. */
std::string
SentenceOf(const std::function<void()> & work)
{
  try
  {
    work();
  }
  catch (const rhombic::Failure & failure)
  {
    return NameOptions(failure.GetDescription());
  }
  return "no failure";
}

} // namespace

TEST(OptionNames, StandInPlaceOfTheSettingsThatModulesName)
{
  EXPECT_EQ(NameOptions("choose one with ScanReadOptions::series and an id from a; ScanReadOptions::series"),
            "choose one with --series and an id from a; --series");
  EXPECT_EQ(NameOptions("SurfaceFinish::minimumVolume in place of SurfaceFinish::keepsLargestPart"),
            "--min-volume in place of --largest");
  EXPECT_EQ(NameOptions("no setting"), "no setting");
}

TEST(OptionNames, AreThoseOfFailuresOfModules)
{
  using rhombic::Denoising;
  const auto denoise = [](double sigma, double edge) {
    return SentenceOf([&] { rhombic::CheckDenoising({ Denoising::Kind::EdgePreserving, sigma, edge }); });
  };
  EXPECT_EQ(denoise(-1.0, 60.0),
            "The sigma of --denoise must be a positive number of mm; try gaussian:0.7 or edges:0.7,60.");
  EXPECT_EQ(denoise(0.7, 0.0),
            "--denoise edges needs the least gradient of an edge, in the scan's units per mm: a positive number after "
            "sigma, as in edges:0.7,60.");
  EXPECT_NE(SentenceOf([] { rhombic::RequireMemory(2, 1, "Reading"); }).find("--max-memory 1G"), std::string::npos);

  const auto finish = [](auto rhombic::SurfaceFinish::*member) {
    rhombic::SurfaceFinish settings;
    settings.*member = -1.0;
    return SentenceOf([&] { CheckSurfaceFinish(settings); });
  };
  EXPECT_EQ(finish(&rhombic::SurfaceFinish::minimumVolume),
            "The smallest volume of a part must be 0 ml or more; write --min-volume 0.5 for half a millilitre.");
  EXPECT_EQ(
    finish(&rhombic::SurfaceFinish::smoothing),
    "Smoothing moves points by 0 to 1 spacings of the lattice, or by a length; write --smooth 0.3 or 0.8mm, for "
    "example.");
  EXPECT_EQ(finish(&rhombic::SurfaceFinish::share),
            "The share of triangles to keep must be above 0 and at most 100 %; write --max-triangles 10%.");
}
