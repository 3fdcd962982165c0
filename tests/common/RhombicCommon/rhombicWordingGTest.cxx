#include "rhombicWording.h"

#include "rhombicGermanNumbers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>

namespace
{

using rhombic::NearestName;
using Words = std::vector<std::string>;

TEST(Wording, NumbersAreThoseOfPrintf)
{
  for (const double value :
       { 0.0, -0.0, 0.05, -0.25, 1.0 / 3.0, 123456.5, 1234567.0, 1e-5, 1e300, HUGE_VAL, std::nan("") })
  {
    char text[400];
    std::snprintf(text, sizeof(text), "%.2f", value);
    EXPECT_EQ(rhombic::FormatFixed(value, 2), value == 0.0 ? "0.00" : text); // zero has no sign
    std::snprintf(text, sizeof(text), "%g", value);
    EXPECT_EQ(rhombic::FormatNumber(value), text);
    std::snprintf(text, sizeof(text), "%.3g", value);
    EXPECT_EQ(rhombic::FormatNumber(value, 3), text);
  }
  EXPECT_EQ(rhombic::FormatFixed(std::numeric_limits<double>::max(), 100).size(), 309u + 1u + 100u);
  EXPECT_EQ(rhombic::DescribeVolume(12.34), "12.3 ml");
  EXPECT_EQ(rhombic::DescribeVolume(0.0), "0.0 ml");
  EXPECT_EQ(rhombic::DescribeVolume(0.05), "0.1 ml");
  EXPECT_EQ(rhombic::DescribeVolume(0.0335), "33.5 mm3");
  EXPECT_EQ(rhombic::DescribeVolume(-3.351e-5), "-0.0335 mm3");
  EXPECT_EQ(rhombic::DescribeVolume(5.23e-10), "523 um3");
  EXPECT_EQ(rhombic::DescribeVolume(312.54, 0.004), "312.5 +- 0.0 ml");
  EXPECT_EQ(rhombic::DescribeVolume(3.351e-5, 1.2e-7), "0.0335 +- 0.00012 mm3");
  EXPECT_EQ(rhombic::DescribeArea(1234.0), "12.3 cm2");
  EXPECT_EQ(rhombic::DescribeArea(0.5027), "0.503 mm2");
  EXPECT_EQ(rhombic::DescribeArea(5.2e-5), "52 um2");
  EXPECT_EQ(rhombic::DescribeLength(12.34), "12.3 mm");
  EXPECT_EQ(rhombic::DescribeLength(0.3981), "0.398 mm");
  EXPECT_EQ(rhombic::DescribeLength(0.0398), "39.8 um");
  EXPECT_EQ(rhombic::DescribeSpacing(std::array<double, 3>{ 0.7, 0.7, 2.0 }), "0.7 x 0.7 x 2 mm");
  EXPECT_EQ(rhombic::DescribeSpacing(std::array<double, 3>{ 0.005, 0.005, 0.0125 }), "5 x 5 x 12.5 um");
  EXPECT_EQ(rhombic::DescribeSpacing(std::array<double, 3>{ 0.05, 0.05, 0.1 }), "0.05 x 0.05 x 0.1 mm");
  EXPECT_EQ(rhombic::FormatProduct(std::array<unsigned long, 3>{ 512, 512, 138 }), "512 x 512 x 138");
  EXPECT_EQ(rhombic::FormatProduct(std::array<double, 3>{ 0.7, 1.0 / 3.0, 2.0 }, 3), "0.7 x 0.333 x 2");
}

TEST(Wording, ExactNumbersAreReadBack)
{
  EXPECT_EQ(rhombic::FormatExact(0.1), "0.1");
  for (const double value : { 1.0 / 3.0, -std::numeric_limits<double>::max(), 1e-310 })
  {
    EXPECT_EQ(rhombic::ToNumber<double>(rhombic::FormatExact(value)), value);
  }
}

TEST(Wording, NumbersDoNotDependOnTheLocale)
{
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new rhombictest::GermanNumbers));
  EXPECT_EQ(rhombic::FormatFixed(1234.5, 1), "1234.5");
  EXPECT_EQ(rhombic::FormatFixed(-0.04, 1), "0.0");
  EXPECT_EQ(rhombic::FormatFixed(-0.0, 0), "0");
  EXPECT_EQ(rhombic::FormatFixed(-0.06, 1), "-0.1");
  EXPECT_EQ(rhombic::FormatFixed(-std::numeric_limits<double>::infinity(), 1), "-inf");
  EXPECT_EQ(rhombic::FormatNumber(1234.5), "1234.5");
  EXPECT_EQ(rhombic::ToNumber<double>("1234.5"), 1234.5);
  std::locale::global(before);
}

TEST(Wording, OnlyWholeTextsAreNumbers)
{
  EXPECT_EQ(rhombic::ToNumber<int>("-12"), -12);
  EXPECT_EQ(rhombic::ToNumber<std::uint8_t>("255"), 255);
  for (const char * const text : { "", " 1", "1 ", "+1", "1.5", "x", "256", "-1" })
  {
    EXPECT_FALSE(rhombic::ToNumber<std::uint8_t>(text)) << text;
  }
}

TEST(Wording, TextsAreTrimmedAndSplit)
{
  EXPECT_EQ(rhombic::LowerCase("Left KIDNEY \xC3\x84"), "left kidney \xC3\x84");
  EXPECT_EQ(rhombic::Trim(" \tleft kidney\r\n"), "left kidney");
  EXPECT_EQ(rhombic::Trim(" \t"), "");
  EXPECT_EQ(rhombic::SplitWords("  a bc\td\n"), std::vector<std::string_view>({ "a", "bc", "d" }));
  EXPECT_TRUE(rhombic::SplitWords(" ").empty());
  EXPECT_EQ(rhombic::Split("a,b;,c", ",;"), Words({ "a", "b", "", "c" }));
  EXPECT_EQ(rhombic::Split("", ","), Words({ "" }));
}

TEST(Wording, HashesAreThoseOfFNV1a)
{
  EXPECT_EQ(rhombic::HashText(""), "cbf29ce484222325");
  EXPECT_EQ(rhombic::HashText("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(rhombic::HashText("foobar"), "85944171f73967e8");
}

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
  EXPECT_EQ(NearestName("kidny", { "liver", "kidney_left", "kidney_right" }), "kidney_left") << "a word of a name";
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

TEST(Wording, PatternsMatchNames)
{
  using rhombic::MatchesPattern;
  EXPECT_TRUE(MatchesPattern("liver", "Liver"));
  EXPECT_FALSE(MatchesPattern("liver", "liver vessel"));
  EXPECT_TRUE(MatchesPattern("kidney*", "kidney_left"));
  EXPECT_TRUE(MatchesPattern("*left", "kidney_left"));
  EXPECT_TRUE(MatchesPattern("*", ""));
  EXPECT_TRUE(MatchesPattern("rib_*_?", "rib_left_7"));
  EXPECT_FALSE(MatchesPattern("rib_*_?", "rib_left_10"));
  EXPECT_TRUE(MatchesPattern("*a*b*", "xxaxxabb"));
  EXPECT_FALSE(MatchesPattern("a?", "a"));
  EXPECT_FALSE(MatchesPattern("", "a"));
}

TEST(Wording, WordsAreReplacedWhereTheyStandAlone)
{
  std::string text = "g.mhd is large, /g/ and g_2, not g2";
  rhombic::ReplaceWords(text, "g", "SCAN");
  EXPECT_EQ(text, "SCAN.mhd is large, /SCAN/ and SCAN_2, not g2");
  std::string folder = "Smith/IM1 in Smith/";
  rhombic::ReplaceWords(folder, "Smith/", "SCAN/");
  EXPECT_EQ(folder, "SCAN/IM1 in SCAN/") << "what ends without a letter";
  rhombic::ReplaceWords(text, "", "x");
  rhombic::ReplaceWords(text, "SCAN", "SCAN SCAN");
  EXPECT_EQ(text, "SCAN SCAN.mhd is large, /SCAN SCAN/ and SCAN SCAN_2, not g2");
}

} // namespace
