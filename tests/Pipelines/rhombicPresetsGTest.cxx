#include "rhombicPresets.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

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

TEST(Presets, SayWhichDenoisingSuitsThem)
{
  for (const auto & preset : rhombic::GetPresets())
  {
    EXPECT_EQ(preset.denoising == "none", preset.name == "mr-head") << preset.name;
  }
  const std::string surfaces = "surfaces: [{name: a, isovalue: 1}]";
  EXPECT_EQ(rhombic::ParsePreset("name: x\n" + surfaces, "test").denoising, "none");
  EXPECT_EQ(rhombic::ParsePreset("name: x\nsuggested-denoising: edges:1,60\n" + surfaces, "test").denoising,
            "edges:1,60");
}

TEST(Presets, ReadEverythingASurfaceHas)
{
  const auto preset = rhombic::ParsePreset(
    "name: x\ndescription: d\nsurfaces:\n"
    "  - {name: a, isovalue: -500.5, side: below, parts: enclosed, colour: \"#0000ff\", opacity: 0.25}\n"
    "  - {name: b, isovalue: otsu}\n",
    "test");
  ASSERT_EQ(preset.surfaces.size(), 2u);
  EXPECT_EQ(preset.surfaces[0].isovalue, -500.5);
  EXPECT_TRUE(preset.surfaces[0].insideIsBelow);
  EXPECT_EQ(preset.surfaces[0].parts, SurfaceRequest::Parts::Enclosed);
  EXPECT_EQ(preset.surfaces[0].colour, (rhombic::Colour{ 0.0, 0.0, 1.0 }));
  EXPECT_EQ(preset.surfaces[0].opacity, 0.25);
  EXPECT_FALSE(preset.surfaces[1].isovalue.has_value());
  EXPECT_FALSE(preset.surfaces[1].insideIsBelow);
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
                             "name: x\nsuggested-denoising: much\nsurfaces: [{name: a, isovalue: 1}]",
                             "name: [x\n" })
  {
    const auto sentence =
      DescriptionOfFailure([yaml] { rhombic::ParsePreset(yaml, "broken.yaml"); }, FailureKind::Unreadable);
    EXPECT_NE(sentence.find("broken.yaml"), std::string::npos) << yaml;
  }
  DescriptionOfFailure([] { rhombic::FindPreset("missing.yaml"); }, FailureKind::NotFound);
}

} // namespace
