#include "rhombicFailure.h"
#include "rhombicJSONFile.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicMachine.h"
#include "rhombicRunBenchmark.h"
#include "rhombicReadScan.h"
#include "rhombicSurfaceFinish.h"
#include "rhombicSurfaceDeviation.h"
#include "rhombicSurfaceMeasures.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTableRemoval.h"
#include "rhombicTextTable.h"

#include "itkTriangleSurfaceAudit.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
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
  std::string scans; ///< folder of the page's scans
  std::string page;
};

constexpr Mode allModes[]{ Mode::Lean, Mode::Fine, Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds };

/** A surface of the page, of a scan in the folder of scans. */
struct PageSurface
{
  const char * scan;
  double isovalue;
};

constexpr PageSurface pageSurfaces[]{ { "ct_head_ge8800_dicom", 500.5 },
                                      { "ct_head_ge8800_dicom", 1150.5 },
                                      { "ct_mr_dicom2stl_nifti/ct_example.nii.gz", -300.5 },
                                      { "ct_mr_dicom2stl_nifti/ct_example.nii.gz", 300.5 },
                                      { "ct_mr_dicom2stl_nifti/mri_t1_example.nii.gz", 150.5 },
                                      { "frog_labels_metaimage/HeadMRVolume.mhd", 50.5 },
                                      { "nifti_orientations_48/ASR.nii.gz", 30.5 },
                                      { "nifti_awkward/avg152T1_LR_nifti.nii.gz", 100.5 },
                                      { "ct_body_totalseg_nifti/example_ct_sm.nii.gz", 150.5 },
                                      { "ct_body_totalseg_nifti/example_ct.nii.gz", -300.5 },
                                      { "ct_body_totalseg_nifti/example_ct.nii.gz", 250.5 },
                                      { "ct_body_totalseg_nifti/ct_aorta_cropped.nii.gz", 150.5 },
                                      { "pet_slope_per_slice_dicom_rle", 2000.5 },
                                      { "ct_head_tilt_varspacing_dicom_rle", -300.5 },
                                      { "ct_head_tilt_varspacing_dicom_rle", 300.5 },
                                      { "ct_body_totalseg_dicom_j2k", 200.5 },
                                      { "ct_chest_lidc0314_dicom_jpegls", 250.5 },
                                      { "mr_head_t1_defaced_dicom_j2k", 24.5 } };

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

double
SpacingOf(const FCCVolume & lattice)
{
  return std::visit([](const auto & image) { return MeanSpacingOf(*image); }, lattice);
}

const itk::ImageBase<3> *
GridOf(const Scan & scan)
{
  return IsSlanted(scan) ? nullptr : &GeometryOf(scan.image);
}

/** A surface as `rhombic mesh` makes it, without finishing. */
itk::TriangleSurface::Pointer
MakeSurface(const FCCVolume & lattice, const Scan & scan, double isovalue, Mode mode)
{
  SurfaceRequest request;
  request.name = "surface";
  request.isovalue = isovalue;
  auto surface = itk::TriangleSurface::New();
  surface->Graft(LatticeToSurfaces(lattice, { request }, mode, {}, GridOf(scan)).front().surface);
  RefineSurface(*surface, {}, SpacingOf(lattice), "surface", {});
  return surface;
}

/** One surface in one mode: audited as a file, simplified, audited again. */
nlohmann::json
Judge(const FCCVolume & lattice, const Scan & scan, double isovalue, Mode mode, const Options & options)
{
  const double spacing = SpacingOf(lattice);
  const auto surface = MakeSurface(lattice, scan, isovalue, mode);
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

/** A row of the page: one surface in one mode, as its file has it; and whether it bounds a solid. */
std::pair<std::string, bool>
PageRow(const FCCVolume & lattice, const Scan & scan, const PageSurface & wanted, Mode mode)
{
  const auto surface = MakeSurface(lattice, scan, wanted.isovalue, mode);
  const auto audit = AuditFile(*surface, ScratchFolder());
  Threshold threshold;
  threshold.isovalue = wanted.isovalue;
  const IsosurfaceVolume volume = EstimateIsosurfaceVolume(lattice, threshold, audit.area, GridOf(scan));
  const SurfaceDeviation deviation = ComputeDeviation(*surface, scan, itk::SeparableKernel::CubicBSpline, threshold);
  std::ostringstream row;
  row << "| " << wanted.scan << " | " << Fixed(wanted.isovalue, 1) << " | " << NameOf(mode) << " | " << audit.triangles
      << " | " << Verdict(ToJSON(audit)) << " | " << audit.intersections.crossingPairs
      << (audit.intersections.isSampled ? " in a sample" : "") << " | " << Fixed(audit.volume / 1000.0, 2) << " | "
      << Fixed(100.0 * volume.GetErrorOf(audit.volume), 2) << " ± " << Fixed(100.0 * volume.GetRelativeUncertainty(), 2)
      << " | " << Fixed(deviation.mean, 3) << " | " << Fixed(deviation.percentile95, 3) << " | "
      << Fixed(deviation.maximum, 3) << " |\n";
  return { row.str(), audit.BoundsSolid() };
}

/** All surfaces of the page, in all modes. */
void
WritePage(const Options & options)
{
  UseThreads(options.threads);
  std::ostringstream page;
  page << "# Whether surfaces of scans can be trusted\n\n"
          "`rhombic-trust --scans SCANS --page pipelines/comparison/TRUST.md` makes this page.\n"
          "[Benchmarks](../../tests/benchmarks/README.md) explain the columns.\n\n"
          "| scan | isovalue | mode | triangles | file | crossings | volume ml | volume error % | mean mm | 95 % mm | "
          "max mm |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  unsigned int rows = 0;
  unsigned int solids = 0;
  std::string read;
  std::optional<Scan> scan;
  std::optional<FCCVolume> lattice;
  for (const PageSurface & wanted : pageSurfaces)
  {
    if (read != wanted.scan)
    {
      lattice.reset();
      scan = ReadScan(fs::path(options.scans) / wanted.scan);
      lattice = ScanToLattice(*scan, {}, {});
      read = wanted.scan;
    }
    for (const Mode mode : allModes)
    {
      const auto [row, isSolid] = PageRow(*lattice, *scan, wanted, mode);
      std::cerr << row;
      page << row;
      ++rows;
      solids += isSolid ? 1 : 0;
    }
  }
  page << "\nWatertight and without crossings: " << solids << " of " << rows << ".\n";
  std::ofstream(options.page) << page.str();
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
    for (const Mode mode : allModes)
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
  auto * const scan = app.add_option("--scan", options.scan, "anything that rhombic reads");
  auto * const isovalues = app.add_option("-t,--threshold", options.isovalues, "isovalue; repeatable");
  scan->needs(isovalues);
  isovalues->needs(scan)->allow_extra_args(false);
  auto * const scans = app.add_option("--scans", options.scans, "instead of --scan: folder of the scans of a page");
  auto * const page = app.add_option("--page", options.page, "Markdown file of all surfaces of these scans");
  scans->needs(page)->excludes(scan);
  page->needs(scans);
  app.add_flag("--remove-table", options.removesTable, "the scan is a CT in HU: its table is removed");
  app.add_option("--mode", options.modes, "only this mode; repeatable")->allow_extra_args(false);
  app.add_option("--share", options.share, "triangles kept by simplification, in %")->capture_default_str();
  app.add_option("--max-error", options.spacings, "of simplification, in spacings of the lattice")
    ->capture_default_str();
  app.add_option("--threads", options.threads, "number of threads")->capture_default_str();
  app.add_option("--json", options.json, "also write a report");
  return RunBenchmark(app, argc, argv, [&options] {
    if (options.scan.empty() && options.page.empty())
    {
      throw Failure(FailureKind::Usage, "No scan is named; use --scan with -t, or --scans with --page.");
    }
    options.page.empty() ? Run(options) : WritePage(options);
  });
}
