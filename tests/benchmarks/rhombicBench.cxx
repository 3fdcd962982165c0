#include "rhombicBenchCommands.h"
#include "rhombicBenchReading.h"
#include "rhombicBenchSections.h"
#include "rhombicFieldSampling.h"
#include "rhombicJSONFile.h"
#include "rhombicMachine.h"
#include "rhombicRunBenchmark.h"
#include "rhombicReadScan.h"
#include "rhombicShapeFields.h"
#include "rhombicTextTable.h"
#include "rhombicWording.h"

#include "itkFCCLattice.h"

#include <algorithm>
#include <iostream>
#include <set>

namespace
{

using namespace rhombic;

struct Options
{
  std::string scan;
  double threshold = 250.5;
  std::string preset;
  std::string labels;
  ScaleVolume scale;
  std::string limit = "128M";
  unsigned int size = 256;
  double density = itk::FCCLattice::NyquistDensity;
  std::vector<unsigned int> threads{ 1 };
  std::vector<std::string> what{ "all" };
  unsigned int repeats = 7;
  unsigned int slowRepeats = 1;
  std::string json;
};

/** Reads a scan as int16, with values rounded and clamped. */
itk::Image<std::int16_t, 3>::Pointer
ReadInt16(const std::string & path)
{
  const auto convert = [](const auto & stored) {
    auto image = itk::Image<std::int16_t, 3>::New();
    image->CopyInformation(stored);
    image->SetRegions(stored->GetBufferedRegion());
    image->Allocate();
    const auto * const begin = stored->GetBufferPointer();
    std::transform(begin, begin + stored->GetPixelContainer()->Size(), image->GetBufferPointer(), [](const auto value) {
      return static_cast<std::int16_t>(std::clamp(std::round(static_cast<double>(value)), -32768.0, 32767.0));
    });
    return image;
  };
  return std::visit(convert, ReadScan(path).image);
}

/** Three periods of the gyroid along each axis, -1500 to 1500, and an isovalue that no sample has. */
BenchInput
MakeInput(const Options & options)
{
  BenchInput input;
  input.density = options.density;
  if (options.scan.empty())
  {
    input.volume = SampleOnGrid<std::int16_t>(MakeGyroidField(options.size / 3.0), options.size, 1.0, 1000.0);
    input.isovalue = 0.5;
  }
  else
  {
    input.volume = ReadInt16(options.scan);
    input.isScan = true;
    input.isovalue = options.threshold;
  }
  return input;
}

/** Options of rhombic that say what a page shows. */
std::vector<std::string>
SourceOf(const Options & options)
{
  if (!options.labels.empty())
  {
    return { "--labels", options.labels };
  }
  return options.preset.empty() ? std::vector<std::string>{ "-t", FormatExact(options.threshold) }
                                : std::vector<std::string>{ "--preset", options.preset };
}

nlohmann::json
ToJSON(const BenchResult & result)
{
  nlohmann::json json = result.details;
  const double ratio = Median(result.times.GetRatios());
  json.update({ { "section", result.section },
                { "candidate", result.candidate },
                { "reference", result.reference },
                { "threads", result.threads },
                { "seconds", Median(result.times.candidate) },
                { "reference_seconds", Median(result.times.reference) },
                { "ratio", ratio },
                { "ratios", result.times.GetRatios() } });
  if (result.target)
  {
    json["target"] = *result.target;
    json["reached"] = ratio >= *result.target;
  }
  return json;
}

nlohmann::json
ToJSON(const MemoryResult & result)
{
  return { { "section", "memory" },         { "candidate", result.candidate }, { "threads", result.threads },
           { "volume_mib", result.volume }, { "mesh_mib", result.mesh },       { "extra_mib", result.extra } };
}

void
Print(const std::vector<BenchResult> & results)
{
  TextTable table(
    { "section", "candidate", "reference", "thr", "s", "ref s", "faster", "range", "target", "", "notes" });
  for (const BenchResult & result : results)
  {
    const auto ratios = result.times.GetRatios();
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    const double ratio = Median(ratios);
    std::string notes;
    for (const auto & [key, value] : result.details.items())
    {
      notes += (notes.empty() ? "" : ", ") + key + " " + value.dump();
    }
    table.Add({ result.section,
                result.candidate,
                result.reference,
                std::to_string(result.threads),
                Fixed(Median(result.times.candidate), 3),
                Fixed(Median(result.times.reference), 3),
                Fixed(ratio, 2),
                Fixed(*least, 2) + "-" + Fixed(*most, 2),
                result.target ? Fixed(*result.target, 2) : "",
                result.target ? (ratio >= *result.target ? "ok" : "MISSED") : "",
                notes });
  }
  table.Print(std::cout);
}

void
Print(const std::vector<MemoryResult> & results)
{
  constexpr double allowance = 64.0; // MiB
  if (results.empty())
  {
    std::cout << "Memory can't be measured here: /proc/self/clear_refs is not writable.\n";
    return;
  }
  TextTable table({ "section", "candidate", "thr", "volume MiB", "mesh MiB", "extra MiB", "target", "" });
  for (const MemoryResult & result : results)
  {
    const bool isOurs = result.candidate.rfind("vtk", 0) != 0;
    table.Add({ "memory",
                result.candidate,
                std::to_string(result.threads),
                Fixed(result.volume, 1),
                Fixed(result.mesh, 1),
                Fixed(result.extra, 1),
                isOurs ? "<= 64" : "",
                isOurs ? (result.extra <= allowance ? "ok" : "MISSED") : "" });
  }
  table.Print(std::cout);
}

void
Run(const Options & options)
{
  const auto isNamed = [&](const char * section) {
    return std::find(options.what.begin(), options.what.end(), section) != options.what.end();
  };
  const auto isWanted = [&](const char * section) { return isNamed(section) || isNamed("all"); };
  const BenchInput input = MakeInput(options);
  const auto & size = input.volume->GetBufferedRegion().GetSize();

  nlohmann::json report{ { "machine", DescribeMachine() },
                         { "input",
                           { { "scan", options.scan.empty() ? "gyroid" : options.scan },
                             { "size", { size[0], size[1], size[2] } },
                             { "isovalue", input.isovalue },
                             { "density", input.density } } },
                         { "results", nlohmann::json::array() } };
  std::cout << "machine: " << report["machine"].dump() << "\ninput: " << report["input"].dump() << "\n";

  for (const unsigned int threads : std::set<unsigned int>(options.threads.begin(), options.threads.end()))
  {
    UseThreads(threads);
    const BenchSettings settings{ threads, options.repeats, options.slowRepeats };
    std::vector<BenchResult> results;
    const auto measure = [&](const char * section, const auto & function) {
      if (isWanted(section))
      {
        const auto more = function(input, settings);
        results.insert(results.end(), more.begin(), more.end());
      }
    };
    if (isWanted("reading") && !options.scan.empty())
    {
      results = MeasureReading(options.scan, settings);
    }
    if (isWanted("commands") && !options.scan.empty())
    {
      const auto more = MeasureCommands(options.scan, options.threshold, settings);
      results.insert(results.end(), more.begin(), more.end());
    }
    if (isNamed("labels"))
    {
      const auto more = MeasureLabelCommands(options.scan, settings);
      results.insert(results.end(), more.begin(), more.end());
    }
    if (isNamed("pages"))
    {
      const auto more = MeasurePage(options.scan, SourceOf(options), settings);
      results.insert(results.end(), more.begin(), more.end());
    }
    if (isNamed("scale"))
    {
      const auto more = MeasureScale(options.scale, options.limit, settings);
      results.insert(results.end(), more.begin(), more.end());
    }
    measure("extraction", MeasureExtraction);
    measure("resampling", MeasureResampling);
    measure("pipeline", MeasurePipeline);
    measure("floor", MeasureFloor);
    if (threads == 1)
    {
      measure("neighbors", MeasureNeighbors);
    }
    if (!results.empty())
    {
      std::cout << '\n';
      Print(results);
    }
    for (const BenchResult & result : results)
    {
      report["results"].push_back(ToJSON(result));
    }
    if (isWanted("memory"))
    {
      const auto memory = MeasureMemory(input, settings);
      std::cout << '\n';
      Print(memory);
      for (const MemoryResult & result : memory)
      {
        report["results"].push_back(ToJSON(result));
      }
    }
    std::cout << std::flush;
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
  CLI::App app{ "Speed and memory of Rhombic beside VTK and ITK, in pairs run in turn", "rhombic-bench" };
  app.add_option("--scan", options.scan, "a DICOM folder or volume file, measured as int16 (default: a gyroid)");
  app.add_option("-t,--threshold", options.threshold, "isovalue in the scan")->capture_default_str();
  app.add_option("--preset", options.preset, "what pages show in place of the isovalue");
  app.add_option("--labels", options.labels, "a label map that pages show in place of the isovalue");
  app.add_option("--scale-size", options.scale.size, "voxels along each axis of the volume of scale")
    ->check(CLI::Range(64, 4096))
    ->capture_default_str();
  app.add_option("--scale-pitch", options.scale.pitch, "voxels from ball to ball of scale")->capture_default_str();
  app.add_option("--scale-radius", options.scale.radius, "radius of the balls of scale in voxels")
    ->capture_default_str();
  app.add_option("--limit", options.limit, "--max-memory of scale")->capture_default_str();
  app.add_option("--size", options.size, "samples along each axis of the gyroid")
    ->check(CLI::Range(16, 1024))
    ->capture_default_str();
  app.add_option("--density", options.density, "lattice sites per voxel")->capture_default_str();
  app.add_option("--threads", options.threads, "numbers of threads, separated by commas")
    ->delimiter(',')
    ->check(CLI::Range(1, 1024))
    ->capture_default_str();
  app.add_option("--what", options.what, "what to measure, separated by commas")
    ->delimiter(',')
    ->check(CLI::IsMember({ "extraction",
                            "resampling",
                            "pipeline",
                            "memory",
                            "floor",
                            "neighbors",
                            "reading",
                            "commands",
                            "labels",
                            "pages",
                            "scale",
                            "all" }))
    ->capture_default_str();
  app.add_option("--repeat", options.repeats, "pairs whose median is reported")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str();
  app.add_option("--slow-repeat", options.slowRepeats, "the same for ITK's cubic B-spline and vtkMarchingCubes")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str();
  app.add_option("--json", options.json, "the report as a file");
  return RunBenchmark(app, argc, argv, [&options] { Run(options); });
}
