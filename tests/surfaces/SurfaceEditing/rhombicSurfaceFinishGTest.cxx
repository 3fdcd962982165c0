#include "rhombicSurfaceFinish.h"

#include "rhombicFailure.h"
#include "itkExampleSurfaces.h"

#include <gtest/gtest.h>

namespace
{

/** The notes of keeping the largest of two balls. */
std::string
NotesOfLargest(double smallerRadius)
{
  const auto surface = itk::example::MakeSphere(10.0, 4);
  itk::example::Append(*surface, *itk::example::MakeSphere(smallerRadius, 4), { 30.0f, 0.0f, 0.0f });
  rhombic::SurfaceFinish finish;
  finish.keepsLargestPart = true;
  std::string notes;
  rhombic::Events events;
  events.note = [&notes](const std::string & line) { notes += line + '\n'; };
  const auto removal = rhombic::RemoveParts(*surface, finish, "bone", events);
  EXPECT_EQ(removal.removed.solids, 1u);
  EXPECT_EQ(notes.find("warning") != std::string::npos, !removal.warning.empty());
  return notes;
}

TEST(SurfaceFinish, WarnsOfALargePartThatIsLeftOut)
{
  const std::string shoulder = NotesOfLargest(5.4); // 13.6 % of both
  EXPECT_NE(shoulder.find("warning: bone: only the largest part is kept, which leaves out 13.6 %"), std::string::npos)
    << shoulder;
}

TEST(SurfaceFinish, TellsOfSpecksWithoutAWarning)
{
  const std::string speck = NotesOfLargest(3.5); // 4.1 % of both
  EXPECT_NE(speck.find("removed 1 solid"), std::string::npos) << speck;
  EXPECT_EQ(speck.find("warning"), std::string::npos) << speck;
}

TEST(SmoothingLimit, IsANumberOfSpacingsOrALength)
{
  using rhombic::ParseSmoothingLimit;
  EXPECT_EQ(ParseSmoothingLimit("0.3").FindLargestMove(2.0), 0.6);
  EXPECT_EQ(ParseSmoothingLimit("0.8mm").FindLargestMove(2.0), 0.8);
  EXPECT_EQ(ParseSmoothingLimit("0.8 mm").FindLargestMove(2.0), 0.8);
  EXPECT_TRUE(ParseSmoothingLimit("0").IsNothing());
  EXPECT_TRUE(ParseSmoothingLimit("0mm").IsNothing());
  for (const char * text : { "", "mm", "0.8cm", "0.8mmm", "a lot", "0.3 0.4" })
  {
    EXPECT_THROW(ParseSmoothingLimit(text), rhombic::Failure) << text;
  }
}

TEST(SmoothingLimit, OfTwoFinishesIsTheLarger)
{
  rhombic::SurfaceFinish spacings;
  spacings.smoothing = 0.5;
  rhombic::SurfaceFinish length;
  length.smoothing = rhombic::ParseSmoothingLimit("0.8mm");
  EXPECT_EQ(CombineFinish(spacings, length).smoothing.FindLargestMove(1.0), 0.8);
  EXPECT_EQ(CombineFinish(length, spacings).smoothing.FindLargestMove(2.0), 1.0);
  length.smoothing.millimetres = -1.0;
  EXPECT_THROW(CheckSurfaceFinish(length), rhombic::Failure);
}

} // namespace
