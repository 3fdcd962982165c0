#include "rhombicDescribeScan.h"

#include "rhombicFailure.h"
#include "rhombicLabelDoubts.h"
#include "rhombicSourceLoading.h"

#include <algorithm>

namespace rhombic
{
namespace
{

/** Suggested thresholds for a modality, which is empty when it is unknown. */
std::vector<SuggestedThreshold>
SuggestThresholds(const std::string & modality, const Intensities & intensities)
{
  std::vector<SuggestedThreshold> suggestions{ { "foreground (Otsu)", intensities.otsu } };
  constexpr double nearAir = -900.0; // raw numbers of an uncalibrated CT don't go below 0
  if ((modality == "CT" || modality.empty()) && intensities.lowest < nearAir)
  {
    for (const SuggestedThreshold & organ : { SuggestedThreshold{ "skin", -300.5 },
                                              SuggestedThreshold{ "lungs, below", -500.5 },
                                              SuggestedThreshold{ "bone", 250.5 } })
    {
      if (organ.isovalue > intensities.lowest && organ.isovalue <= intensities.highest)
      {
        suggestions.push_back(organ);
      }
    }
  }
  return suggestions;
}

void
Append(const std::vector<std::string> & notes, ScanDescription & description)
{
  description.notes.insert(description.notes.end(), notes.begin(), notes.end());
}

/** Describes the labels of the label map that was named for the scan, or of the scan if it is a label map. */
void
DescribeLabels(const Scan & scan,
               const ScanSource & source,
               const LabelMapSource & labels,
               ScanDescription & description)
{
  if (!labels.path.empty())
  {
    LabelMap map = ReadLabelMap(labels, source.read, scan, source.path);
    for (const std::string & doubt : FindLabelDoubts(scan, map))
    {
      description.notes.push_back("warning: " + doubt);
    }
    description.labels = std::move(map.labels);
    Append(map.scan.notes, description);
  }
  else if (!labels.table.empty() || IsLabelMap(scan))
  {
    description.labels = FindLabels(scan, { source.path, labels.table });
    description.thresholds.clear();
  }
}

ScanDescription
DescribeLattice(const ScanSource & source)
{
  ScanDescription description;
  const FCCVolume & volume = description.volume.emplace<FCCVolume>(ReadFCCImage(source.path));
  description.intensities = ComputeIntensities(volume);
  description.thresholds = SuggestThresholds("other", description.intensities);
  return description;
}

ScanDescription
DescribeVolume(const ScanSource & source, const LabelMapSource & labels)
{
  ScanDescription description;
  const Scan & scan = description.volume.emplace<Scan>(ReadScan(source, {}));
  description.intensities = ComputeIntensities(scan.image);
  description.thresholds = SuggestThresholds(scan.modality, description.intensities);
  description.choice = scan.choice;
  description.filesConsidered = scan.filesConsidered;
  description.filesSkipped = scan.filesSkipped;
  Append(scan.notes, description);
  DescribeLabels(scan, source, labels, description);
  Append(scan.fileNotes, description);
  return description;
}

ScanDescription
DescribeList(const SeriesList & list)
{
  ScanDescription description;
  description.filesConsidered = list.filesConsidered;
  description.filesSkipped = list.filesSkipped;
  Append(list.notes, description);
  Append(list.fileNotes, description);
  return description;
}

/** The scan, or, when it is one of several series and can't be chosen or read, their list. */
ScanDescription
DescribeSeries(const ScanSource & source, const LabelMapSource & labels)
{
  SeriesList list = ListSeries(source.path, source.read);
  const auto chosen =
    std::find_if(list.series.begin(), list.series.end(), [](const SeriesSummary & series) { return series.chosen; });
  const bool isListed = list.series.size() > 1 && source.read.series.empty() && labels.path.empty();
  std::optional<ScanDescription> description;
  try
  {
    if (!isListed || chosen != list.series.end())
    {
      description = DescribeVolume(source, labels);
    }
  }
  catch (const Failure & failure)
  {
    if (!isListed)
    {
      throw;
    }
    chosen->problem = failure.GetDescription();
    chosen->chosen = false;
  }
  if (!description)
  {
    description = DescribeList(list);
  }
  description->series = std::move(list.series);
  return std::move(*description);
}

/** Whether a scan has the values of a CT with bone. */
bool
IsCT(const Scan & scan)
{
  const std::vector<SuggestedThreshold> thresholds =
    SuggestThresholds(scan.modality, ComputeIntensities(scan.image, false));
  return thresholds.back().surface == "bone";
}

} // namespace

bool
ScanDescription::IsUnreadable() const
{
  return !this->HasVolume() && !series.empty() &&
         std::all_of(series.begin(), series.end(), [](const SeriesSummary & item) { return !item.problem.empty(); });
}

ScanDescription
DescribeScan(const ScanSource & source, const LabelMapSource & labels)
{
  if (IsFCCImageFile(source.path))
  {
    return DescribeLattice(source);
  }
  ScanSource first = source;
  first.read.onSeveralFrames = ScanReadOptions::Policy::Accept;
  return DescribeSeries(first, labels);
}

std::string
ChoosePreset(ScanSource & source, bool hasLabels, const Events & events)
{
  source.volume = std::make_shared<SourceVolume>(LoadVolume(source, events));
  const Scan * const scan = std::get_if<Scan>(source.volume.get());
  std::string preset = hasLabels ? "" : "mr-head";
  if (scan != nullptr)
  {
    preset = IsCT(*scan) ? (hasLabels ? "ct-organs" : "ct-bone-skin") : IsLabelMap(*scan) ? "" : preset;
  }
  events.Note("preset: " + (preset.empty() ? "none" : preset));
  return preset;
}

} // namespace rhombic
