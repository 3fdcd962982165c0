#include "rhombicLabelMapReader.h"

#include "rhombicAnatomicalColours.h"
#include "rhombicFailure.h"
#include "rhombicLabelFiles.h"
#include "rhombicProbabilities.h"
#include "rhombicVolumeFile.h"

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The table that was named, or that in or beside the label map. */
LabelTable
FindTable(const Scan & scan, const LabelMapSource & source)
{
  if (!source.table.empty())
  {
    if (source.paths.size() > 1 || (scan.format != "DICOM" && fs::is_directory(source.GetFirstPath())))
    {
      throw Failure(FailureKind::Usage,
                    "The label table " + source.table.string() +
                      " can't name the labels of several files, which are called as their files and numbered in their "
                      "order; leave it out, or make one label map of them.");
    }
    return ReadLabelTable(source.table);
  }
  if (!scan.labels.empty() || scan.format == "DICOM" || source.paths.size() != 1)
  {
    return scan.labels;
  }
  return FindLabelTable(source.paths.front()).value_or(LabelTable());
}

/** Calls the label of a mask as its file. */
void
NameMask(const fs::path & path, std::vector<LabelSummary> & labels)
{
  Label & label = labels.front().label;
  label.name = SanitizeLabelName(StemOfVolume(path), label.value);
  label.colour = AnatomicalColour(label.name, label.value);
}

/** The label map, or all of them as one. */
UnreadScan
OpenLabels(const std::vector<fs::path> & paths, const ScanReadOptions & options)
{
  if (paths.size() == 1)
  {
    return OpenScan(paths.front(), options);
  }
  std::vector<fs::path> files;
  for (const fs::path & path : paths)
  {
    const std::vector<fs::path> masks =
      fs::is_directory(path) ? FindMasks(path, options.followsLinks) : std::vector<fs::path>();
    files.insert(files.end(), masks.begin(), masks.end());
    if (masks.empty())
    {
      files.push_back(path);
    }
  }
  return OpenLabelFiles(files, options);
}

} // namespace

bool
IsLabelMap(const Scan & scan)
{
  return !scan.labels.empty() || LooksLikeLabelMap(scan);
}

std::vector<LabelSummary>
FindLabels(const Scan & scan, const LabelMapSource & source)
{
  LabelTable table = FindTable(scan, source);
  if (!table.empty())
  {
    return SummarizeLabels(scan, table);
  }
  if (!LooksLikeLabelMap(scan))
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot take " + source.GetFirstPath().string() +
                    " for a label map: its values look like intensities; if it is one, give a --label-table.");
  }
  const bool isFile = source.paths.size() == 1 && IsVolumeFileName(source.paths.front());
  table = isFile ? FindDatasetTable(source.paths.front()).value_or(LabelTable()) : table;
  std::vector<LabelSummary> labels = SummarizeLabels(scan, table);
  if (isFile && source.namesMask && table.empty() && IsMask(labels))
  {
    NameMask(source.paths.front(), labels);
  }
  return labels;
}

LabelMap
ReadLabelMap(const LabelMapSource & source,
             const ScanReadOptions & options,
             const Scan & scan,
             const std::filesystem::path & scanPath)
{
  ScanReadOptions mapOptions = options;
  mapOptions.series.clear(); // chosen for the scan, not for the map
  mapOptions.frame.reset();
  LabelMap map;
  if (source.probabilities.empty())
  {
    map.scan = ReadVoxels(OpenLabels(source.paths, mapOptions));
    map.labels = FindLabels(map.scan, source);
  }
  else
  {
    map = ReadProbabilities(source, mapOptions);
  }
  if (const std::string note = RequireOverlap(scan, map.scan, scanPath, source.GetFirstPath()); !note.empty())
  {
    map.scan.notes.push_back(note);
  }
  return map;
}

} // namespace rhombic
