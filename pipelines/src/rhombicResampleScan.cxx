#include "rhombicResampleScan.h"

#include "rhombicFailure.h"
#include "rhombicPatientAxes.h"
#include "rhombicScanReport.h"
#include "rhombicScanWriter.h"

namespace rhombic
{
namespace
{

/** Writes the lattice of a scan; returns its report. */
Report
StageLattice(const Scan & scan, const ResampleScanSettings & settings, const Events & events, StagedFiles & staged)
{
  const LatticeSettings & lattice = settings.source.lattice;
  LatticeStream stream;
  const FCCVolume volume = ScanToLattice(
    OrderAlongPatient(scan, lattice.maximumMemory, settings.source.read.temporaryFolder), lattice, events, &stream);
  events.Progress("writing", 0.0);
  StageFCCImage(volume, settings.volume, staged);
  return { { "scan", ReportWithoutNames(scan, settings.source.path) },
           { "denoising", ReportDenoising(lattice.denoising) },
           { "lattice", ReportLattice(volume) } };
}

/** Writes the grid of a lattice volume; returns its report. */
Report
StageGrid(const FCCVolume & volume, const ResampleScanSettings & settings, const Events & events, StagedFiles & staged)
{
  const LatticeSettings & lattice = settings.source.lattice;
  const FCCVolume denoised = DenoiseLattice(volume, lattice.denoising, lattice.maximumMemory, events);
  const ScanImage image = LatticeToScan(denoised, lattice.spacing, events);
  events.Progress("writing", 0.0);
  StageScan(image, settings.volume, staged);
  return { { "denoising", ReportDenoising(lattice.denoising) }, { "lattice", ReportLattice(denoised) } };
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
  const auto * const scan = std::get_if<Scan>(&volume);
  OutputFiles outputs{ settings.provenance };
  Report report = Report::object();
  if (settings.source.isHashed)
  {
    report["input"] = ReportFiles(scan != nullptr ? scan->files : std::vector{ settings.source.path });
  }
  report.update(scan != nullptr ? StageLattice(*scan, settings, events, outputs.staged)
                                : StageGrid(std::get<FCCVolume>(volume), settings, events, outputs.staged));
  AddOutput(settings.volume, "volume", report, outputs);
  outputs.staged.Commit();
  events.Progress("writing", 1.0);
  return outputs.made;
}

} // namespace rhombic
