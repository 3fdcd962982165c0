#include "rhombicSurfaceReport.h"

#include "rhombicAuditReport.h"
#include "rhombicMeasureTable.h"
#include "rhombicOptionNames.h"
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
ToReport(const EnclosedParts & parts)
{
  return { { "leftOutAroundBodyInMillilitres", parts.aroundBody },
           { "leftOutSmallParts", parts.numberOfSmall },
           { "leftOutSmallPartsInMillilitres", parts.small },
           { "keptPartsCutBySides", parts.numberCutBySides } };
}

/** A label's voxels and pieces, beside its surface's. */
Report
ToReport(const LabelSurface & surface)
{
  return { { "voxels", surface.numberOfVoxels },
           { "volumeDifferenceInPercent", 100.0 * surface.GetVolumeDifference() },
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
ToReport(const SmoothingResult & smoothing)
{
  return { { "maximumMoveInMillimetres", smoothing.maximumMove },
           { "meanMoveInMillimetres", smoothing.moves.meanMove },
           { "largestMoveInMillimetres", smoothing.moves.largestMove },
           { "volumeBeforeInMillilitres", ToMillilitres(smoothing.volumeBefore) },
           { "volumeAfterInMillilitres", ToMillilitres(smoothing.volumeAfter) } };
}

Report
ToReport(const itk::TriangleSurfaceUntanglingReport & untangling)
{
  return { { "crossingTrianglesBefore", untangling.crossingBefore },
           { "crossingTrianglesAfter", untangling.crossingAfter },
           { "pointsMoved", untangling.pointsMoved },
           { "largestMoveInMillimetres", untangling.largestMove } };
}

Report
ToReport(const SimplificationResult & simplification)
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

Report
ToReport(const SurfaceDeviation & deviation)
{
  return { { "of", "the points and triangle centres from the scan's isosurface" },
           { "samples", deviation.samples },
           { "complete", deviation.isComplete },
           { "unresolved", deviation.unresolved } };
}

/** Adds the result of a step, if there is one. */
template <typename TResult>
void
AddStep(const char * key, const std::optional<TResult> & result, Report & report)
{
  if (result)
  {
    report[key] = ToReport(*result);
  }
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
ReportMeshedSurface(const MeshedSurface & surface)
{
  Report report{ { "name", surface.scene.name }, { "measures", ReportMeasures(surface) } };
  AddStep("label", surface.label, report);
  AddStep("enclosed", surface.enclosed, report);
  if (!surface.parts.IsNothing())
  {
    report["parts"] = { { "filled", ReportShells(surface.parts.filled) },
                        { "removed", ReportShells(surface.parts.removed) } };
  }
  if (!surface.parts.warning.empty())
  {
    report["warnings"] = { NameOptions(surface.parts.warning) };
  }
  AddStep("smoothing", surface.refinement.smoothing, report);
  AddStep("untangling", surface.refinement.untangling, report);
  AddStep("simplification", surface.refinement.simplification, report);
  if (surface.refinement.shellsTurned > 0)
  {
    report["shellsTurned"] = surface.refinement.shellsTurned;
  }
  AddStep("deviation", surface.deviation, report);
  if (surface.audit)
  {
    report["audit"] = ReportAudit(*surface.audit);
  }
  return report;
}

} // namespace rhombic
