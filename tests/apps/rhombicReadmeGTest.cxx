#include "rhombicProgram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace fs = std::filesystem;

namespace
{

/** The shell blocks of README.md's section "Examples". */
std::vector<std::string>
Examples()
{
  std::vector<std::string> blocks;
  std::ifstream readme(RHOMBIC_SOURCE "/README.md");
  std::string line;
  bool isInSection = false;
  bool isInBlock = false;
  while (std::getline(readme, line))
  {
    if (line.rfind("## ", 0) == 0)
    {
      isInSection = line == "## Examples";
    }
    else if (isInSection && line == "```sh")
    {
      isInBlock = true;
      blocks.emplace_back();
    }
    else if (line == "```")
    {
      isInBlock = false;
    }
    else if (isInBlock)
    {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

/** Whether the output of an example is there, under its name or, with several views or surfaces, its name and that of
 * each. */
bool
Exists(const fs::path & output)
{
  if (fs::exists(output))
  {
    return true;
  }
  const std::string stem = output.stem().string();
  const auto brace = stem.find('{');
  const std::string beginning = brace == std::string::npos ? stem + "-" : stem.substr(0, brace);
  const fs::directory_iterator files(output.parent_path());
  return std::any_of(begin(files), end(files), [&beginning](const fs::directory_entry & entry) {
    return entry.path().filename().string().rfind(beginning, 0) == 0;
  });
}

TEST(Readme, ItsExamplesRunAndMakeWhatTheyName)
{
  const auto examples = Examples();
  ASSERT_GE(examples.size(), 6u);
  const rhombictest::TemporaryFolder folder;
  fs::create_directory_symlink(RHOMBIC_TESTDATA, folder.Path() / "testdata");
  for (const std::string & example : examples)
  {
    const auto outcome = rhombictest::RunShell(example, folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << example << outcome.errors;
    std::istringstream words(example);
    std::string word;
    while (words >> word)
    {
      if (word == "-o")
      {
        words >> word;
        EXPECT_TRUE(Exists(folder.Path() / word)) << example;
      }
    }
  }
}

} // namespace
