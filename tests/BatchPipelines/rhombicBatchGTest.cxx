#include "rhombicProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using rhombictest::Outcome;
using rhombictest::ReadText;
using rhombictest::RunShell;
using rhombictest::TemporaryFolder;

const fs::path phantom = fs::path(RHOMBIC_TESTDATA) / "phantom";

/** A manifest of variants of the phantom and of broken scans, and a pipeline of two files for each. */
void
WriteCollection(const fs::path & folder, int variants)
{
  fs::copy(phantom / "dicom", folder / "QzPatient");
  std::ofstream(folder / "QzEmpty.nii");
  const std::string whole = ReadText(phantom / "phantom.nii.gz");
  std::ofstream(folder / "QzShort.nii.gz", std::ios::binary) << whole.substr(0, whole.size() / 2);
  std::ofstream manifest(folder / "cases.tsv");
  manifest << "case\tscan\tlabels\toptions\n";
  for (int n = 0; n < variants; ++n)
  {
    manifest << "v" << n << "\tQzPatient\t\t--density " << 0.5 + 0.05 * n << "\n";
  }
  manifest << "empty\tQzEmpty.nii\t\t\nshort\tQzShort.nii.gz\t\t\ngone\tQzGone.nii\t\t\n";
  std::ofstream(folder / "pipeline.yaml") << "outputs:\n"
                                             "  - mesh: bone.stl\n"
                                             "    threshold: 250.5\n"
                                             "  - volume: scan.fcc.nrrd\n";
}

/** The files of a folder, by their path and content, without those that hold times. */
std::map<std::string, std::string>
ContentsOf(const fs::path & folder)
{
  std::map<std::string, std::string> contents;
  for (const auto & entry : fs::recursive_directory_iterator(folder))
  {
    const std::string path = entry.path().lexically_relative(folder).string();
    const bool hasTimes = path == "journal.jsonl" || path == "index.html" || path.rfind("results.", 0) == 0;
    if (!entry.is_directory())
    {
      contents[path] = hasTimes ? "" : ReadText(entry.path());
    }
  }
  return contents;
}

/** Status and cause of each case in results.json. */
std::map<std::string, std::string>
ResultsOf(const fs::path & folder)
{
  std::map<std::string, std::string> results;
  for (const auto & one : nlohmann::json::parse(ReadText(folder / "results.json")))
  {
    results[one["case"]] = one["status"].get<std::string>() + ": " + one.value("cause", "");
  }
  return results;
}

constexpr char command[] = "rhombic batch cases.tsv --pipeline pipeline.yaml ";

TEST(Batch, BrokenScansAreNamedAndTheOthersDone)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 2);
  const Outcome outcome = RunShell(std::string(command) + "-o out", folder.Path());
  EXPECT_EQ(outcome.exitCode, 12) << outcome.errors;
  EXPECT_NE(outcome.errors.find("3 cases of 5 failed"), std::string::npos) << outcome.errors;
  const auto results = ResultsOf(folder.Path() / "out");
  EXPECT_EQ(results.at("v0"), "done: ");
  EXPECT_EQ(results.at("v1"), "done: ");
  for (const char * const broken : { "empty", "short", "gone" })
  {
    EXPECT_EQ(results.at(broken).rfind("failed: ", 0), 0u);
    EXPECT_GT(results.at(broken).size(), 20u);
    EXPECT_FALSE(fs::exists(folder.Path() / "out" / broken));
  }
  for (const auto & [path, ignored] : ContentsOf(folder.Path()))
  {
    if (path.rfind("out/", 0) == 0 && path != "out/cases.tsv")
    {
      const std::string content = ReadText(folder.Path() / path); // of those with times, too
      for (const char * const name : { "QzPatient", "QzEmpty", "QzShort", "QzGone" })
      {
        EXPECT_EQ(content.find(name), std::string::npos) << path;
      }
    }
  }
  const std::string table = ReadText(folder.Path() / "out/results.tsv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 6);
  const std::string measures = ReadText(folder.Path() / "out/measures.tsv");
  EXPECT_EQ(std::count(measures.begin(), measures.end(), '\n'), 3) << measures;
  for (const char * const column : { "\tvolume_ml\t", "\tdeviation_mean_mm\t" })
  {
    EXPECT_LT(measures.find(column), measures.find('\n')) << measures;
  }
  const std::string page = ReadText(folder.Path() / "out/index.html");
  EXPECT_NE(page.find("./v0/bone.stl"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
}

/** The lines of a table, by their columns. */
std::vector<std::map<std::string, std::string>>
ReadTable(const fs::path & path)
{
  const auto split = [](const std::string & text) {
    std::vector<std::string> fields(1);
    for (const char letter : text)
    {
      letter == '\t' ? fields.emplace_back() : fields.back().append(1, letter);
    }
    return fields;
  };
  std::istringstream lines(ReadText(path));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> heads = split(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line))
  {
    const std::vector<std::string> fields = split(line);
    EXPECT_EQ(fields.size(), heads.size()) << line;
    rows.emplace_back();
    for (std::size_t n = 0; n < std::min(heads.size(), fields.size()); ++n)
    {
      rows.back()[heads[n]] = fields[n];
    }
  }
  return rows;
}

TEST(Batch, TablesHaveOneLineForEachSurfaceAndColumnsThatDependOnNothing)
{
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "pipeline.yaml") << "options: {preset: ct-skin, denoise: none}\n"
                                                    "outputs:\n"
                                                    "  - mesh: a.stl\n"
                                                    "  - mesh: b.ply\n"
                                                    "  - mesh: few.stl\n"
                                                    "    max-triangles: 10%\n"
                                                    "  - picture: front.png\n"
                                                    "    size: 100\n"
                                                    "    view: [anterior, left]\n"
                                                    "  - volume: scan.fcc.nrrd\n";
  std::ofstream(folder.Path() / "labels.yaml") << "outputs: [{mesh: '{name}.stl', label: ['10', '14']}]\n";
  const std::string labels = (phantom / "phantom-labels.nii.gz").string();
  const std::string run = "rhombic batch " + (phantom / "dicom").string() + " --names-from-paths --pipeline ";
  const Outcome outcome = RunShell(run + "pipeline.yaml -o out\nrhombic batch " + labels +
                                     " --pipeline labels.yaml -o labels\nstat -c %a out/cases.tsv",
                                   folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "600\n") << "the modes of cases.tsv";
  EXPECT_NE(ReadText(folder.Path() / "out/cases.tsv").find((phantom / "dicom").string()), std::string::npos);

  const auto measures = ReadTable(folder.Path() / "out/measures.tsv");
  const auto files = ReadTable(folder.Path() / "out/outputs.tsv");
  std::map<std::string, std::string> surfaceOf;
  for (const auto & file : files)
  {
    EXPECT_EQ(std::to_string(fs::file_size(folder.Path() / "out" / file.at("file"))), file.at("size_bytes"));
    surfaceOf[fs::path(file.at("file")).filename()] = file.at("surface_ids");
  }
  EXPECT_EQ(surfaceOf.at("a.stl"), surfaceOf.at("b.ply")) << "of one surface";
  EXPECT_NE(surfaceOf.at("a.stl"), surfaceOf.at("few.stl"));
  EXPECT_EQ(surfaceOf.at("front-anterior.png"), surfaceOf.at("front-left.png"));
  EXPECT_EQ(surfaceOf.at("scan.fcc.nrrd"), "n/a");
  std::map<std::string, int> count;
  for (const auto & row : measures)
  {
    ++count[row.at("surface_id")];
    EXPECT_EQ(row.at("surface"), "skin");
    EXPECT_EQ(row.at("label_value"), "n/a");
    EXPECT_GT(std::stod(row.at("volume_ml")), 20000.0);
    EXPECT_LT(std::stod(row.at("area_mm2")), 1e6);
  }
  for (const char * const file : { "a.stl", "few.stl", "front-left.png" })
  {
    EXPECT_EQ(count[surfaceOf.at(file)], 1) << file;
  }
  EXPECT_EQ(count.size(), measures.size()) << "no surface is there twice";

  const auto ofLabels = ReadTable(folder.Path() / "labels/measures.tsv");
  ASSERT_EQ(ofLabels.size(), 2u);
  EXPECT_EQ(ofLabels[0].at("label_value"), "10");
  EXPECT_NEAR(std::stod(ofLabels[0].at("voxel_volume_ml")), 1446.91, 0.01);
  EXPECT_EQ(ofLabels[0].at("mean_scan_unit"), "n/a") << "there is no scan";
  const auto headOf = [&](const std::string & table) {
    const std::string text = ReadText(folder.Path() / table);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(headOf("out/measures.tsv"), headOf("labels/measures.tsv"));
  for (const char * const table : { "measures", "outputs" })
  {
    const auto described =
      nlohmann::ordered_json::parse(ReadText(folder.Path() / ("out/" + std::string(table) + ".json")));
    std::string heads;
    for (const auto & [column, description] : described.items())
    {
      heads += (heads.empty() ? "" : "\t") + column;
      EXPECT_GT(description["Description"].get<std::string>().size(), 10u) << column;
    }
    EXPECT_EQ(heads, headOf("out/" + std::string(table) + ".tsv"));
  }

  const Outcome stats = RunShell("rhombic batch -o out --stats", folder.Path());
  ASSERT_EQ(stats.exitCode, 0) << stats.errors;
  EXPECT_NE(ReadText(folder.Path() / "out/statistics.tsv").find("a.stl,b.ply"), std::string::npos);
  ASSERT_EQ(RunShell(run + "pipeline.yaml -o out --tables --no-cases-table", folder.Path()).exitCode, 0);
  EXPECT_FALSE(fs::exists(folder.Path() / "out/cases.tsv"));
}

TEST(Batch, AFailedOutputLeavesTheOthersOfItsCase)
{
  const TemporaryFolder folder;
  fs::copy(phantom / "phantom.nii.gz", folder.Path() / "scan.nii.gz");
  const std::string good = "outputs:\n  - mesh: a.stl\n    threshold: 250.5\n";
  std::ofstream(folder.Path() / "pipeline.yaml")
    << good << "  - mesh: b.stl\n    threshold: 1e9\n  - mesh: c.stl\n    threshold: 350.5\n";
  const std::string run = "rhombic batch scan.nii.gz --pipeline pipeline.yaml -o out";
  const Outcome outcome = RunShell(run, folder.Path());
  EXPECT_EQ(outcome.exitCode, 12) << outcome.errors;
  EXPECT_NE(outcome.errors.find("Not made: b.stl"), std::string::npos) << outcome.errors;
  const Outcome files = RunShell("export LC_ALL=C; cd out/case && ls -A", folder.Path());
  EXPECT_EQ(files.output, "a.stl\na.stl.json\nc.stl\nc.stl.json\ncase.json\n");
  const auto result = ReadTable(folder.Path() / "out/results.tsv").at(0);
  EXPECT_EQ(result.at("status"), "failed");
  EXPECT_EQ(result.at("code"), "6");
  EXPECT_EQ(result.at("failed_outputs"), "b.stl");
  EXPECT_EQ(ReadTable(folder.Path() / "out/measures.tsv").size(), 2u);
  EXPECT_NE(ReadText(folder.Path() / "out/index.html").find("./case/c.stl"), std::string::npos);
  EXPECT_NE(RunShell(run, folder.Path()).errors.find("0 done before, 1 to run"), std::string::npos);
  std::ofstream(folder.Path() / "pipeline.yaml") << good;
  EXPECT_EQ(RunShell(run, folder.Path()).exitCode, 0);
  EXPECT_FALSE(fs::exists(folder.Path() / "out/case/c.stl"));
}

TEST(Batch, TheMeasuresOfASurfaceDependOnNoNamesOfOutputs)
{
  std::vector<std::map<std::string, std::string>> first;
  for (const char * const page : { "a.png", "z.png" })
  {
    const TemporaryFolder folder;
    std::ofstream(folder.Path() / "pipeline.yaml")
      << "options: {surface: [bone=375.5]}\noutputs: [{page: " << page << ", dpi: 40}, {mesh: b.stl}]\n";
    const std::string scan = (phantom / "phantom.nii.gz").string();
    const Outcome outcome = RunShell("rhombic batch " + scan + " --pipeline pipeline.yaml -o out", folder.Path());
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto measures = ReadTable(folder.Path() / "out/measures.tsv");
    ASSERT_EQ(measures.size(), 1u) << "page and mesh share the surface";
    EXPECT_NE(measures[0].at("isosurface_volume_ml"), "n/a");
    EXPECT_EQ(measures[0].at("volume_error_reference"), "isosurface");
    const double reference = std::stod(measures[0].at("isosurface_volume_ml"));
    EXPECT_NEAR(std::stod(measures[0].at("volume_error_percent")),
                100.0 * (std::stod(measures[0].at("volume_ml")) / reference - 1.0),
                1e-3);
    first = first.empty() ? measures : first;
    EXPECT_EQ(measures, first) << page;
  }
}

TEST(Batch, AManifestInTheFolderOfOutputsIsNotRemoved)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 1);
  ASSERT_EQ(RunShell(std::string(command) + "-o out", folder.Path()).exitCode, 12);
  const std::string manifest = ReadText(folder.Path() / "out/cases.tsv");
  const Outcome outcome =
    RunShell("rhombic batch ./out/cases.tsv --pipeline pipeline.yaml -o out --tables --no-cases-table", folder.Path());
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_NE(outcome.errors.find("would remove the manifest out/cases.tsv"), std::string::npos) << outcome.errors;
  EXPECT_EQ(ReadText(folder.Path() / "out/cases.tsv"), manifest);
}

TEST(Batch, PatientsNamesAreInDicomFilesOnlyAndOfDicomScansOnly)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "scans");
  fs::copy(phantom / "dicom", folder.Path() / "scans/dicom");
  fs::copy(phantom / "phantom.nii.gz", folder.Path() / "scans");
  std::ofstream(folder.Path() / "pipeline.yaml")
    << "outputs:\n  - picture: front.png\n    preset: ct-bone\n    size: 100\n    dicom-sc: true\n";
  const Outcome outcome =
    RunShell("rhombic batch scans -o out --names-from-paths --pipeline pipeline.yaml", folder.Path());
  EXPECT_EQ(outcome.exitCode, 12) << outcome.errors;
  EXPECT_NE(outcome.errors.find("hold the patients' names"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("is NIfTI"), std::string::npos) << outcome.errors;
  const Outcome files = RunShell("export LC_ALL=C; cd out; ls */*.dcm */*.jpg; grep -rl PHANTOM .", folder.Path());
  EXPECT_EQ(files.output, "dicom/front.dcm\ndicom/thumbnail.jpg\n./dicom/front.dcm\n");
  EXPECT_NE(ReadText(folder.Path() / "out/outputs.tsv").find("\tdicom/front.dcm\tdicom\tfront.png\t"),
            std::string::npos);
}

TEST(Batch, LargeCasesAreFirstAndTablesInTheOrderOfTheCollection)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "scans");
  for (const auto & [name, size] : { std::pair("a", 10), { "b", 3000 }, { "c", 20 }, { "d", 500 } })
  {
    std::ofstream(folder.Path() / "scans" / (std::string(name) + ".nii")) << std::string(size, '\0');
  }
  const Outcome outcome = RunShell("rhombic batch scans -o out --names-from-paths --jobs 1", folder.Path());
  EXPECT_EQ(outcome.exitCode, 12);
  std::string order;
  std::istringstream journal(ReadText(folder.Path() / "out/journal.jsonl"));
  for (std::string line; std::getline(journal, line);)
  {
    order += nlohmann::json::parse(line)["case"].get<std::string>() + ' ';
  }
  EXPECT_EQ(order, "b.nii d.nii c.nii a.nii ");
  std::string table;
  for (const auto & one : nlohmann::json::parse(ReadText(folder.Path() / "out/results.json")))
  {
    table += one["case"].get<std::string>() + ' ';
  }
  EXPECT_EQ(table, "a.nii b.nii c.nii d.nii ");
}

TEST(Batch, ARerunDoesWhatIsMissingOrChanged)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 3);
  const std::string run = std::string(command) + "-o out --case v0 --case v1 --case v2";
  const Outcome first = RunShell(run, folder.Path());
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  EXPECT_FALSE(fs::exists(folder.Path() / "out/results.tsv")) << "other cases may be running";
  const auto runAgain = [&] {
    const Outcome outcome = RunShell(run, folder.Path());
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto place = outcome.errors.find(" to run");
    return outcome.errors.substr(outcome.errors.rfind(' ', place - 1) + 1, 1);
  };
  EXPECT_EQ(runAgain(), "0");
  fs::remove(folder.Path() / "out/v1/bone.stl");
  EXPECT_EQ(runAgain(), "1");
  fs::last_write_time(folder.Path() / "QzPatient/slice-0001.dcm", fs::file_time_type::clock::now());
  EXPECT_EQ(runAgain(), "0") << "a new time, the same contents";
  fs::rename(folder.Path() / "QzPatient", folder.Path() / "QzOther");
  EXPECT_EQ(RunShell("sed -i s/QzPatient/QzOther/ cases.tsv", folder.Path()).exitCode, 0);
  EXPECT_EQ(runAgain(), "0") << "another place, the same contents";
  std::ofstream(folder.Path() / "QzOther/readme.txt") << "more";
  EXPECT_EQ(runAgain(), "3") << "contents";
  std::ofstream(folder.Path() / "pipeline.yaml", std::ios::app) << "    kernel: linear\n";
  EXPECT_EQ(runAgain(), "3") << "options";
}

TEST(Batch, KilledRunsGoOnToTheSameOutputs)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 6);
  ASSERT_EQ(RunShell(std::string(command) + "-o one --jobs 1", folder.Path()).exitCode, 12);
  ASSERT_EQ(RunShell(std::string(command) + "-o two --jobs 2", folder.Path()).exitCode, 12);
  std::mt19937 random(7);
  for (int n = 0; n < 8; ++n)
  {
    const int milliseconds = 150 + static_cast<int>(random() % 1500);
    const std::string signal = n % 4 == 3 ? "TERM" : "KILL";
    RunShell(std::string(command) + "-o killed --jobs 2 & sleep " + std::to_string(milliseconds / 1000.0) + "; kill -" +
               signal + " $! || true; wait || true",
             folder.Path());
  }
  EXPECT_EQ(RunShell(std::string(command) + "-o killed --jobs 2", folder.Path()).exitCode, 12);
  const auto expected = ContentsOf(folder.Path() / "one");
  EXPECT_GT(expected.size(), 30u);
  for (const char * const other : { "two", "killed" })
  {
    const auto contents = ContentsOf(folder.Path() / other);
    EXPECT_TRUE(contents == expected) << other;
    EXPECT_EQ(ResultsOf(folder.Path() / other), ResultsOf(folder.Path() / "one"));
  }
}

/** Starts a run in the background, and stops its process when it works on a case, which takes long; fails if it ends
 * before. */
std::string
StartRun(const std::string & options)
{
  return std::string(command) + "-o out " + options +
         " &\nuntil ls -d out/.stage-* 2>&1; do kill -0 $!; sleep 0.01; done\nkill -STOP $!\n";
}

TEST(Batch, ACaseThatCanNotBePutInPlaceHasNoOutputs)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 1);
  const std::string goOn = "mkdir -p out/v0/others\nkill -CONT $!\nwait $!\n";
  EXPECT_EQ(RunShell(StartRun("--case v0") + goOn, folder.Path()).exitCode, 12);
  const auto record = nlohmann::json::parse(ReadText(folder.Path() / "out/journal.jsonl"));
  EXPECT_EQ(record["code"], 7);
  EXPECT_EQ(record["failedOutputs"], nlohmann::json({ "bone.stl", "scan.fcc.nrrd" }));
  EXPECT_TRUE(record["outputs"].empty());
  EXPECT_FALSE(record.contains("measures"));
}

TEST(Batch, AFileThatCanNotBeChangedIsNamed)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 1);
  ASSERT_EQ(RunShell(std::string(command) + "-o out", folder.Path()).exitCode, 12);
  fs::create_directories(folder.Path() / "out/agreement.tsv/QzKept");
  const Outcome outcome = RunShell(std::string(command) + "-o out", folder.Path());
  EXPECT_EQ(outcome.exitCode, 7) << outcome.errors;
  EXPECT_NE(outcome.errors.find("out/agreement.tsv: Directory not empty"), std::string::npos) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder.Path() / "out/agreement.tsv/QzKept"));
}

TEST(Batch, TwoRunsOfACaseExcludeEachOther)
{
  for (const auto & [first, second] : { std::pair("", ""), std::pair("", "--case v0"), std::pair("--case v0", "") })
  {
    const TemporaryFolder folder;
    WriteCollection(folder.Path(), 2);
    std::ofstream(folder.Path() / "pipeline.yaml") << "outputs: [{page: page.png, preset: ct-bone-skin, dpi: 600}]";
    const Outcome outcome =
      RunShell(StartRun(first) + std::string(command) + "-o out " + second + " || code=$?\nkill -KILL $!\nexit $code",
               folder.Path());
    EXPECT_EQ(outcome.exitCode, 7);
    EXPECT_NE(outcome.errors.find("Another run writes to out"), std::string::npos) << outcome.errors;
  }
}

TEST(Batch, CasesRunSideBySideAndMakeTheSameOutputs)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 3);
  ASSERT_EQ(RunShell(std::string(command) + "-o whole", folder.Path()).exitCode, 12);
  const Outcome parts = RunShell("run() { " + std::string(command) +
                                   "-o out --case $1 || echo $1 $?; }\n"
                                   "for name in v0 v1 v2 empty short gone; do run $name & done; wait\n" +
                                   command + "-o out --tables",
                                 folder.Path());
  ASSERT_EQ(parts.exitCode, 0) << parts.errors;
  for (const char * const broken : { "empty 12\n", "short 12\n", "gone 12\n" })
  {
    EXPECT_NE(parts.output.find(broken), std::string::npos) << parts.output;
  }
  EXPECT_TRUE(ContentsOf(folder.Path() / "out") == ContentsOf(folder.Path() / "whole"));
  EXPECT_EQ(ResultsOf(folder.Path() / "out"), ResultsOf(folder.Path() / "whole"));
}

TEST(Batch, FoldersOfOthersAreNotTouched)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 1);
  fs::create_directory(folder.Path() / "out");
  std::ofstream(folder.Path() / "out/thesis.txt") << "x";
  EXPECT_EQ(RunShell(std::string(command) + "-o out", folder.Path()).exitCode, 7);
  EXPECT_TRUE(fs::exists(folder.Path() / "out/thesis.txt"));
}

TEST(Batch, LimitsEndCasesWithTheirNames)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 1);
  std::ofstream(folder.Path() / "slow.yaml") << "outputs: [{page: page.png, preset: ct-bone-skin}]";
  const Outcome slow =
    RunShell("rhombic batch cases.tsv --case v0 --pipeline slow.yaml -o slow --max-time 0.001", folder.Path());
  EXPECT_EQ(slow.exitCode, 12);
  EXPECT_NE(slow.errors.find("v0: failed: It took longer than 0.001 s"), std::string::npos) << slow.errors;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all memory for themselves
  const Outcome large = RunShell(std::string(command) + "--case v0 -o large --max-memory 1M", folder.Path());
  EXPECT_EQ(large.exitCode, 12);
  EXPECT_NE(large.errors.find("v0: failed: "), std::string::npos) << large.errors;
#endif
}

TEST(Batch, ADryRunIsAManifestOfTheSameCases)
{
  const TemporaryFolder folder;
  WriteCollection(folder.Path(), 2);
  const Outcome plan = RunShell("rhombic batch . -o out --dry-run", folder.Path());
  ASSERT_EQ(plan.exitCode, 0) << plan.errors;
  EXPECT_FALSE(fs::exists(folder.Path() / "out"));
  std::ofstream(folder.Path() / "plan.tsv") << plan.output;
  EXPECT_EQ(RunShell("rhombic batch plan.tsv -o out --dry-run", folder.Path()).output, plan.output);
  EXPECT_EQ(std::count(plan.output.begin(), plan.output.end(), '\n'), 4) << plan.output;
}

TEST(Batch, TheDefaultIsAPageWithAThumbnail)
{
  const TemporaryFolder folder;
  fs::copy(phantom / "phantom.nii.gz", folder.Path());
  const Outcome outcome = RunShell("rhombic batch phantom.nii.gz -o out", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  for (const char * const file : { "page.png", "page.png.json", "thumbnail.jpg", "case.json" })
  {
    EXPECT_TRUE(fs::exists(folder.Path() / "out/case" / file)) << file;
  }
  EXPECT_NE(ReadText(folder.Path() / "out/case/page.png.json").find("\"bone\""), std::string::npos);
  EXPECT_NE(ReadText(folder.Path() / "out/index.html").find("src=\"./case/thumbnail.jpg\""), std::string::npos);
}

TEST(Batch, TheIndexLeadsToInteractivePages)
{
  const TemporaryFolder folder;
  fs::copy(phantom / "phantom.nii.gz", folder.Path());
  std::ofstream(folder.Path() / "pipeline.yaml") << "outputs:\n  - page: page.html\n    preset: ct-bone\n";
  const Outcome outcome = RunShell("rhombic batch phantom.nii.gz --pipeline pipeline.yaml -o out", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(ReadText(folder.Path() / "out/case/page.html").substr(0, 15), "<!doctype html>");
  const std::string index = ReadText(folder.Path() / "out/index.html");
  EXPECT_NE(index.find("<a href=\"./case/page.html\">page.html</a>"), std::string::npos);
  EXPECT_NE(index.find("<a href=\"./case/page.html\"><img "), std::string::npos) << "the thumbnail leads there, too";
}

TEST(Batch, TheChosenPresetFitsScanAndLabels)
{
  const TemporaryFolder folder;
  std::ofstream(folder.Path() / "pipeline.yaml") << "outputs: [{mesh: a.glb, preset: auto}]";
  const struct
  {
    std::string name, scan, labels, options, preset;
  } cases[] = { { "ct", phantom / "dicom", "", "--density 0.5", " --preset ct-bone-skin" },
                { "organs", phantom / "phantom.nii.gz", phantom / "phantom-labels.nii.gz", "", " --preset ct-organs" },
                { "labels", phantom / "phantom-labels.nii.gz", "", "--density 0.5", "" } };
  std::ofstream manifest(folder.Path() / "cases.tsv");
  manifest << "case\tscan\tlabels\toptions\n";
  for (const auto & one : cases)
  {
    manifest << one.name << '\t' << one.scan << '\t' << one.labels << '\t' << one.options << '\n';
  }
  manifest.close();
  const Outcome outcome = RunShell("rhombic batch cases.tsv --pipeline pipeline.yaml -o out", folder.Path());
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  for (const auto & one : cases)
  {
    const std::string labels = one.labels.empty() ? " " : " --labels " + one.labels + " ";
    RunShell("rhombic mesh " + one.scan + labels + one.options + one.preset + " -o a.glb", folder.Path());
    EXPECT_TRUE(ReadText(folder.Path() / "out" / one.name / "a.glb") == ReadText(folder.Path() / "a.glb")) << one.name;
  }
}

TEST(Batch, RenderAndMeshMakeTheSameFilesOfAPipeline)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "files");
  fs::copy(phantom / "dicom", folder.Path() / "scan");
  fs::copy(phantom / "phantom-labels.nii.gz", folder.Path());
  fs::copy(RHOMBIC_SOURCE "/pipelines/presets/ct-bone.yaml", folder.Path() / "files/mine.yaml");
  std::ofstream(folder.Path() / "files/all.yaml") << "options: {preset: auto}\n"
                                                     "outputs:\n"
                                                     "  - page: page.png\n"
                                                     "    dpi: 40\n"
                                                     "    dicom-sc: true\n"
                                                     "  - mesh: organs.glb\n"
                                                     "    measures: organs.csv\n"
                                                     "  - picture: front.png\n"
                                                     "    size: 100\n"
                                                     "    view: [left, right]\n"
                                                     "    labels: false\n"
                                                     "  - mesh: '{name}.ply'\n"
                                                     "    preset: mine.yaml\n"
                                                     "    labels: false\n"
                                                     "  - volume: scan.fcc.nrrd\n";
  std::ofstream(folder.Path() / "cases.tsv") << "case\tscan\tlabels\toptions\n"
                                                "one\tscan\tphantom-labels.nii.gz\t--on-gap=interpolate\n";
  const Outcome batch = RunShell("rhombic batch cases.tsv --pipeline files/all.yaml -o out", folder.Path());
  ASSERT_EQ(batch.exitCode, 0) << batch.errors;
  const std::string arguments =
    " scan --labels phantom-labels.nii.gz --on-gap interpolate --pipeline files/all.yaml -o a/folder";
  const Outcome mesh = RunShell("rhombic mesh" + arguments, folder.Path());
  ASSERT_EQ(mesh.exitCode, 0) << mesh.errors;
  EXPECT_NE(mesh.errors.find("left out: page.png, which rhombic render makes, front.png, which rhombic render makes, "
                             "scan.fcc.nrrd, which rhombic resample makes\n"),
            std::string::npos)
    << mesh.errors;
  const Outcome render = RunShell("RHOMBIC_MAX_MEMORY=4G rhombic --threads 3 render" + arguments, folder.Path());
  ASSERT_EQ(render.exitCode, 0) << render.errors;
  auto expected = ContentsOf(folder.Path() / "out/one");
  for (const char * const ofBatchAlone : { "case.json", "thumbnail.jpg", "scan.fcc.nrrd", "scan.fcc.nrrd.json" })
  {
    EXPECT_EQ(expected.erase(ofBatchAlone), 1u) << ofBatchAlone;
  }
  const auto contents = ContentsOf(folder.Path() / "a/folder");
  EXPECT_GT(contents.size(), 9u);
  EXPECT_EQ(contents.count("page.dcm"), 1u);
  for (const auto & [name, content] : expected)
  {
    EXPECT_TRUE(contents.count(name) == 1 && contents.at(name) == content) << name;
  }
  EXPECT_EQ(contents.size(), expected.size());
}

TEST(Batch, RenderAndMeshRefuseWhatIsNotOfAPipeline)
{
  const TemporaryFolder folder;
  fs::copy(phantom / "phantom.nii.gz", folder.Path());
  const auto meshBy = [&](const std::string & pipeline, const std::string & options) {
    std::ofstream(folder.Path() / "pipeline.yaml") << pipeline;
    return RunShell("rhombic mesh phantom.nii.gz --pipeline=pipeline.yaml " + options, folder.Path());
  };
  struct Mistake
  {
    const char * pipeline;
    const char * options;
    int exitCode;
    const char * expected;
  };
  const char * const bone = "outputs:\n  - mesh: bone.stl\n    threshold: 250.5\n";
  for (const Mistake & mistake :
       { Mistake{
           "outputs: [page: a.png]", "-o out", 2, "no output that rhombic mesh makes, but a.png, which rhombic" },
         Mistake{ "outputs:\n  - mesh: a.stl\n    treshold: 1\n", "-o out", 2, "in line 3 (did you mean threshold?)" },
         Mistake{ bone, "-o out --space ras", 2, "--space does not go with --pipeline" },
         Mistake{ bone, "", 2, "a folder with -o" },
         Mistake{ bone, "-o pipeline.yaml", 7, "the folder pipeline.yaml" },
         Mistake{ "outputs:\n  - mesh: a.stl\n    threshold: 250.5\n  - mesh: b.stl\n    threshold: 1e9\n",
                  "-o out",
                  6,
                  "Not made: b.stl." } })
  {
    const Outcome outcome = meshBy(mistake.pipeline, mistake.options);
    EXPECT_EQ(outcome.exitCode, mistake.exitCode) << outcome.errors;
    EXPECT_NE(outcome.errors.find(mistake.expected), std::string::npos) << outcome.errors;
    EXPECT_EQ(fs::exists(folder.Path() / "out/a.stl"), mistake.exitCode == 6) << "what was finished is kept";
    EXPECT_FALSE(fs::exists(folder.Path() / "out/b.stl"));
  }
  EXPECT_EQ(meshBy(bone, "-o out").exitCode, 0);
}

TEST(Batch, OutputsThatCannotBeMadeAreRefusedBeforeAnyCaseRuns)
{
  const TemporaryFolder folder;
  fs::copy(phantom / "phantom.nii.gz", folder.Path());
  fs::copy(phantom / "phantom-labels.nii.gz", folder.Path());
  std::ofstream(folder.Path() / "cases.tsv") << "case\tscan\tlabels\none\tphantom.nii.gz\tphantom-labels.nii.gz\n";
  const std::string page = "outputs:\n  - page: page.png\n    preset: auto\n";
  for (const auto & [more, expected] :
       { std::pair<std::string, std::string>{ "  - mesh: two.stl\n    preset: ct-bone-skin\n", "line 4" },
         { "  - mesh: two.stl\n    preset: ct-organs\n", "the output two.stl" },
         { "  - mesh: bone.xyz\n    preset: ct-bone\n", "line 4" },
         { "  - mesh: a.stl\n    preset: ct-bone\n    only: bonne\n    labels: false\n", "line 4" },
         { "  - picture: a.png\n    slice: axial\n    window: lungs\n", "did you mean lung?" },
         { "  - picture: a.png\n    view: lefft\n", "did you mean left?" },
         { "  - picture: a.png\n    preset: ct-bnoe\n", "did you mean ct-bone?" },
         { "  - picture: a.png\n    view: [left, right]\n  - picture: a-left.png\n", "would write a-left.png" },
         { "  - mesh: a.stl\n    measures: m.csv\n  - mesh: b.stl\n    measures: m.csv\n", "would write m.csv" },
         { "  - picture: thumbnail.jpg\n", "a batch writes a file thumbnail.jpg itself" },
         { "  - volume: scan.raw\n", "line 4" } })
  {
    std::ofstream(folder.Path() / "pipeline.yaml") << page << more;
    const Outcome outcome = RunShell("rhombic batch cases.tsv --pipeline pipeline.yaml -o out", folder.Path());
    EXPECT_EQ(outcome.exitCode, 2) << more << outcome.errors;
    EXPECT_NE(outcome.errors.find(expected), std::string::npos) << more << outcome.errors;
    EXPECT_FALSE(fs::exists(folder.Path() / "out"));
  }
}

/** A BIDS dataset of three participants, one of them in a session. */
void
WriteDataset(const fs::path & folder)
{
  fs::create_directories(folder);
  std::ofstream(folder / "dataset_description.json") << R"({"Name": "phantoms", "BIDSVersion": "1.8.0"})";
  std::ofstream(folder / "README") << "Three phantoms.\n";
  for (const char * const name : { "sub-01/anat/sub-01", "sub-02/anat/sub-02", "sub-03/ses-1/anat/sub-03_ses-1" })
  {
    const fs::path scan = folder / (std::string(name) + "_T1w.nii.gz");
    fs::create_directories(scan.parent_path());
    fs::copy(phantom / "phantom.nii.gz", scan);
    std::ofstream(folder / (std::string(name) + "_T1w.json")) << "{}";
  }
}

TEST(Batch, ABIDSDatasetBecomesADerivative)
{
  const TemporaryFolder folder;
  WriteDataset(folder.Path() / "data");
  std::ofstream(folder.Path() / "pipeline.yaml") << "outputs: [{mesh: bone.stl, threshold: 250.5}]";
  const std::string run = "rhombic bids data data/derivatives/rhombic --pipeline pipeline.yaml ";
  const fs::path out = folder.Path() / "data/derivatives/rhombic";
  const Outcome first = RunShell(run + "participant --participant_label 02 sub-03", folder.Path());
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  EXPECT_NE(first.errors.find("the level group writes the tables"), std::string::npos) << first.errors;
  EXPECT_EQ(first.errors.find("--tables"), std::string::npos) << first.errors;
  EXPECT_TRUE(fs::exists(out / "sub-02/anat/sub-02_T1w/bone.stl"));
  EXPECT_TRUE(fs::exists(out / "sub-03/ses-1/anat/sub-03_ses-1_T1w/bone.stl.json"));
  EXPECT_FALSE(fs::exists(out / "sub-01"));
  EXPECT_EQ(RunShell(run + "participant --participant-label 1", folder.Path()).exitCode, 2);
  const Outcome second = RunShell(run + "participant --participant-label sub-01", folder.Path());
  ASSERT_EQ(second.exitCode, 0) << second.errors;
  ASSERT_EQ(RunShell(run + "group", folder.Path()).exitCode, 0);
  const auto description = nlohmann::json::parse(ReadText(out / "dataset_description.json"));
  EXPECT_EQ(description["DatasetType"], "derivative");
  EXPECT_EQ(description["GeneratedBy"][0]["Name"], "Rhombic");
  const std::string table = ReadText(out / "results.tsv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
  EXPECT_NE(ReadText(out / "index.html").find("./sub-01/anat/sub-01_T1w/bone.stl"), std::string::npos);
  const Outcome whole = RunShell(run + "participant", folder.Path());
  EXPECT_NE(whole.errors.find("3 done before, 0 to run"), std::string::npos) << whole.errors;
  EXPECT_EQ(RunShell("rhombic bids out x participant", folder.Path()).exitCode, 3);
  if (const char * const copy = std::getenv("RHOMBIC_BIDS_COPY"))
  {
    fs::copy(folder.Path() / "data", copy, fs::copy_options::recursive); // for check-bids.sh
  }
}

TEST(Batch, LinesOfTheJournalThatAreNoRecordsAreLeftOut)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.Path() / "out");
  std::ofstream(folder.Path() / "cases.tsv") << "case\tscan\nsound\tx.nii\nwrong\tx.nii\n";
  std::ofstream journal(folder.Path() / "out/journal.jsonl");
  journal << R"({"case": "sound", "status": "failed", "cause": "was no scan", "measures": [{"surface": "bone"}]})"
          << '\n';
  for (const char * const line : { R"({"case": 7})",
                                   R"(["case"])",
                                   R"({"case": "wrong", "status": 3})",
                                   R"({"case": "wrong", "seconds": "1"})",
                                   R"({"case": "wrong", "outputs": {"name": "a"}})",
                                   R"({"case": "wrong", "outputs": [{"name": "a", "bytes": "x"}]})",
                                   R"({"case": "wrong", "outputs": ["a"]})",
                                   R"({"case": "wrong", "steps": [{"output": "a"}]})",
                                   R"({"case": "wrong", "measures": [{"surface": null}]})",
                                   R"({"case": "wrong", "agreement": [{"status": "compared", "dice": 1}]})",
                                   R"({"case": "wrong", "input": {"md5": 5}})",
                                   R"({"case": "wrong", "status": "do)" })
  {
    journal << line << '\n';
  }
  journal.close();
  const Outcome outcome = RunShell("rhombic batch cases.tsv -o out --tables", folder.Path());
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  const std::string table = ReadText(folder.Path() / "out/results.tsv");
  EXPECT_NE(table.find("sound\tfailed"), std::string::npos) << table;
  EXPECT_NE(table.find("wrong\tnot run"), std::string::npos) << table;
}

TEST(Batch, TheIndexOfManyCasesWorksInABrowser)
{
  const TemporaryFolder folder;
  if (RunShell("command -v chromium", folder.Path()).exitCode != 0)
  {
    GTEST_SKIP() << "chromium is not installed";
  }
  fs::create_directory(folder.Path() / "out");
  std::ofstream manifest(folder.Path() / "cases.tsv");
  std::ofstream journal(folder.Path() / "out/journal.jsonl");
  manifest << "case\tscan\n";
  for (int n = 0; n < 300; ++n)
  {
    const std::string name = "c" + std::to_string(n);
    manifest << name << "\tx.nii\n";
    journal << nlohmann::json{ { "case", name }, { "status", n % 3 == 0 ? "failed" : "done" }, { "cause", "<&>" } }
            << '\n';
  }
  manifest.close();
  journal.close();
  ASSERT_EQ(RunShell("rhombic batch cases.tsv -o out --tables", folder.Path()).exitCode, 0);
  const Outcome page = RunShell("sed -i 's/ name=\"failed\" checked/ name=\"failed\"/' out/index.html\n"
                                "chromium --headless --no-sandbox --disable-gpu --user-data-dir=profile "
                                "--dump-dom \"file://$PWD/out/index.html\"",
                                folder.Path());
  ASSERT_EQ(page.exitCode, 0) << page.errors;
  EXPECT_NE(page.output.find("200 of 300 shown"), std::string::npos) << page.output.substr(0, 3000);
  EXPECT_NE(page.output.find("failed (100)"), std::string::npos);
  EXPECT_NE(page.output.find("&lt;&amp;&gt;"), std::string::npos);
}

} // namespace
