#include "rhombicPresets.h"

#include "rhombicFailure.h"
#include "rhombicGermanNumbers.h"

#include <gtest/gtest.h>

#include <locale>
#include <set>

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::SurfaceRequest;

std::string
DescriptionOfFailure(const std::function<void()> & work, FailureKind kind)
{
  try
  {
    work();
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), kind);
    return failure.GetDescription();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(Presets, AllBuiltInOnesParse)
{
  std::set<std::string> names;
  for (const auto & preset : rhombic::GetPresets())
  {
    names.insert(preset.name);
    EXPECT_FALSE(preset.description.empty());
    EXPECT_FALSE(preset.surfaces.empty());
    EXPECT_EQ(rhombic::FindPreset(preset.name).surfaces.size(), preset.surfaces.size());
  }
  for (const char * name : { "ct-bone", "ct-skin", "ct-lung", "ct-bone-skin", "mr-head" })
  {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

TEST(Presets, ThoseForCTRemoveTheTable)
{
  for (const auto & preset : rhombic::GetPresets())
  {
    EXPECT_EQ(preset.removesTable, preset.name.rfind("ct-", 0) == 0) << preset.name;
  }
  const std::string surfaces = "surfaces: [{name: a, isovalue: 1}]";
  EXPECT_FALSE(rhombic::ParsePreset("name: x\n" + surfaces, "test").removesTable);
  EXPECT_FALSE(rhombic::ParsePreset("name: x\nremoves: nothing\n" + surfaces, "test").removesTable);
  EXPECT_TRUE(rhombic::ParsePreset("name: x\nremoves: table\n" + surfaces, "test").removesTable);
  const auto sentence = DescriptionOfFailure(
    [&] { rhombic::ParsePreset("name: x\nremoves: bed\n" + surfaces, "test"); }, FailureKind::Unreadable);
  EXPECT_NE(sentence.find("'nothing' or 'table'"), std::string::npos) << sentence;
}

TEST(Presets, SayHowNoiseIsRemoved)
{
  using Kind = rhombic::Denoising::Kind;
  for (const auto & preset : rhombic::GetPresets())
  {
    const bool isSmoothed = preset.name != "mr-brain"; // its sulci are as narrow as the Gaussian
    EXPECT_EQ(preset.denoising.kind, isSmoothed ? Kind::Gaussian : Kind::None) << preset.name;
  }
  const std::string surfaces = "surfaces: [{name: a, isovalue: 1}]";
  EXPECT_EQ(rhombic::ParsePreset("name: x\n" + surfaces, "test").denoising.kind, Kind::None);
  const auto edges = rhombic::ParsePreset("name: x\ndenoise: edges:1,60\n" + surfaces, "test").denoising;
  EXPECT_EQ(edges.kind, Kind::EdgePreserving);
  EXPECT_EQ(edges.edge, 60.0);
}

TEST(Presets, HaveRulesForLabels)
{
  const auto preset =
    rhombic::ParsePreset("name: x\nsurfaces: [{name: a, isovalue: 1}]\n"
                         "rules: [{match: 'lung*', opacity: 0.5}, {match: 'group:bones', colour: red}]\n",
                         "test");
  ASSERT_EQ(preset.rules.size(), 2u);
  EXPECT_EQ(preset.rules[0].pattern, "lung*");
  EXPECT_EQ(preset.rules[0].opacity, 0.5);
  EXPECT_FALSE(preset.rules[0].colour.has_value());
  EXPECT_EQ(preset.rules[1].colour, (rhombic::Colour{ 1.0, 0.0, 0.0 }));
}

TEST(Presets, ReadEverythingASurfaceHas)
{
  const auto preset = rhombic::ParsePreset(
    "name: x\ndescription: d\nsurfaces:\n"
    "  - {name: a, isovalue: -500.5, side: below, parts: enclosed, colour: \"#0000ff\", opacity: 0.25, look: glossy}\n"
    "  - {name: b, isovalue: otsu, parts: outermost, min-volume: 2, largest: true, fill: true, smooth: 0.3}\n",
    "test");
  ASSERT_EQ(preset.surfaces.size(), 2u);
  EXPECT_EQ(preset.surfaces[0].isovalue, -500.5);
  EXPECT_TRUE(preset.surfaces[0].insideIsBelow);
  EXPECT_EQ(preset.surfaces[0].parts, SurfaceRequest::Parts::Enclosed);
  EXPECT_EQ(preset.surfaces[0].colour, (rhombic::Colour{ 0.0, 0.0, 1.0 }));
  EXPECT_EQ(preset.surfaces[0].opacity, 0.25);
  EXPECT_TRUE(rhombic::IsGlossy(preset.rules, "a"));
  EXPECT_FALSE(rhombic::IsGlossy(preset.rules, "b"));
  EXPECT_FALSE(preset.surfaces[1].isovalue.has_value());
  EXPECT_EQ(preset.surfaces[1].parts, SurfaceRequest::Parts::Outermost);
  EXPECT_EQ(preset.surfaces[1].finish.minimumVolume, 2.0);
  EXPECT_TRUE(preset.surfaces[1].finish.keepsLargestPart);
  EXPECT_TRUE(preset.surfaces[1].finish.fillsCavities);
  EXPECT_EQ(preset.surfaces[1].finish.smoothing.spacings, 0.3);
  EXPECT_FALSE(preset.surfaces[1].insideIsBelow);
}

TEST(Presets, DoNotDependOnTheLocaleOfTheHost)
{
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new rhombictest::GermanNumbers));
  const auto preset =
    rhombic::ParsePreset("name: x\nsurfaces: [{name: a, isovalue: 1.5, opacity: 0.5, min-volume: 0.2}]", "test");
  std::locale::global(before);
  EXPECT_EQ(preset.surfaces[0].isovalue, 1.5);
  EXPECT_EQ(preset.surfaces[0].opacity, 0.5);
  EXPECT_EQ(preset.surfaces[0].finish.minimumVolume, 0.2);
}

TEST(Presets, SuggestTheNearestName)
{
  const auto sentence = DescriptionOfFailure([] { rhombic::FindPreset("ct-bnoe"); }, FailureKind::Usage);
  EXPECT_NE(sentence.find("did you mean ct-bone?"), std::string::npos) << sentence;
}

TEST(Presets, RefuseDamagedFiles)
{
  for (const char * yaml : { "",
                             "just text",
                             "[1, 2]",
                             "name: x",
                             "name: x\nsurfaces: []",
                             "name: x\nsurfaces: [{name: a}]",
                             "name: x\nsurfaces: [{name: a, isovalue: high}]",
                             "name: x\nsurfaces: [{name: a, isovalue: .nan}]",
                             "name: x\nsurfaces: [{name: a, isovalue: -.inf}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, side: left}]",
                             "name: x\ncolor: red\nsurfaces: [{name: a, isovalue: 1}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, colr: 2}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, parts: inner}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, min-volume: -1}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, min-volume: 2 ml}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, min-volume: [2]}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, largest: 2}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, fill: maybe}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\nrules: [{opacity: 0.5}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\nrules: [{match: 'group:bone'}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\nrules: [{match: a, opacity: 2}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1, isovalue: 2}]",
                             "name: x\nsurfaces: [{name: , isovalue: 1}]",
                             "name: x\nsurfaces: [{name: '', isovalue: 1}]",
                             "name: x\nsurfaces: [{name: !, isovalue: 1}]",
                             "name: x\nsurfaces: [{name: !!str , isovalue: 1}]",
                             "name: x\ndenoise: much\nsurfaces: [{name: a, isovalue: 1}]",
                             "name: x\ndescription: \xE4\nsurfaces: [{name: a, isovalue: 1}]",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\n---\nname: y\n",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\n%u",
                             "{name: x, surfaces: [{name: a, isovalue: 1}]} rules: []",
                             "name: [x\n",
                             ",a\n%a", // documents without end for yaml-cpp
                             ",",
                             "name: x\nsurfaces: [{name: a, isovalue: 1}]\n,",
                             "]" })
  {
    const auto sentence =
      DescriptionOfFailure([yaml] { rhombic::ParsePreset(yaml, "broken.yaml"); }, FailureKind::Unreadable);
    EXPECT_NE(sentence.find("broken.yaml"), std::string::npos) << yaml;
  }
  DescriptionOfFailure([] { rhombic::FindPreset("missing.yaml"); }, FailureKind::NotFound);
}

/** yaml-cpp takes characters that YAML forbids. */
TEST(Presets, ControlCharactersAreRefusedWithTheirLine)
{
  const auto presetWith = [](const std::string & text) {
    return "name: x\ndescription: \"a" + text + "b\"\nsurfaces: [{name: a, isovalue: 1}]\n";
  };
  for (const std::string wrong : { "\x01",
                                   "\x0B",
                                   "\x1F",
                                   "\x7F",
                                   "\xC2\x80",
                                   "\xC2\x84",
                                   "\xC2\x86",
                                   "\xC2\x9F",
                                   "\xEF\xBF\xBE",
                                   "\xEF\xBF\xBF" })
  {
    const auto sentence =
      DescriptionOfFailure([&] { rhombic::ParsePreset(presetWith(wrong), "broken.yaml"); }, FailureKind::Unreadable);
    EXPECT_NE(sentence.find("control character in line 2"), std::string::npos) << sentence;
  }
  for (const std::string right :
       { "\t", "\xC2\x85", "\xC2\xA0", "\xC3\x84", "\xEF\xBF\xBD", "\xEE\x80\x80", "\xF0\x9F\x98\x80", "\\x01" })
  {
    EXPECT_EQ(rhombic::ParsePreset(presetWith(right), "x.yaml").name, "x");
  }
}

} // namespace
