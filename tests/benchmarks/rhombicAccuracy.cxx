#include "rhombicAccuracyExperiment.h"
#include "rhombicAccuracyTargets.h"
#include "rhombicJSONFile.h"
#include "rhombicMachine.h"
#include "rhombicRunBenchmark.h"
#include "rhombicTextTable.h"

#include <iostream>
#include <map>
#include <thread>

namespace
{

using namespace rhombic;

struct Options
{
  unsigned int size = 40;
  unsigned int seeds = 3;
  unsigned int threads = std::max(1U, std::thread::hardware_concurrency());
  std::string json;
};

const char *
NameOf(SampleSource source)
{
  return source == SampleSource::Exact ? "exact" : "cubic";
}

double
TrianglesOf(const AccuracyResult & result)
{
  return static_cast<double>(result.errors.triangles);
}

/** A figure and its ratio to that of marching cubes, such as "0.0119 (0.78)". */
std::string
WithRatio(double value, double reference, int digits)
{
  return Fixed(value, digits) + " (" + Fixed(value / reference, 2) + ")";
}

std::string
Verdict(const std::vector<AccuracyTarget> & targets)
{
  std::string verdict;
  for (const AccuracyTarget & target : targets)
  {
    const int digits = target.what == "no manifold" ? 0 : 3;
    verdict += (verdict.empty() ? "" : ", ") + target.what + " " + Fixed(target.value, digits) +
               (target.isUpperLimit ? " <= " : " >= ") + Fixed(target.limit, digits) +
               (target.IsReached() ? " ok" : " MISSED");
  }
  return verdict;
}

void
Print(const AccuracyCase & experiment, const std::vector<AccuracyResult> & results)
{
  TextTable table({ "rho",
                    "samples",
                    "mesh",
                    "mean",
                    "rms",
                    "99 %",
                    "max",
                    "facet deg",
                    "vertex deg",
                    "tri/MC",
                    "quality",
                    "% < 0.2",
                    "targets" });
  const AccuracyResult & reference = results.front();
  const SurfaceErrors & mc = reference.errors;
  for (const AccuracyResult & result : results)
  {
    const SurfaceErrors & errors = result.errors;
    table.Add({ Fixed(result.density, 2),
                NameOf(result.source),
                result.mesh,
                WithRatio(errors.meanDistance, mc.meanDistance, 4),
                WithRatio(errors.rmsDistance, mc.rmsDistance, 4),
                WithRatio(errors.distance99, mc.distance99, 3),
                WithRatio(errors.maximumDistance, mc.maximumDistance, 2),
                WithRatio(errors.facetNormalError, mc.facetNormalError, 2),
                WithRatio(errors.vertexNormalError, mc.vertexNormalError, 2),
                Fixed(TrianglesOf(result) / TrianglesOf(reference), 2),
                Fixed(errors.meanQuality, 3),
                Fixed(100.0 * errors.poorFraction, 2),
                Verdict(GetAccuracyTargets(experiment, reference, result)) });
  }
  std::cout << '\n' << experiment.name << '\n';
  table.Print(std::cout);
  std::cout << std::flush;
}

nlohmann::json
ToJSON(const AccuracyCase & experiment, const AccuracyResult & reference, const AccuracyResult & result)
{
  const SurfaceErrors & errors = result.errors;
  nlohmann::json json{ { "field", experiment.name },
                       { "density", result.density },
                       { "samples", NameOf(result.source) },
                       { "mesh", result.mesh },
                       { "triangles", errors.triangles },
                       { "mean_distance", errors.meanDistance },
                       { "rms_distance", errors.rmsDistance },
                       { "distance_99", errors.distance99 },
                       { "maximum_distance", errors.maximumDistance },
                       { "facet_normal_error", errors.facetNormalError },
                       { "vertex_normal_error", errors.vertexNormalError },
                       { "mean_quality", errors.meanQuality },
                       { "poor_fraction", errors.poorFraction },
                       { "unresolved_fraction", errors.unresolvedFraction },
                       { "non_manifold", result.nonManifold },
                       { "degenerate", result.degenerate },
                       { "relative_mean_distance", errors.meanDistance / reference.errors.meanDistance },
                       { "relative_triangles", TrianglesOf(result) / TrianglesOf(reference) } };
  for (const AccuracyTarget & target : GetAccuracyTargets(experiment, reference, result))
  {
    json["targets"].push_back({ { "what", target.what },
                                { "value", target.value },
                                { target.isUpperLimit ? "at_most" : "at_least", target.limit },
                                { "reached", target.IsReached() } });
  }
  return json;
}

void
Run(const Options & options)
{
  UseThreads(options.threads);
  nlohmann::json report{ { "size", options.size }, { "seeds", options.seeds }, { "results", nlohmann::json::array() } };
  std::cout << "Distances in h, the spacing of marching cubes' grid, of " << options.size
            << " samples along each axis; in parentheses, relative to marching cubes; means of " << options.seeds
            << " fields.\n";

  std::map<SampleSource, double> lean; // sum of the relative distances
  for (const AccuracyCase & experiment : GetAccuracyCases())
  {
    const auto results = RunAccuracyCase(experiment, options.size, options.seeds);
    const AccuracyResult & reference = results.front();
    Print(experiment, results);
    for (const AccuracyResult & result : results)
    {
      report["results"].push_back(ToJSON(experiment, reference, result));
      if (result.mesh == "lean" && result.density == itk::FCCLattice::NyquistDensity)
      {
        lean[result.source] += result.errors.meanDistance / reference.errors.meanDistance;
      }
    }
  }
  for (const auto & [source, sum] : lean)
  {
    const AccuracyTarget target{ "lean's distance, mean over all fields, samples " + std::string(NameOf(source)) + ":",
                                 sum / static_cast<double>(GetAccuracyCases().size()),
                                 1.0 };
    std::cout << '\n' << Verdict({ target }) << '\n';
  }
  if (!options.json.empty())
  {
    WriteJSONFile(options.json, report);
  }
}

} // namespace

int
main(int argc, char ** argv)
{
  Options options;
  CLI::App app{ "Errors of Rhombic's surfaces beside those of marching cubes, on fields that are known exactly",
                "rhombic-accuracy" };
  app.add_option("--size", options.size, "samples along each axis of the Cartesian grid")
    ->check(CLI::Range(24, 200))
    ->capture_default_str();
  app.add_option("--seeds", options.seeds, "fields of each kind")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("--json", options.json, "the report as a file");
  return RunBenchmark(app, argc, argv, [&options] { Run(options); });
}
