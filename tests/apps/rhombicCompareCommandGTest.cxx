#include "rhombicProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <ostream>

using namespace rhombictest;

namespace
{

const std::string experiments = RHOMBIC_SOURCE "/pipelines/comparison/paper.yaml";

/** From the heading of a page's section to its pictures or the next one. */
std::string
SectionOf(const std::string & page, const std::string & heading)
{
  const auto begin = page.find("## " + heading);
  return begin == std::string::npos
           ? ""
           : page.substr(begin, std::min(page.find("\n![", begin), page.find("\n## ", begin)) - begin);
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

/** \class AccuracyLimits
 * \brief Distances and numbers of triangles relative to marching cubes on a grid with 30 % more samples. */
struct AccuracyLimits
{
  std::string experiment;
  double fine;          ///< distance
  double lean;          ///< distance
  double triangles;     ///< of lean
  double quality;       ///< of lean's triangles, at least
  double poor;          ///< of lean's triangles, in %
  double forResampling; ///< added to both distances
  double genus;         ///< of a closed surface; -1 for others

  /** The name of a test. */
  friend std::ostream &
  operator<<(std::ostream & os, const AccuracyLimits & limits)
  {
    return os << limits.experiment;
  }
};

class AccuracyOfModes : public testing::TestWithParam<AccuracyLimits>
{};

INSTANTIATE_TEST_SUITE_P(CompareCommand,
                         AccuracyOfModes,
                         testing::Values(AccuracyLimits{ "sphere", 0.46, 0.42, 0.64, 0.91, 0.0, 0.01, 0.0 },
                                         AccuracyLimits{ "torus", 0.47, 0.60, 0.65, 0.91, 0.0, 0.01, 1.0 },
                                         AccuracyLimits{ "waves-25", 0.50, 0.80, 0.66, 0.89, 0.5, 0.01, -1.0 },
                                         AccuracyLimits{ "waves-50", 0.60, 0.92, 0.75, 0.84, 2.1, 0.02, -1.0 },
                                         AccuracyLimits{ "waves-75", 0.75, 1.04, 0.96, 0.77, 4.7, 0.05, -1.0 }));

TEST_P(AccuracyOfModes, IsWithinLimits)
{
  const AccuracyLimits limits = GetParam();
  const TemporaryFolder folder;
  const Outcome outcome =
    RunShell("rhombic compare '" RHOMBIC_SOURCE "/tests/apps/accuracy.yaml' -o out --repeats 1 --no-pictures --only " +
               limits.experiment,
             folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto rows = nlohmann::json::parse(ReadText(folder.Path() / "out/figures.json"))["experiments"][0]["rows"];
  const auto figure = [&rows](std::size_t row, const char * name) { return rows[row]["figures"][name].get<double>(); };
  const char * const triangles = limits.genus < 0.0 ? "judged" : "triangles";
  for (const std::size_t fine : { 1, 3 })
  {
    const std::size_t lean = fine + 1;
    const double allowance = fine == 3 ? limits.forResampling : 0.0;
    EXPECT_LE(figure(fine, "mean"), (limits.fine + allowance) * figure(0, "mean"));
    EXPECT_LE(figure(lean, "mean"), (limits.lean + allowance) * figure(0, "mean"));
    EXPECT_LE(figure(lean, triangles), limits.triangles * figure(0, triangles));
    EXPECT_GE(figure(lean, "quality"), limits.quality);
    EXPECT_LE(figure(lean, "poor"), limits.poor);
    for (const std::size_t row : { fine, lean })
    {
      if (limits.genus >= 0.0)
      {
        EXPECT_EQ(figure(row, "flaws") + figure(row, "open"), 0.0);
        EXPECT_EQ(figure(row, "genus"), limits.genus);
        EXPECT_EQ(figure(row, "parts"), 1.0);
      }
    }
  }
}

TEST(CompareCommand, IsTheSameWithAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  const std::string options = "compare '" + experiments + "' --only corner --repeats 1 --no-pictures -o ";
  ASSERT_EQ(RunShell("rhombic --threads 1 " + options + "one", folder.Path()).exitCode, 0);
  ASSERT_EQ(RunShell("rhombic --threads 3 " + options + "three", folder.Path()).exitCode, 0);
  EXPECT_EQ(ReadText(folder.Path() / "one/figures.csv"), ReadText(folder.Path() / "three/figures.csv"));
}

TEST(CompareCommand, TakesAScanAsAFieldInAnyOrderOfItsAxes)
{
  if (std::getenv("RHOMBIC_SCANS") == nullptr)
  {
    GTEST_SKIP() << "RHOMBIC_SCANS is not set";
  }
  const TemporaryFolder folder;
  const auto figuresOf = [&](const std::string & scan) {
    std::ofstream(folder.Path() / "file.yaml")
      << "title: T\nexperiments:\n  - name: a\n    field: { kind: scan, file: nifti_orientations_48/" << scan
      << ", isovalue: 30.5, spacing: 3, size: 40 }\n"
         "    rows: [ { method: flying-edges, density: 0.7698 }, { method: fine, density: 0.7698 } ]\n";
    const Outcome outcome = RunShell("rhombic compare file.yaml -o out --no-pictures --repeats 1", folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto rows = nlohmann::json::parse(ReadText(folder.Path() / "out/figures.json"))["experiments"][0]["rows"];
    return std::pair(rows[0]["figures"], rows[1]["figures"]);
  };
  const auto [edges, fine] = figuresOf("RAS.nii.gz");
  EXPECT_GT(edges["judged"], 500.0);
  EXPECT_LT(edges["mean"], 0.3);
  EXPECT_LT(fine["mean"], 0.85 * edges["mean"].get<double>());
  const auto [edgesAgain, fineAgain] = figuresOf("AIL.nii.gz");
  EXPECT_NEAR(fineAgain["mean"], fine["mean"], 1e-4);
  EXPECT_NEAR(fineAgain["triangles"], fine["triangles"], 4.0);
  EXPECT_NEAR(edgesAgain["mean"], edges["mean"], 1e-4);
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
  EXPECT_EQ(run("kind: scan, file: missing.nii", "lean").exitCode, 3);
  EXPECT_EQ(RunShell("rhombic compare missing.yaml -o out", folder.Path()).exitCode, 3);
  EXPECT_EQ(RunShell("rhombic compare '" + experiments + "' -o out --only nothing", folder.Path()).exitCode, 2);
}
