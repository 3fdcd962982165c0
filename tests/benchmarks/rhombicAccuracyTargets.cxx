#include "rhombicAccuracyTargets.h"

#include "itkFCCLattice.h"

namespace rhombic
{

std::vector<AccuracyTarget>
GetAccuracyTargets(const AccuracyCase & experiment, const AccuracyResult & reference, const AccuracyResult & result)
{
  if (result.mesh.rfind("marching cubes", 0) == 0)
  {
    return {};
  }
  const SurfaceErrors & errors = result.errors;
  const double distance = errors.meanDistance / reference.errors.meanDistance;
  const double allowance = result.source == SampleSource::Exact ? 0.0 : 0.1; // for the errors of resampling
  std::vector<AccuracyTarget> targets;
  if (result.density == itk::FCCLattice::NyquistDensity && result.mesh == "fine")
  {
    targets.push_back({ "distance", distance, experiment.fineDistance + allowance });
  }
  if (result.density == itk::FCCLattice::NyquistDensity && result.mesh == "lean")
  {
    const double triangles = static_cast<double>(errors.triangles) / static_cast<double>(reference.errors.triangles);
    targets.push_back({ "distance", distance, experiment.leanDistance + allowance });
    targets.push_back({ "triangles", triangles, experiment.isRough ? 0.7 : 0.65 });
    targets.push_back({ "quality", errors.meanQuality, experiment.isRough ? 0.85 : 0.88, false });
    targets.push_back({ "poor %", 100.0 * errors.poorFraction, experiment.isRough ? 1.5 : 0.0 });
  }
  targets.push_back({ "no manifold", static_cast<double>(result.nonManifold + result.degenerate), 0.0 });
  return targets;
}

} // namespace rhombic
