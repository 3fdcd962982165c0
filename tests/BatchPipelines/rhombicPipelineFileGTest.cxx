#include "rhombicPipelineFile.h"

#include "rhombicFailure.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace
{

using rhombic::CommandSyntax;
using rhombic::Failure;
using rhombic::Pipeline;
using rhombic::Report;
using rhombictest::TemporaryFolder;

/** Commands with a few settings, which take any value but "bad". */
CommandSyntax
SomeSyntax()
{
  CommandSyntax syntax;
  syntax.settingsOf = [](const std::string & command) -> std::vector<CommandSyntax::Setting> {
    std::vector<CommandSyntax::Setting> settings{ { "preset", true, false }, { "labels", false, false } };
    for (const char * const name : { "view", "size", "no-shadows" })
    {
      if (command == "render")
      {
        settings.push_back({ name, false, false });
      }
    }
    if (command == "mesh")
    {
      settings.push_back({ "smooth", false, false });
      settings.push_back({ "measures", false, true });
    }
    return settings;
  };
  syntax.check = [](const std::string &, const Report & settings) {
    if (settings.value("size", "") == "bad")
    {
      throw Failure(rhombic::FailureKind::Usage, "'bad' is no size.");
    }
    const auto output = settings["output"].get<std::string>();
    return std::vector<std::filesystem::path>{ output, output + ".json" };
  };
  return syntax;
}

Pipeline
Parse(const std::string & text, const std::string & preset = "")
{
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "mine.yaml") << preset;
  std::ofstream(folder.Path() / "pipeline.yaml") << text;
  return rhombic::ReadPipeline(folder.Path() / "pipeline.yaml", SomeSyntax());
}

TEST(PipelineFile, OutputsBecomeCommands)
{
  const Pipeline pipeline = Parse("options:\n"
                                  "  preset: ct-bone\n"
                                  "  smooth: 0.5\n"
                                  "outputs:\n"
                                  "  - page: page.pdf\n"
                                  "    preset: auto\n"
                                  "  - picture: a.png\n"
                                  "    view: [left, right]\n"
                                  "    no-shadows: true\n"
                                  "    labels: false\n"
                                  "  - mesh: bone.stl\n");
  ASSERT_EQ(pipeline.steps.size(), 3u);
  EXPECT_EQ(pipeline.steps[0].command, "render");
  EXPECT_EQ(pipeline.steps[0].settings, (Report{ { "sheet", true }, { "preset", "auto" } }));
  EXPECT_TRUE(pipeline.steps[0].takesLabels);
  EXPECT_EQ(pipeline.steps[1].settings,
            (Report{ { "preset", "ct-bone" }, { "view", { "left", "right" } }, { "no-shadows", true } }));
  EXPECT_FALSE(pipeline.steps[1].takesLabels);
  EXPECT_EQ(pipeline.steps[2].command, "mesh");
  EXPECT_EQ(pipeline.steps[2].settings, (Report{ { "preset", "ct-bone" }, { "smooth", "0.5" } }));
  EXPECT_EQ(pipeline.steps[2].output, "bone.stl");
}

TEST(PipelineFile, FilesOfAStepLieInTheFolderOfItsOutputs)
{
  const Pipeline pipeline = Parse("outputs:\n  - mesh: bone.stl\n    measures: m.csv\n    preset: mine.yaml\n", "x");
  rhombic::BatchCase batchCase;
  batchCase.scan = "/scans/a";
  batchCase.labels = "/scans/b";
  const Report settings = rhombic::GetSettings(pipeline.steps[0], batchCase, { { "frame", 1 } }, "/out");
  EXPECT_EQ(settings["scan"], "/scans/a");
  EXPECT_EQ(settings["labels"], "/scans/b");
  EXPECT_EQ(settings["output"], "/out/bone.stl");
  EXPECT_EQ(settings["measures"], "/out/m.csv");
  EXPECT_EQ(settings["frame"], 1);
  const auto preset = settings["preset"].get<std::string>();
  EXPECT_EQ(preset.substr(preset.rfind('/')), "/mine.yaml");
}

TEST(PipelineFile, SettingsOfACaseJoinTheLists)
{
  const Pipeline pipeline = Parse("outputs: [{picture: a.png, view: [left, right], size: 300}]");
  const Report settings = rhombic::GetSettings(pipeline.steps[0], {}, { { "view", "top" }, { "size", 200 } }, "");
  EXPECT_EQ(settings["view"], (Report{ "left", "right", "top" }));
  EXPECT_EQ(settings["size"], (Report{ "300", 200 })); // which the command refuses
}

TEST(PipelineFile, TheDefaultIsAPage)
{
  const Pipeline pipeline = rhombic::ReadPipeline({}, SomeSyntax());
  ASSERT_EQ(pipeline.steps.size(), 1u);
  EXPECT_EQ(pipeline.steps[0].output, "page.png");
}

TEST(PipelineFile, ItsHashIsThatOfWhatDeterminesTheOutputs)
{
  const std::string text = "outputs: [{mesh: a.stl, preset: mine.yaml}]";
  const auto hashOf = [](const Pipeline & pipeline) { return pipeline.hash; };
  EXPECT_NE(hashOf(Parse("outputs: [{mesh: a.stl}]")), hashOf(Parse("outputs: [{mesh: b.stl}]")));
  EXPECT_NE(hashOf(Parse("outputs: [{mesh: a.stl}]")), hashOf(Parse("outputs: [{mesh: a.stl, labels: false}]")));
  EXPECT_NE(hashOf(Parse(text, "one")), hashOf(Parse(text, "two")));
  EXPECT_EQ(hashOf(Parse("outputs: [{mesh: a.stl}]")), hashOf(Parse("description: d\noutputs:\n- mesh: a.stl # x")));
}

TEST(PipelineFile, NamesOfSurfacesMayStandWhereTheyMakeNoTwoFilesTheSame)
{
  EXPECT_EQ(Parse("outputs: [{mesh: 'a-{name}.stl'}, {mesh: 'b-{name}.stl'}, {mesh: a.stl}, {mesh: 'a-{name}.ply'}, "
                  "{mesh: 'a.stl-{name}.stl'}]")
              .steps.size(),
            5u);
}

TEST(PipelineFile, MistakesAreNamedWithLineAndNearestKey)
{
  struct Mistake
  {
    const char * text;
    const char * expected;
  };
  for (const Mistake & mistake :
       { Mistake{ "outputs:\n  - page: a.png\n    vew: left\n", "'vew' in line 3 (did you mean view?)" },
         Mistake{ "outputs:\n  - page: a.png\n    output: b.png\n", "'output' in line 3" },
         Mistake{ "options:\n  sise: 3\noutputs: [{page: a.png}]\n", "'sise' in line 2 (did you mean size?)" },
         Mistake{ "output:\n  - page: a.png\n", "'output' in line 1 (did you mean outputs?)" },
         Mistake{ "outputs:\n  - pag: a.png\n", "page, picture, mesh, volume or agreement in line 2" },
         Mistake{ "outputs:\n  - page: a.png\n  - mesh: a.png\n",
                  "line 3: it would write a.png, as the output in line 2 does; give" },
         Mistake{
           "outputs:\n  - mesh: '{name}.stl'\n  - mesh: bone.stl\n",
           "line 3: it would write bone.stl, as the output in line 2 does with {name}.stl and some name of a surface" },
         Mistake{
           "outputs:\n  - mesh: bone-{name}.stl\n  - mesh: '{name}.stl'\n",
           "line 3: it would write {name}.stl, as the output in line 2 does with bone-{name}.stl and some name" },
         Mistake{ "outputs:\n  - page: thumbnail.jpg\n", "line 2: a batch writes a file thumbnail.jpg itself" },
         Mistake{ "outputs:\n  - page: ../a.png\n", "line 2" },
         Mistake{ "outputs:\n  - page: a.png\n    size: bad\n", "line 2: 'bad' is no size" },
         Mistake{ "outputs:\n  - page: a.png\n    labels: maybe\n", "true or false is expected, in line 3" },
         Mistake{ "outputs:\n  - mesh: a.stl\n    measures: [a.csv, b.csv]\n",
                  "name of one file is expected, in line 3" },
         Mistake{ "outputs:\n  - mesh: a.stl\n    measures: true\n", "name of one file is expected, in line 3" },
         Mistake{ "outputs:\n  - page: [\n", "not valid in line" },
         Mistake{ "description: nothing\n", "has no outputs" } })
  {
    try
    {
      Parse(mistake.text);
      ADD_FAILURE() << mistake.text;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
      EXPECT_NE(std::string(failure.GetDescription()).find(mistake.expected), std::string::npos)
        << failure.GetDescription();
    }
  }
}

} // namespace
