#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicLabelMapReader.h"
#include "rhombicScanOptions.h"
#include "rhombicScanReport.h"
#include "rhombicWording.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace rhombic
{
namespace
{

struct InfoOptions
{
  ScanOptions scan;
  std::string labels;
  std::string labelTable;
  bool isJson = false;
};

/** Numbers with six digits, lists as products. */
std::string
ToText(const Report & value)
{
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  if (value.is_number_float())
  {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << value.get<double>();
    return text.str();
  }
  if (!value.is_array())
  {
    return value.dump();
  }
  std::string text;
  for (const Report & item : value)
  {
    text += (text.empty() ? "" : " x ") + ToText(item);
  }
  return text;
}

void
PrintLine(const std::string & name, const std::string & text)
{
  if (!text.empty())
  {
    std::cout << name << std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') << text << '\n';
  }
}

std::string
CountOf(const Report & number, const std::string & noun)
{
  return Count(number.get<std::uintmax_t>(), noun);
}

void
PrintStack(const Report & stack)
{
  const bool isTilted = stack["tiltDegrees"].get<double>() > 0.06;
  PrintLine("tilt", isTilted ? ToText(stack["tiltDegrees"]) + " degrees" : "none");
  if (!stack["isEven"].get<bool>())
  {
    std::string blocks;
    for (const Report & block : stack["blocks"])
    {
      blocks += (blocks.empty() ? "" : ", ") + CountOf(block["steps"], "step") + " of " + ToText(block["step"]) + " mm";
    }
    PrintLine("slices", "uneven: " + blocks);
  }
  for (const Report & gap : stack["gaps"])
  {
    PrintLine("gap", gap["missingSlices"].dump() + " missing behind " + ToText(gap["position"]) + " mm");
  }
}

void
PrintSeries(const Report & report)
{
  const std::string choice = ToText(report["choice"]);
  for (const Report & series : report["series"])
  {
    const std::string modality = ToText(series["modality"]);
    const std::string kind = ToText(series["kind"]);
    const std::string number = ToText(series["seriesNumber"]);
    PrintLine("series " + series["number"].dump(),
              (modality.empty() ? "modality unknown" : modality) + ", " + ToText(series["size"]) +
                (series.contains("spacing") ? " of " + ToText(series["spacing"]) + " mm" : "") + ", " +
                CountOf(series["files"], "file") + (kind.empty() ? "" : ", " + kind) +
                (number.empty() ? "" : ", SeriesNumber " + number) + ", id " + ToText(series["id"]) +
                (series["chosen"].get<bool>() && !choice.empty() ? "  <- read: " + choice : ""));
    const std::string problem = ToText(series["problem"]);
    PrintLine("", problem.empty() ? "" : "problem: " + problem);
  }
  if (choice.empty())
  {
    PrintLine("choose",
              "one with --series and its id; its place or SeriesNumber will do, too, where no other has that number");
  }
}

void
PrintLabels(const Report & labels)
{
  for (const Report & label : labels)
  {
    PrintLine("label " + label["value"].dump(),
              ToText(label["name"]) + ", " + ToText(label["colour"]) + ", " + CountOf(label["voxels"], "voxel") + ", " +
                ToText(label["millilitres"]) + " ml");
  }
}

/** What is known once the voxels are read. */
void
PrintVolume(const Report & report)
{
  const auto text = [&report](const char * key) { return report.contains(key) ? ToText(report[key]) : ""; };
  PrintLine("modality", text("modality"));
  PrintLine("encoding", text("encoding"));
  PrintLine("pixels", text("pixelType") + (text("scaling").empty() ? "" : ", " + text("scaling")));
  if (report.contains("frames"))
  {
    PrintLine("frames",
              text("frames") + ", of which this is " + text("frame") + "; see another one with --frame N, from 0 to " +
                std::to_string(report["frames"].get<std::size_t>() - 1));
  }
  PrintLine("size", text("size") + " samples");
  PrintLine("spacing", text("spacing") + " mm");
  PrintLine("orientation", text("orientation") + ", " + text("handedness") + "-handed");
  const Report & origin = report["origin"];
  PrintLine("origin", ToText(origin[0]) + ", " + ToText(origin[1]) + ", " + ToText(origin[2]) + " mm (LPS)");
  if (report.contains("stack"))
  {
    PrintStack(report["stack"]);
  }
  if (report.contains("affine"))
  {
    PrintLine("affine",
              ToText(report["affine"]["source"]) +
                (report["affine"]["disagreement"].get<double>() > 0
                   ? ", the other one is " + ToText(report["affine"]["disagreement"]) + " mm off"
                   : ""));
  }
  PrintLine("values", ToText(report["range"][0]) + " to " + ToText(report["range"][1]));
  if (report.contains("padding"))
  {
    PrintLine("padding", CountOf(report["padding"]["samples"], "sample") + " of " + ToText(report["padding"]["value"]));
  }
  for (const Report & suggestion : report.value("suggestedThresholds", Report::array()))
  {
    PrintLine("threshold", ToText(suggestion["isovalue"]) + "  " + ToText(suggestion["surface"]));
  }
  PrintLabels(report.value("labels", Report::array()));
}

void
Print(const Report & report)
{
  PrintLine("format", ToText(report["format"]));
  if (report.contains("size"))
  {
    PrintVolume(report);
  }
  if (report.contains("series") && !report["series"].empty())
  {
    PrintSeries(report);
  }
  if (report.contains("filesSkipped"))
  {
    for (const auto & [reason, count] : report["filesSkipped"].items())
    {
      PrintLine("skipped", count.dump() + " " + reason);
    }
  }
  if (report.contains("notes"))
  {
    for (const Report & note : report["notes"])
    {
      PrintLine("note", ToText(note));
    }
  }
}

void
AddNotes(const std::vector<std::string> & notes, Report & report)
{
  for (const std::string & note : notes)
  {
    report["notes"].push_back(note);
  }
}

/** The labels of the scan if it is a label map, and those of the label map that was named for it. */
void
AddLabels(const Scan & scan, const ScanSource & source, const InfoOptions & options, Report & report)
{
  if (!options.labels.empty())
  {
    const LabelMap map = ReadLabelMap({ options.labels, options.labelTable }, source.read, scan, source.path);
    report["labels"] = ReportLabels(map.labels);
    AddNotes(map.scan.notes, report);
  }
  else if (!options.labelTable.empty() || IsLabelMap(scan))
  {
    report["labels"] = ReportLabels(FindLabels(scan, { source.path, options.labelTable }));
    report.erase("suggestedThresholds");
  }
}

Report
DescribeLattice(const ScanSource & source)
{
  const FCCVolume volume = ReadFCCImage(source.path);
  Report report = ReportLattice(volume);
  report.update(ReportIntensities(volume));
  return report;
}

Report
DescribeScan(const ScanSource & source, const InfoOptions & options)
{
  const Scan scan = ReadScan(source.path, source.read);
  Report report = ReportScan(scan);
  report.update(ReportIntensities(scan));
  AddLabels(scan, source, options, report);
  AddNotes(scan.fileNotes, report);
  return report;
}

/** The scan, or, when it is one of several series and none is named, these alone if it can't be chosen or read. */
Report
Describe(const ScanSource & source, const InfoOptions & options)
{
  SeriesList list = ListSeries(source.path, source.read);
  const auto chosen =
    std::find_if(list.series.begin(), list.series.end(), [](const SeriesSummary & series) { return series.chosen; });
  const bool isListed = list.series.size() > 1 && source.read.series.empty() && options.labels.empty();
  const bool isRead = !isListed || chosen != list.series.end();
  Report report;
  try
  {
    report = isRead ? DescribeScan(source, options) : Report();
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
  const Report listed = ReportSeriesList(list);
  if (report.is_null())
  {
    report = listed;
    AddNotes(list.fileNotes, report);
  }
  report["series"] = listed["series"];
  return report;
}

/** Whether there are series, and none of them can be read. */
bool
IsUnreadable(const Report & report)
{
  const Report series = report.value("series", Report::array());
  return !series.empty() && !report.contains("size") &&
         std::all_of(
           series.begin(), series.end(), [](const Report & item) { return !ToText(item["problem"]).empty(); });
}

void
Info(const InfoOptions & options, const CommandContext & context)
{
  ScanSource source = options.scan.GetSource(context);
  source.read.onSeveralFrames = ScanReadOptions::Policy::Accept;
  const Report report = IsFCCImageFile(source.path) ? DescribeLattice(source) : Describe(source, options);
  if (options.isJson)
  {
    std::cout << ToJson(report) << '\n';
  }
  else
  {
    Print(report);
  }
  if (IsUnreadable(report))
  {
    throw Failure(FailureKind::Unreadable,
                  "None of the series in " + source.path.string() + " can be read; see their problems above.");
  }
}

} // namespace

CommandRun
AddInfoCommand(CLI::App & parser)
{
  const auto options = std::make_shared<InfoOptions>();
  options->scan.AddSource(parser);
  parser.add_option("--labels", options->labels, "a label map of the scan: NIfTI, NRRD, MetaImage or DICOM SEG");
  parser.add_option("--label-table",
                    options->labelTable,
                    "names and colours of labels (ITK-SNAP, Slicer, FreeSurfer, BIDS; default: in or beside the map)");
  parser.add_flag("--json", options->isJson, "as JSON, on standard output");
  return [options](const CommandContext & context) { Info(*options, context); };
}

} // namespace rhombic
