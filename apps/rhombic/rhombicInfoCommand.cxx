#include "rhombicCommands.h"
#include "rhombicDescribeScan.h"
#include "rhombicFailure.h"
#include "rhombicScanOptions.h"
#include "rhombicScanReport.h"
#include "rhombicWording.h"

#include <iostream>

namespace rhombic
{
namespace
{

struct InfoOptions
{
  ScanOptions scan;
  std::vector<std::string> labels;
  std::string labelTable;
  bool isJson = false;
};

void
PrintLine(const std::string & name, const std::string & text)
{
  if (!text.empty())
  {
    std::cout << name << std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') << text << '\n';
  }
}

void
PrintGrid(const itk::ImageBase<3> & grid, bool isOriented)
{
  const auto & direction = grid.GetDirection();
  const auto & origin = grid.GetOrigin();
  PrintLine("size", FormatProduct(grid.GetLargestPossibleRegion().GetSize()) + " samples");
  PrintLine("spacing", DescribeSpacing(grid.GetSpacing()));
  PrintLine("orientation",
            (isOriented ? OrientationLetters(direction) : "unknown") + ", " + HandednessOf(direction) + "-handed");
  PrintLine("origin",
            FormatNumber(origin[0]) + ", " + FormatNumber(origin[1]) + ", " + FormatNumber(origin[2]) + " mm (LPS)");
}

void
PrintStack(const StackReport & stack, bool isEven)
{
  constexpr double smallestTilt = 0.06; // degrees
  PrintLine("tilt", stack.tiltDegrees > smallestTilt ? FormatNumber(stack.tiltDegrees) + " degrees" : "none");
  if (!isEven)
  {
    std::string blocks;
    for (const SliceBlock & block : stack.blocks)
    {
      blocks +=
        (blocks.empty() ? "" : ", ") + Count(block.numberOfSteps, "step") + " of " + FormatNumber(block.step) + " mm";
    }
    PrintLine("slices", "uneven: " + blocks);
  }
  for (const SliceGap & gap : stack.gaps)
  {
    PrintLine("gap", std::to_string(gap.numberOfMissing) + " missing behind " + FormatNumber(gap.position) + " mm");
  }
}

/** Modality, encoding, pixel type and frames. */
void
PrintEncoding(const Scan & scan)
{
  PrintLine("modality", scan.modality);
  PrintLine("encoding", scan.encoding);
  PrintLine("pixels", PixelTypeName(scan.image) + (scan.scaling.empty() ? "" : ", " + scan.scaling));
  if (scan.numberOfFrames > 1)
  {
    PrintLine("frames",
              std::to_string(scan.numberOfFrames) + ", of which this is " + std::to_string(scan.frame) +
                "; see another one with --frame N, from 0 to " + std::to_string(scan.numberOfFrames - 1));
  }
  if (scan.numberOfLevels > 1)
  {
    PrintLine("levels",
              std::to_string(scan.numberOfLevels) + ", of which this is " + std::to_string(scan.level) +
                "; see another one with --level N, from 0 to " + std::to_string(scan.numberOfLevels - 1));
  }
}

void
PrintPlacement(const Scan & scan)
{
  if (scan.stack)
  {
    PrintStack(*scan.stack, scan.sliceOrigins.empty());
  }
  if (scan.affine)
  {
    const double disagreement = scan.affine->disagreement;
    PrintLine("affine",
              scan.affine->source +
                (disagreement > 0.0 ? ", the other one is " + FormatNumber(disagreement) + " mm off" : ""));
  }
}

void
PrintValues(const ScanDescription & description)
{
  PrintLine("values",
            FormatNumber(description.intensities.lowest) + " to " + FormatNumber(description.intensities.highest));
  const auto * const scan = std::get_if<Scan>(&description.volume);
  if (scan != nullptr && scan->paddingValue)
  {
    PrintLine("padding", Count(scan->numberOfPaddingSamples, "sample") + " of " + FormatNumber(*scan->paddingValue));
  }
  for (const SuggestedThreshold & threshold : description.thresholds)
  {
    PrintLine("threshold", FormatNumber(threshold.isovalue) + "  " + threshold.surface);
  }
  for (const LabelSummary & summary : description.labels.value_or(std::vector<LabelSummary>()))
  {
    PrintLine("label " + std::to_string(summary.label.value),
              summary.label.name + ", " + ToHexadecimal(summary.label) + ", " + Count(summary.numberOfVoxels, "voxel") +
                ", " + FormatNumber(summary.millilitres) + " ml");
  }
}

void
PrintVolume(const ScanDescription & description)
{
  if (const auto * const scan = std::get_if<Scan>(&description.volume))
  {
    PrintLine("format", scan->format);
    PrintEncoding(*scan);
    PrintGrid(GeometryOf(scan->image), scan->isOriented);
    PrintPlacement(*scan);
  }
  else
  {
    PrintLine("format", "lattice volume (face-centered cubic)");
    std::visit([](const auto & image) { PrintGrid(*image, true); }, std::get<FCCVolume>(description.volume));
  }
  PrintValues(description);
}

void
PrintSeries(const ScanDescription & description)
{
  const std::string & choice = description.choice;
  for (const SeriesSummary & series : description.series)
  {
    PrintLine("series " + std::to_string(series.number),
              (series.modality.empty() ? "modality unknown" : series.modality) + ", " + FormatProduct(series.size) +
                (series.spacing[0] > 0.0 ? " of " + DescribeSpacing(series.spacing) : "") + ", " +
                Count(series.numberOfFiles, "file") + (series.kind.empty() ? "" : ", " + series.kind) +
                (series.seriesNumber.empty() ? "" : ", SeriesNumber " + series.seriesNumber) + ", id " + series.id +
                (series.chosen && !choice.empty() ? "  <- read: " + choice : ""));
    PrintLine("", series.problem.empty() ? "" : "problem: " + series.problem);
  }
  if (!description.series.empty() && choice.empty())
  {
    PrintLine("choose",
              "one with --series and its id, or its position or SeriesNumber if no other series has that number");
  }
}

void
Print(const ScanDescription & description)
{
  if (description.HasVolume())
  {
    PrintVolume(description);
  }
  else
  {
    PrintLine("format", "DICOM");
  }
  PrintSeries(description);
  for (const auto & [reason, count] : description.filesSkipped)
  {
    PrintLine("skipped", std::to_string(count) + " " + reason);
  }
  for (const std::string & note : description.notes)
  {
    PrintLine("note", note);
  }
}

void
Info(const InfoOptions & options)
{
  const ScanSource source = options.scan.GetSource();
  const ScanDescription description =
    DescribeScan(source, { { options.labels.begin(), options.labels.end() }, options.labelTable });
  if (options.isJson)
  {
    std::cout << ToJson(ReportDescription(description)) << '\n';
  }
  else
  {
    Print(description);
  }
  if (description.IsUnreadable())
  {
    throw Failure(FailureKind::Unreadable,
                  "None of the series in " + source.path.string() + " can be read; see their problems above.");
  }
}

} // namespace

CommandRun
AddInfoCommand(CommandSettings & command)
{
  static const SettingsTable<InfoOptions> table{
    { "--labels",
      &InfoOptions::labels,
      "a label map of the scan: NIfTI, NRRD, MetaImage or DICOM SEG, or a folder of masks; repeatable",
      OfKind(SettingKind::Source) },
    { "--label-table",
      &InfoOptions::labelTable,
      "names and colours of labels (ITK-SNAP, Slicer, FreeSurfer, BIDS, nnU-Net, CSV; default: in or beside the map)",
      OfKind(SettingKind::InputFile) },
    { "--json", &InfoOptions::isJson, "as JSON, on standard output" },
  };
  const auto options = std::make_shared<InfoOptions>();
  command.Add(ScanOptions::SourceTable(), options->scan);
  command.Add(table, *options);
  return WithoutOutputs([options](const CommandContext &) { Info(*options); });
}

} // namespace rhombic
