#include "rhombicSurfaceReport.h"

#include "rhombicAuditReport.h"
#include "rhombicMeasureTable.h"
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
ReportEnclosedParts(const EnclosedParts & parts)
{
  return { { "leftOutAroundBodyInMillilitres", parts.aroundBody },
           { "leftOutSmallParts", parts.numberOfSmall },
           { "leftOutSmallPartsInMillilitres", parts.small },
           { "keptPartsCutBySides", parts.numberCutBySides } };
}

/** A label's voxels and pieces, beside its surface's. */
Report
ReportLabel(const LabelSurface & surface)
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
ReportDeviation(const SurfaceDeviation & deviation)
{
  return { { "of", "the points and triangle centres from the scan's isosurface" },
           { "samples", deviation.samples },
           { "complete", deviation.isComplete },
           { "unresolved", deviation.unresolved } };
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
  if (surface.label)
  {
    report["label"] = ReportLabel(*surface.label);
  }
  if (surface.enclosed)
  {
    report["enclosed"] = ReportEnclosedParts(*surface.enclosed);
  }
  ReportFinish(surface, report);
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
