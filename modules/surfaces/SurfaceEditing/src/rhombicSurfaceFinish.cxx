#include "rhombicSurfaceFinish.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceForRendering.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>
#include <optional>

namespace rhombic
{
namespace
{

/** "3 solids", "1 cavity", "3 solids and 1 cavity". */
std::string
DescribeShells(const itk::RemovedShells & shells)
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

std::string
DescribeFilling(const itk::RemovedShells & filled, double volumeBefore, const std::string & name)
{
  const double growth = -filled.volume / volumeBefore;
  constexpr double notable = 0.01;
  return name + ": SurfaceFinish::fillsCavities removed " + DescribeShells(filled) + " inside the surface and added " +
         DescribeVolume(-filled.volume / CubicMillimetresPerMl) + " (" + (growth < 0.0 ? "" : "+") +
         FormatFixed(100.0 * growth, 1) + " %)" +
         (growth > notable ? "; the volume is no longer that of " + name +
                               " alone, leave out SurfaceFinish::fillsCavities to measure it"
                           : "");
}

std::string
DescribeRemoval(const itk::RemovedShells & removed, double volumeBefore, const std::string & name)
{
  return name + ": removed " + DescribeShells(removed) + " of " +
         DescribeVolume(removed.volume / CubicMillimetresPerMl) + " in all (" +
         FormatFixed(100.0 * removed.volume / volumeBefore, 1) + " % of the volume)";
}

SmoothingResult
Smooth(const RefinementFunctions & functions,
       itk::TriangleSurface & surface,
       double maximumMove,
       const ProgressFunction & report)
{
  const double volumeBefore = functions.computeVolume(surface);
  itk::TriangleSurfaceSmoothingSettings settings;
  settings.maximumMove = maximumMove;
  const auto moves = functions.smooth(surface, settings, report);
  return { maximumMove, moves, volumeBefore, functions.computeVolume(surface) };
}

/** A warning if the largest part alone leaves out much; otherwise empty. */
std::string
WarnOfLostParts(const itk::RemovedShells & removed, double volumeBefore)
{
  constexpr double notable = 0.05;
  const double share = removed.volume / volumeBefore;
  return share >= notable ? "only the largest part is kept, which leaves out " + FormatFixed(100.0 * share, 1) +
                              " % of the volume; SurfaceFinish::minimumVolume in place of "
                              "SurfaceFinish::keepsLargestPart removes specks only"
                          : "";
}

/** Reports the progress of a step, which begins. */
ProgressFunction
ReportStep(const Events & events, const std::string & step)
{
  events.Progress(step, 0.0);
  return [&events, step](double share) { events.Progress(step, share); };
}

/** The smaller of the two limits of triangles; 0 for none. */
std::size_t
FindTargetTriangles(const SurfaceFinish & finish, std::size_t triangles)
{
  if (finish.share >= 1.0)
  {
    return finish.maximumTriangles;
  }
  const auto shared = static_cast<std::size_t>(std::ceil(finish.share * static_cast<double>(triangles)));
  return finish.maximumTriangles > 0 ? std::min(finish.maximumTriangles, shared) : shared;
}

SimplificationResult
Simplify(const RefinementFunctions & functions,
         itk::TriangleSurface & surface,
         const SurfaceFinish & finish,
         double spacing,
         const ProgressFunction & report)
{
  const double volumeBefore = functions.computeVolume(surface);
  const auto original = itk::TriangleSurface::New();
  original->Graft(&surface);
  itk::TriangleSurfaceSimplificationSettings settings;
  settings.targetTriangles = FindTargetTriangles(finish, surface.GetNumberOfTriangles());
  settings.maximumError = finish.maximumError.value_or(spacing);
  const auto triangles = functions.simplify(surface, settings, report);
  constexpr itk::SizeValueType measuredTriangles = 30'000; // of either surface; simplification itself checks all
  const auto distances = ComputeTriangleSurfaceDistances(*original, surface, measuredTriangles);
  return {
    settings.maximumError,  triangles,    std::max(distances.fromFirst.GetMean(), distances.fromSecond.GetMean()),
    distances.GetMaximum(), volumeBefore, functions.computeVolume(surface)
  };
}

/** "volume +0.12 %". */
std::string
DescribeVolumeChange(double before, double after, int digits)
{
  const double change = 100.0 * (after - before) / before;
  return std::string("volume ") + (change < 0.0 ? "" : "+") + FormatNumber(change, digits) + " %";
}

std::string
DescribeSmoothing(const std::string & name, const SmoothingResult & done)
{
  return name + ": smoothing moved points by " + FormatNumber(done.moves.meanMove, 2) + " mm on average, " +
         FormatNumber(done.moves.largestMove, 2) + " mm at most; " +
         DescribeVolumeChange(done.volumeBefore, done.volumeAfter, 2);
}

std::string
DescribeSimplification(const std::string & name, const SurfaceFinish & finish, const SimplificationResult & done)
{
  const bool isTargetMissed =
    done.triangles.end != itk::SimplificationEnd::Target && (finish.maximumTriangles > 0 || finish.share < 1.0);
  return name + ": simplified from " + std::to_string(done.triangles.trianglesBefore) + " to " +
         std::to_string(done.triangles.trianglesAfter) + " triangles, " + FormatNumber(done.maximumDistance, 3) +
         " mm away at most where measured; " + DescribeVolumeChange(done.volumeBefore, done.volumeAfter, 3) +
         (isTargetMissed ? "; fewer would be further away than " + FormatNumber(done.maximumError, 3) +
                             " mm, or have other holes and handles"
                         : "");
}

} // namespace

SmoothingLimit
ParseSmoothingLimit(const std::string & text)
{
  const std::size_t unit = text.rfind("mm");
  const bool isLength = unit != std::string::npos && unit + 2 == text.size();
  std::string digits = text.substr(0, isLength ? unit : text.size());
  digits.erase(digits.find_last_not_of(' ') + 1);
  const auto number = ToNumber<double>(digits);
  if (!number)
  {
    throw Failure(FailureKind::Usage,
                  "Smoothing by '" + text +
                    "' is neither a number of spacings of the lattice nor a length; write SurfaceFinish::smoothing = "
                    "0.3 or 0.8mm, for example.");
  }
  SmoothingLimit limit;
  (isLength ? limit.millimetres : limit.spacings) = *number;
  return limit;
}

std::istream &
operator>>(std::istream & stream, SmoothingLimit & limit)
{
  limit = ParseSmoothingLimit({ std::istreambuf_iterator<char>(stream), {} });
  return stream;
}

SurfaceFinish
CombineFinish(const SurfaceFinish & first, const SurfaceFinish & second)
{
  SurfaceFinish both = second.Simplifies() ? second : first;
  both.minimumVolume = std::max(first.minimumVolume, second.minimumVolume);
  both.keepsLargestPart = first.keepsLargestPart || second.keepsLargestPart;
  both.fillsCavities = first.fillsCavities || second.fillsCavities;
  both.smoothing.spacings = std::max(first.smoothing.spacings, second.smoothing.spacings);
  both.smoothing.millimetres = std::max(first.smoothing.millimetres, second.smoothing.millimetres);
  return both;
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
          "The smallest volume of a part must be 0 ml or more; write SurfaceFinish::minimumVolume = 0.5 for half a "
          "millilitre.");
  require(finish.smoothing.spacings >= 0.0 && finish.smoothing.spacings <= 1.0,
          "Smoothing moves points by 0 to 1 spacings of the lattice, or by a length; write SurfaceFinish::smoothing = "
          "0.3 or 0.8mm, for example.");
  require(finish.smoothing.millimetres >= 0.0 && std::isfinite(finish.smoothing.millimetres),
          "Smoothing moves points by 0 mm or more; write SurfaceFinish::smoothing = 0.8mm, for example.");
  require(!finish.maximumError || (*finish.maximumError > 0.0 && std::isfinite(*finish.maximumError)),
          "The largest error of simplification must be above 0; write SurfaceFinish::maximumError = 0.2 for 0.2 mm.");
  require(
    finish.share > 0.0 && finish.share <= 1.0,
    "The share of triangles to keep must be above 0 and at most 100 %; write SurfaceFinish::share = 0.1, for example.");
}

PartRemoval
RemoveParts(itk::TriangleSurface & surface,
            const SurfaceFinish & finish,
            const std::string & name,
            const Events & events)
{
  PartRemoval removal;
  const double extractedVolume = ComputeTriangleSurfaceVolume(surface);
  if (finish.fillsCavities)
  {
    removal.filled = FillTriangleSurfaceCavities(surface);
  }
  if (removal.filled.solids + removal.filled.cavities > 0)
  {
    events.Note(DescribeFilling(removal.filled, extractedVolume, name));
  }
  if (finish.keepsLargestPart)
  {
    removal.removed = KeepLargestTriangleSurfaceSolid(surface);
    removal.warning = WarnOfLostParts(removal.removed, extractedVolume - removal.filled.volume);
  }
  if (finish.minimumVolume > 0.0)
  {
    removal.removed += RemoveSmallTriangleSurfaceSolids(surface, finish.minimumVolume * CubicMillimetresPerMl);
  }
  if (removal.removed.solids + removal.removed.cavities > 0)
  {
    events.Note(DescribeRemoval(removal.removed, extractedVolume - removal.filled.volume, name));
  }
  if (!removal.warning.empty())
  {
    events.Note("warning: " + name + ": " + removal.warning);
  }
  return removal;
}

Refinement
RefineBy(const RefinementFunctions & functions,
         itk::TriangleSurface & surface,
         const SurfaceFinish & finish,
         double spacing,
         const std::string & name,
         const Events & events)
{
  Refinement refinement;
  if (!finish.smoothing.IsNothing())
  {
    const ProgressFunction report = ReportStep(events, "smoothing " + name);
    refinement.smoothing = Smooth(functions, surface, finish.smoothing.FindLargestMove(spacing), report);
    events.Note(DescribeSmoothing(name, *refinement.smoothing));
  }
  if (finish.Simplifies())
  {
    const ProgressFunction report = ReportStep(events, "simplifying " + name);
    refinement.simplification = Simplify(functions, surface, finish, spacing, report);
    events.Note(DescribeSimplification(name, finish, *refinement.simplification));
  }
  return refinement;
}

Refinement
RefineSurface(itk::TriangleSurface & surface,
              const SurfaceFinish & finish,
              double spacing,
              const std::string & name,
              const Events & events,
              const std::optional<itk::CrossingCandidates> & candidates)
{
  const RefinementFunctions functions{
    itk::SmoothTriangleSurface,
    [](itk::TriangleSurface & simplified, const auto & settings, const auto & report) {
      const auto result = SimplifyTriangleSurface(simplified, settings, report);
      OptimizeTriangleSurfaceForRendering(simplified);
      return result;
    },
    itk::ComputeTriangleSurfaceVolume
  };
  const ProgressFunction report = ReportStep(events, "untangling " + name);
  const auto untangled = UntangleTriangleSurface(surface, spacing, candidates, report);
  if (untangled.crossingAfter > 0)
  {
    events.Note(name + ": " + Count(untangled.crossingAfter, "triangle passes", "triangles pass") +
                " through others of it");
  }
  Refinement refinement;
  if (!finish.smoothing.IsNothing() || finish.Simplifies())
  {
    refinement = RefineBy(functions, surface, finish, spacing, name, events);
  }
  if (untangled.crossingBefore > 0)
  {
    refinement.untangling = untangled;
  }
  refinement.shellsTurned = TurnMisfacingTriangleSurfaceShells(surface);
  return refinement;
}

} // namespace rhombic
