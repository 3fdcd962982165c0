#include "rhombicDescribeScan.h"

#include "rhombicScanReader.h"
#include "rhombicFailure.h"
#include "rhombicLabelDoubts.h"
#include "rhombicOptionNames.h"
#include "rhombicWording.h"

#include <algorithm>

namespace rhombic
{
namespace
{

// Isovalues of CTs in HU. Raw numbers of an uncalibrated CT don't go below 0.
constexpr double NearAir = -900.0;
constexpr double Skin = -300.5;
constexpr double Bone = 250.5;

/** Suggested thresholds for a modality, which is empty when it is unknown. */
std::vector<SuggestedThreshold>
SuggestThresholds(const std::string & modality, const Intensities & intensities)
{
  std::vector<SuggestedThreshold> suggestions{ { "foreground (Otsu)", intensities.otsu } };
  if ((modality == "CT" || modality.empty()) && intensities.lowest < NearAir)
  {
    for (const SuggestedThreshold & organ :
         { SuggestedThreshold{ "skin", Skin }, { "lungs, below", -500.5 }, { "bone", Bone } })
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
  if (!labels.paths.empty())
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
    description.labels = FindLabels(scan, { { source.path }, labels.table });
    description.thresholds.clear();
  }
}

ScanDescription
DescribeSourceVolume(const ScanSource & source, const LabelMapSource & labels)
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

/** The scan, or, when it is one of several series and can't be chosen or read, their list. */
ScanDescription
DescribeSeries(const ScanSource & source, const LabelMapSource & labels)
{
  SeriesList list = ListSeries(source.path, source.read);
  for (SeriesSummary & series : list.series)
  {
    series.problem = NameOptions(series.problem);
  }
  const auto chosen =
    std::find_if(list.series.begin(), list.series.end(), [](const SeriesSummary & series) { return series.chosen; });
  const bool isListed = list.series.size() > 1 && source.read.series.empty() && labels.paths.empty();
  std::optional<ScanDescription> description;
  try
  {
    if (!isListed || chosen != list.series.end())
    {
      description = DescribeSourceVolume(source, labels);
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
    description.emplace();
    description->filesConsidered = list.filesConsidered;
    description->filesSkipped = list.filesSkipped;
    Append(list.notes, *description);
    Append(list.fileNotes, *description);
  }
  description->series = std::move(list.series);
  return std::move(*description);
}

/** The choice for a CT, or a scan of unknown modality. */
PresetChoice
ChooseForCT(const Scan & scan, const Intensities & intensities)
{
  constexpr double belowFat = -200.0; // CTs of the inside of a body have no air
  const bool isNamed = scan.modality == "CT";
  const bool hasAir = intensities.lowest < NearAir;
  const bool hasSkin = hasAir && intensities.highest >= Skin;
  const bool hasBone = intensities.highest >= Bone;
  const std::string range = FormatNumber(intensities.lowest) + " to " + FormatNumber(intensities.highest);
  if (isNamed && intensities.lowest >= belowFat)
  {
    return { "uncalibrated-ct",
             "the scan is a CT whose values (" + range + ") are not taken for HU: there is neither air nor fat" };
  }
  if (!isNamed && !(hasAir && hasBone))
  {
    return { "outline", "the scan does not say what it is" };
  }
  const std::string kind = isNamed ? "the scan is a CT in HU" : "the scan's values (" + range + ") are those of a CT";
  return hasAir && hasBone ? PresetChoice{ "ct-bone-skin", kind }
         : hasSkin         ? PresetChoice{ "ct-skin", kind + " without values of bone" }
         : hasBone         ? PresetChoice{ "ct-bone", kind + " without air" }
                           : PresetChoice{ "outline", kind + " without values of both sides of skin or bone" };
}

/** The choice for a scan that is no label map. */
PresetChoice
ChooseForScan(const Scan & scan, bool hasLabels)
{
  const std::string & modality = scan.modality;
  const DicomExamination examination = ReadDicomExamination(scan);
  PresetChoice choice{ "outline", "the scan is of modality " + modality };
  if (modality.empty() || modality == "CT")
  {
    choice = ChooseForCT(scan, ComputeIntensities(scan.image, false));
  }
  else if (modality == "PT")
  {
    const bool isActivity = examination.units == "Bq/ml";
    choice = { "pet-hot-spots",
               "the scan is a PET" + (examination.units.empty() ? "" : " in " + examination.units) +
                 (isActivity ? " (not turned into SUV)" : "") + "; thresholds follow from its values" };
  }
  else if (modality == "MR")
  {
    const std::string & part = examination.bodyPart;
    const bool isHead = part == "HEAD" || part == "BRAIN" || part == "SKULL";
    choice = { isHead ? "mr-head" : "mr-outline",
               "the scan is an MR" + (part.empty() ? " that names no body part" : " of body part " + part) };
  }
  if (hasLabels)
  {
    const bool hasSkin = choice.preset == "ct-bone-skin" || choice.preset == "ct-skin";
    return { hasSkin ? "ct-organs" : "", choice.reason + ", with labels" };
  }
  return choice;
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
    ScanDescription description;
    const FCCVolume & volume = description.volume.emplace<FCCVolume>(ReadFCCImage(source.path));
    description.intensities = ComputeIntensities(volume);
    description.thresholds = SuggestThresholds("other", description.intensities);
    return description;
  }
  ScanSource first = source;
  first.read.onSeveralFrames = ScanReadOptions::Policy::Accept;
  return DescribeSeries(first, labels);
}

PresetChoice
ChoosePreset(const SourceVolume & volume, bool hasLabels)
{
  const Scan * const scan = std::get_if<Scan>(&volume);
  if (scan == nullptr)
  {
    return { "outline", "the source is a lattice volume, which does not say what it is of" };
  }
  return IsLabelMap(*scan) ? PresetChoice{ "", "the scan is a label map" } : ChooseForScan(*scan, hasLabels);
}

} // namespace rhombic
