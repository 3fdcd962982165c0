#include "rhombicSurfaceReport.h"

#include "rhombicMeasureTable.h"
#include "rhombicOptionNames.h"
#include "rhombicWording.h"

#include <algorithm>
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

/** A label's voxels and pieces, beside its surface's as far as that is measured. */
Report
ToReport(const LabelSurface & surface)
{
  if (surface.isPart)
  {
    return { { "voxels", surface.numberOfVoxels } };
  }
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

Report
ToReport(const itk::ThinParts & thin)
{
  constexpr std::size_t most = 50;
  Report parts = Report::array();
  for (std::size_t n = 0; n < std::min(most, thin.parts.size()); ++n)
  {
    const itk::ThinPart & part = thin.parts[n];
    parts.push_back({ { "areaInSquareMillimetres", part.area },
                      { "thinnestInMillimetres", part.thinnest },
                      { "thinnestAtInLPSMillimetres", part.thinnestAt } });
  }
  return { { "limitInMillimetres", thin.limit },
           { "areaInSquareMillimetres", thin.area },
           { "areaOfSurfaceInSquareMillimetres", thin.areaOfSurface },
           { "numberOfParts", thin.parts.size() },
           { "largestParts", parts } };
}

/** Adds the result of a step, if the step has a result. */
template <typename TResult>
void
AddStep(const char * key, const std::optional<TResult> & result, Report & report)
{
  if (result)
  {
    report[key] = ToReport(*result);
  }
}

/** Solids and cavities of closed surfaces; connected parts of others. */
std::string
DescribeParts(const itk::TriangleSurfaceAudit & audit)
{
  if (!audit.topology.IsWatertight())
  {
    return Count(audit.topology.components, "connected part");
  }
  return Count(audit.shells.solids, "solid") + " with " +
         (audit.shells.cavities == 0 ? "no cavities" : Count(audit.shells.cavities, "cavity", "cavities"));
}

std::string
DescribeIntersections(const itk::TriangleSurfaceIntersections & found)
{
  if (found.testedTriangles == 0)
  {
    return "self-intersections: not looked for";
  }
  return "self-intersections: " + Count(found.crossingPairs, "pair") + " of triangles cross, " +
         std::to_string(found.touchingPairs) + " touch" +
         (found.isSampled ? ", of " + std::to_string(found.testedTriangles) + " triangles tested" : "");
}

} // namespace

Report
ReportInput(const LoadedSource & loaded, const ScanSource & source)
{
  if (!source.isHashed)
  {
    return nullptr;
  }
  const Scan * const scan = loaded.FindScan();
  auto files = scan != nullptr ? scan->files : std::vector<std::filesystem::path>{ source.path };
  if (loaded.scan && loaded.labels)
  {
    files.insert(files.end(), loaded.labels->scan.files.begin(), loaded.labels->scan.files.end());
  }
  return ReportFiles(files);
}

Report
ReportSource(const LoadedSource & loaded, const ScanSource & source, const Report & input)
{
  Report report = Report::object();
  if (!input.is_null())
  {
    report["input"] = input;
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
  if (surface.whole)
  {
    report["drawnTriangles"] = surface.scene.surface->GetNumberOfTriangles();
  }
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
  AddStep("thinParts", surface.thin, report);
  if (surface.audit)
  {
    report["audit"] = ReportAudit(*surface.audit);
  }
  return report;
}

Report
ReportAudit(const itk::TriangleSurfaceAudit & audit)
{
  const auto & topology = audit.topology;
  return { { "watertight", audit.IsWatertight() },
           { "points", audit.points },
           { "triangles", audit.triangles },
           { "components", topology.components },
           { "eulerCharacteristic", topology.eulerCharacteristic },
           { "genus", topology.genus },
           { "boundaryEdges", topology.boundaryEdges },
           { "nonManifoldEdges", topology.nonManifoldEdges },
           { "nonManifoldPoints", topology.nonManifoldPoints },
           { "misorientedEdges", topology.misorientedEdges },
           { "degenerateTriangles", topology.degenerateTriangles },
           { "duplicateTriangles", topology.duplicateTriangles },
           { "solids", audit.shells.solids },
           { "cavities", audit.shells.cavities },
           { "misfacingShells", audit.shells.misfacing },
           { "repeatedPositions", topology.repeatedPositions },
           { "nonFinitePoints", topology.nonFinitePoints },
           { "unusedPoints", topology.unusedPoints },
           { "volumeInMillilitres", audit.volume / CubicMillimetresPerMl },
           { "areaInSquareMillimetres", audit.area },
           { "intersections",
             { { "testedTriangles", audit.intersections.testedTriangles },
               { "complete", !audit.intersections.isSampled && audit.intersections.testedTriangles == audit.triangles },
               { "crossingPairs", audit.intersections.crossingPairs },
               { "touchingPairs", audit.intersections.touchingPairs } } },
           { "quality",
             { { "mean", audit.quality.mean },
               { "minimum", audit.quality.minimum },
               { "poorFraction", audit.quality.poorFraction },
               { "smallestAngleInDegrees", audit.quality.smallestAngle } } } };
}

std::vector<std::string>
DescribeAudit(const itk::TriangleSurfaceAudit & audit)
{
  const auto & topology = audit.topology;
  const std::string shape = Count(audit.triangles, "triangle") + ", " + Count(audit.points, "point") + ", " +
                            DescribeParts(audit) + ", Euler characteristic " +
                            std::to_string(topology.eulerCharacteristic) + ", genus " + std::to_string(topology.genus) +
                            ", " + DescribeVolume(audit.volume / CubicMillimetresPerMl) + ", " +
                            DescribeArea(audit.area);
  const std::string quality = "triangles: quality " + FormatFixed(audit.quality.mean, 2) + " on average, " +
                              FormatFixed(100.0 * audit.quality.poorFraction, 2) + " % below " +
                              FormatFixed(itk::TriangleSurfaceQuality::Poor, 2) + ", smallest angle " +
                              FormatFixed(audit.quality.smallestAngle, 2) + " degrees";
  const std::string leaks = DescribeLeaks(audit);
  std::vector<std::string> lines{
    shape,
    leaks.empty() ? "watertight: closed, oriented, manifold, without degenerate or duplicate triangles"
                  : "not watertight: " + leaks,
    DescribeIntersections(audit.intersections),
    quality
  };
  if (topology.boundaryEdges > 0 && topology.repeatedPositions > 0)
  {
    lines.push_back(Count(topology.repeatedPositions, "point lies", "points lie") +
                    " where another one does: if the program that wrote the file repeats points for each triangle, "
                    "write it as STL, whose points are joined when it is read");
  }
  return lines;
}

std::string
DescribeLeaks(const itk::TriangleSurfaceAudit & audit)
{
  const auto & topology = audit.topology;
  std::string text;
  const auto add = [&text](itk::SizeValueType number, const char * noun, const char * plural = "") {
    if (number > 0)
    {
      text += (text.empty() ? "" : ", ") + Count(number, noun, plural);
    }
  };
  add(topology.boundaryEdges, "boundary edge");
  add(topology.nonManifoldEdges, "non-manifold edge");
  add(topology.nonManifoldPoints, "non-manifold point");
  add(topology.misorientedEdges, "misoriented edge");
  add(topology.degenerateTriangles, "degenerate triangle");
  add(topology.duplicateTriangles, "duplicate triangle");
  add(topology.nonFinitePoints, "point that is nowhere (NaN or infinite)", "points that are nowhere (NaN or infinite)");
  add(audit.shells.misfacing, "shell that faces the wrong way", "shells that face the wrong way");
  return text.empty() && !audit.IsWatertight() ? "it has no volume" : text;
}

Report
ReportWalls(const WallAudit & audit)
{
  return { { "sound", audit.IsSound() },
           { "sharedTriangles", audit.sharedTriangles },
           { "oneSidedTriangles", audit.oneSidedTriangles },
           { "repeatedTriangles", audit.repeatedTriangles },
           { "loneJunctions", audit.loneJunctions },
           { "testedTriangles", audit.intersections.testedTriangles },
           { "crossingPairs", audit.intersections.crossingPairs },
           { "touchingPairs", audit.intersections.touchingPairs } };
}

std::string
DescribeWalls(const WallAudit & audit)
{
  return Count(audit.sharedTriangles, "triangle is", "triangles are") + " walls between two surfaces; " +
         std::to_string(audit.oneSidedTriangles) + " have one surface on both sides, " +
         std::to_string(audit.repeatedTriangles) + " are there twice; " +
         Count(audit.loneJunctions, "edge has", "edges have") +
         " more than two triangles where fewer than three regions meet; " +
         (audit.intersections.testedTriangles == 0
            ? "crossings: not looked for"
            : Count(audit.intersections.crossingPairs, "pair") + " of triangles cross");
}

} // namespace rhombic
