#include "../scans/ScanIO/rhombicDicomTestFile.h"
#include "rhombicBatchCases.h"

#include "rhombicFailure.h"
#include "rhombicNobody.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include <sys/resource.h>
#include <sys/stat.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::CaseCollection;
using rhombic::Failure;
using rhombic::FailureKind;
using rhombictest::TemporaryFolder;

const fs::path phantom = fs::path(RHOMBIC_TESTDATA) / "phantom";

void
WriteFile(const fs::path & path, const std::string & text)
{
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(BatchCases, LocalizersAreNoCasesButBesideNothingElse)
{
  const TemporaryFolder folder;
  const auto write = [&](const std::string & series, int slices) {
    for (int k = 0; k < slices; ++k)
    {
      DicomTestFile file(4, 4);
      file.SetSeries(series, "1");
      file.SetPosition("0\\0\\" + std::to_string(k));
      file.Write(folder.Path() / (series + "-" + std::to_string(k) + ".dcm"));
    }
  };
  write("1.2.1", 1);
  write("1.2.2", 1);
  CaseCollection found = rhombic::FindCases(folder.Path());
  EXPECT_EQ(found.cases.size(), 2u) << "each ends with the reason for which it is not drawn";
  write("1.2.3", 3);
  found = rhombic::FindCases(folder.Path());
  ASSERT_EQ(found.cases.size(), 1u);
  EXPECT_EQ(found.cases[0].options.size(), 1u) << "the series is named";
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_EQ(found.notes[0], "2 DICOM series of a single slice left out, as localizers are");
  write("1.2.4", 4);
  EXPECT_EQ(rhombic::FindCases(folder.Path()).cases.size(), 2u);
}

TEST(BatchCases, ATreeHasACaseForEachSeriesAndVolume)
{
  const TemporaryFolder folder;
  const fs::path root = folder.Path() / "DOE^JANE";
  fs::create_directories(root / "a");
  fs::copy(phantom / "dicom", root / "a/series");
  fs::copy(phantom / "phantom.nii.gz", root / "phantom.nii.gz");
  WriteFile(root / "pair.hdr", "x");
  WriteFile(root / "pair.img", "x");
  WriteFile(root / "notes.txt", "x");
  WriteFile(root / ".hidden/scan.nii", "x");
  WriteFile(root / "out/page.nrrd", "x");
  const CaseCollection found = rhombic::FindCases(root, { false, root / "out", {} });
  std::set<fs::path> scans;
  for (const auto & one : found.cases)
  {
    scans.insert(one.scan.lexically_relative(fs::canonical(root)));
    EXPECT_EQ(one.name.find("DOE"), std::string::npos) << one.name;
    EXPECT_EQ(one.name.rfind("case-", 0), 0u) << one.name;
  }
  EXPECT_EQ(scans, (std::set<fs::path>{ "a/series", "pair.hdr", "phantom.nii.gz" }));
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes.front().find("1 file"), std::string::npos);

  const auto named = rhombic::FindCases(root, { true, root / "out", {} }).cases;
  EXPECT_EQ(named.front().name, "pair.hdr");
  EXPECT_EQ(named.front().files.size(), 2u) << "header and voxels";
  EXPECT_EQ(named.back().name, "a_series");
}

TEST(BatchCases, AFolderOfOMEZarrIsACase)
{
  const TemporaryFolder folder;
  const rhombictest::OMEZarrTestFolder zarr;
  zarr.Write(folder.Path() / "a.ome.zarr", std::vector<std::uint8_t>(120));
  zarr.Write(folder.Path() / "group.zarr/0", std::vector<std::uint8_t>(120));
  WriteFile(folder.Path() / "group.zarr/.zattrs", R"({"bioformats2raw.layout": 3})");
  const auto cases = rhombic::FindCases(folder.Path(), { true, {}, {} }).cases;
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "a.ome.zarr");
  EXPECT_EQ(cases[0].files.size(), 1u + 1u + 1u + 8u) << "metadata and chunks";
  EXPECT_EQ(cases[1].name, "group.zarr_0");
}

TEST(BatchCases, NamesStayWhenScansAreAdded)
{
  const TemporaryFolder folder;
  WriteFile(folder.Path() / "b.nii", "x");
  const std::string name = rhombic::FindCases(folder.Path()).cases.front().name;
  WriteFile(folder.Path() / "a.nii", "x");
  EXPECT_EQ(rhombic::FindCases(folder.Path()).cases.back().name, name);
}

TEST(BatchCases, BIDSHasItsNamesAndLabels)
{
  const TemporaryFolder folder;
  const fs::path root = folder.Path();
  WriteFile(root / "dataset_description.json", "{}");
  for (const char * const name : { "sub-01/anat/sub-01_T1w.nii.gz",
                                   "sub-01/anat/sub-01_T1w.json",
                                   "sub-02/ses-1/anat/sub-02_ses-1_T1w.nii.gz",
                                   "sub-02/ses-1/anat/sub-02_ses-1_T2w.nii.gz",
                                   "sub-02/ses-1/func/sub-02_ses-1_bold.nii.gz",
                                   "derivatives/seg/sub-01/anat/sub-01_space-orig_dseg.nii.gz",
                                   "derivatives/seg/sub-02/anat/sub-02_ses-1_dseg/liver.nii.gz",
                                   "derivatives/seg/sub-02/anat/sub-02_ses-1_dseg/spleen.nii.gz" })
  {
    WriteFile(root / name, "x");
  }
  const auto cases = rhombic::FindCases(root).cases;
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].name, "sub-01_T1w");
  EXPECT_EQ(cases[0].labels.filename(), "sub-01_space-orig_dseg.nii.gz");
  EXPECT_EQ(cases[0].files.size(), 2u);
  EXPECT_EQ(cases[1].name, "sub-02_ses-1_T1w");
  EXPECT_EQ(cases[1].labels.filename(), "sub-02_ses-1_dseg") << "a folder of masks";
  EXPECT_EQ(cases[1].files.size(), 3u);
}

TEST(BatchCases, PathsThatATableCannotHoldAreLeftOut)
{
  for (const char * const name : { "a\tb.nii", "a\nb.nii", "a\rb.nii" })
  {
    const TemporaryFolder folder;
    WriteFile(folder.Path() / name, "x");
    EXPECT_THROW(rhombic::FindCases(folder.Path()), Failure);
    WriteFile(folder.Path() / "c.nii", "x");
    const CaseCollection found = rhombic::FindCases(folder.Path());
    ASSERT_EQ(found.cases.size(), 1u);
    EXPECT_EQ(found.cases.front().scan.filename(), "c.nii");
    ASSERT_EQ(found.notes.size(), 1u);
    EXPECT_NE(found.notes.front().find("has a tab or line break"), std::string::npos) << found.notes.front();
  }
}

TEST(BatchCases, AManifestNamesCasesWithPathsRelativeToIt)
{
  const TemporaryFolder folder;
  WriteFile(folder.Path() / "scans/a.nii", "x");
  const fs::path manifest = folder.Path() / "cases.tsv";
  WriteFile(manifest, "case\tscan\toptions\r\none\tscans/a.nii\t--frame 2\r\ntwo\tnone.nii\t\r\n");
  const auto cases = rhombic::FindCases(manifest).cases;
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].scan, fs::canonical(folder.Path()) / "scans/a.nii");
  EXPECT_EQ(cases[0].options, (std::vector<std::string>{ "--frame", "2" }));
  EXPECT_TRUE(cases[1].files.empty()) << "what is missing is for its command to say";
}

TEST(BatchCases, AManifestMayHaveAByteOrderMarkAndFoldersOfMasks)
{
  const TemporaryFolder folder;
  WriteFile(folder.Path() / "a.nii", "x");
  WriteFile(folder.Path() / "masks/liver.nii", "x");
  WriteFile(folder.Path() / "masks/spleen.nii", "x");
  const fs::path manifest = folder.Path() / "cases.tsv";
  WriteFile(manifest,
            "\xEF\xBB\xBF"
            "case\tscan\tlabels\r\none\ta.nii\tmasks\r\n");
  const auto cases = rhombic::FindCases(manifest).cases;
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].labels, fs::canonical(folder.Path()) / "masks");
  EXPECT_EQ(cases[0].files.size(), 3u);
  WriteFile(manifest,
            std::string("\xFF\xFE"
                        "c\0a\0s\0e\0",
                        10));
  EXPECT_THROW(rhombic::FindCases(manifest), Failure);
}

TEST(BatchCases, MistakesInManifestsAreNamedWithTheirLine)
{
  struct Mistake
  {
    const char * text;
    const char * expected;
  };
  for (const Mistake & mistake : { Mistake{ "case\tscann\n", "did you mean scan" },
                                   Mistake{ "case\tlabels\n", "column scan is missing" },
                                   Mistake{ "case\tscan\na\tx\nb\n", "line 3: 1 field" },
                                   Mistake{ "case\tscan\na\tx\na\ty\n", "line 3: there is a case a" },
                                   Mistake{ "case\tscan\n../a\tx\n", "line 2: '../a' is no name" } })
  {
    const TemporaryFolder folder;
    WriteFile(folder.Path() / "m.tsv", mistake.text);
    try
    {
      rhombic::FindCases(folder.Path() / "m.tsv");
      ADD_FAILURE() << mistake.text;
    }
    catch (const Failure & failure)
    {
      EXPECT_NE(std::string(failure.GetDescription()).find(mistake.expected), std::string::npos)
        << failure.GetDescription();
    }
  }
}

TEST(BatchCases, FilesThatTheSystemRefusesToLookForAreMissing)
{
  const TemporaryFolder folder;
  WriteFile(folder.Path() / "m.tsv", "case\tscan\na\t" + std::string(300, 'x') + ".nii\n");
  const auto found = rhombic::FindCases(folder.Path() / "m.tsv");
  ASSERT_EQ(found.cases.size(), 1u);
  EXPECT_TRUE(found.cases[0].files.empty());
}

/** The kind of the failure with which work ends, and whether its sentence has a text; none, 0, when it does not fail.
 */
template <typename TWork>
std::pair<FailureKind, bool>
FailureOf(const TWork & work, const std::string & text)
{
  try
  {
    work();
  }
  catch (const Failure & failure)
  {
    return { failure.GetKind(), std::string(failure.GetDescription()).find(text) != std::string::npos };
  }
  return {};
}

TEST(BatchCases, AClosedFolderInACollectionIsRefusedAndNotLeftOut)
{
  const std::string slice = std::string(128, '\0') + "DICM";
  for (const std::vector<std::string> & names :
       { std::vector<std::string>{ "b/scan.nii", "a/scan.nii" }, // the folder of the first is closed
         std::vector<std::string>{ "s/more/slice", "s/slice" },
         std::vector<std::string>{ "sub-02/T1w.nii", "sub-01/anat/sub-01_T1w.nii", "dataset_description.json" } })
  {
    for (const fs::perms mode : { fs::perms::none, fs::perms(0444) }) // which may be listed, but not looked into
    {
      const TemporaryFolder folder;
      fs::permissions(folder.Path(), fs::perms(0755));
      for (const std::string & name : names)
      {
        WriteFile(folder.Path() / name, slice);
      }
      const fs::path closed = (folder.Path() / names.front()).parent_path();
      fs::permissions(closed, mode);
      {
        const rhombictest::Nobody nobody;
        if (!nobody.IsBound() || !std::ifstream(folder.Path() / names.back()))
        {
          GTEST_SKIP() << "this user can't be another one, or not in the folder of temporary files";
        }
        const auto outcome = FailureOf([&] { rhombic::FindCases(folder.Path()); },
                                       closed.string() + (mode == fs::perms::none ? ":" : "/"));
        EXPECT_EQ(outcome, std::pair(FailureKind::Unreadable, true)) << closed;
        EXPECT_EQ(FailureOf([&] { rhombic::IsBIDS(closed / "in"); }, "Permission denied"),
                  std::pair(FailureKind::Unreadable, true));
      }
      fs::permissions(closed, fs::perms::owner_all);
    }
  }
}

TEST(BatchCases, ClosedFoldersOfADatasetWithoutChosenCasesAreNoMatter)
{
  const TemporaryFolder folder;
  fs::permissions(folder.Path(), fs::perms(0755));
  for (const char * const name : { "dataset_description.json",
                                   "sub-01/anat/sub-01_T1w.nii",
                                   "sub-02/anat/sub-02_T1w.nii",
                                   "sourcedata/sub-01/a.dcm" })
  {
    WriteFile(folder.Path() / name, "x");
  }
  fs::permissions(folder.Path() / "sourcedata", fs::perms::none);
  fs::permissions(folder.Path() / "sub-02", fs::perms::none);
  {
    const rhombictest::Nobody nobody;
    if (!nobody.IsBound() || !std::ifstream(folder.Path() / "dataset_description.json"))
    {
      GTEST_SKIP() << "this user can't be another one, or not in the folder of temporary files";
    }
    rhombic::CaseSearch search;
    for (const char * const chosen : { "sub-01_*", "sub-01_T1w", "sub-02_*", "*" })
    {
      search.only = { chosen };
      const FailureKind kind = FailureOf([&] { rhombic::FindCases(folder.Path(), search); }, "sub-02").first;
      const bool isFirst = std::string(chosen).rfind("sub-01", 0) == 0;
      EXPECT_EQ(kind, isFirst ? FailureKind() : FailureKind::Unreadable) << chosen;
    }
  }
  fs::permissions(folder.Path() / "sub-02", fs::perms::owner_all);
  fs::permissions(folder.Path() / "sourcedata", fs::perms::owner_all);
  EXPECT_EQ(rhombic::FindCases(folder.Path()).cases.size(), 2u);
}

TEST(BatchCases, AFolderThatTheSystemDoesNotListIsRefused)
{
  const TemporaryFolder folder;
  WriteFile(folder.Path() / "a.nii", "x");
  rlimit usual{};
  getrlimit(RLIMIT_NOFILE, &usual);
  const rlimit none{ 0, usual.rlim_max };
  setrlimit(RLIMIT_NOFILE, &none);
  const auto outcome = FailureOf([&] { rhombic::FindCases(folder.Path()); }, "Too many open files");
  setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_EQ(outcome, std::pair(FailureKind::Memory, true));
  WriteFile(folder.Path() / "lost+found/b.nii", "x"); // of a file system, mostly closed
  EXPECT_EQ(rhombic::FindCases(folder.Path()).cases.size(), 1u);

  const fs::path before = fs::current_path();
  fs::current_path(folder.Path());
  for (int n = 0; n < 17; ++n) // more letters than a path may have
  {
    fs::create_directory(std::string(250, 'f'));
    fs::current_path(std::string(250, 'f'));
  }
  fs::current_path(before);
  EXPECT_EQ(FailureOf([&] { rhombic::FindCases(folder.Path()); }, "File name too long"),
            std::pair(FailureKind::Unreadable, true));
}

TEST(BatchCases, CollectionsThatTheSystemRefusesToLookForAreFailures)
{
  const TemporaryFolder folder;
  fs::create_symlink("loop", folder.Path() / "loop");
  for (const std::string & name : { std::string("loop"), std::string(300, 'x') })
  {
    const fs::path path = folder.Path() / name;
    const std::pair expected(FailureKind::Unreadable, true);
    EXPECT_EQ(FailureOf([&] { rhombic::FindCases(path); }, name), expected);
    EXPECT_EQ(FailureOf([&] { rhombic::IsBIDS(path); }, name), expected);
  }
}

TEST(BatchCases, PipesAreNotOpened)
{
  const TemporaryFolder folder;
  const fs::path pipe = folder.Path() / "f.nii.gz";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(FailureOf([&] { rhombic::FindCases(pipe); }, "it is a device or pipe"),
            std::pair(FailureKind::Unreadable, true));
  WriteFile(folder.Path() / "m.tsv", "case\tscan\na\tf.nii.gz\n");
  const auto found = rhombic::FindCases(folder.Path() / "m.tsv");
  ASSERT_EQ(found.cases.size(), 1u);
  EXPECT_TRUE(found.cases[0].files.empty()) << "its contents are not hashed; its command refuses it";
}

TEST(BatchCases, AnEmptyCollectionIsAFailure)
{
  const TemporaryFolder folder;
  EXPECT_THROW(rhombic::FindCases(folder.Path()), Failure);
  EXPECT_THROW(rhombic::FindCases(folder.Path() / "missing"), Failure);
}

} // namespace
