#include "rhombicScanOptions.h"

#include "rhombicFailure.h"

#include <map>

namespace rhombic
{
namespace
{

/** One number for all axes, or one for each; 0 for none. */
std::array<double, 3>
ToSpacing(const std::vector<double> & numbers)
{
  switch (numbers.size())
  {
    case 0:
      return {};
    case 1:
      return { numbers[0], numbers[0], numbers[0] };
    case 3:
      return { numbers[0], numbers[1], numbers[2] };
    default:
      throw Failure(FailureKind::Usage, "--spacing takes one number or three; write --spacing 1.5 or 1,1,2 (mm).");
  }
}

/** \param accept the word for Policy::Accept; "error" is the other one */
ScanReadOptions::Policy
ParsePolicy(const std::string & option, const std::string & text, const std::string & accept)
{
  using Policy = ScanReadOptions::Policy;
  return FindNamed<Policy>(option, text, { { accept, Policy::Accept }, { "error", Policy::Refuse } });
}

} // namespace

const SettingsTable<ScanOptions> &
ScanOptions::SourceTable()
{
  static const SettingsTable<ScanOptions> table{
    { "SCAN",
      &ScanOptions::scan,
      "DICOM folder, NIfTI, NRRD or MetaImage file, folder of masks, or a lattice volume (.fcc.nrrd)",
      OfKind(SettingKind::Source) },
    { "--series",
      &ScanOptions::series,
      "which DICOM series: id, UID, position in the list or SeriesNumber (default: the one with at least twice as many "
      "slices as any other)",
      OfKind(SettingKind::Source) },
    { "--frame",
      &ScanOptions::frame,
      "which volume of a file that holds several, from 0",
      Checked(CLI::NonNegativeNumber) },
    { "--on-irregular",
      &ScanOptions::onIrregular,
      "tilted, sheared or unevenly spaced scans: resample from their true positions, or error",
      ShowingDefault },
    { "--on-gap",
      &ScanOptions::onGap,
      "missing or damaged slices: error, or interpolate across the gap",
      ShowingDefault },
    { "--max-memory",
      &ScanOptions::maximumMemory,
      "most memory for a volume, and then for a picture, as 8G or 500M (default: half of what is free)",
      DefaultsTo("RHOMBIC_MAX_MEMORY"),
      InBytes,
      OfKind(SettingKind::Run) },
    { "--analyze", &ScanOptions::acceptsAnalyze, "read Analyze 7.5 files, in which left and right are not defined" },
    { "--follow-links", &ScanOptions::followsLinks, "follow symbolic links in folders" },
  };
  return table;
}

const SettingsTable<ScanOptions> &
ScanOptions::LatticeTable()
{
  static const SettingsTable<ScanOptions> table{
    { "--density",
      &ScanOptions::density,
      "lattice sites per sample of the scan (this and the next three: without effect when SCAN is a lattice volume)",
      ShowingDefault },
    { "--spacing",
      &ScanOptions::spacing,
      "lattice spacing in mm, one number or x,y,z, instead of a density",
      SplitAtCommas,
      Checked(CLI::PositiveNumber) },
    { "--kernel",
      &ScanOptions::kernel,
      "how values between samples are computed: cubic (B-spline), linear or lanczos",
      ShowingDefault },
    { "--nested",
      &ScanOptions::isNested,
      "instead: every other sample of the scan, without interpolation, after a half-band filter; density 0.5",
      Excludes({ "--density", "--spacing", "--kernel" }) },
    { "--denoise",
      &ScanOptions::denoising,
      "remove noise before surfaces are made: gaussian:SIGMA in mm; or edges:SIGMA,EDGE, which keeps gradients above "
      "EDGE, in the scan's units per mm, and is slow; or none (default: what the preset asks for, see render "
      "--list-presets)" },
  };
  return table;
}

const SettingsTable<ScanOptions> &
ScanOptions::SidecarTable()
{
  static const SettingsTable<ScanOptions> table{
    { "--no-sidecar",
      &ScanOptions::hasNoSidecar,
      "do not write the report beside each output (OUTPUT.json)",
      OfKind(SettingKind::Run) },
  };
  return table;
}

Provenance
ScanOptions::GetProvenance(const CommandSettings & command) const
{
  return { "Rhombic " RHOMBIC_VERSION, command.GetRecordedCommand(), command.GetRecorded(), !hasNoSidecar };
}

ScanSource
ScanOptions::GetSource() const
{
  if (scan.empty())
  {
    throw Failure(FailureKind::Usage, "No scan is given; name a DICOM folder or a volume file (see --help).");
  }
  ScanSource source;
  source.path = scan;
  source.isHashed = !hasNoSidecar;
  source.read.series = series;
  source.read.frame = frame;
  source.read.onTilted = ParsePolicy("--on-irregular", onIrregular, "resample");
  source.read.onUneven = source.read.onTilted;
  source.read.onGap = ParsePolicy("--on-gap", onGap, "interpolate");
  source.read.maximumMemory = maximumMemory;
  source.read.acceptsAnalyze = acceptsAnalyze;
  source.read.followsLinks = followsLinks;
  source.lattice.density = density;
  source.lattice.spacing = ToSpacing(spacing);
  source.lattice.kernel = FindNamed<itk::SeparableKernel>("kernel",
                                                          kernel,
                                                          { { "cubic", itk::SeparableKernel::CubicBSpline },
                                                            { "linear", itk::SeparableKernel::Linear },
                                                            { "lanczos", itk::SeparableKernel::Lanczos4 } });
  source.lattice.denoising = denoising.empty() ? Denoising() : ParseDenoising(denoising);
  source.lattice.nested = isNested;
  source.lattice.maximumMemory = source.read.maximumMemory;
  return source;
}

void
ScanOptions::ApplyPreset(const Preset & preset, ScanSource & source) const
{
  if (denoising.empty())
  {
    source.lattice.denoising = preset.denoising;
  }
}

} // namespace rhombic
