#include "rhombicAuditReport.h"

#include "rhombicWording.h"

#include <array>
#include <utility>

namespace rhombic
{
namespace
{

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
                            ", " + FormatMillilitres(audit.volume / CubicMillimetresPerMl) + ", " +
                            FormatFixed(audit.area / 100.0, 1) + " cm2";
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
  const std::array<std::pair<itk::SizeValueType, std::array<const char *, 2>>, 8> defects{
    { { topology.boundaryEdges, { "boundary edge", "boundary edges" } },
      { topology.nonManifoldEdges, { "non-manifold edge", "non-manifold edges" } },
      { topology.nonManifoldPoints, { "non-manifold point", "non-manifold points" } },
      { topology.misorientedEdges, { "misoriented edge", "misoriented edges" } },
      { topology.degenerateTriangles, { "degenerate triangle", "degenerate triangles" } },
      { topology.duplicateTriangles, { "duplicate triangle", "duplicate triangles" } },
      { topology.nonFinitePoints,
        { "point that is nowhere (NaN or infinite)", "points that are nowhere (NaN or infinite)" } },
      { audit.shells.misfacing, { "shell that faces the wrong way", "shells that face the wrong way" } } }
  };
  std::string text;
  for (const auto & [number, names] : defects)
  {
    if (number > 0)
    {
      text += (text.empty() ? "" : ", ") + Count(number, names[0], names[1]);
    }
  }
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
