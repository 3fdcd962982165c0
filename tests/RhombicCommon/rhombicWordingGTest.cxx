#include "rhombicWording.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::NearestName;

TEST(Wording, OneIsSingular)
{
  EXPECT_EQ(rhombic::Count(0, "label"), "0 labels");
  EXPECT_EQ(rhombic::Count(1, "label"), "1 label");
  EXPECT_EQ(rhombic::Count(2, "label"), "2 labels");
  EXPECT_EQ(rhombic::Count(1, "slice is", "slices are"), "1 slice is");
  EXPECT_EQ(rhombic::Count(7, "slice is", "slices are"), "7 slices are");
}

TEST(Wording, ListsEndWithAConjunction)
{
  EXPECT_EQ(rhombic::Enumerate({}), "");
  EXPECT_EQ(rhombic::Enumerate({ "lps" }), "lps");
  EXPECT_EQ(rhombic::Enumerate({ "lps", "ras" }), "lps or ras");
  EXPECT_EQ(rhombic::Enumerate({ "a", "b", "c" }, "and"), "a, b and c");
}

TEST(Wording, TheNearestNameIsSuggestedAndNoneThatIsFar)
{
  const std::vector<std::string> presets{ "ct-bone", "ct-bone-skin", "ct-lung", "ct-skin", "mr-head" };
  EXPECT_EQ(NearestName("ct-bnoe", presets), "ct-bone");
  EXPECT_EQ(NearestName("CT-Bone", presets), "ct-bone");
  EXPECT_EQ(NearestName("lung", presets), "ct-lung") << "a part";
  EXPECT_EQ(NearestName("ct-lungs-of-mine", presets), "ct-lung") << "the whole";
  EXPECT_EQ(NearestName("liver", presets), "");
  EXPECT_EQ(NearestName("ct", presets), "") << "two letters are a part of anything";
  EXPECT_EQ(NearestName("", presets), "");
  EXPECT_EQ(NearestName("a", { "b", "c" }), "");
  EXPECT_EQ(NearestName("leen", { "lean", "fine" }), "lean");
  EXPECT_EQ(NearestName("haert", { "heart", "head" }), "heart") << "two letters exchanged are one mistake";
  EXPECT_EQ(NearestName("thin", { "lean", "fine" }), "");
}

TEST(Wording, UnknownNamesComeWithASuggestionOrAdvice)
{
  EXPECT_EQ(rhombic::DescribeUnknown("mode", "leen", { "lean", "fine" }, "use lean or fine"),
            "There is no mode 'leen'; did you mean lean? Otherwise use lean or fine.");
  EXPECT_EQ(rhombic::DescribeUnknown("mode", "thin", { "lean", "fine" }, "use lean or fine"),
            "There is no mode 'thin'; use lean or fine.");
}

} // namespace
