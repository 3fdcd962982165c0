#include "rhombicScanOptions.h"

#include "rhombicFailure.h"
#include "rhombicNamedValues.h"

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
  return FindNamed(option, text, NamedValues<Policy>{ { accept, Policy::Accept }, { "error", Policy::Refuse } });
}

} // namespace

void
ScanOptions::AddSource(CLI::App & parser)
{
  parser.add_option(
    "SCAN", m_Path, "DICOM folder, NIfTI, NRRD or MetaImage file, folder of masks, or a lattice volume (.fcc.nrrd)");
  parser.add_option("--series",
                    m_Series,
                    "which DICOM series: id, UID, position in the list or SeriesNumber (default: the one with at least "
                    "twice as many slices as any other)");
  parser.add_option("--frame", m_Frame, "which volume of a file that holds several, from 0")
    ->check(CLI::NonNegativeNumber);
  parser
    .add_option("--on-irregular",
                m_OnIrregular,
                "tilted, sheared or unevenly spaced scans: resample from their true positions, or error")
    ->capture_default_str();
  parser.add_option("--on-gap", m_OnGap, "missing or damaged slices: error, or interpolate across the gap")
    ->capture_default_str();
  parser
    .add_option("--max-memory",
                m_MaximumMemory,
                "most memory for a volume, and then for a picture, as 8G or 500M (default: half of what is free)")
    ->envname("RHOMBIC_MAX_MEMORY")
    ->transform(CLI::AsSizeValue(false));
  parser.add_flag("--analyze", m_AcceptsAnalyze, "read Analyze 7.5 files, in which left and right are not defined");
  parser.add_flag("--follow-links", m_FollowsLinks, "follow symbolic links in folders");
}

void
ScanOptions::AddLattice(CLI::App & parser)
{
  CLI::Option * const density =
    parser
      .add_option(
        "--density",
        m_Density,
        "lattice sites per sample of the scan (this and the next three: without effect when SCAN is a lattice volume)")
      ->capture_default_str();
  CLI::Option * const spacing =
    parser.add_option("--spacing", m_Spacing, "lattice spacing in mm, one number or x,y,z, instead of a density")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber);
  CLI::Option * const kernel =
    parser
      .add_option("--kernel", m_Kernel, "how values between samples are computed: cubic (B-spline), linear or lanczos")
      ->capture_default_str();
  parser
    .add_flag("--nested",
              m_Nested,
              "instead: every other sample of the scan, without interpolation, after a half-band filter; density 0.5")
    ->excludes(density)
    ->excludes(spacing)
    ->excludes(kernel);
  parser.add_option(
    "--denoise",
    m_Denoising,
    "remove noise before surfaces are made: gaussian:SIGMA in mm; or edges:SIGMA,EDGE, which keeps gradients "
    "above EDGE, in the scan's units per mm, and is slow; or none (default: what the preset asks for, see render "
    "--list-presets)");
}

void
ScanOptions::AddSidecar(CLI::App & parser)
{
  parser.add_flag("--no-sidecar", m_HasNoSidecar, "do not write the report beside each output (OUTPUT.json)");
}

Provenance
ScanOptions::GetProvenance(const CommandContext & context, std::map<std::string, std::string> names) const
{
  names["SCAN"] = m_Path;
  names["SERIES"] = m_Series;
  return { "Rhombic " RHOMBIC_VERSION, DescribeArguments(context.arguments, names), !m_HasNoSidecar };
}

ScanSource
ScanOptions::GetSource(const CommandContext & context) const
{
  static const NamedValues<itk::SeparableKernel> kernels{ { "cubic", itk::SeparableKernel::CubicBSpline },
                                                          { "linear", itk::SeparableKernel::Linear },
                                                          { "lanczos", itk::SeparableKernel::Lanczos4 } };
  if (m_Path.empty())
  {
    throw Failure(FailureKind::Usage, "No scan is given; name a DICOM folder or a volume file (see --help).");
  }
  ScanSource source;
  source.path = m_Path;
  source.isHashed = !m_HasNoSidecar;
  source.read.series = m_Series;
  source.read.frame = m_Frame;
  source.read.onTilted = ParsePolicy("--on-irregular", m_OnIrregular, "resample");
  source.read.onUneven = source.read.onTilted;
  source.read.onGap = ParsePolicy("--on-gap", m_OnGap, "interpolate");
  source.read.maximumMemory = m_MaximumMemory;
  source.read.acceptsAnalyze = m_AcceptsAnalyze;
  source.read.followsLinks = m_FollowsLinks;
  source.read.decoder = context.decoder;
  source.lattice.density = m_Density;
  source.lattice.spacing = ToSpacing(m_Spacing);
  source.lattice.kernel = FindNamed("kernel", m_Kernel, kernels);
  source.lattice.denoising = m_Denoising.empty() ? Denoising() : ParseDenoising(m_Denoising);
  source.lattice.nested = m_Nested;
  source.lattice.maximumMemory = source.read.maximumMemory;
  return source;
}

void
ScanOptions::ApplyPreset(const Preset & preset, ScanSource & source) const
{
  if (m_Denoising.empty())
  {
    source.lattice.denoising = preset.denoising;
  }
}

} // namespace rhombic
