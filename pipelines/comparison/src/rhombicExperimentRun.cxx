#include "rhombicComparisonSteps.h"

#include "rhombicSurfaceErrors.h"

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurfaceTopology.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

/** The measures of errors that all rows of a field share. */
struct Judge
{
  const itk::TriangleSurface & truth;
  FindNearest findNearest;
  SurfaceErrorSettings settings;
  std::vector<GapPoint> gap;
};

void
AddTopology(const itk::TriangleSurface & surface, Figures & figures)
{
  const auto topology = itk::ComputeTriangleSurfaceTopology(surface);
  figures["parts"] = static_cast<double>(topology.components);
  figures["genus"] = static_cast<double>(topology.genus);
  figures["open"] = static_cast<double>(topology.boundaryEdges);
  figures["flaws"] =
    static_cast<double>(topology.nonManifoldEdges + topology.nonManifoldPoints + topology.degenerateTriangles);
}

/** The width up to which a gap is closed; of a gap that is open in some narrower places, the sum of the closed ranges
 * of widths. */
double
ClosedWidth(const std::vector<GapPoint> & points, const itk::TriangleTree & tree)
{
  double closed = 0.0;
  double before = 0.0;
  for (const auto & [p, width] : points)
  {
    int turns = 0;
    tree.VisitCrossings({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) },
                        [&turns](std::uint32_t, int turn) { turns += turn; });
    closed += turns == 0 ? 0.0 : width - before;
    before = width;
  }
  return closed;
}

Figures
JudgeSurface(const itk::TriangleSurface & surface, const Judge & judge)
{
  const SurfaceErrors errors = ComputeSurfaceErrors(surface, judge.findNearest, judge.settings);
  const itk::TriangleTree tree(surface);
  const SurfaceErrors back = ComputePointDistances(judge.truth, NearestOnMesh(tree), judge.settings);
  Figures figures{ { "triangles", static_cast<double>(surface.GetNumberOfTriangles()) },
                   { "q", ComputeNormalPenalty(surface, judge.truth, judge.settings) },
                   { "mean", errors.meanDistance },
                   { "rms", errors.rmsDistance },
                   { "p99", errors.distance99 },
                   { "max", errors.maximumDistance },
                   { "back-mean", back.meanDistance },
                   { "back-rms", back.rmsDistance },
                   { "back-max", back.maximumDistance },
                   { "facet", errors.facetNormalError },
                   { "quality", errors.meanQuality },
                   { "poor", 100.0 * errors.poorFraction } };
  if (!judge.gap.empty())
  {
    figures["gap"] = ClosedWidth(judge.gap, tree) / judge.settings.unit;
  }
  if (std::isfinite(judge.settings.lower[0]))
  {
    figures["judged"] = static_cast<double>(errors.triangles);
  }
  if (!std::isnan(errors.vertexNormalError))
  {
    figures["vertex"] = errors.vertexNormalError;
  }
  AddTopology(surface, figures);
  return figures;
}

/** Extracts each row's surface in turn, again and again, so that other work on the machine affects all alike. */
std::vector<double>
MedianTimes(const std::vector<PreparedMethod> & rows, unsigned int repeats)
{
  using Clock = std::chrono::steady_clock;
  std::vector<std::vector<double>> times(rows.size());
  const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1); // VTK's have one, too: see RunComparison()
  for (unsigned int repeat = 0; repeat < repeats; ++repeat)
  {
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      const auto begin = Clock::now();
      rows[row].extract();
      times[row].push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    }
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  std::vector<double> medians;
  for (std::vector<double> & ofRow : times)
  {
    std::nth_element(ofRow.begin(), ofRow.begin() + static_cast<std::ptrdiff_t>(repeats / 2), ofRow.end());
    medians.push_back(ofRow[repeats / 2]);
  }
  return medians;
}

/** Adds the figures of one seed to the sum of those before; of maxima the largest is kept. */
void
Accumulate(Figures & sum, const Figures & more)
{
  for (const auto & [name, value] : more)
  {
    const bool isMaximum = name == "max" || name == "back-max";
    sum[name] = isMaximum ? std::max(sum[name], value) : sum[name] + value;
  }
}

double
DensityOf(const ComparedRow & row, const FieldCase & fieldCase)
{
  return row.samples > 0.0 ? DensityOfSamples(GetComparedMethod(row.method), fieldCase.box, row.samples)
                           : row.density / std::pow(fieldCase.spacing, 3.0);
}

SurfaceErrorSettings
JudgedBox(const FieldCase & fieldCase, double spacing)
{
  constexpr double margin = 3.0; // h from the border, where surfaces end
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SurfaceErrorSettings settings{ { -infinity, -infinity, -infinity }, { infinity, infinity, infinity }, spacing };
  for (unsigned int axis = 0; axis < 3 && !fieldCase.isClosed; ++axis)
  {
    settings.lower[axis] = fieldCase.box.lower[axis] + margin * spacing;
    settings.upper[axis] = fieldCase.box.upper[axis] - margin * spacing;
  }
  return settings;
}

/** Runs the rows on the field of one seed, and adds their figures to the sums. */
void
RunSeed(const Experiment & experiment, std::uint64_t seed, unsigned int repeats, ExperimentRun & run)
{
  constexpr double truthPerSpacing = 3.0;
  const FieldCase fieldCase = MakeFieldCase(experiment.field, seed);
  const double spacing = std::cbrt(1.0 / DensityOf(experiment.rows.front(), fieldCase));
  const auto truth =
    fieldCase.truth ? fieldCase.truth : MakeTrueSurface(fieldCase.field, fieldCase.box, spacing / truthPerSpacing);
  const itk::TriangleTree tree(*truth);
  const Judge judge{ *truth,
                     fieldCase.isObject ? NearestOnMesh(tree) : NearestOnField(fieldCase.field, spacing),
                     JudgedBox(fieldCase, spacing),
                     fieldCase.gap };
  const ReferenceField resampled = MakeInterpolatedField(SampleBox(fieldCase.field, fieldCase.box, spacing));

  std::vector<PreparedMethod> prepared;
  for (const ComparedRow & row : experiment.rows)
  {
    const ReferenceField & field = row.isResampled ? resampled : fieldCase.field;
    prepared.push_back(GetComparedMethod(row.method).prepare(field, fieldCase.box, DensityOf(row, fieldCase)));
  }
  const auto seconds = MedianTimes(prepared, repeats);
  for (std::size_t row = 0; row < prepared.size(); ++row)
  {
    const auto surface = prepared[row].extract();
    Figures figures = JudgeSurface(*surface, judge);
    figures["samples"] = static_cast<double>(prepared[row].samples);
    figures["density"] = DensityOf(experiment.rows[row], fieldCase) * std::pow(spacing, 3.0);
    figures["seconds"] = seconds[row];
    figures["squared-mean"] = figures["mean"] * figures["mean"];
    Accumulate(run.result.rows[row], figures);
    if (!run.truth)
    {
      run.surfaces.push_back(surface);
      run.samples.push_back(prepared[row].samples);
    }
  }
  if (!run.truth)
  {
    run.truth = truth;
    run.result.spacing = spacing;
    run.result.truth["triangles"] = static_cast<double>(truth->GetNumberOfTriangles());
    AddTopology(*truth, run.result.truth);
    if (!fieldCase.isObject)
    {
      run.result.truth["facet"] = ComputeSurfaceErrors(*truth, judge.findNearest, judge.settings).facetNormalError;
    }
  }
}

} // namespace

ExperimentRun
RunExperiment(const Experiment & experiment, unsigned int repeats, const Events & events)
{
  ExperimentRun run;
  run.result.experiment = experiment;
  run.result.rows.resize(experiment.rows.size());
  for (unsigned int seed = 1; seed <= experiment.seeds; ++seed)
  {
    events.Progress(experiment.name, (seed - 1.0) / experiment.seeds);
    RunSeed(experiment, seed, repeats, run);
  }
  for (Figures & figures : run.result.rows)
  {
    for (auto & [name, value] : figures)
    {
      value /= name == "max" || name == "back-max" ? 1.0 : experiment.seeds;
    }
    const double variance = figures["squared-mean"] - figures["mean"] * figures["mean"];
    figures.erase("squared-mean");
    if (experiment.seeds > 1)
    {
      figures["spread"] = std::sqrt(std::max(0.0, variance) / (experiment.seeds - 1.0));
    }
  }
  return run;
}

} // namespace rhombic
