#include "rhombicFailure.h"
#include "rhombicView.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::View;
using DirectionType = rhombic::ViewFrame::DirectionType;

void
ExpectView(View view, DirectionType look, DirectionType up, DirectionType right, const std::string & letters)
{
  const auto frame = rhombic::FrameOf(view);
  EXPECT_EQ(frame.look, look);
  EXPECT_EQ(frame.up, up);
  EXPECT_EQ(frame.right, right);
  const auto edges = rhombic::EdgeLettersOf(view);
  EXPECT_EQ((std::string{ edges.left, edges.right, edges.top, edges.bottom }), letters);
}

// Worked out by hand in LPS: x to the patient's left, y to the back, z to the head. Letters: left, right, top, bottom.

TEST(View, AnteriorLooksAtTheFace)
{
  ExpectView(View::Anterior, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, "RLHF");
}

TEST(View, PosteriorLooksAtTheBack)
{
  ExpectView(View::Posterior, { 0, -1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, "LRHF");
}

TEST(View, LeftHasTheNoseAtTheLeft)
{
  ExpectView(View::Left, { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, "APHF");
}

TEST(View, RightHasTheNoseAtTheRight)
{
  ExpectView(View::Right, { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 }, "PAHF");
}

TEST(View, SuperiorHasThePatientsLeftAtTheLeft)
{
  ExpectView(View::Superior, { 0, 0, -1 }, { 0, -1, 0 }, { -1, 0, 0 }, "LRAP");
}

TEST(View, InferiorIsTheRadiologicalAxialOrientation)
{
  ExpectView(View::Inferior, { 0, 0, 1 }, { 0, -1, 0 }, { 1, 0, 0 }, "RLAP");
}

TEST(View, NamesAreReadBack)
{
  for (const View view : rhombic::AllViews)
  {
    EXPECT_EQ(rhombic::ViewFromName(rhombic::NameOf(view)), view);
  }
  EXPECT_EQ(rhombic::ViewFromName("Anterior"), View::Anterior);
}

TEST(View, UnknownNameListsTheKnownOnes)
{
  try
  {
    rhombic::ViewFromName("front");
    FAIL() << "there is no such view";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
    EXPECT_NE(std::string(failure.GetDescription()).find("anterior, posterior, left"), std::string::npos);
  }
}

} // namespace
