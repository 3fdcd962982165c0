#include "rhombicProgram.h"
#include "rhombicReadScan.h"
#include "rhombicScanWriter.h"
#include "rhombicWording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

constexpr double Liver = 17;
constexpr double Spleen = 18;

/** A copy of the phantom's labels, without their names, in which a function replaces the labels by their slices. Gives
 * the number of voxels of the liver. */
template <typename TFunction>
std::size_t
WriteVariant(const fs::path & path, const TFunction & replace)
{
  const rhombic::Scan labels = rhombic::ReadScan(fs::path(RHOMBIC_TESTDATA) / "phantom/phantom-labels.nii.gz");
  std::size_t voxels = 0;
  std::visit(
    [&](const auto & image) {
      const auto & size = image->GetBufferedRegion().GetSize();
      auto * const begin = image->GetBufferPointer();
      for (std::size_t voxel = 0; voxel < image->GetBufferedRegion().GetNumberOfPixels(); ++voxel)
      {
        using LabelType = std::decay_t<decltype(*begin)>;
        begin[voxel] = static_cast<LabelType>(replace(static_cast<double>(begin[voxel]), voxel / (size[0] * size[1])));
        voxels += static_cast<double>(begin[voxel]) == Liver ? 1 : 0;
      }
    },
    labels.image);
  rhombic::WriteScan(labels.image, path);
  return voxels;
}

/** The rows of a table with tabs, by the names of its columns. */
std::vector<std::map<std::string, std::string>>
ReadRows(const fs::path & path)
{
  std::vector<std::string> heads;
  std::vector<std::map<std::string, std::string>> rows;
  for (const std::string & line : rhombic::Split(ReadText(path), "\n"))
  {
    const std::vector<std::string> fields = rhombic::Split(line, "\t");
    if (heads.empty())
    {
      heads = fields;
    }
    else if (fields.size() > 1)
    {
      EXPECT_EQ(fields.size(), heads.size()) << line;
      rows.emplace_back();
      for (std::size_t n = 0; n < std::min(heads.size(), fields.size()); ++n)
      {
        rows.back()[heads[n]] = fields[n];
      }
    }
  }
  return rows;
}

double
MeanOf(const std::vector<double> & values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/** In case n, n / 4 slices of the liver are lost; in cases 3 and 11 the spleen, too. */
TEST(BatchAgreement, TwentyVariantsOfThePhantom)
{
  constexpr std::size_t count = 20;
  const std::set<std::size_t> withoutSpleen{ 3, 11 };
  const TemporaryFolder folder;
  std::set<double> values;
  std::size_t firstSlice = 1000;
  const std::size_t whole = WriteVariant(folder.Path() / "QzReference.nii.gz", [&](double label, std::size_t slice) {
    values.insert(label);
    firstSlice = label == Liver ? std::min(firstSlice, slice) : firstSlice;
    return label;
  });
  values.erase(0.0);
  ASSERT_GT(whole, 100u);
  std::ofstream manifest(folder.Path() / "cases.tsv");
  manifest << "case\tscan\treference\n";
  std::vector<double> dice; // of the liver
  for (std::size_t n = 0; n < count; ++n)
  {
    const std::string file = "QzVariant" + std::to_string(n) + ".nii.gz";
    const std::size_t left = WriteVariant(folder.Path() / file, [&](double label, std::size_t slice) {
      const bool isLost =
        (label == Liver && slice < firstSlice + n / 4) || (label == Spleen && withoutSpleen.count(n) > 0);
      return isLost ? 0.0 : label;
    });
    dice.push_back(2.0 * static_cast<double>(left) / static_cast<double>(left + whole));
    manifest << 'v' << n << '\t' << file << "\tQzReference.nii.gz\n";
  }
  manifest.close();
  std::ofstream(folder.Path() / "pipeline.yaml") << "outputs: [{agreement: agreement.tsv}]\n";

  const Outcome outcome = RunShell("rhombic batch cases.tsv --pipeline pipeline.yaml -o out --jobs 2", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const auto rows = ReadRows(folder.Path() / "out/agreement.tsv");
  EXPECT_EQ(rows.size(), count * values.size());
  double largestOfSpleen = 0.0; // HD95 in mm; its voxels stay, its wall moves a little, as those of other labels do
  for (const auto & row : rows)
  {
    if (row.at("label") == "label 17")
    {
      EXPECT_NEAR(std::stod(row.at("dice")), dice[std::stoul(row.at("case").substr(1))], 1e-9);
    }
    if (row.at("label") == "label 18" && row.at("status") == "compared")
    {
      const double distance = std::stod(row.at("hd95_mm"));
      EXPECT_LT(distance, std::stod(row.at("noise_floor_mm")));
      largestOfSpleen = std::max(largestOfSpleen, distance);
    }
  }
  for (const auto & row : ReadRows(folder.Path() / "out/agreement-statistics.tsv"))
  {
    const bool isSpleen = row.at("label") == "label 18";
    EXPECT_EQ(row.at("compared"), isSpleen ? "18" : "20");
    EXPECT_EQ(row.at("missing_in_case"), isSpleen ? "2" : "0");
    EXPECT_EQ(row.at("missing_in_reference"), "0");
    if (row.at("measure") == "dice")
    {
      std::vector<double> expected(count, 1.0);
      if (row.at("label") == "label 17")
      {
        expected = dice;
      }
      if (isSpleen)
      {
        expected[3] = expected[11] = 0.0;
      }
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(row.at("cases"), "20");
      EXPECT_NEAR(std::stod(row.at("mean")), MeanOf(expected), 1e-5) << row.at("label");
      EXPECT_NEAR(std::stod(row.at("least")), expected.front(), 1e-5);
      EXPECT_NEAR(std::stod(row.at("q1")), 0.25 * expected[4] + 0.75 * expected[5], 1e-5);
      EXPECT_NEAR(std::stod(row.at("median")), 0.5 * (expected[9] + expected[10]), 1e-5);
      EXPECT_NEAR(std::stod(row.at("q3")), 0.75 * expected[14] + 0.25 * expected[15], 1e-5);
    }
    if (isSpleen && row.at("measure") == "hd95_mm")
    {
      EXPECT_EQ(row.at("cases"), "18") << "a missing organ has no distance";
      EXPECT_NEAR(std::stod(row.at("largest")), largestOfSpleen, 1e-5);
    }
  }

  const std::string page = ReadText(folder.Path() / "out/index.html");
  std::size_t before = 0;
  for (const char * const name : { ">v11<", ">v3<", ">v16<", ">v12<", ">v0<" }) // by missing labels, then lost slices
  {
    const std::size_t place = page.find(name);
    EXPECT_GT(place, before) << name;
    before = place;
  }
  EXPECT_NE(page.find("label 18 is missing"), std::string::npos);
  for (const auto & entry : fs::recursive_directory_iterator(folder.Path() / "out"))
  {
    if (entry.is_regular_file() && entry.path().filename() != "cases.tsv")
    {
      EXPECT_EQ(ReadText(entry.path()).find("Qz"), std::string::npos) << entry.path();
    }
  }
}

TEST(BatchAgreement, ReferencesAreComparedBesideOtherOutputs)
{
  const TemporaryFolder folder;
  const std::string labels = (fs::path(RHOMBIC_TESTDATA) / "phantom/phantom-labels.nii.gz").string();
  const std::string scan = (fs::path(RHOMBIC_TESTDATA) / "phantom/phantom.nii.gz").string();
  std::ofstream(folder.Path() / "cases.tsv")
    << "case\tscan\tlabels\treference\toptions\n"
    << "one\t" << scan << '\t' << labels << '\t' << labels << "\t--density 0.5\n"
    << "two\t" << scan << "\t\t\t\n"
    << "gone\t" << scan << '\t' << labels << "\tQzGone.nii\t\n";
  std::ofstream(folder.Path() / "pipeline.yaml") << "outputs: [{volume: scan.fcc.nrrd}]\n";
  std::ofstream(folder.Path() / "only.yaml") << "outputs: [{agreement: agreement.tsv, tolerance: 2}]\n";
  const Outcome outcome = RunShell("rhombic batch cases.tsv --pipeline pipeline.yaml -o out", folder.Path());
  EXPECT_EQ(outcome.exitCode, 12) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder.Path() / "out/one/agreement.tsv"));
  EXPECT_TRUE(fs::exists(folder.Path() / "out/one/scan.fcc.nrrd"));
  EXPECT_FALSE(fs::exists(folder.Path() / "out/two/agreement.tsv")) << "there is no reference";
  const auto rows = ReadRows(folder.Path() / "out/agreement.tsv");
  ASSERT_FALSE(rows.empty());
  for (const auto & row : rows)
  {
    EXPECT_EQ(row.at("case"), "one");
    EXPECT_EQ(std::stod(row.at("dice")), 1.0);
  }
  EXPECT_NE(ReadText(folder.Path() / "out/results.tsv").find("REFERENCE"), std::string::npos)
    << ReadText(folder.Path() / "out/results.tsv");
  const Outcome without = RunShell("rhombic batch cases.tsv --pipeline only.yaml -o other", folder.Path());
  EXPECT_EQ(without.exitCode, 2) << without.errors;
  EXPECT_NE(without.errors.find("The case two has no reference"), std::string::npos) << without.errors;
}

} // namespace
