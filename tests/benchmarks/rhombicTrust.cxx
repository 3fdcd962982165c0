#include "rhombicJSONFile.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicMachine.h"
#include "rhombicRunBenchmark.h"
#include "rhombicReadScan.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTableRemoval.h"
#include "rhombicTextTable.h"

#include "itkTriangleSurfaceAudit.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <thread>

namespace fs = std::filesystem;

namespace
{

using namespace rhombic;
using Mode = itk::FCCIsosurfaceMode;

struct Options
{
  std::string scan;
  std::vector<double> isovalues;
  bool removesTable = false;
  double share = 10.0;
  double spacings = 1.0;
  std::vector<std::string> modes;
  unsigned int threads = std::max(1U, std::thread::hardware_concurrency());
  std::string json;
};

/** A folder for files that are written only to be read back. */
class ScratchFolder
{
public:
  ScratchFolder()
    : m_Path(fs::temp_directory_path() / ("rhombic-trust-" + std::to_string(getpid())))
  {
    fs::create_directory(m_Path);
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    fs::remove_all(m_Path, ignored);
  }
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &
  operator=(const ScratchFolder &) = delete;

  const fs::path &
  GetPath() const
  {
    return m_Path;
  }

private:
  fs::path m_Path;
};

/** What a file says about the surface written to it: an STL, whose reader has to find out which points are the same. */
itk::TriangleSurfaceAudit
AuditFile(const itk::TriangleSurface & surface, const ScratchFolder & folder)
{
  const fs::path path = folder.GetPath() / "surface.stl";
  WriteSurfaces({ { "surface", &surface } }, path);
  return AuditTriangleSurface(*ReadSurfaces(path).front().surface);
}

double
SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string
NameOf(Mode mode)
{
  std::ostringstream name;
  name << mode;
  return name.str();
}

nlohmann::json
ToJSON(const itk::TriangleSurfaceAudit & audit)
{
  return { { "triangles", audit.triangles },
           { "components", audit.topology.components },
           { "genus", audit.topology.genus },
           { "watertight", audit.IsWatertight() },
           { "boundary_edges", audit.topology.boundaryEdges },
           { "non_manifold", audit.topology.nonManifoldEdges + audit.topology.nonManifoldPoints },
           { "degenerate", audit.topology.degenerateTriangles },
           { "misfacing_shells", audit.shells.misfacing },
           { "crossing_pairs", audit.intersections.crossingPairs },
           { "touching_pairs", audit.intersections.touchingPairs },
           { "volume", audit.volume } };
}

/** One surface in one mode: audited as a file, simplified, audited again. */
nlohmann::json
Judge(const FCCVolume & lattice, const Scan & scan, double isovalue, Mode mode, const Options & options)
{
  SurfaceRequest request;
  request.name = "surface";
  request.isovalue = isovalue;
  const auto * const grid = IsSlanted(scan) ? nullptr : &GeometryOf(scan.image);
  const double spacing = std::visit([](const auto & image) { return MeanSpacingOf(*image); }, lattice);
  const auto surface = itk::TriangleSurface::New();
  surface->Graft(LatticeToSurfaces(lattice, { request }, mode, {}, grid).front().surface);
  RefineSurface(*surface, {}, spacing, "surface", {});
  const ScratchFolder folder;
  auto start = std::chrono::steady_clock::now();
  const auto before = AuditFile(*surface, folder);
  nlohmann::json result{ { "isovalue", isovalue }, { "mode", NameOf(mode) }, { "before", ToJSON(before) } };
  result["audit_seconds"] = SecondsSince(start);
  result["triangles"] = before.triangles;

  const auto simplified = itk::TriangleSurface::New();
  simplified->Graft(surface);
  SurfaceFinish finish;
  finish.share = options.share / 100.0;
  finish.maximumError = options.spacings * spacing;
  start = std::chrono::steady_clock::now();
  const Refinement refinement = RefineSurface(*simplified, finish, spacing, "surface", {});
  result["simplification_seconds"] = SecondsSince(start);
  const auto after = AuditFile(*simplified, folder);
  const SimplificationResult & done = refinement.simplification.value();
  std::ostringstream end;
  end << done.triangles.end;
  result["after"] = ToJSON(after);
  result["ended_by"] = end.str();
  result["maximum_error"] = options.spacings * spacing;
  result["mean_distance"] = done.meanDistance;
  result["maximum_distance"] = done.maximumDistance;
  return result;
}

/** "ok", or what is wrong. */
std::string
Verdict(const nlohmann::json & audit)
{
  if (audit["watertight"].get<bool>())
  {
    return "ok";
  }
  return audit["boundary_edges"].dump() + "/" + audit["non_manifold"].dump() + "/" + audit["degenerate"].dump() + "/" +
         audit["misfacing_shells"].dump();
}

std::vector<std::string>
ToRow(const nlohmann::json & result)
{
  const auto & before = result["before"];
  const auto & after = result["after"];
  const auto triangles = [](const nlohmann::json & audit) { return audit["triangles"].dump(); };
  return { Fixed(result["isovalue"], 1),
           result["mode"],
           triangles(before),
           Verdict(before),
           before["crossing_pairs"].dump(),
           Fixed(result["audit_seconds"], 1),
           triangles(after),
           Fixed(100.0 * after["triangles"].get<double>() / before["triangles"].get<double>(), 1),
           Verdict(after),
           after["crossing_pairs"].dump(),
           Fixed(100.0 * (after["volume"].get<double>() / before["volume"].get<double>() - 1.0), 3),
           Fixed(result["mean_distance"], 3),
           Fixed(result["maximum_distance"], 3),
           result["ended_by"],
           Fixed(result["simplification_seconds"], 1) };
}

void
Run(const Options & options)
{
  UseThreads(options.threads);
  Scan scan = ReadScan(options.scan);
  if (options.removesTable)
  {
    RemoveTable(scan, {});
  }
  const FCCVolume lattice = ScanToLattice(scan, {}, {});
  TextTable table({ "isovalue",
                    "mode",
                    "triangles",
                    "file",
                    "crossings",
                    "audit s",
                    "simplified",
                    "%",
                    "file",
                    "crossings",
                    "volume %",
                    "mean mm",
                    "max mm",
                    "ended by",
                    "s" });
  nlohmann::json report{ { "results", nlohmann::json::array() } };
  for (const double isovalue : options.isovalues)
  {
    for (const Mode mode : { Mode::Lean, Mode::Fine, Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds })
    {
      const bool isChosen = std::any_of(options.modes.begin(), options.modes.end(), [mode](std::string name) {
        name[0] = static_cast<char>(std::toupper(name[0]));
        return name == NameOf(mode);
      });
      if (options.modes.empty() || isChosen)
      {
        std::cerr << isovalue << ' ' << NameOf(mode) << "...\n";
        report["results"].push_back(Judge(lattice, scan, isovalue, mode, options));
        table.Add(ToRow(report["results"].back()));
      }
    }
  }
  table.Print(std::cout);
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
  CLI::App app{ "Whether surfaces of a scan are watertight as files, in every mode, before and after simplification",
                "rhombic-trust" };
  app.add_option("--scan", options.scan, "anything that rhombic reads")->required();
  app.add_option("-t,--threshold", options.isovalues, "isovalue; repeatable")->required()->allow_extra_args(false);
  app.add_flag("--remove-table", options.removesTable, "the scan is a CT in HU: its table is removed");
  app.add_option("--mode", options.modes, "only this mode; repeatable")->allow_extra_args(false);
  app.add_option("--share", options.share, "triangles kept by simplification, in %")->capture_default_str();
  app.add_option("--max-error", options.spacings, "of simplification, in spacings of the lattice")
    ->capture_default_str();
  app.add_option("--threads", options.threads, "number of threads")->capture_default_str();
  app.add_option("--json", options.json, "also write a report");
  return RunBenchmark(app, argc, argv, [&options] { Run(options); });
}
