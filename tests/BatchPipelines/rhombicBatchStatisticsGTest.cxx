#include "rhombicRunBatch.h"
#include "rhombicFailure.h"
#include "rhombicNobody.h"
#include "rhombicProgram.h"
#include "rhombicWording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{

using rhombic::Split;
using rhombictest::ReadText;
using rhombictest::TemporaryFolder;

constexpr char measureHead[] = "case\tsurface_id\tsurface\tmode\tvolume_ml\n";
constexpr char outputHead[] = "case\toutput\tsurface_ids\n";

/** The fields of the only line of statistics. */
std::vector<std::string>
StatisticsOf(const std::vector<double> & values)
{
  const TemporaryFolder folder;
  std::ofstream table(folder.Path() / "measures.tsv");
  std::ofstream outputs(folder.Path() / "outputs.tsv");
  table << measureHead;
  outputs << outputHead;
  for (std::size_t n = 0; n < values.size(); ++n)
  {
    table << "c" << n << "\t5f\tbone\tLean\t" << rhombic::FormatExact(values[n]) << '\n';
    outputs << "c" << n << "\tbone.stl\t5f\n";
  }
  table.close();
  outputs.close();
  rhombic::WriteBatchStatistics(folder.Path());
  const auto lines = Split(ReadText(folder.Path() / "statistics.tsv"), "\n");
  EXPECT_EQ(lines.size(), 3u) << "a head, a line, and the end of it";
  return Split(lines[1], "\t");
}

double
NumberOf(const std::string & text)
{
  return rhombic::ToNumber<double>(text).value();
}

TEST(BatchStatistics, QuartilesPartTheValues)
{
  std::mt19937 random(5);
  for (std::size_t count = 1; count < 60; ++count)
  {
    std::vector<double> values(count);
    std::generate(values.begin(), values.end(), [&random] { return static_cast<double>(random() % 100000); });
    const auto fields = StatisticsOf(values);
    ASSERT_EQ(fields.size(), 10u);
    EXPECT_EQ(fields[3], std::to_string(count));
    std::sort(values.begin(), values.end());
    EXPECT_EQ(NumberOf(fields[4]), values.front());
    EXPECT_EQ(NumberOf(fields[8]), values.back());
    for (const std::size_t quarter : { 1u, 2u, 3u })
    {
      // Between the two values that have so many quarters of the steps below them; their mixture where there are two.
      const std::size_t steps = quarter * (count - 1);
      const double expected = (values[steps / 4] * static_cast<double>(4 - steps % 4) +
                               values[(steps + 3) / 4] * static_cast<double>(steps % 4)) /
                              4.0;
      EXPECT_NEAR(NumberOf(fields[4 + quarter]), expected, 1.0);
    }
  }
}

TEST(BatchStatistics, ValuesFarFromTheOthersAreNamed)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(1000.0, 10.0);
  for (int round = 0; round < 100; ++round)
  {
    std::vector<double> values(40);
    std::generate(values.begin(), values.end(), [&] { return noise(random); });
    values[11] = 1500.0;
    values[23] = 200.0;
    const std::string apart = StatisticsOf(values)[9];
    EXPECT_NE(apart.find("c11 (1500)"), std::string::npos) << apart;
    EXPECT_NE(apart.find("c23 (200)"), std::string::npos) << apart;
    EXPECT_LE(std::count(apart.begin(), apart.end(), '('), 6) << "of the others, few by chance: " << apart;
  }
  EXPECT_EQ(StatisticsOf({ 1, 2, 3, 4, 5, 6 })[9], "");
  EXPECT_EQ(StatisticsOf({ 1, 1, 1, 100 })[9], "") << "too few to tell";
  EXPECT_EQ(StatisticsOf({ 3, 3, 3, 3, 3, 3 })[9], "");
  EXPECT_EQ(StatisticsOf({ 3, 3, 3, 3, 3, 3, 3, 3, 3, 7 })[9], "c9 (7)") << "where more than half are the same";
}

/** The kind and sentence of the failure with which work ends. */
template <typename TWork>
std::pair<rhombic::FailureKind, std::string>
FailureOf(const TWork & work)
{
  try
  {
    work();
  }
  catch (const rhombic::Failure & failure)
  {
    return { failure.GetKind(), failure.GetDescription() };
  }
  return {};
}

TEST(BatchStatistics, ClosedFilesAndFoldersAreNotSaidToBeMissing)
{
  namespace fs = std::filesystem;
  using rhombic::FailureKind;
  const TemporaryFolder folder;
  rhombic::BatchSettings settings;
  settings.output = folder.Path();
  const auto statistics = [&] { rhombic::WriteBatchStatistics(folder.Path()); };
  const auto tables = [&] { rhombic::WriteBatchTables(settings); };
  const auto run = [&] { rhombic::RunBatch(settings, rhombic::Events()); };
  EXPECT_EQ(FailureOf(statistics).first, FailureKind::NotFound);
  const std::vector<fs::path> files{ folder.Path() / "measures.tsv", folder.Path() / "journal.jsonl" };
  for (const fs::path & file : files)
  {
    std::ofstream(file) << measureHead;
    fs::permissions(file, fs::perms::none);
  }
  fs::permissions(folder.Path(), fs::perms(0777));
  {
    const rhombictest::Nobody nobody;
    std::error_code error;
    if (!nobody.IsBound() || !fs::exists(files.front(), error))
    {
      GTEST_SKIP() << "this user can't be another one, or not in the folder of temporary files";
    }
    for (const auto & [kind, sentence] : { FailureOf(statistics), FailureOf(tables) })
    {
      EXPECT_EQ(kind, FailureKind::Unreadable);
      EXPECT_NE(sentence.find("Permission denied"), std::string::npos) << sentence;
    }
    EXPECT_FALSE(fs::exists(folder.Path() / "results.tsv")) << "a table without the cases of the journal";
  }
  fs::permissions(folder.Path(), fs::perms::none);
  {
    const rhombictest::Nobody nobody;
    EXPECT_EQ(FailureOf(statistics).first, FailureKind::Unreadable);
    const auto [kind, sentence] = FailureOf(run);
    EXPECT_EQ(kind, FailureKind::Output);
    EXPECT_NE(sentence.find("Permission denied"), std::string::npos) << sentence;
  }
  fs::permissions(folder.Path(), fs::perms::owner_all);
}

TEST(BatchStatistics, EachMeasureOfEachSurfaceHasALine)
{
  const TemporaryFolder folder;
  EXPECT_THROW(rhombic::WriteBatchStatistics(folder.Path()), rhombic::Failure);
  std::ofstream(folder.Path() / "measures.tsv") << "case\tarea_mm2\tsurface_id\tsurface\tvolume_ml\n"
                                                   "1\t5\ta1\t7\t10\n"
                                                   "2\tn/a\ta2\t7\t20\n"
                                                   "2\tn/a\ts2\tskin\t30\n"
                                                   "1\tn/a\tb1\t7\tinf\n"
                                                   "2\tn/a\tb2\t7\t40\n";
  std::ofstream(folder.Path() / "outputs.tsv") << "case\toutput\tsurface_ids\n"
                                                  "1\ta.stl\ta1\n"
                                                  "1\tpage.png\ta1\n"
                                                  "1\tb.stl\tb1\n"
                                                  "1\tscan.nrrd\tn/a\n"
                                                  "2\ta.stl\ta2,s2\n"
                                                  "2\tpage.png\ta2\n"
                                                  "2\tb.stl\tb2\n";
  const std::string text = rhombic::WriteBatchStatistics(folder.Path());
  EXPECT_EQ(ReadText(folder.Path() / "statistics.tsv"),
            "outputs\tsurface\tmeasure\tcases\tleast\tq1\tmedian\tq3\tlargest\tapart\n"
            "a.stl\tskin\tvolume_ml\t1\t30\t30\t30\t30\t30\t\n"
            "a.stl,page.png\t7\tvolume_ml\t2\t10\t12.5\t15\t17.5\t20\t\n"
            "a.stl,page.png\t7\tarea_mm2\t1\t5\t5\t5\t5\t5\t\n"
            "b.stl\t7\tvolume_ml\t1\t40\t40\t40\t40\t40\t\n")
    << "surfaces that outputs share once, others by their outputs";
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
  EXPECT_EQ(text.find('\t'), std::string::npos);
  std::ofstream(folder.Path() / "measures.tsv") << "case\toutput\tname\tvolume\n";
  EXPECT_THROW(rhombic::WriteBatchStatistics(folder.Path()), rhombic::Failure) << "of another version";
}

} // namespace
