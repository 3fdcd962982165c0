#include "rhombicGreyWindow.h"

#include "rhombicFailure.h"
#include "rhombicSliceTestScans.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using rhombic::GreyWindow;

/** Values 0 to 999 of an MR, with as many of padding. */
rhombic::Scan
MakeMR()
{
  const auto image = slicetest::MakeImage<std::int16_t>({ 20, 10, 10 });
  slicetest::Fill(*image, {}, [n = 0](const auto &, const auto &) mutable { return ++n > 1000 ? n - 1001 : -50; });
  rhombic::Scan scan;
  scan.image = image;
  scan.modality = "MR";
  return scan;
}

TEST(GreyWindow, TheEndsAreBlackAndWhite)
{
  const GreyWindow window{ 350, 50 };
  EXPECT_EQ(window.GreyOf(-125), 0);
  EXPECT_EQ(window.GreyOf(-1e30), 0);
  EXPECT_EQ(window.GreyOf(50), 128);
  EXPECT_EQ(window.GreyOf(224.4), 255);
  EXPECT_EQ(window.GreyOf(225), 255);
  EXPECT_EQ(window.GreyOf(1e30), 255);
  EXPECT_EQ(window.GreyOf(std::nan("")), 0);
}

TEST(GreyWindow, PresetsAndNumbersAreReadAndOthersRefused)
{
  const rhombic::Scan scan = MakeMR();
  for (const auto & [name, preset] : rhombic::WindowPresets())
  {
    EXPECT_GT(preset.width, 0.0);
    EXPECT_EQ(WindowFromText(name, scan).centre, preset.centre);
  }
  const GreyWindow liver = rhombic::WindowFromText("Liver", scan); // soft tissue, unlike that of some programs
  EXPECT_LE(liver.width, 250.0);
  EXPECT_GT(liver.centre, 0.0);
  const GreyWindow window = rhombic::WindowFromText("350.5/-50", scan);
  EXPECT_EQ(window.width, 350.5);
  EXPECT_EQ(window.centre, -50.0);
  for (const char * text : { "", "350", "0/50", "-1/50", "350/", "350/50/1", "nan/5", "inf/5", "5/nan", "livver" })
  {
    EXPECT_THROW(rhombic::WindowFromText(text, scan), rhombic::Failure) << text;
  }
}

TEST(GreyWindow, AutomaticWindowsFollowTheValues)
{
  rhombic::Scan scan = MakeMR();
  const GreyWindow window = rhombic::WindowFromText("auto", scan);
  EXPECT_NEAR(window.centre, 499.5, 1.0); // the padding has no part in it
  EXPECT_NEAR(window.width, 980.0, 2.0);

  scan.modality = "CT"; // with raw numbers instead of HU
  EXPECT_NEAR(AutomaticWindow(scan).width, 980.0, 2.0);
  scan.modality = "";
  EXPECT_NEAR(AutomaticWindow(scan).width, 980.0, 2.0);
  std::get<itk::Image<std::int16_t, 3>::Pointer>(scan.image)->GetBufferPointer()[0] = -1000;
  EXPECT_EQ(AutomaticWindow(scan).width, 400.0);
  scan.modality = "CT";
  EXPECT_EQ(AutomaticWindow(scan).width, 400.0);

  const auto constant = slicetest::MakeImage<float>({ 3, 3, 3 });
  constant->FillBuffer(7.0f);
  scan.image = constant;
  EXPECT_EQ(AutomaticWindow(scan).centre, 7.0);
  EXPECT_GT(AutomaticWindow(scan).width, 0.0);
  constant->FillBuffer(std::nanf(""));
  EXPECT_GT(AutomaticWindow(scan).width, 0.0);
}

} // namespace
