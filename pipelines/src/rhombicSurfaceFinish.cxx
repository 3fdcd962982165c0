#include "rhombicSurfaceFinish.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceSmoothing.h"
#include "itkTriangleSurfaceSolids.h"
#include "itkTriangleSurfaceUntangling.h"
#include "itkTriangleSurfaceVertexOrder.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace rhombic
{
namespace
{

constexpr double CubicMillimetresPerMillilitre = 1000.0;

/** "3 solids", "1 cavity", "3 solids and 1 cavity". */
std::string
CountShells(const itk::RemovedShells & shells)
{
  std::vector<std::string> counts;
  if (shells.solids > 0)
  {
    counts.push_back(Count(shells.solids, "solid"));
  }
  if (shells.cavities > 0)
  {
    counts.push_back(Count(shells.cavities, "cavity", "cavities"));
  }
  return Enumerate(counts, "and");
}

void
NoteFilling(const itk::RemovedShells & filled, double volumeBefore, const std::string & name, const Events & events)
{
  if (filled.solids + filled.cavities == 0)
  {
    return;
  }
  const double growth = -filled.volume / volumeBefore;
  std::ostringstream note;
  note.imbue(std::locale::classic());
  note << std::fixed << std::setprecision(1);
  note << name << ": --fill removed " << CountShells(filled) << " inside the surface and added "
       << -filled.volume / CubicMillimetresPerMillilitre << " ml (" << std::showpos << 100.0 * growth << " %)";
  constexpr double notable = 0.01;
  if (growth > notable)
  {
    note << "; the volume is no longer that of " << name << " alone, leave out --fill to measure it";
  }
  events.Note(note.str());
}

void
NoteRemoval(const itk::RemovedShells & removed, double volumeBefore, const std::string & name, const Events & events)
{
  if (removed.solids + removed.cavities == 0)
  {
    return;
  }
  std::ostringstream note;
  note.imbue(std::locale::classic());
  note << std::fixed << std::setprecision(1);
  note << name << ": removed " << CountShells(removed) << " of " << removed.volume / CubicMillimetresPerMillilitre
       << " ml in all (" << 100.0 * removed.volume / volumeBefore << " % of the volume)";
  events.Note(note.str());
}

Report
ReportShells(const itk::RemovedShells & shells)
{
  return { { "solids", shells.solids },
           { "cavities", shells.cavities },
           { "volumeChangeInMillilitres", -shells.volume / CubicMillimetresPerMillilitre } };
}

Report
Smooth(itk::TriangleSurface & surface, double maximumMove)
{
  const double volumeBefore = ComputeVolume(surface);
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.maximumMove = maximumMove;
  const auto smoothed = SmoothSurface(surface, settings);
  return { { "maximumMoveInMillimetres", maximumMove },
           { "meanMoveInMillimetres", smoothed.meanMove },
           { "largestMoveInMillimetres", smoothed.largestMove },
           { "volumeBeforeInMillilitres", volumeBefore / CubicMillimetresPerMillilitre },
           { "volumeAfterInMillilitres", ComputeVolume(surface) / CubicMillimetresPerMillilitre } };
}

/** How far a surface may be from what it was before it is simplified. */
double
MaximumError(const SurfaceFinish & finish, double spacing)
{
  return finish.maximumError.value_or(spacing);
}

Report
Simplify(itk::TriangleSurface & surface, const SurfaceFinish & finish, double spacing)
{
  itk::TriangleSurfaceSimplificationSettings settings;
  settings.targetTriangles = finish.maximumTriangles;
  if (finish.share < 1.0)
  {
    const auto shared =
      static_cast<std::size_t>(std::ceil(finish.share * static_cast<double>(surface.GetNumberOfTriangles())));
    settings.targetTriangles = settings.targetTriangles > 0 ? std::min(settings.targetTriangles, shared) : shared;
  }
  settings.maximumError = MaximumError(finish, spacing);
  const double volumeBefore = ComputeVolume(surface);
  const auto simplified = SimplifySurface(surface, settings);
  OptimizeForRendering(surface);
  std::ostringstream end;
  end << simplified.end;
  return { { "trianglesBefore", simplified.trianglesBefore },
           { "trianglesAfter", simplified.trianglesAfter },
           { "maximumErrorInMillimetres", MaximumError(finish, spacing) },
           { "volumeBeforeInMillilitres", volumeBefore / CubicMillimetresPerMillilitre },
           { "volumeAfterInMillilitres", ComputeVolume(surface) / CubicMillimetresPerMillilitre },
           { "endedBy", end.str() } };
}

/** Without a word where there was nothing to do. */
Report
Untangle(itk::TriangleSurface & surface, double maximumMove)
{
  const auto untangled = UntangleSurface(surface, maximumMove);
  if (untangled.crossingBefore == 0)
  {
    return nullptr;
  }
  return { { "crossingTrianglesBefore", untangled.crossingBefore },
           { "crossingTrianglesAfter", untangled.crossingAfter },
           { "pointsMoved", untangled.pointsMoved },
           { "largestMoveInMillimetres", untangled.largestMove } };
}

void
WarnOfCrossings(std::size_t triangles, const std::string & name, const Events & events)
{
  if (triangles > 0)
  {
    events.Note(name + ": " + Count(triangles, "triangle passes", "triangles pass") + " through others of it");
  }
}

void
AddDistances(const itk::TriangleSurface & original, const itk::TriangleSurface & surface, Report & report)
{
  const auto distances = ComputeTwoDistances(original, surface);
  report["meanDistanceInMillimetres"] = std::max(distances.fromFirst.mean, distances.fromSecond.mean);
  report["maximumDistanceInMillimetres"] = distances.GetMaximum();
}

/** Relative change of the volume in a step of finishing, in %. */
double
VolumeChange(const Report & done)
{
  const double before = done["volumeBeforeInMillilitres"];
  return 100.0 * (done["volumeAfterInMillilitres"].get<double>() - before) / before;
}

std::string
DescribeSmoothing(const std::string & name, const Report & done)
{
  std::ostringstream note;
  note.imbue(std::locale::classic());
  note.precision(2);
  note << name << ": smoothing moved points by " << done["meanMoveInMillimetres"].get<double>() << " mm on average, "
       << done["largestMoveInMillimetres"].get<double>() << " mm at most; volume " << std::showpos << VolumeChange(done)
       << " %";
  return note.str();
}

std::string
DescribeSimplification(const std::string & name, const SurfaceFinish & finish, const Report & done)
{
  std::ostringstream note;
  note.imbue(std::locale::classic());
  note.precision(3);
  note << name << ": simplified from " << done["trianglesBefore"] << " to " << done["trianglesAfter"] << " triangles, "
       << done["maximumDistanceInMillimetres"].get<double>() << " mm away at most; volume " << std::showpos
       << VolumeChange(done) << std::noshowpos << " %";
  if (done["endedBy"] != "target" && (finish.maximumTriangles > 0 || finish.share < 1.0))
  {
    note << "; fewer would be further away than " << done["maximumErrorInMillimetres"].get<double>()
         << " mm, or have other holes and handles";
  }
  return note.str();
}

} // namespace

bool
IsSimplified(const SurfaceFinish & finish)
{
  return finish.maximumError || finish.maximumTriangles > 0 || finish.share < 1.0;
}

void
CheckSurfaceFinish(const SurfaceFinish & finish)
{
  const auto require = [](bool isGood, const std::string & sentence) {
    if (!isGood)
    {
      throw Failure(FailureKind::Usage, sentence);
    }
  };
  require(finish.minimumVolume >= 0.0 && std::isfinite(finish.minimumVolume),
          "The smallest volume of a part must be 0 ml or more; write --min-volume 0.5 for half a millilitre.");
  require(finish.smoothing >= 0.0 && finish.smoothing <= 1.0,
          "Smoothing moves points by 0 to 1 spacings of the lattice; write --smooth 0.3, for example.");
  require(!finish.maximumError || (*finish.maximumError > 0.0 && std::isfinite(*finish.maximumError)),
          "The largest error of simplification must be above 0; write --max-error 0.2 for 0.2 mm.");
  require(finish.share > 0.0 && finish.share <= 1.0,
          "The share of triangles to keep must be above 0 and at most 100 %; write --max-triangles 10%.");
}

PartRemoval
RemoveParts(itk::TriangleSurface & surface,
            const SurfaceFinish & finish,
            const std::string & name,
            const Events & events)
{
  PartRemoval removal;
  const double extractedVolume = ComputeVolume(surface);
  if (finish.fillsCavities)
  {
    removal.filled = FillCavities(surface);
    NoteFilling(removal.filled, extractedVolume, name, events);
  }
  const double filledVolume = extractedVolume - removal.filled.volume;
  if (finish.keepsLargestPart)
  {
    removal.removed = KeepLargestSolid(surface);
  }
  if (finish.minimumVolume > 0.0)
  {
    removal.removed += RemoveSmallSolids(surface, finish.minimumVolume * CubicMillimetresPerMillilitre);
  }
  NoteRemoval(removal.removed, filledVolume, name, events);
  return removal;
}

Report
ReportPartRemoval(const PartRemoval & removal)
{
  return { { "filled", ReportShells(removal.filled) }, { "removed", ReportShells(removal.removed) } };
}

Report
RefineSurface(itk::TriangleSurface & surface,
              const SurfaceFinish & finish,
              double spacing,
              const std::string & name,
              const Events & events)
{
  Report report;
  if (finish.smoothing > 0.0)
  {
    events.Progress("smoothing " + name, 0.0);
    report["smoothing"] = Smooth(surface, finish.smoothing * spacing);
    events.Note(DescribeSmoothing(name, report["smoothing"]));
  }
  events.Progress("untangling " + name, 0.0);
  const Report untangled = Untangle(surface, spacing);
  if (!untangled.is_null())
  {
    report["untangling"] = untangled;
    WarnOfCrossings(untangled["crossingTrianglesAfter"].get<std::size_t>(), name, events);
  }
  if (IsSimplified(finish))
  {
    events.Progress("simplifying " + name, 0.0);
    const auto original = itk::TriangleSurface::New();
    original->Graft(&surface);
    Report & done = report["simplification"] = Simplify(surface, finish, spacing);
    AddDistances(*original, surface, done);
    events.Note(DescribeSimplification(name, finish, done));
  }
  if (const itk::SizeValueType turned = TurnMisfacingShells(surface); turned > 0)
  {
    report["shellsTurned"] = turned;
  }
  return report;
}

} // namespace rhombic
