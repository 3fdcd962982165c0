#include "rhombicProgram.h"

#include <gtest/gtest.h>

using namespace rhombictest;

namespace
{

const std::string experiments = RHOMBIC_SOURCE "/pipelines/comparison/paper.yaml";

/** From the heading of a page's section to the next one, without its pictures. */
std::string
SectionOf(const std::string & page, const std::string & heading)
{
  const auto begin = page.find("## " + heading);
  if (begin == std::string::npos)
  {
    return "";
  }
  std::istringstream lines(page.substr(begin, page.find("\n## ", begin) - begin));
  std::string section;
  for (std::string line; std::getline(lines, line);)
  {
    if (!line.empty() && line[0] != '!')
    {
      section += line + '\n';
    }
  }
  return section;
}

} // namespace

TEST(CompareCommand, MakesASectionOfThePageOfResults)
{
  const TemporaryFolder folder;
  const Outcome outcome =
    RunShell("rhombic compare '" + experiments + "' -o out --only corner --repeats 1 --no-pictures", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const std::string heading = "Figure 13, right";
  const std::string section = SectionOf(ReadText(folder.Path() / "out/RESULTS.md"), heading);
  EXPECT_NE(section, "");
  EXPECT_EQ(section, SectionOf(ReadText(RHOMBIC_SOURCE "/pipelines/comparison/RESULTS.md"), heading));
  EXPECT_NE(ReadText(folder.Path() / "out/figures.csv").find("corner,1,Cartesian"), std::string::npos);
  EXPECT_NE(ReadText(folder.Path() / "out/times.csv").find("corner,1,"), std::string::npos);
}

TEST(CompareCommand, IsTheSameWithAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  const std::string options = "compare '" + experiments + "' --only corner --repeats 1 --no-pictures -o ";
  ASSERT_EQ(RunShell("rhombic --threads 1 " + options + "one", folder.Path()).exitCode, 0);
  ASSERT_EQ(RunShell("rhombic --threads 3 " + options + "three", folder.Path()).exitCode, 0);
  EXPECT_EQ(ReadText(folder.Path() / "one/figures.csv"), ReadText(folder.Path() / "three/figures.csv"));
}

TEST(CompareCommand, RefusesWhatItDoesNotKnow)
{
  const TemporaryFolder folder;
  const auto run = [&](const std::string & field, const std::string & method) {
    std::ofstream(folder.Path() / "file.yaml") << "title: T\nexperiments:\n  - name: a\n    field: { " << field
                                               << " }\n    rows: [ { method: " << method << " } ]\n";
    return RunShell("rhombic compare file.yaml -o out --no-pictures", folder.Path());
  };
  EXPECT_EQ(run("kind: corner, size: 12", "lean").exitCode, 0);
  EXPECT_EQ(run("kind: corners", "lean").exitCode, 4);
  EXPECT_EQ(run("kynd: corner", "lean").exitCode, 4);
  EXPECT_EQ(run("kind: corner", "leen").exitCode, 2);
  EXPECT_EQ(RunShell("rhombic compare missing.yaml -o out", folder.Path()).exitCode, 3);
  EXPECT_EQ(RunShell("rhombic compare '" + experiments + "' -o out --only nothing", folder.Path()).exitCode, 2);
}
