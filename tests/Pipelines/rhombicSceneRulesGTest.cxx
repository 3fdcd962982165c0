#include "rhombicScanSource.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using rhombic::ApplySceneRules;
using rhombic::Failure;
using rhombic::LabelMap;
using rhombic::SceneRules;
using rhombic::SurfaceRequest;

SurfaceRequest
MakeRequest(const std::string & name)
{
  SurfaceRequest request;
  request.name = name;
  request.isovalue = 1.0;
  return request;
}

/** A map of 8 x 8 x 8 voxels in which every label touches others, at random. */
LabelMap
MakeMap(const std::vector<std::string> & names)
{
  using ImageType = rhombic::CartesianImage<std::uint8_t>;
  const auto image = ImageType::New();
  image->SetRegions(itk::Size<3>{ { 8, 8, 8 } });
  image->Allocate();
  std::mt19937 random(3);
  std::uniform_int_distribution<int> value(0, static_cast<int>(names.size()));
  std::generate_n(image->GetBufferPointer(), 512, [&] { return static_cast<std::uint8_t>(value(random)); });
  LabelMap map;
  map.scan.image = ImageType::Pointer(image);
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    rhombic::LabelSummary summary;
    summary.label.value = static_cast<std::int32_t>(n + 1);
    summary.label.name = names[n];
    summary.label.colour = { 0, 255, 255 };
    map.labels.push_back(summary);
  }
  return map;
}

std::vector<std::string>
NamesOf(const LabelMap & map)
{
  std::vector<std::string> names;
  for (const auto & summary : map.labels)
  {
    names.push_back(summary.label.name);
  }
  return names;
}

std::string
SentenceOf(const SceneRules & rules, const std::vector<std::string> & names)
{
  LabelMap map = MakeMap(names);
  std::vector<SurfaceRequest> requests;
  try
  {
    ApplySceneRules(rules, requests, &map);
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
    return failure.GetDescription();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(SceneRules, ShowWhatPatternsName)
{
  LabelMap map = MakeMap({ "liver", "kidney_left", "kidney_right", "spleen", "rib_left_7" });
  std::vector<SurfaceRequest> requests{ MakeRequest("skin"), MakeRequest("bone") };
  SceneRules rules;
  rules.only = { "SKIN", "kidney*", "group:bones" };
  rules.hidden = { "*right", "bone" };
  ApplySceneRules(rules, requests, &map);
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].name, "skin");
  EXPECT_EQ(NamesOf(map), (std::vector<std::string>{ "kidney_left", "rib_left_7" }));
}

TEST(SceneRules, LaterRulesCountMore)
{
  LabelMap map = MakeMap({ "liver", "spleen" });
  std::vector<SurfaceRequest> requests{ MakeRequest("skin") };
  SceneRules rules;
  rules.rules = { rhombic::ParseSceneRule("*=red,0.5"),
                  rhombic::ParseSceneRule("liver=#994736"),
                  rhombic::ParseSceneRule("skin=,0.2") };
  ApplySceneRules(rules, requests, &map);
  EXPECT_EQ(requests[0].colour, (rhombic::Colour{ 1.0, 0.0, 0.0 }));
  EXPECT_EQ(requests[0].opacity, 0.2);
  EXPECT_EQ(map.labels[0].label.colour, (std::array<std::uint8_t, 3>{ 0x99, 0x47, 0x36 }));
  EXPECT_EQ(map.labels[0].label.opacity, 0.5);
  EXPECT_EQ(map.labels[1].label.colour, (std::array<std::uint8_t, 3>{ 255, 0, 0 }));
}

TEST(SceneRules, TheLastRuleWithALookCounts)
{
  const std::vector<rhombic::SceneRule> rules{ rhombic::ParseSceneRule("*=,,glossy"),
                                               rhombic::ParseSceneRule("skin=red,0.5,matte"),
                                               rhombic::ParseSceneRule("skin=,0.2") };
  EXPECT_TRUE(rhombic::IsGlossy(rules, "liver"));
  EXPECT_FALSE(rhombic::IsGlossy(rules, "skin"));
  EXPECT_FALSE(rhombic::IsGlossy({}, "skin"));
}

TEST(SceneRules, AWholeListOfLabelsKeepsItsColoursWhenSomeAreHidden)
{
  LabelMap all = MakeMap({ "a", "b", "c", "d" });
  LabelMap some = MakeMap({ "a", "b", "c", "d" });
  std::vector<SurfaceRequest> requests;
  ApplySceneRules({}, requests, &all);
  SceneRules rules;
  rules.hidden = { "a", "c" };
  ApplySceneRules(rules, requests, &some);
  EXPECT_EQ(some.labels[0].label.colour, all.labels[1].label.colour);
  EXPECT_EQ(some.labels[1].label.colour, all.labels[3].label.colour);
}

TEST(SceneRules, SuggestTheNearestName)
{
  SceneRules rules;
  rules.only = { "livr" };
  EXPECT_NE(SentenceOf(rules, { "liver", "spleen" }).find("did you mean liver?"), std::string::npos);
  rules.only = { "group:bonse" };
  EXPECT_NE(SentenceOf(rules, { "liver" }).find("did you mean group:bones?"), std::string::npos);
  rules.only = { "liver" };
  rules.hidden = { "l*" };
  EXPECT_NE(SentenceOf(rules, { "liver", "spleen" }).find("No surface is left"), std::string::npos);
}

TEST(SceneRules, RefuseWhatIsNoRule)
{
  for (const char * text : { "",
                             "=red",
                             "liver=red,0",
                             "liver=red,2",
                             "liver=red,0.5,1",
                             "liver=,,shiny",
                             "liver=,,glossy,",
                             "liver=nocolour",
                             "liver=,x" })
  {
    EXPECT_THROW(rhombic::ParseSceneRule(text), Failure) << text;
  }
}

TEST(SceneRules, OpacitiesThatWereAskedForAreKnown)
{
  rhombic::SurfaceSelection selection;
  selection.requests = { rhombic::ParseSurfaceRequest("bone=250.5,ivory,1", 0),
                         rhombic::ParseSurfaceRequest("head=100,ivory", 1) };
  selection.rules.rules = { rhombic::ParseSceneRule("liver=,1"), rhombic::ParseSceneRule("kidney*=red") };
  const auto hasOwnOpacity = [&selection](const std::string & name, std::int32_t label) {
    rhombic::SceneSurface surface;
    surface.name = name;
    surface.label = label;
    return rhombic::HasOwnOpacity(selection, surface);
  };
  EXPECT_TRUE(hasOwnOpacity("bone", 0));
  EXPECT_TRUE(hasOwnOpacity("liver", 0));
  EXPECT_TRUE(hasOwnOpacity("liver", 7));
  EXPECT_FALSE(hasOwnOpacity("bone", 3)) << "a label in the isosurface of the same name";
  for (const char * const name : { "head", "kidney_left", "spleen" })
  {
    EXPECT_FALSE(hasOwnOpacity(name, 0)) << name;
    EXPECT_FALSE(hasOwnOpacity(name, 5)) << name;
  }
}

TEST(SceneRules, NeededNamesMustBeShown)
{
  std::vector<SurfaceRequest> requests{ MakeRequest("bone"), MakeRequest("skin") };
  SceneRules rules;
  rules.needed = { "bo*", "skin" };
  EXPECT_NO_THROW(ApplySceneRules(rules, requests, nullptr));
  rules.hidden = { "skin" };
  EXPECT_THROW(ApplySceneRules(rules, requests, nullptr), Failure);
}

TEST(SceneRules, LooksForNothingAreSaid)
{
  std::vector<rhombic::SceneRule> rules{ rhombic::ParseSceneRule("bo*=,0.3"),
                                         rhombic::ParseSceneRule("muscls=red"),
                                         rhombic::ParseSceneRule("7=red") };
  rules.emplace_back().pattern = "lung*"; // of a preset
  const auto sentences = rhombic::FindUnusedRules(rules, { "bone", "muscles" });
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("muscls"), std::string::npos);
  EXPECT_NE(sentences[0].find("did you mean muscles?"), std::string::npos);
}

} // namespace
