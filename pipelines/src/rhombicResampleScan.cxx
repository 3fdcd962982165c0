#include "rhombicResampleScan.h"

#include "rhombicFailure.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanReport.h"
#include "rhombicScanWriter.h"
#include "rhombicSourceLoading.h"

namespace rhombic
{
namespace
{

Report
ReportInput(const ResampleScanSettings & settings, const std::vector<std::filesystem::path> & files)
{
  return settings.source.isHashed ? Report{ { "input", ReportFiles(files) } } : Report::object();
}

void
StageLattice(const Scan & scan, const ResampleScanSettings & settings, const Events & events, StagedFiles & staged)
{
  const FCCVolume volume =
    ScanToLattice(OrderAlongPatient(scan, settings.source.lattice.maximumMemory), settings.source.lattice, events);
  events.Progress("writing", 0.0);
  StageFCCImage(volume, settings.volume, staged);
  Report report = ReportInput(settings, scan.files);
  report["scan"] = ReportWithoutNames(scan, settings.source.path);
  report["denoising"] = ReportDenoising(settings.source.lattice.denoising);
  report["lattice"] = ReportLattice(volume);
  StageSidecar(settings.volume, settings.provenance, report, staged);
}

void
StageGrid(const FCCVolume & volume, const ResampleScanSettings & settings, const Events & events, StagedFiles & staged)
{
  const LatticeSettings & lattice = settings.source.lattice;
  const FCCVolume denoised = DenoiseLattice(volume, lattice.denoising, lattice.maximumMemory, events);
  const ScanImage image = LatticeToScan(denoised, lattice.spacing, events);
  events.Progress("writing", 0.0);
  StageScan(image, settings.volume, staged);
  Report report = ReportInput(settings, { settings.source.path });
  report["denoising"] = ReportDenoising(lattice.denoising);
  report["lattice"] = ReportLattice(denoised);
  StageSidecar(settings.volume, settings.provenance, report, staged);
}

/** Throws Failure(Usage) for an extension that the kind of volume can't be written with. */
void
CheckVolumePath(const ResampleScanSettings & settings)
{
  if (IsFCCImageFile(settings.source.path))
  {
    CheckScanPath(settings.volume);
  }
  else if (settings.volume.extension() != ".nrrd")
  {
    throw Failure(FailureKind::Usage,
                  "A lattice volume is a NRRD file; give " + settings.volume.string() + " the extension .nrrd.");
  }
}

} // namespace

std::vector<std::filesystem::path>
CheckResampleScan(const ResampleScanSettings & settings)
{
  CheckScanPath(settings.volume);
  return WithSidecars({ settings.volume }, settings.provenance);
}

std::vector<MadeFile>
ResampleScan(const ResampleScanSettings & settings, const Events & events)
{
  CheckVolumePath(settings);
  CheckOutputs(CheckResampleScan(settings), settings.source);
  const SourceVolume volume = LoadVolume(settings.source, events);
  StagedFiles staged;
  if (const auto * const scan = std::get_if<Scan>(&volume))
  {
    StageLattice(*scan, settings, events, staged);
  }
  else
  {
    StageGrid(std::get<FCCVolume>(volume), settings, events, staged);
  }
  staged.Commit();
  events.Progress("writing", 1.0);
  std::vector<MadeFile> outputs{ { settings.volume, "volume" } };
  AddSidecars(settings.provenance, outputs);
  return outputs;
}

} // namespace rhombic
