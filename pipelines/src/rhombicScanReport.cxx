#include "rhombicScanReport.h"

#include "rhombicIntensities.h"

#include "vnl/vnl_det.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace rhombic
{
namespace
{

/** A threshold worth trying, and what it shows. */
struct Suggestion
{
  const char * surface;
  double isovalue;
};

std::vector<Suggestion>
Suggest(const std::string & modality, const Intensities & intensities)
{
  std::vector<Suggestion> suggestions{ { "foreground (Otsu)", intensities.otsu } };
  constexpr double nearAir = -900.0; // raw numbers of an uncalibrated CT don't go below 0
  if ((modality == "CT" || modality.empty()) && intensities.lowest < nearAir)
  {
    for (const Suggestion & organ :
         { Suggestion{ "skin", -300.5 }, Suggestion{ "lungs, below", -500.5 }, Suggestion{ "bone", 250.5 } })
    {
      if (organ.isovalue > intensities.lowest && organ.isovalue <= intensities.highest)
      {
        suggestions.push_back(organ);
      }
    }
  }
  return suggestions;
}

Report
ReportRange(const std::string & modality, const Intensities & intensities)
{
  Report report;
  report["range"] = { intensities.lowest, intensities.highest };
  for (const Suggestion & suggestion : Suggest(modality, intensities))
  {
    report["suggestedThresholds"].push_back({ { "surface", suggestion.surface }, { "isovalue", suggestion.isovalue } });
  }
  return report;
}

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
  report["handedness"] = vnl_det(direction.GetVnlMatrix()) > 0 ? "right" : "left";
}

Report
ReportStack(const StackReport & stack)
{
  Report report;
  report["tiltDegrees"] = stack.tiltDegrees;
  report["firstPosition"] = stack.firstPosition;
  report["lastPosition"] = stack.lastPosition;
  report["blocks"] = Report::array();
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
ReportSeries(const SeriesSummary & series)
{
  Report report;
  report["number"] = series.number;
  report["id"] = series.id;
  report["seriesNumber"] = series.seriesNumber;
  report["modality"] = series.modality;
  report["kind"] = series.kind;
  report["files"] = series.numberOfFiles;
  report["size"] = series.size;
  if (series.spacing[0] > 0.0)
  {
    report["spacing"] = series.spacing;
  }
  report["problem"] = series.problem;
  report["chosen"] = series.chosen;
  return report;
}

/** For a Scan or a SeriesList: the series in its folder, and the files that are none. */
template <typename TFolder>
void
ReportFolder(const TFolder & folder, const std::string & choice, Report & report)
{
  report["series"] = Report::array();
  for (const SeriesSummary & series : folder.series)
  {
    report["series"].push_back(ReportSeries(series));
  }
  report["choice"] = choice;
  report["filesConsidered"] = folder.filesConsidered;
  report["filesSkipped"] = folder.filesSkipped.empty() ? Report::object() : Report(folder.filesSkipped);
  report["notes"] = folder.notes;
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
ReportScan(const Scan & scan)
{
  Report report;
  report["format"] = scan.format;
  report["modality"] = scan.modality;
  report["encoding"] = scan.encoding;
  report["pixelType"] = PixelTypeName(scan.image);
  report["scaling"] = scan.scaling;
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
  ReportFolder(scan, scan.choice, report);
  return report;
}

Report
ReportSeriesList(const SeriesList & list)
{
  Report report;
  report["format"] = "DICOM";
  ReportFolder(list, "", report);
  return report;
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
ReportIntensities(const Scan & scan)
{
  return ReportRange(scan.modality, ComputeIntensities(scan.image));
}

Report
ReportIntensities(const FCCVolume & volume)
{
  return ReportRange("other", ComputeIntensities(volume));
}

Report
ReportTableRemoval(const TableRemoval & removal)
{
  Report report;
  report["objects"] = Report::array();
  for (const RemovedObject & object : removal.objects)
  {
    report["objects"].push_back({ { "millilitres", object.millilitres },
                                  { "centroid", ToArray(object.centroid.GetDataPointer()) },
                                  { "lowest", ToArray(object.lowest.GetDataPointer()) },
                                  { "highest", ToArray(object.highest.GetDataPointer()) } });
  }
  report["specks"] = { { "count", removal.numberOfSpecks }, { "millilitres", removal.millilitresOfSpecks } };
  report["airValue"] = removal.airValue;
  report["notes"] = removal.notes;
  return report;
}

Report
ReportLabels(const std::vector<LabelSummary> & labels)
{
  Report report = Report::array();
  for (const LabelSummary & summary : labels)
  {
    char colour[8];
    std::snprintf(colour,
                  sizeof(colour),
                  "#%02x%02x%02x",
                  summary.label.colour[0],
                  summary.label.colour[1],
                  summary.label.colour[2]);
    report.push_back({ { "value", summary.label.value },
                       { "name", summary.label.name },
                       { "colour", colour },
                       { "voxels", summary.numberOfVoxels },
                       { "millilitres", summary.millilitres } });
  }
  return report;
}

Report
ReportLabelSurfaces(const std::vector<LabelSurface> & surfaces)
{
  Report report = Report::array();
  for (const LabelSurface & surface : surfaces)
  {
    report.push_back({ { "value", surface.value },
                       { "name", surface.scene.name },
                       { "voxels", surface.numberOfVoxels },
                       { "voxelVolumeInMillilitres", surface.voxelMillilitres },
                       { "volumeAsExtractedInMillilitres", surface.surfaceMillilitres },
                       { "volumeDifference", surface.GetVolumeDifference() },
                       { "pieces", surface.pieces },
                       { "surfacePieces", surface.surfacePieces },
                       { "isTorn", surface.isTorn },
                       { "finerPieces", surface.finerPieces },
                       { "protectedVoxels", surface.protectedVoxels },
                       { "triangles", surface.scene.surface->GetNumberOfTriangles() } });
  }
  return report;
}

std::string
ToJson(const Report & report)
{
  return report.dump(2, ' ', false, Report::error_handler_t::replace);
}

} // namespace rhombic
