#include "rhombicScanOptions.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
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

/** One length or three, separated by commas, in mm or with a unit of length behind the number; nothing for an empty
 * text. */
std::optional<std::array<double, 3>>
ParseVoxelSize(const std::string & text)
{
  static const std::map<std::string, double> units{ { "", 1.0 },         { "mm", 1.0 },       { "um", 1e-3 },
                                                    { "\u00b5m", 1e-3 }, { "\u03bcm", 1e-3 }, { "nm", 1e-6 },
                                                    { "cm", 10.0 } };
  if (text.empty())
  {
    return std::nullopt;
  }
  std::vector<double> lengths;
  for (const std::string & part : Split(text, ","))
  {
    const std::size_t end = std::min(part.find_first_not_of("0123456789.eE+-"), part.size());
    const auto number = ToNumber<double>(part.substr(0, end));
    const auto unit = units.find(part.substr(end));
    if (!number || unit == units.end() || !(*number > 0.0) || !std::isfinite(*number))
    {
      throw Failure(
        FailureKind::Usage,
        "'" + text +
          "' is no size of voxels; write one length or three above 0 for --voxel-size, as 5um, 0.005 (mm) or "
          "5um,5um,10um.");
    }
    lengths.push_back(*number * unit->second);
  }
  if (lengths.size() != 1 && lengths.size() != 3)
  {
    throw Failure(FailureKind::Usage,
                  "--voxel-size takes one length or three; write --voxel-size 5um or 5um,5um,10um.");
  }
  return ToSpacing(lengths);
}

/** The layout of a file of bare voxels, as "2048x2048x2048,uint16,le"; nothing for an empty text. */
std::optional<RawLayout>
ParseRawLayout(const std::string & text)
{
  using Component = itk::IOComponentEnum;
  static const std::map<std::string, Component> types{
    { "uint8", Component::UCHAR },   { "int8", Component::CHAR },     { "uint16", Component::USHORT },
    { "int16", Component::SHORT },   { "uint32", Component::UINT },   { "int32", Component::INT },
    { "uint64", Component::ULONG },  { "int64", Component::LONG },    { "float", Component::FLOAT },
    { "float32", Component::FLOAT }, { "double", Component::DOUBLE }, { "float64", Component::DOUBLE }
  };
  if (text.empty())
  {
    return std::nullopt;
  }
  const std::vector<std::string> parts = Split(LowerCase(text), ",");
  const std::vector<std::string> sizes = Split(parts[0], "x");
  const auto type = parts.size() > 1 ? types.find(parts[1]) : types.end();
  const bool isByte = type != types.end() && (type->second == Component::UCHAR || type->second == Component::CHAR);
  const std::string order = parts.size() > 2 ? parts[2] : isByte ? "le" : "";
  bool isValid = sizes.size() == 3 && type != types.end() && (order == "le" || order == "be") && parts.size() <= 3;
  RawLayout layout;
  for (std::size_t axis = 0; isValid && axis < 3; ++axis)
  {
    layout.size[axis] = ToNumber<std::uint32_t>(sizes[axis]).value_or(0);
    isValid = layout.size[axis] > 0;
  }
  if (!isValid)
  {
    throw Failure(
      FailureKind::Usage,
      "'" + text +
        "' is no layout of bare voxels; write columns x rows x slices, the type (uint8, int16, uint16, int32, "
        "float ...) and the byte order (le or be) for --raw, as 2048x2048x2048,uint16,le.");
  }
  layout.type = type->second;
  layout.isBigEndian = order == "be";
  return layout;
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
      "DICOM folder, NIfTI, NRRD or MetaImage file, OME-Zarr folder, folder of masks or of pictures, or a lattice "
      "volume (.fcc.nrrd)",
      OfKind(SettingKind::Source) },
    { "--series",
      &ScanOptions::series,
      "which DICOM series: id, UID, position in the list or SeriesNumber (default: the one with at least twice as many "
      "slices as any other)",
      OfKind(SettingKind::Source) },
    { "--frame", &ScanOptions::frame, "which volume of a file that holds several, from 0", NotBelowZero },
    { "--level",
      &ScanOptions::level,
      "which level of the pyramid of an OME-Zarr image, from 0, the finest",
      ShowingDefault },
    { "--voxel-size",
      &ScanOptions::voxelSize,
      "the size of a voxel, as 5um, 0.005 (mm) or x,y,z, for --raw, for pictures, and for an OME-Zarr image that does "
      "not tell it" },
    { "--raw",
      &ScanOptions::raw,
      "SCAN is a file of bare voxels: columns x rows x slices, type and byte order, as 2048x2048x2048,uint16,le; with "
      "--voxel-size" },
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
    { "--temporary",
      &ScanOptions::temporaryFolder,
      "folder on a disk for temporary files of what does not fit into --max-memory (default: TMPDIR, else /tmp)",
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
      AboveZero },
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
  source.read.level = level;
  source.read.voxelSize = ParseVoxelSize(voxelSize);
  source.read.raw = ParseRawLayout(raw);
  source.read.onTilted = ParsePolicy("--on-irregular", onIrregular, "resample");
  source.read.onUneven = source.read.onTilted;
  source.read.onGap = ParsePolicy("--on-gap", onGap, "interpolate");
  source.read.maximumMemory = maximumMemory;
  source.read.temporaryFolder = temporaryFolder;
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
