#include "rhombicBatchCases.h"

#include "rhombicFailure.h"
#include "rhombicOMEZarrImage.h"
#include "rhombicScanReader.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

bool
IsVolume(const fs::path & path)
{
  return !VolumeFormatOf(path).empty();
}

/** Whether a file begins as DICOM files do, with or without a preamble. */
bool
IsDicom(const fs::path & path)
{
  std::string start(132, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  const bool hasGroup = (start[0] == 2 || start[0] == 8) && start[1] == 0 && start[3] == 0;
  return start.compare(128, 4, "DICM") == 0 || (hasGroup && start[2] != 0);
}

/** Throws Failure when the system refuses to look at a path, but not when it is gone meanwhile. */
void
FailUnlessGone(const fs::path & path, const std::error_code & error)
{
  if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
  {
    const bool isScarce = error.value() == EMFILE || error.value() == ENFILE || error.value() == ENOMEM;
    throw Failure(isScarce ? FailureKind::Memory : FailureKind::Unreadable,
                  "Cannot look for scans in " + path.string() + ": " + error.message() +
                    "; see to that, or name the scans in a manifest.");
  }
}

struct FolderEntries
{
  std::vector<fs::path> files;
  std::vector<fs::path> folders;
};

/** Files and folders in a folder, sorted, without hidden ones, links, lost+found and \a excluded. Throws Failure for a
 * folder that can't be listed to its end: its cases would be lost. */
FolderEntries
ListFolder(const fs::path & folder, const fs::path & excluded)
{
  FolderEntries entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; entry != end; entry.increment(error))
  {
    const fs::file_status status = entry->symlink_status(error);
    const std::string name = entry->path().filename().string();
    if (name[0] == '.' || name == "lost+found" || entry->path() == excluded) // lost+found is the file system's
    {
      continue;
    }
    FailUnlessGone(entry->path(), error);
    if (fs::is_directory(status))
    {
      entries.folders.push_back(entry->path());
    }
    else if (fs::is_regular_file(status))
    {
      entries.files.push_back(entry->path());
    }
  }
  FailUnlessGone(folder, error);
  std::sort(entries.files.begin(), entries.files.end());
  std::sort(entries.folders.begin(), entries.folders.end());
  return entries;
}

/** A path without the extensions of a volume: "a/b" for "a/b.nii.gz". */
std::string
StemOf(const fs::path & volume)
{
  const std::string text = volume.string();
  return text.substr(0, text.size() - VolumeExtension(volume).size());
}

/** The name of a volume's file without its extensions: "b" for "a/b.nii.gz". */
std::string
StemNameOf(const fs::path & volume)
{
  return fs::path(StemOf(volume)).filename().string();
}

/** Adds all files that belong to a scan or label map: a folder's, or a header's and those of the same stem beside it.
 */
void
AddFiles(const fs::path & path, std::vector<fs::path> & files)
{
  static const std::set<std::string> inParts{ ".hdr", ".hdr.gz", ".img", ".img.gz", ".nhdr", ".mhd" };
  constexpr auto options = fs::directory_options::skip_permission_denied;
  const auto add = [&files](const fs::directory_entry & entry) {
    if (entry.is_regular_file())
    {
      files.push_back(entry.path());
    }
  };
  if (fs::is_directory(path))
  {
    std::for_each(fs::recursive_directory_iterator(path, options), {}, add);
  }
  else if (inParts.count(VolumeExtension(path)) == 0)
  {
    add(fs::directory_entry(path));
  }
  else
  {
    std::for_each(fs::directory_iterator(path.parent_path(), options), {}, [&](const fs::directory_entry & entry) {
      if (entry.path().string().rfind(StemOf(path) + ".", 0) == 0)
      {
        add(entry);
      }
    });
  }
}

/** All files of a case, sorted; none if its scan, labels or reference do not exist, or where the system refuses to look
 * for them: the case then says why. */
std::vector<fs::path>
ListFilesOf(const BatchCase & batchCase)
try
{
  std::vector<fs::path> files;
  for (const fs::path & path : { batchCase.scan, batchCase.labels, batchCase.reference })
  {
    if (path.empty())
    {
      continue;
    }
    if (!fs::exists(path))
    {
      return {};
    }
    AddFiles(path, files);
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}
catch (const fs::filesystem_error &)
{
  return {};
}

/** A text whose letters may be in the name of any file. */
std::string
ToFileName(std::string text)
{
  const auto isUnsafe = [](unsigned char letter) {
    return std::isalnum(letter) == 0 && letter != '-' && letter != '.' && letter != '_';
  };
  std::replace_if(text.begin(), text.end(), isUnsafe, '_');
  return text;
}

/** Finds the cases in a tree of folders. */
class TreeSearch
{
public:
  TreeSearch(const fs::path & root, const CaseSearch & search)
    : m_Root(root)
    , m_Search(search)
  {}

  CaseCollection
  Run()
  {
    this->Enter(m_Root);
    if (m_NumberOfOthers > 0)
    {
      m_Found.notes.push_back(Count(m_NumberOfOthers, "file") + " left out, neither DICOM nor volumes");
    }
    if (m_NumberOfSingleSlices > 0)
    {
      m_Found.notes.push_back(Count(m_NumberOfSingleSlices, "DICOM series", "DICOM series") +
                              " of a single slice left out, as localizers are");
    }
    return m_Found;
  }

private:
  /** \param isInSeries whether the slices in the folder are found with those above, and it need only be listed */
  void
  Enter(const fs::path & folder, bool isInSeries = false)
  {
    if (!isInSeries && HoldsOMEZarrImage(folder))
    {
      this->Add(folder, "");
      return;
    }
    const FolderEntries entries = ListFolder(folder, m_Search.excluded);
    bool hasSlices = false;
    for (const fs::path & file : isInSeries ? std::vector<fs::path>() : entries.files)
    {
      if (IsVolume(file))
      {
        this->AddVolume(file);
      }
      else if (file.filename() != "DICOMDIR" && IsDicom(file))
      {
        hasSlices = true;
      }
      else
      {
        ++m_NumberOfOthers;
      }
    }
    if (hasSlices)
    {
      this->AddSeries(folder);
    }
    for (const fs::path & subfolder : entries.folders)
    {
      this->Enter(subfolder, isInSeries || hasSlices);
    }
  }

  void
  AddVolume(const fs::path & file)
  {
    const std::string extension = VolumeExtension(file);
    const bool isImage = extension == ".img" || extension == ".img.gz"; // a case is named by the header
    std::error_code error;
    if (!isImage || (!fs::exists(StemOf(file) + ".hdr", error) && !fs::exists(StemOf(file) + ".hdr.gz", error)))
    {
      this->Add(file, "");
    }
  }

  /** A folder of slices is a case for each series, or a case that ends with the reason for which it can't be read.
   * Single slices beside volumes, as localizers, are no cases. */
  void
  AddSeries(const fs::path & folder)
  {
    std::vector<SeriesSummary> series;
    try
    {
      series = ListSeries(folder).series;
    }
    catch (const Failure &) // the case's own command will say it
    {}
    if (series.size() < 2)
    {
      this->Add(folder, "");
      return;
    }
    const auto isSingleSlice = [](const SeriesSummary & summary) {
      return summary.size[2] < 2 && !summary.problem.empty();
    };
    const bool hasVolumes = !std::all_of(series.begin(), series.end(), isSingleSlice);
    for (const SeriesSummary & summary : series)
    {
      if (hasVolumes && isSingleSlice(summary))
      {
        ++m_NumberOfSingleSlices;
      }
      else
      {
        this->Add(folder, summary.id);
      }
    }
  }

  void
  Add(const fs::path & scan, const std::string & series)
  {
    BatchCase found;
    const std::string place = (scan == m_Root ? scan.filename() : scan.lexically_relative(m_Root)).string() +
                              (series.empty() ? "" : "/" + series);
    constexpr std::size_t digits = 12;
    found.name = m_Search.namesFromPaths ? ToFileName(place) : "case-" + HashText(place).substr(0, digits);
    found.scan = scan;
    if (!series.empty())
    {
      found.options.push_back("--series=" + series);
    }
    m_Found.cases.push_back(found);
  }

  fs::path m_Root;
  CaseSearch m_Search;
  CaseCollection m_Found;
  std::size_t m_NumberOfOthers = 0;
  std::size_t m_NumberOfSingleSlices = 0; ///< series
};

/** "sub-01_ses-1" of ".../sub-01_ses-1_T1w.nii.gz": a BIDS name without its suffix. */
std::string
EntitiesOf(const fs::path & volume)
{
  const std::string stem = StemNameOf(volume);
  return stem.substr(0, stem.rfind('_'));
}

std::string
SuffixOf(const fs::path & volume)
{
  const std::string stem = StemNameOf(volume);
  return stem.substr(stem.rfind('_') + 1);
}

/** The volumes, and folders of masks, in folders of a name, anywhere in a folder. */
void
FindVolumes(const fs::path & folder, const std::string & name, const fs::path & excluded, std::vector<fs::path> & found)
{
  const FolderEntries entries = ListFolder(folder, excluded);
  if (folder.filename() == name)
  {
    std::copy_if(entries.files.begin(), entries.files.end(), std::back_inserter(found), IsVolume);
  }
  for (const fs::path & subfolder : entries.folders)
  {
    if (folder.filename() == name && SuffixOf(subfolder) == "dseg") // of masks
    {
      found.push_back(subfolder);
    }
    FindVolumes(subfolder, name, excluded, found);
  }
}

/** Whether a folder of a dataset may hold chosen cases, or their labels. */
bool
MayHoldCases(const std::string & folder, const std::vector<std::string> & only)
{
  const std::string begin = folder + '_'; // of names of cases
  const bool isOther = !only.empty() && std::none_of(only.begin(), only.end(), [&begin](const std::string & name) {
    const std::size_t known = std::min(name.find_first_of("*?["), std::min(name.size(), begin.size()));
    return name.compare(0, known, begin, 0, known) == 0;
  });
  return folder != "sourcedata" && !(isOther && folder.rfind("sub-", 0) == 0);
}

CaseCollection
FindInBIDS(const fs::path & root, const CaseSearch & search)
{
  std::vector<fs::path> volumes;
  for (const fs::path & folder : ListFolder(root, search.excluded).folders)
  {
    try
    {
      FindVolumes(folder, "anat", search.excluded, volumes);
    }
    catch (const Failure &)
    {
      if (MayHoldCases(folder.filename().string(), search.only))
      {
        throw;
      }
    }
  }
  CaseCollection found;
  for (const fs::path & volume : volumes)
  {
    const std::string suffix = SuffixOf(volume);
    const std::string below = volume.lexically_relative(root).begin()->string();
    if (below.rfind("sub-", 0) != 0 || suffix == "dseg" || suffix == "probseg" || suffix == "mask")
    {
      continue;
    }
    BatchCase batchCase;
    batchCase.name = ToFileName(StemNameOf(volume));
    batchCase.scan = volume;
    std::vector<fs::path> labels;
    const std::string entities = EntitiesOf(volume);
    std::copy_if(volumes.begin(), volumes.end(), std::back_inserter(labels), [&entities](const fs::path & other) {
      return SuffixOf(other) == "dseg" && (EntitiesOf(other) + "_").rfind(entities + "_", 0) == 0;
    });
    if (labels.size() == 1)
    {
      batchCase.labels = labels.front();
    }
    else if (labels.size() > 1)
    {
      found.notes.push_back(batchCase.name + " has " + Count(labels.size(), "label map") +
                            ", and none is used; choose in a manifest, which --dry-run writes");
    }
    found.cases.push_back(batchCase);
  }
  return found;
}

[[noreturn]] void
FailInManifest(const fs::path & manifest, std::size_t line, const std::string & why)
{
  throw Failure(FailureKind::Usage,
                "The manifest " + manifest.string() + ", line " + std::to_string(line) + ": " + why +
                  "; rhombic batch FOLDER --dry-run writes one to start from.");
}

/** The first line of a manifest: its columns. Those that --dry-run adds for the reader may be there. */
std::vector<std::string>
ParseHead(const fs::path & manifest, const std::string & line)
{
  const std::vector<std::string> known{ "case",  "scan",      "labels",  "reference", "options",
                                        "state", "megabytes", "seconds", "peak_MiB" };
  std::vector<std::string> columns = Split(line, "\t");
  for (const std::string & column : columns)
  {
    if (std::count(known.begin(), known.end(), column) == 0 || std::count(columns.begin(), columns.end(), column) > 1)
    {
      const std::string nearest = NearestName(column, known);
      FailInManifest(manifest,
                     1,
                     "'" + column + "' is no column, or there twice" +
                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  }
  for (const char * const needed : { "case", "scan" })
  {
    if (std::count(columns.begin(), columns.end(), needed) == 0)
    {
      FailInManifest(manifest, 1, std::string("the column ") + needed + " is missing");
    }
  }
  return columns;
}

CaseCollection
ReadManifest(const fs::path & manifest)
{
  std::istringstream stream(ReadTextFile(manifest, "manifest"));
  CaseCollection found;
  std::vector<std::string> columns;
  std::set<std::string> names;
  std::string text;
  for (std::size_t line = 1; std::getline(stream, text); ++line)
  {
    text = text.substr(0, text.find_last_not_of('\r') + 1);
    if (columns.empty())
    {
      columns = ParseHead(manifest, text);
      continue;
    }
    if (Trim(text).empty())
    {
      continue;
    }
    const std::vector<std::string> fields = Split(text, "\t");
    if (fields.size() != columns.size())
    {
      FailInManifest(
        manifest, line, Count(fields.size(), "field") + " where there are " + Count(columns.size(), "column"));
    }
    std::map<std::string, std::string> row;
    for (std::size_t n = 0; n < columns.size(); ++n)
    {
      row[columns[n]] = fields[n];
    }
    BatchCase batchCase;
    batchCase.name = row["case"];
    if (batchCase.name.empty() || batchCase.name[0] == '.' || batchCase.name[0] == '-' ||
        batchCase.name != ToFileName(batchCase.name))
    {
      FailInManifest(
        manifest, line, "'" + batchCase.name + "' is no name of a case: letters, digits, . _ and - are allowed");
    }
    if (!names.insert(batchCase.name).second)
    {
      FailInManifest(manifest, line, "there is a case " + batchCase.name + " before");
    }
    const fs::path folder = manifest.parent_path();
    batchCase.scan = (folder / row["scan"]).lexically_normal();
    const auto pathOf = [&](const char * column) {
      return row[column].empty() ? fs::path() : (folder / row[column]).lexically_normal();
    };
    batchCase.labels = pathOf("labels");
    batchCase.reference = pathOf("reference");
    const auto words = SplitWords(row["options"]);
    batchCase.options.assign(words.begin(), words.end());
    found.cases.push_back(batchCase);
  }
  return found;
}

/** Leaves the cases of some names. */
void
Choose(const std::vector<std::string> & only, std::vector<BatchCase> & cases)
{
  std::vector<std::string> names;
  for (const BatchCase & found : cases)
  {
    names.push_back(found.name);
  }
  std::set<std::string> chosen;
  for (const std::string & wanted : only)
  {
    const auto isWanted = [&wanted](const std::string & name) { return MatchesPattern(wanted, name); };
    if (std::none_of(names.begin(), names.end(), isWanted))
    {
      throw Failure(FailureKind::Usage, DescribeUnknown("case", wanted, names, "--dry-run lists all of them"));
    }
    std::copy_if(names.begin(), names.end(), std::inserter(chosen, chosen.end()), isWanted);
  }
  const auto isOther = [&chosen](const BatchCase & found) { return chosen.count(found.name) == 0; };
  cases.erase(std::remove_if(cases.begin(), cases.end(), isOther), cases.end());
}

/** Leaves out the cases that a table of cases can't hold, and notes them. Throws Failure(Usage) when none is left. */
void
LeaveOutUnlistable(CaseCollection & found)
{
  const auto isListable = [](const BatchCase & batchCase) {
    return (batchCase.scan.string() + batchCase.labels.string() + batchCase.reference.string())
             .find_first_of("\t\r\n") == std::string::npos;
  };
  const auto end = std::stable_partition(found.cases.begin(), found.cases.end(), isListable);
  for (auto leftOut = end; leftOut != found.cases.end(); ++leftOut)
  {
    found.notes.push_back(leftOut->name +
                          " left out: the path of its scan or labels has a tab or line break, which the table of "
                          "cases cannot hold; rename the file or folder");
  }
  if (end == found.cases.begin())
  {
    throw Failure(FailureKind::Usage, "Case " + found.notes.back() + ".");
  }
  found.cases.erase(end, found.cases.end());
}

} // namespace

bool
IsBIDS(const fs::path & folder)
{
  std::error_code error;
  const bool isDescribed = IsFolder(folder) && fs::exists(folder / "dataset_description.json", error);
  FailUnlessGone(folder, error);
  const auto entries = ListFolder(folder, {});
  return isDescribed && std::any_of(entries.folders.begin(), entries.folders.end(), [](const fs::path & path) {
           return path.filename().string().rfind("sub-", 0) == 0;
         });
}

std::uintmax_t
BatchCase::GetSize() const
{
  std::uintmax_t size = 0;
  for (const fs::path & file : files)
  {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    size += error ? 0 : bytes;
  }
  return size;
}

CaseCollection
FindCases(const fs::path & path, const CaseSearch & given)
{
  std::error_code error;
  const fs::path collection = fs::canonical(path, error);
  const bool isFolder = IsFolder(error ? path : collection);
  CaseSearch search = given;
  search.excluded = given.excluded.empty() ? fs::path() : fs::weakly_canonical(given.excluded, error);
  CaseCollection found;
  if (LowerCase(collection.extension().string()) == ".tsv")
  {
    found = ReadManifest(collection);
  }
  else if (!isFolder)
  {
    BatchCase & batchCase = found.cases.emplace_back();
    batchCase.name = search.namesFromPaths ? ToFileName(StemNameOf(collection)) : "case";
    batchCase.scan = collection;
  }
  else
  {
    found = IsBIDS(collection) ? FindInBIDS(collection, search) : TreeSearch(collection, search).Run();
  }
  if (found.cases.empty())
  {
    throw Failure(FailureKind::NotFound,
                  "There is no case in " + path.string() +
                    "; name a folder of scans, a BIDS dataset, or a manifest with lines below its head.");
  }
  std::set<std::string> names;
  for (BatchCase & batchCase : found.cases)
  {
    for (unsigned int n = 2; !names.insert(batchCase.name).second; ++n)
    {
      batchCase.name += "-" + std::to_string(n);
    }
  }
  LeaveOutUnlistable(found);
  if (!search.only.empty())
  {
    Choose(search.only, found.cases);
  }
  for (BatchCase & batchCase : found.cases)
  {
    batchCase.folder = batchCase.name;
    batchCase.files = ListFilesOf(batchCase);
  }
  return found;
}

} // namespace rhombic
