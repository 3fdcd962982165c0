#include "rhombicExtractSurface.h"
#include "rhombicJSONFile.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicMachine.h"
#include "rhombicPhantom.h"
#include "rhombicRunBenchmark.h"
#include "rhombicReadScan.h"
#include "rhombicSurfaceMeasures.h"
#include "rhombicTableRemoval.h"
#include "rhombicTextTable.h"

#include "itkTriangleSurfaceMeasures.h"

#include <cmath>
#include <iostream>
#include <thread>

namespace
{

using namespace rhombic;

struct Options
{
  std::string scan;
  std::vector<double> spacings{ 4.0, 3.0, 2.0 };
  std::vector<double> isovalues{ 375.5, -485.5 }; // of the phantom: half way from muscle to spine, ribs and pelvis, and
                                                  // from air to skin
  std::vector<double> densities{ itk::FCCLattice::NyquistDensity, 3.0 };
  double referenceDensity = 13.7;
  bool removesTable = false;
  unsigned int threads = std::max(1U, std::thread::hardware_concurrency());
  std::string json;
};

constexpr ExtractionMode modes[] = { ExtractionMode::Lean, ExtractionMode::Fine, ExtractionMode::Tetrahedra };

/** A volume that was found in one way. */
struct Finding
{
  std::string way; ///< a mode, "samples" or "voxels"
  double density;
  double volume; ///< mm^3
};

/** One isosurface's volume, found in all ways. */
struct VolumeCase
{
  std::string scan;
  double isovalue;
  IsosurfaceVolume reference;
  double thickness; ///< 3 V / A in voxels: a ball's radius, one and a half times a plate's thickness
  std::vector<Finding> findings;
};

FCCVolume
Resample(const Scan & scan, double density)
{
  LatticeSettings settings;
  settings.density = density;
  return ScanToLattice(scan, settings, {});
}

VolumeCase
Measure(const Scan & scan, const std::string & name, double isovalue, const Options & options)
{
  SurfaceRequest request;
  request.name = "surface";
  request.isovalue = isovalue;
  const auto & geometry = GeometryOf(scan.image);
  const auto * const grid = IsSlanted(scan) ? nullptr : &geometry;
  VolumeCase result;
  result.scan = name;
  result.isovalue = isovalue;
  double area = 0.0;
  for (const double density : options.densities)
  {
    const FCCVolume lattice = Resample(scan, density);
    for (const ExtractionMode mode : modes)
    {
      const auto surface = LatticeToSurfaces(lattice, { request }, mode, {}, grid).front().surface;
      result.findings.push_back({ NameOf(mode), density, ComputeTriangleSurfaceVolume(*surface) });
      area = ComputeTriangleSurfaceArea(*surface);
    }
    result.findings.push_back(
      { "samples", density, EstimateIsosurfaceVolume(lattice, request.GetThreshold(), area, grid).volume });
  }
  result.findings.push_back({ "voxels", 1.0, CountVoxelVolume(scan, request.GetThreshold()) });
  result.reference =
    EstimateIsosurfaceVolume(Resample(scan, options.referenceDensity), request.GetThreshold(), area, grid);
  result.thickness = 3.0 * result.reference.volume / area / MeanSpacingOf(geometry);
  return result;
}

std::vector<VolumeCase>
MeasureAll(const Options & options)
{
  std::vector<VolumeCase> cases;
  const auto measure = [&](const Scan & scan, const std::string & name) {
    for (const double isovalue : options.isovalues)
    {
      std::cerr << name << ", " << isovalue << "...\n";
      cases.push_back(Measure(scan, name, isovalue, options));
    }
  };
  if (!options.scan.empty())
  {
    Scan scan = ReadScan(options.scan);
    if (options.removesTable)
    {
      RemoveTable(scan, {});
    }
    measure(scan, "scan");
    return cases;
  }
  for (const double spacing : options.spacings)
  {
    Scan phantom;
    phantom.image = MakePhantomScan({ spacing });
    measure(phantom, "phantom " + Fixed(spacing, 1) + " mm");
  }
  return cases;
}

void
Print(const std::vector<VolumeCase> & cases)
{
  std::vector<std::string> heading{ "surface", "threshold", "thickness", "ml" };
  for (const Finding & finding : cases.front().findings)
  {
    heading.push_back(finding.way + (finding.way == "voxels" ? "" : " " + Fixed(finding.density, 2)));
  }
  TextTable table(heading);
  for (const VolumeCase & one : cases)
  {
    std::vector<std::string> row{
      one.scan, Fixed(one.isovalue, 1), Fixed(one.thickness, 1), Fixed(one.reference.volume / 1000.0, 1)
    };
    for (const Finding & finding : one.findings)
    {
      row.push_back(Fixed(100.0 * one.reference.GetErrorOf(finding.volume), 2));
    }
    table.Add(row);
  }
  table.Print(std::cout);
}

nlohmann::json
ToJSON(const std::vector<VolumeCase> & cases)
{
  nlohmann::json results = nlohmann::json::array();
  for (const VolumeCase & one : cases)
  {
    for (const Finding & finding : one.findings)
    {
      results.push_back({ { "surface", one.scan },
                          { "isovalue", one.isovalue },
                          { "thickness", one.thickness },
                          { "reference_volume", one.reference.volume },
                          { "reference_uncertainty", one.reference.uncertainty },
                          { "way", finding.way },
                          { "density", finding.density },
                          { "volume", finding.volume } });
    }
  }
  return { { "results", results } };
}

void
Run(const Options & options)
{
  UseThreads(options.threads);
  const auto cases = MeasureAll(options);
  Print(cases);
  if (!options.json.empty())
  {
    WriteJSONFile(options.json, ToJSON(cases));
  }
}

} // namespace

int
main(int argc, char ** argv)
{
  Options options;
  CLI::App app{ "Errors of volumes in %, by mode and density of the lattice", "rhombic-volumes" };
  app.add_option("--scan", options.scan, "anything that rhombic reads, instead of the phantom");
  app.add_option("-t,--threshold", options.isovalues, "isovalue; repeatable")->allow_extra_args(false);
  app.add_option("--spacing", options.spacings, "of the phantom, in mm; repeatable")->allow_extra_args(false);
  app.add_option("--density", options.densities, "of the lattice; repeatable")->allow_extra_args(false);
  app.add_option("--reference-density", options.referenceDensity, "of the lattice whose samples give the reference")
    ->capture_default_str();
  app.add_flag("--remove-table", options.removesTable, "the scan is a CT in HU: its table is removed");
  app.add_option("--threads", options.threads, "number of threads")->capture_default_str();
  app.add_option("--json", options.json, "also write a report");
  return RunBenchmark(app, argc, argv, [&options] { Run(options); });
}
