#include "rhombicScanFormats.h"

#include "rhombicDicomHeader.h"
#include "rhombicFiles.h"
#include "rhombicLabelMap.h"
#include "rhombicLabelLayers.h"
#include "rhombicVolumeGeometry.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <map>
#include <set>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

bool
IsVolume(const fs::directory_entry & entry, bool followsLinks)
{
  std::error_code error;
  const fs::path & path = entry.path();
  const std::string extension = VolumeExtension(path);
  const bool isVoxels = extension == ".img" || extension == ".img.gz"; // of a .hdr
  return path.filename().string()[0] != '.' && !isVoxels && !VolumeFormatOf(path).empty() &&
         (followsLinks || !entry.is_symlink(error)) && entry.is_regular_file(error);
}

/** Throws Failure(Geometry) for a label map with other voxels than the first. */
void
CheckGrid(const Scan & scan, const fs::path & path, const Scan & first, const fs::path & firstPath)
{
  const bool isUneven = !scan.sliceOrigins.empty();
  FailIf(isUneven || !AreSameGrids(GeometryOf(scan.image), GeometryOf(first.image)),
         FailureKind::Geometry,
         "Cannot take " + firstPath.string() + " and " + path.string() + " for one segmentation: " +
           (isUneven ? "the slices of " + path.filename().string() + " are unevenly spaced"
                     : "their voxels are not in the same places") +
           "; resample both to one grid.");
}

/** The names of a file's labels; not those of a dataset, which has one table for all masks. */
LabelTable
FindNames(const Scan & scan, const fs::path & path)
{
  const bool isInFile = !scan.labels.empty() || scan.format == "DICOM";
  return isInFile ? scan.labels : FindLabelTable(path).value_or(LabelTable());
}

std::string
WithoutPath(std::string note, const std::string & path)
{
  const std::size_t at = note.find(path);
  return at == std::string::npos ? note : note.erase(at, path.size());
}

/** Reads all files into \a scan. */
void
ReadLabelFiles(const std::vector<fs::path> & files, const ScanReadOptions & options, Scan & scan)
{
  ScanReadOptions mapOptions = options;
  LabelUnion labels(GeometryOf(scan.image), options.maximumMemory);
  std::vector<std::string> empty;
  std::map<std::string, std::vector<std::string>> notes; // by their text without the file's path
  for (std::size_t n = 0; n < files.size(); ++n)
  {
    if (options.progress)
    {
      mapOptions.progress = [&, n](double done) {
        options.progress((static_cast<double>(n) + done) / static_cast<double>(files.size()));
      };
    }
    const Scan map = ReadVoxels(OpenScan(files[n], mapOptions));
    LabelTable table = FindNames(map, files[n]);
    FailIf(table.empty() && !LooksLikeLabelMap(map),
           FailureKind::Unreadable,
           "Cannot take " + files[n].string() +
             " for a mask or label map: its values look like intensities; name the file itself if it is the "
             "scan, and put masks into a folder of their own.");
    const std::string name = StemOfVolume(files[n]);
    if (table.empty() && SummarizeLabels(map, {}).size() > 1)
    {
      table = FindDatasetTable(files[n]).value_or(LabelTable());
    }
    bool hasLabels = false;
    for (const ScanImage & layer : LayersOf(map))
    {
      hasLabels = labels.Add(layer, table, name) || hasLabels;
    }
    if (!hasLabels)
    {
      empty.push_back(SanitizeLabelName(name, 0));
    }
    for (const std::string & note : map.notes)
    {
      notes[WithoutPath(note, files[n].string())].push_back(note);
    }
  }
  scan.notes.clear();
  for (const auto & [text, all] : notes)
  {
    scan.notes.push_back(all.size() > 1 ? all.front() + " So it is with " + Count(all.size() - 1, "other file") + "."
                                        : all.front());
  }
  labels.Take(scan);
  if (!empty.empty())
  {
    scan.notes.push_back(std::to_string(empty.size()) + " of " + Count(files.size(), "mask") +
                         (empty.size() == 1 ? " holds" : " hold") + " no voxels: " + Enumerate(empty, "and") + ".");
  }
}

} // namespace

std::vector<fs::path>
FindMasks(const fs::path & folder, bool followsLinks)
{
  std::vector<fs::path> masks;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    if (IsVolume(*entry, followsLinks))
    {
      masks.push_back(entry->path());
    }
  }
  if (masks.empty())
  {
    return {};
  }
  const auto others = ListFiles(folder, followsLinks).paths;
  const bool hasDicom = std::any_of(others.begin(), others.end(), [](const fs::path & path) {
    return VolumeFormatOf(path).empty() && IsReadable(path) && ReadDicomHeader(path).has_value();
  });
  std::sort(masks.begin(), masks.end());
  return hasDicom ? std::vector<fs::path>() : masks;
}

UnreadScan
OpenLabelFiles(const std::vector<fs::path> & files, const ScanReadOptions & options)
{
  ScanReadOptions mapOptions = options;
  mapOptions.series.clear();
  mapOptions.frame.reset();
  Scan scan;
  std::set<fs::path> paths;
  bool isOriented = true;
  for (const fs::path & file : files)
  {
    const Scan header = OpenScan(file, mapOptions).scan;
    if (paths.empty())
    {
      scan = header;
    }
    CheckGrid(header, file, scan, files.front());
    paths.insert(header.files.begin(), header.files.end());
    isOriented = isOriented && header.isOriented;
  }
  const auto frame = itk::Image<std::uint16_t, 3>::New();
  frame->CopyInformation(&GeometryOf(scan.image));
  scan.image = frame;
  scan.isOriented = isOriented;
  scan.files.assign(paths.begin(), paths.end());
  scan.choice = Count(files.size(), "mask or label map", "masks and label maps") + " as one segmentation";
  return { scan, [=](Scan & read) { ReadLabelFiles(files, mapOptions, read); } };
}

} // namespace rhombic
