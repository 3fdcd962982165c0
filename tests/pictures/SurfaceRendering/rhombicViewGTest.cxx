#include "rhombicFailure.h"
#include "rhombicView.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using rhombic::ObliqueView;
using rhombic::View;
using rhombic::ViewFromText;
using DirectionType = rhombic::Vector3;

void
ExpectView(const View & view, DirectionType look, DirectionType up, DirectionType right, const std::string & letters)
{
  const auto & frame = view.frame;
  EXPECT_EQ(frame.look, look);
  EXPECT_EQ(frame.up, up);
  EXPECT_EQ(frame.right, right);
  const auto edges = rhombic::EdgeLettersOf(frame);
  EXPECT_EQ(edges.left + edges.right + edges.top + edges.bottom, letters);
}

void
ExpectUsage(const std::string & text, const std::string & inSentence)
{
  try
  {
    rhombic::ViewFromText(text);
    ADD_FAILURE() << "there is no view " << text;
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
    EXPECT_NE(std::string(failure.GetDescription()).find(inSentence), std::string::npos) << failure.GetDescription();
  }
}

// Worked out by hand in LPS: x to the patient's left, y to the back, z to the head. Letters: left, right, top, bottom.

TEST(View, AnteriorLooksAtTheFace)
{
  ExpectView(ViewFromText("anterior"), { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, "RLHF");
}

TEST(View, PosteriorLooksAtTheBack)
{
  ExpectView(ViewFromText("posterior"), { 0, -1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, "LRHF");
}

TEST(View, LeftHasTheNoseAtTheLeft)
{
  ExpectView(ViewFromText("left"), { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, "APHF");
}

TEST(View, RightHasTheNoseAtTheRight)
{
  ExpectView(ViewFromText("right"), { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 }, "PAHF");
}

TEST(View, SuperiorHasThePatientsLeftAtTheLeft)
{
  ExpectView(ViewFromText("superior"), { 0, 0, -1 }, { 0, -1, 0 }, { -1, 0, 0 }, "LRAP");
}

TEST(View, InferiorIsTheRadiologicalAxialOrientation)
{
  ExpectView(ViewFromText("inferior"), { 0, 0, 1 }, { 0, -1, 0 }, { 1, 0, 0 }, "RLAP");
}

TEST(View, NamesAreReadBack)
{
  for (const View & view : rhombic::StandardViews())
  {
    EXPECT_EQ(ViewFromText(view.name).name, view.name);
    EXPECT_EQ(ViewFromText(view.name.substr(0, 3)).name, view.name);
    EXPECT_EQ(ViewFromText(view.name.substr(0, 1)).name, view.name);
  }
  EXPECT_EQ(ViewFromText("Anterior").name, View().name);
  EXPECT_EQ(ViewFromText("H").name, "superior");
  EXPECT_EQ(ViewFromText("f").name, "inferior");
}

TEST(View, ObliqueViewsMeetTheStandardOnesAtRightAngles)
{
  const auto expectSame = [](const View & a, const View & b) {
    EXPECT_EQ(a.frame.look, b.frame.look) << b.name;
    EXPECT_EQ(a.frame.up, b.frame.up) << b.name;
    EXPECT_EQ(a.frame.right, b.frame.right) << b.name;
  };
  expectSame(ObliqueView(0, 0), ViewFromText("anterior"));
  expectSame(ObliqueView(90, 0), ViewFromText("left"));
  expectSame(ObliqueView(180, 0), ViewFromText("posterior"));
  expectSame(ObliqueView(-180, 0), ViewFromText("posterior"));
  expectSame(ObliqueView(-90, 0), ViewFromText("right"));
  expectSame(ObliqueView(270, 0), ViewFromText("right"));
  expectSame(ObliqueView(180, 90), ViewFromText("superior"));
  expectSame(ObliqueView(0, -90), ViewFromText("inferior"));
}

TEST(View, ObliqueViewsAreAsTheAnglesSay)
{
  // From the front, 30 degrees towards the patient's left (x) and 15 degrees up (z).
  const auto frame = ViewFromText("30,15").frame;
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_NEAR(frame.look[0], -std::sin(30 * degree) * std::cos(15 * degree), 1e-15);
  EXPECT_NEAR(frame.look[1], std::cos(30 * degree) * std::cos(15 * degree), 1e-15);
  EXPECT_NEAR(frame.look[2], -std::sin(15 * degree), 1e-15);
  EXPECT_NEAR(frame.right[0], std::cos(30 * degree), 1e-15);
  EXPECT_NEAR(frame.right[1], std::sin(30 * degree), 1e-15);
  EXPECT_NEAR(frame.right[2], 0.0, 1e-15);
  EXPECT_GT(frame.up[2], 0.9);
  for (double azimuth = -350.0; azimuth < 360.0; azimuth += 37.0)
  {
    for (double elevation = -90.0; elevation <= 90.0; elevation += 15.0)
    {
      const auto axes = ObliqueView(azimuth, elevation).frame;
      EXPECT_NEAR(rhombic::Dot(axes.look, axes.look), 1.0, 1e-12);
      EXPECT_NEAR(rhombic::Dot(axes.up, axes.up), 1.0, 1e-12);
      EXPECT_NEAR(rhombic::Dot(axes.look, axes.up), 0.0, 1e-12);
      EXPECT_NEAR(rhombic::Dot(rhombic::Cross(axes.look, axes.up), axes.right), 1.0, 1e-12);
    }
  }
}

TEST(View, NamesOfObliqueViewsFitIntoFileNames)
{
  EXPECT_EQ(ViewFromText("30,-15").name, "az30el-15");
  EXPECT_EQ(ViewFromText("-0,22.5").name, "az0el22.5");
}

TEST(View, WhatIsNoViewIsAnErrorThatSaysWhatIs)
{
  ExpectUsage("front", "anterior, posterior, left");
  ExpectUsage("", "anterior, posterior, left");
  ExpectUsage("30,", "30,15");
  ExpectUsage("30,15,4", "30,15");
  ExpectUsage("30;15", "30,15");
  ExpectUsage("nan,15", "degrees");
  ExpectUsage("361,0", "-360 to 360");
  ExpectUsage("0,91", "-90 to 90");
}

} // namespace
