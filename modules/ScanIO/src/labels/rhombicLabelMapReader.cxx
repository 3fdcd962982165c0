#include "rhombicLabelMapReader.h"

#include "rhombicFailure.h"
#include "rhombicProbabilities.h"

namespace rhombic
{
namespace
{

LabelTable
FindTable(const Scan & scan, const LabelMapSource & source)
{
  if (!source.table.empty())
  {
    return ReadLabelTable(source.table);
  }
  if (!scan.labels.empty() || scan.format == "DICOM")
  {
    return scan.labels;
  }
  return FindLabelTable(source.path).value_or(LabelTable());
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
  const LabelTable table = FindTable(scan, source);
  if (table.empty() && !LooksLikeLabelMap(scan))
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot take " + source.path.string() +
                    " for a label map: its values look like intensities; if it is one, give a --label-table.");
  }
  return SummarizeLabels(scan, table);
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
    map.scan = ReadVoxels(OpenScan(source.path, mapOptions));
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
