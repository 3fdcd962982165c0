#include "rhombicSurfaceReport.h"

#include "rhombicAuditReport.h"
#include "rhombicWording.h"

#include <sstream>

namespace rhombic
{
namespace
{

template <typename TEnum>
std::string
ToText(TEnum value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

double
ToMillilitres(double volume)
{
  return volume / CubicMillimetresPerMl;
}

Report
ReportRequest(const SurfaceRequest & request, itk::FCCIsosurfaceMode mode)
{
  return { { "name", request.name },
           { "isovalue", request.isovalue.value() },
           { "inside", request.insideIsBelow ? "below" : "above" },
           { "mode", ToText(mode) } };
}

Report
ReportEnclosedParts(const EnclosedParts & parts)
{
  return { { "leftOutAroundBodyInMillilitres", parts.aroundBody },
           { "leftOutSmallParts", parts.numberOfSmall },
           { "leftOutSmallPartsInMillilitres", parts.small },
           { "keptPartsCutBySides", parts.numberCutBySides } };
}

/** The report of a label's surface, without its triangles. */
Report
ReportLabel(const LabelSurface & surface, const std::string & name)
{
  return { { "value", surface.value },
           { "name", name },
           { "voxels", surface.numberOfVoxels },
           { "voxelVolumeInMillilitres", surface.voxelMillilitres },
           { "volumeAsExtractedInMillilitres", surface.surfaceMillilitres },
           { "volumeDifference", surface.GetVolumeDifference() },
           { "pieces", surface.pieces },
           { "surfacePieces", surface.surfacePieces },
           { "isTorn", surface.isTorn } };
}

Report
ReportShells(const itk::RemovedShells & shells)
{
  return { { "solids", shells.solids },
           { "cavities", shells.cavities },
           { "volumeChangeInMillilitres", -ToMillilitres(shells.volume) } };
}

Report
ReportSmoothing(const SmoothingResult & smoothing)
{
  return { { "maximumMoveInMillimetres", smoothing.maximumMove },
           { "meanMoveInMillimetres", smoothing.moves.meanMove },
           { "largestMoveInMillimetres", smoothing.moves.largestMove },
           { "volumeBeforeInMillilitres", ToMillilitres(smoothing.volumeBefore) },
           { "volumeAfterInMillilitres", ToMillilitres(smoothing.volumeAfter) } };
}

Report
ReportUntangling(const itk::TriangleSurfaceUntanglingReport & untangling)
{
  return { { "crossingTrianglesBefore", untangling.crossingBefore },
           { "crossingTrianglesAfter", untangling.crossingAfter },
           { "pointsMoved", untangling.pointsMoved },
           { "largestMoveInMillimetres", untangling.largestMove } };
}

Report
ReportSimplification(const SimplificationResult & simplification)
{
  return { { "trianglesBefore", simplification.triangles.trianglesBefore },
           { "trianglesAfter", simplification.triangles.trianglesAfter },
           { "maximumErrorInMillimetres", simplification.maximumError },
           { "volumeBeforeInMillilitres", ToMillilitres(simplification.volumeBefore) },
           { "volumeAfterInMillilitres", ToMillilitres(simplification.volumeAfter) },
           { "endedBy", ToText(simplification.triangles.end) },
           { "meanDistanceInMillimetres", simplification.meanDistance },
           { "maximumDistanceInMillimetres", simplification.maximumDistance } };
}

void
ReportFinish(const MeshedSurface & surface, Report & report)
{
  if (!surface.parts.IsNothing())
  {
    report["parts"] = { { "filled", ReportShells(surface.parts.filled) },
                        { "removed", ReportShells(surface.parts.removed) } };
  }
  if (!surface.parts.warning.empty())
  {
    report["warnings"] = { surface.parts.warning };
  }
  const Refinement & refinement = surface.refinement;
  if (refinement.smoothing)
  {
    report["smoothing"] = ReportSmoothing(*refinement.smoothing);
  }
  if (refinement.untangling)
  {
    report["untangling"] = ReportUntangling(*refinement.untangling);
  }
  if (refinement.simplification)
  {
    report["simplification"] = ReportSimplification(*refinement.simplification);
  }
  if (refinement.shellsTurned > 0)
  {
    report["shellsTurned"] = refinement.shellsTurned;
  }
}

Report
ReportMeasures(const SurfaceMeasures & measures)
{
  Report report{ { "volumeInMillilitres", ToMillilitres(measures.volume) } };
  if (measures.voxelVolume)
  {
    report["voxelVolumeInMillilitres"] = ToMillilitres(*measures.voxelVolume);
  }
  if (measures.isosurface)
  {
    report["isosurfaceVolumeInMillilitres"] = ToMillilitres(measures.isosurface->volume);
    report["isosurfaceUncertaintyInMillilitres"] = ToMillilitres(measures.isosurface->uncertainty);
  }
  if (const auto error = measures.GetVolumeError())
  {
    report["volumeErrorInPercent"] = *error;
    report["volumeErrorReference"] = measures.isosurface ? "isosurface" : "voxels";
  }
  report["areaInSquareMillimetres"] = measures.area;
  report["boundsInMillimetres"] = measures.bounds;
  report["centroidInMillimetres"] = measures.centroid;
  report["longestDiameterInMillimetres"] = measures.longestDiameter;
  if (measures.meanValue)
  {
    report["meanValue"] = *measures.meanValue;
    report["standardDeviation"] = *measures.standardDeviation;
  }
  return report;
}

Report
ReportExtractedSize(const ExtractedSize & extracted, const SurfaceMeasures & measures)
{
  return { { "volumeInMillilitres", ToMillilitres(extracted.volume) },
           { "areaInSquareMillimetres", extracted.area },
           { "triangles", extracted.triangles },
           { "volumeChangeInPercent", PercentChange(extracted.volume, measures.volume) },
           { "areaChangeInPercent", PercentChange(extracted.area, measures.area) } };
}

Report
ReportDeviation(const SurfaceDeviation & deviation)
{
  Report report{ { "of", "the points and triangle centres from the scan's isosurface" },
                 { "samples", deviation.samples },
                 { "complete", deviation.isComplete },
                 { "unresolved", deviation.unresolved } };
  if (deviation.IsKnown())
  {
    report["meanInMillimetres"] = deviation.mean;
    report["percentile95InMillimetres"] = deviation.percentile95;
    report["maximumInMillimetres"] = deviation.maximum;
    report["biasInMillimetres"] = deviation.bias;
  }
  return report;
}

} // namespace

Report
ReportSource(const LoadedSource & loaded, const ScanSource & source)
{
  Report report = Report::object();
  if (source.isHashed)
  {
    const Scan * const scan = loaded.FindScan();
    auto files = scan != nullptr ? scan->files : std::vector<std::filesystem::path>{ source.path };
    if (loaded.scan && loaded.labels)
    {
      files.insert(files.end(), loaded.labels->scan.files.begin(), loaded.labels->scan.files.end());
    }
    report["input"] = ReportFiles(files);
  }
  if (!source.presetChoice.empty())
  {
    report["preset"] = source.presetChoice;
  }
  if (const Scan * const scan = loaded.FindScan())
  {
    report["scan"] = ReportWithoutNames(*scan, source.path);
  }
  if (!loaded.warnings.empty())
  {
    report["warnings"] = loaded.warnings;
  }
  if (loaded.tableRemoval)
  {
    report["removed"] = ReportTableRemoval(*loaded.tableRemoval);
  }
  if (!loaded.requests.empty())
  {
    report["denoising"] = ReportDenoising(source.lattice.denoising);
    report["lattice"] = ReportLattice(loaded.lattice);
  }
  return report;
}

Report
ReportIsosurface(const SurfaceRequest & request, const ExtractedSurface & surface, itk::FCCIsosurfaceMode mode)
{
  Report report = ReportRequest(request, mode);
  report["points"] = surface.surface->GetNumberOfPoints();
  report["triangles"] = surface.surface->GetNumberOfTriangles();
  if (surface.enclosed)
  {
    report["enclosed"] = ReportEnclosedParts(*surface.enclosed);
  }
  return report;
}

Report
ReportLabelSurface(const LabelSurface & surface)
{
  Report report = ReportLabel(surface, surface.scene.name);
  report["triangles"] = surface.scene.surface->GetNumberOfTriangles();
  return report;
}

Report
ReportMeshedSurface(const MeshedSurface & surface, itk::FCCIsosurfaceMode mode)
{
  Report report =
    surface.label ? ReportLabel(*surface.label, surface.scene.name) : ReportRequest(*surface.request, mode);
  report["points"] = surface.points;
  report["triangles"] = surface.triangles;
  if (surface.enclosed)
  {
    report["enclosed"] = ReportEnclosedParts(*surface.enclosed);
  }
  ReportFinish(surface, report);
  report["measures"] = ReportMeasures(surface.measures);
  report["extracted"] = ReportExtractedSize(surface.extracted, surface.measures);
  if (surface.deviation)
  {
    report["deviation"] = ReportDeviation(*surface.deviation);
  }
  if (surface.audit)
  {
    report["audit"] = ReportAudit(*surface.audit);
  }
  return report;
}

} // namespace rhombic
