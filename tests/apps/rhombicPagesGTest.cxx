#include "rhombicProgram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <vector>

namespace fs = std::filesystem;
using rhombictest::ReadText;

namespace
{

const fs::path source = RHOMBIC_SOURCE;

/** The pages of the project: every .md file outside the build folder, by its path below the source folder. */
std::vector<fs::path>
Pages()
{
  std::vector<fs::path> pages{ "README.md" };
  for (const char * folder : { "apps", "modules", "pipelines", "testdata", "tests" })
  {
    for (const auto & entry : fs::recursive_directory_iterator(source / folder))
    {
      if (entry.path().extension() == ".md")
      {
        pages.push_back(fs::relative(entry.path(), source));
      }
    }
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

/** A block of a page between lines of three backticks. */
struct Block
{
  std::string language;
  std::string text;
};

std::vector<Block>
BlocksOf(const fs::path & page)
{
  std::vector<Block> blocks;
  std::istringstream lines(ReadText(source / page));
  std::string line;
  bool isInBlock = false;
  while (std::getline(lines, line))
  {
    if (line.rfind("```", 0) == 0)
    {
      isInBlock = !isInBlock;
      if (isInBlock)
      {
        blocks.push_back({ line.substr(3), "" });
      }
    }
    else if (isInBlock)
    {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

/** A page without its blocks. */
std::string
ProseOf(const fs::path & page)
{
  std::string text = ReadText(source / page);
  for (const Block & block : BlocksOf(page))
  {
    text.erase(text.find(block.text), block.text.size());
  }
  return text;
}

/** All matches of an expression's first group. */
std::vector<std::string>
FindAll(const std::string & text, const std::string & expression)
{
  const std::regex regex(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
  {
    found.push_back((*match)[1]);
  }
  return found;
}

/** Whether the output of an example exists: under its name or, with several views or surfaces, its name and that of
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

/** Checks that the files that a block names with -o exist; names that the shell makes are left out. */
void
ExpectOutputs(const std::string & commands, const fs::path & folder)
{
  std::istringstream words(commands);
  std::string word;
  while (words >> word)
  {
    if (word == "-o" && words >> word && word.find('$') == std::string::npos)
    {
      EXPECT_TRUE(Exists(folder / word)) << word << " of\n" << commands;
    }
  }
}

/** Text whose numbers are replaced by #: they may change in the last digits. */
std::string
WithoutNumbers(const std::string & text)
{
  return std::regex_replace(text, std::regex("[0-9]+(\\.[0-9]+)?"), "#");
}

/** The anchor that a heading gets on a web page of the repository. */
std::string
AnchorOf(const std::string & heading)
{
  std::string anchor;
  for (const char character : heading)
  {
    if (character == ' ')
    {
      anchor += '-';
    }
    else if (std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '-' || character == '_')
    {
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    }
  }
  return anchor;
}

std::set<std::string>
AnchorsOf(const fs::path & page)
{
  std::set<std::string> anchors;
  for (const std::string & heading : FindAll("\n" + ProseOf(page), "\n#+ ([^\n]+)"))
  {
    anchors.insert(AnchorOf(heading));
  }
  return anchors;
}

/** The pages with commands to run. */
std::vector<fs::path>
PagesWithCommands()
{
  std::vector<fs::path> pages;
  for (const fs::path & page : Pages())
  {
    const auto blocks = BlocksOf(page);
    if (std::any_of(blocks.begin(), blocks.end(), [](const Block & block) { return block.language == "sh"; }))
    {
      pages.push_back(page);
    }
  }
  return pages;
}

class PageWithCommands : public testing::TestWithParam<fs::path>
{};

/** The blocks of a page run in their order, in one folder. A block of text after a block of commands is what these
 * print, but for the numbers. */
TEST_P(PageWithCommands, RunsAndMakesAndPrintsWhatIsShown)
{
  const rhombictest::TemporaryFolder folder;
  fs::create_directory_symlink(RHOMBIC_TESTDATA, folder.Path() / "testdata");
  rhombictest::Outcome outcome;
  for (const Block & block : BlocksOf(GetParam()))
  {
    if (block.language == "sh")
    {
      outcome = rhombictest::RunShell(block.text, folder.Path());
      EXPECT_EQ(outcome.exitCode, 0) << block.text << outcome.errors;
      ExpectOutputs(block.text, folder.Path());
    }
    else if (block.language == "text")
    {
      EXPECT_EQ(WithoutNumbers(outcome.output + outcome.errors), WithoutNumbers(block.text));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, PageWithCommands, testing::ValuesIn(PagesWithCommands()), [](const auto & page) {
  std::string name = page.param.string();
  std::replace_if(
    name.begin(), name.end(), [](unsigned char character) { return std::isalnum(character) == 0; }, '_');
  return name;
});

TEST(Pages, TheReadmeAndTheGuideHaveCommands)
{
  const auto pages = PagesWithCommands();
  for (const char * page : { "README.md", "apps/rhombic/GUIDE.md" })
  {
    EXPECT_EQ(std::count(pages.begin(), pages.end(), page), 1) << page;
  }
}

TEST(Pages, LinksLeadToFilesAndHeadings)
{
  for (const fs::path & page : Pages())
  {
    const std::string prose = ProseOf(page);
    std::vector<std::string> links = FindAll(prose, "\\]\\(([^)]+)\\)");
    for (const std::string & picture : FindAll(prose, "src=\"([^\"]+)\""))
    {
      links.push_back(picture);
    }
    for (const std::string & link : links)
    {
      if (link.find("://") != std::string::npos)
      {
        continue;
      }
      const auto hash = std::min(link.find('#'), link.size());
      const fs::path target = hash == 0 ? page : page.parent_path() / link.substr(0, hash);
      const bool exists = fs::exists(source / target);
      EXPECT_TRUE(exists) << link << " in " << page;
      EXPECT_TRUE(!exists || hash == link.size() || AnchorsOf(target).count(link.substr(hash + 1)) == 1)
        << link << " in " << page;
    }
  }
}

/** Paths in backticks that begin with a folder of the project. */
TEST(Pages, PathsExist)
{
  for (const fs::path & page : Pages())
  {
    for (const std::string & path :
         FindAll(ProseOf(page), "`(?:\\./)?((?:apps|modules|pipelines|testdata|tests)/[A-Za-z0-9_./-]+)[` ]"))
    {
      EXPECT_TRUE(fs::exists(source / path)) << path << " in " << page;
    }
  }
}

/** The components in CMake blocks, as `COMPONENTS FCCResampling` and `Rhombic::FCCResampling`. */
/** The modules' names, and their folders below modules/. */
std::map<std::string, std::string>
FindModules()
{
  std::map<std::string, std::string> modules;
  for (const auto & entry : fs::recursive_directory_iterator(source / "modules"))
  {
    if (entry.path().filename() == "itk-module.cmake")
    {
      const fs::path folder = entry.path().parent_path();
      modules[folder.filename().string()] = folder.lexically_relative(source / "modules").string();
    }
  }
  return modules;
}

TEST(Pages, ComponentsAreModules)
{
  const auto modules = FindModules();
  std::size_t numberOfComponents = 0;
  for (const fs::path & page : Pages())
  {
    for (const Block & block : BlocksOf(page))
    {
      std::vector<std::string> components = FindAll(block.text, "Rhombic::([A-Za-z]+)");
      for (const std::string & list : FindAll(block.text, "find_package\\(Rhombic REQUIRED COMPONENTS ([A-Za-z ]+)\\)"))
      {
        std::istringstream words(list);
        std::copy(std::istream_iterator<std::string>(words), {}, std::back_inserter(components));
      }
      for (const std::string & component : components)
      {
        ++numberOfComponents;
        EXPECT_EQ(modules.count(component), 1u) << component << " in " << page;
      }
    }
  }
  EXPECT_GE(numberOfComponents, 4u);
}

/** The C++ in the README, line by line but for its comments, is from the program in the map, which the tests of the
 * package build. */
TEST(Pages, TheReadmeShowsLinesOfTheProgramThatIsBuilt)
{
  const std::string map = ReadText(source / "modules/README.md");
  const auto blocks = BlocksOf("README.md");
  const auto shown =
    std::find_if(blocks.begin(), blocks.end(), [](const auto & block) { return block.language == "cpp"; });
  ASSERT_NE(shown, blocks.end());
  std::istringstream lines(shown->text);
  std::string line;
  while (std::getline(lines, line))
  {
    const std::string statement = line.substr(0, line.find(';') + 1);
    EXPECT_NE(map.find("\n  " + statement + "\n"), std::string::npos) << line;
  }
}

TEST(Pages, TheMapHasEveryModule)
{
  const std::string map = ReadText(source / "modules/README.md");
  const auto modules = FindModules();
  EXPECT_GE(modules.size(), 20u);
  for (const auto & [name, folder] : modules)
  {
    EXPECT_NE(map.find("| [" + name + "](" + folder + "/README.md) |"), std::string::npos) << name;
  }
}

} // namespace
