#include "rhombicCommands.h"
#include "rhombicLabelPipeline.h"
#include "rhombicScanOptions.h"
#include "rhombicScanReport.h"

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
      blocks += (blocks.empty() ? "" : ", ") + block["steps"].dump() +
                (block["steps"] == 1 ? " step of " : " steps of ") + ToText(block["step"]) + " mm";
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
  for (const Report & series : report["series"])
  {
    const std::string kind = ToText(series["kind"]);
    const std::string problem = ToText(series["problem"]);
    PrintLine("series " + series["number"].dump(),
              ToText(series["modality"]) + " " + ToText(series["size"]) + ", " + series["files"].dump() + " files" +
                (kind.empty() ? "" : ", " + kind) + ", id " + ToText(series["id"]) +
                (problem.empty() ? "" : ": " + problem) +
                (series["chosen"].get<bool>() ? "  <- read: " + ToText(report["choice"]) : ""));
  }
}

void
PrintLabels(const Report & labels)
{
  for (const Report & label : labels)
  {
    PrintLine("label " + label["value"].dump(),
              ToText(label["name"]) + ", " + ToText(label["colour"]) + ", " + label["voxels"].dump() + " voxels, " +
                ToText(label["millilitres"]) + " ml");
  }
}

void
Print(const Report & report)
{
  const auto text = [&report](const char * key) { return report.contains(key) ? ToText(report[key]) : ""; };
  PrintLine("format", text("format"));
  PrintLine("modality", text("modality"));
  PrintLine("encoding", text("encoding"));
  PrintLine("pixels", text("pixelType") + (text("scaling").empty() ? "" : ", " + text("scaling")));
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
    PrintLine("padding", report["padding"]["samples"].dump() + " samples of " + ToText(report["padding"]["value"]));
  }
  for (const Report & suggestion : report.value("suggestedThresholds", Report::array()))
  {
    PrintLine("threshold", ToText(suggestion["isovalue"]) + "  " + ToText(suggestion["surface"]));
  }
  PrintLabels(report.value("labels", Report::array()));
  if (report.contains("series"))
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

/** The labels of the scan if it is a label map, and those of the label map that was named for it. */
void
AddLabels(const Scan & scan, const ScanSource & source, const InfoOptions & options, Report & report)
{
  if (!options.labels.empty())
  {
    const LabelMap map = ReadLabelMap({ options.labels, options.labelTable }, source.read, scan, source.path);
    report["labels"] = ReportLabels(map.labels);
    for (const std::string & note : map.scan.notes)
    {
      report["notes"].push_back(note);
    }
  }
  else if (!options.labelTable.empty() || !scan.labels.empty() || LooksLikeLabelMap(scan))
  {
    report["labels"] = ReportLabels(FindLabels(scan, { source.path, options.labelTable }));
    report.erase("suggestedThresholds");
  }
}

void
Info(const InfoOptions & options, const CommandContext & context)
{
  const ScanSource source = options.scan.GetSource(context);
  Report report;
  if (IsFCCImageFile(source.path))
  {
    const FCCVolume volume = ReadFCCImage(source.path);
    report = ReportLattice(volume);
    report.update(ReportIntensities(volume));
  }
  else
  {
    const Scan scan = ReadScan(source.path, source.read);
    report = ReportScan(scan);
    report.update(ReportIntensities(scan));
    AddLabels(scan, source, options, report);
    for (const std::string & note : scan.fileNotes)
    {
      report["notes"].push_back(note);
    }
  }
  if (options.isJson)
  {
    std::cout << ToJson(report) << '\n';
  }
  else
  {
    Print(report);
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
