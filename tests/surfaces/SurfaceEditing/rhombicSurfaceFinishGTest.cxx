#include "rhombicSurfaceFinish.h"

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

} // namespace
