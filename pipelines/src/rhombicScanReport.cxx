#include "rhombicScanReport.h"

#include "rhombicFiles.h"
#include "rhombicWording.h"

#include "vnl/vnl_det.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace rhombic
{
namespace
{

Report
ToArray(const double * numbers)
{
  return { numbers[0], numbers[1], numbers[2] };
}

void
ReportGrid(const itk::ImageBase<3> & grid, bool isOriented, Report & report)
{
  const auto & size = grid.GetLargestPossibleRegion().GetSize();
  const auto & direction = grid.GetDirection();
  report["size"] = { size[0], size[1], size[2] };
  report["spacing"] = ToArray(grid.GetSpacing().GetDataPointer());
  report["origin"] = ToArray(grid.GetOrigin().GetDataPointer());
  for (unsigned int row = 0; row < 3; ++row)
  {
    report["direction"].push_back({ direction[row][0], direction[row][1], direction[row][2] });
  }
  report["orientation"] = isOriented ? OrientationLetters(direction) : "unknown";
  report["handedness"] = HandednessOf(direction);
}

Report
ReportStack(const StackReport & stack)
{
  Report report{ { "tiltDegrees", stack.tiltDegrees },
                 { "firstPosition", stack.firstPosition },
                 { "lastPosition", stack.lastPosition },
                 { "blocks", Report::array() } };
  for (const SliceBlock & block : stack.blocks)
  {
    report["blocks"].push_back({ { "steps", block.numberOfSteps }, { "step", block.step } });
  }
  report["gaps"] = Report::array();
  for (const SliceGap & gap : stack.gaps)
  {
    report["gaps"].push_back(
      { { "position", gap.position }, { "step", gap.step }, { "missingSlices", gap.numberOfMissing } });
  }
  return report;
}

Report
ReportSeries(const std::vector<SeriesSummary> & all)
{
  Report report = Report::array();
  for (const SeriesSummary & series : all)
  {
    report.push_back({ { "number", series.number },
                       { "id", series.id },
                       { "seriesNumber", series.seriesNumber },
                       { "modality", series.modality },
                       { "kind", series.kind },
                       { "files", series.numberOfFiles },
                       { "size", series.size } });
    if (series.spacing[0] > 0.0)
    {
      report.back()["spacing"] = series.spacing;
    }
    report.back()["problem"] = series.problem;
    report.back()["chosen"] = series.chosen;
  }
  return report;
}

/** The series and files of a scan or a description, and notes. */
template <typename TDescription>
void
ReportFolder(const TDescription & description, Report & report)
{
  report["series"] = ReportSeries(description.series);
  report["choice"] = description.choice;
  report["filesConsidered"] = description.filesConsidered;
  report["filesSkipped"] = description.filesSkipped.empty() ? Report::object() : Report(description.filesSkipped);
  report["notes"] = description.notes;
}

/** Format, geometry, series, assumptions and repairs of the reader. */
Report
ReportScan(const Scan & scan)
{
  Report report{ { "format", scan.format },
                 { "modality", scan.modality },
                 { "encoding", scan.encoding },
                 { "pixelType", PixelTypeName(scan.image) },
                 { "scaling", scan.scaling } };
  ReportGrid(GeometryOf(scan.image), scan.isOriented, report);
  if (scan.stack)
  {
    report["stack"] = ReportStack(*scan.stack);
    report["stack"]["isEven"] = scan.sliceOrigins.empty();
  }
  if (scan.affine)
  {
    report["affine"] = { { "source", scan.affine->source }, { "disagreement", scan.affine->disagreement } };
  }
  if (scan.paddingValue)
  {
    report["padding"] = { { "value", *scan.paddingValue }, { "samples", scan.numberOfPaddingSamples } };
  }
  if (scan.numberOfFrames > 1)
  {
    report["frames"] = scan.numberOfFrames;
    report["frame"] = scan.frame;
  }
  if (scan.numberOfLevels > 1)
  {
    report["levels"] = scan.numberOfLevels;
    report["level"] = scan.level;
  }
  ReportFolder(scan, report);
  return report;
}

/** For each label: value, name, colour (`#rrggbb`), voxels and ml. */
Report
ReportLabels(const std::vector<LabelSummary> & labels)
{
  Report report = Report::array();
  for (const LabelSummary & summary : labels)
  {
    report.push_back({ { "value", summary.label.value },
                       { "name", summary.label.name },
                       { "colour", ToHexadecimal(summary.label) },
                       { "voxels", summary.numberOfVoxels },
                       { "millilitres", summary.millilitres } });
  }
  return report;
}

} // namespace

std::string
OrientationLetters(const itk::ImageBase<3>::DirectionType & direction)
{
  constexpr char letters[3][2] = { { 'L', 'R' }, { 'P', 'A' }, { 'S', 'I' } };
  std::string text;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    unsigned int nearest = 0;
    for (unsigned int row = 1; row < 3; ++row)
    {
      nearest = std::abs(direction[row][axis]) > std::abs(direction[nearest][axis]) ? row : nearest;
    }
    text += letters[nearest][direction[nearest][axis] < 0.0 ? 1 : 0];
  }
  return text;
}

Report
ReportWithoutNames(const Scan & scan, const std::filesystem::path & path)
{
  Report report = ReportScan(scan);
  for (Report & note : report["notes"])
  {
    auto text = note.get<std::string>();
    constexpr std::size_t fewestLetters = 3;
    for (const std::string & name : { path.string(), path.filename().string(), path.stem().string() })
    {
      const bool mayBeWord = name.size() < fewestLetters && name == LowerCase(name); // as "a", unlike initials
      mayBeWord ? void() : ReplaceWords(text, name, "SCAN");
    }
    note = text;
  }
  return report;
}

Report
ReportFiles(const std::vector<std::filesystem::path> & files)
{
  return { { "files", files.size() }, { "md5", HashFiles(files) } };
}

Report
ReportLattice(const FCCVolume & volume)
{
  Report report;
  report["format"] = "lattice volume (face-centered cubic)";
  std::visit([&report](const auto & image) { ReportGrid(*image, true, report); }, volume);
  return report;
}

Report
ReportDenoising(const Denoising & denoising)
{
  switch (denoising.kind)
  {
    case Denoising::Kind::Gaussian:
      return { { "kind", "gaussian" }, { "sigma", denoising.sigma } };
    case Denoising::Kind::EdgePreserving:
      return { { "kind", "edges" }, { "sigma", denoising.sigma }, { "edge", denoising.edge } };
    default:
      return { { "kind", "none" } };
  }
}

Report
ReportTableRemoval(const TableRemoval & removal)
{
  Report report;
  for (const auto & [key, objects] : { std::pair("objects", &removal.objects), std::pair("kept", &removal.kept) })
  {
    report[key] = Report::array();
    for (const ScanObject & object : *objects)
    {
      report[key].push_back({ { "millilitres", object.millilitres },
                              { "centroid", ToArray(object.centroid.GetDataPointer()) },
                              { "lowest", ToArray(object.lowest.GetDataPointer()) },
                              { "highest", ToArray(object.highest.GetDataPointer()) } });
    }
  }
  report["specks"] = { { "count", removal.numberOfSpecks }, { "millilitres", removal.millilitresOfSpecks } };
  report["airValue"] = removal.airValue;
  report["notes"] = removal.notes;
  return report;
}

Report
ReportDescription(const ScanDescription & description)
{
  Report report;
  if (!description.HasVolume()) // nothing could be read: the series alone
  {
    report["format"] = "DICOM";
    ReportFolder(description, report);
    return report;
  }
  if (const auto * const scan = std::get_if<Scan>(&description.volume))
  {
    report = ReportScan(*scan);
    report["series"] = ReportSeries(description.series);
    report["notes"] = description.notes;
  }
  else
  {
    report = ReportLattice(std::get<FCCVolume>(description.volume));
  }
  report["range"] = { description.intensities.lowest, description.intensities.highest };
  for (const SuggestedThreshold & threshold : description.thresholds)
  {
    report["suggestedThresholds"].push_back({ { "surface", threshold.surface }, { "isovalue", threshold.isovalue } });
  }
  if (description.labels)
  {
    report["labels"] = ReportLabels(*description.labels);
  }
  return report;
}

std::string
ToJson(const Report & report)
{
  return report.dump(2, ' ', false, Report::error_handler_t::replace);
}

std::string
HandednessOf(const itk::ImageBase<3>::DirectionType & direction)
{
  return vnl_det(direction.GetVnlMatrix()) > 0 ? "right" : "left";
}

std::string
ToHexadecimal(const Label & label)
{
  char text[8];
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", label.colour[0], label.colour[1], label.colour[2]);
  return text;
}

} // namespace rhombic
