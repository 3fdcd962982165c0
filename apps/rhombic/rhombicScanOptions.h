#ifndef rhombicScanOptions_h
#define rhombicScanOptions_h

#include "rhombicCommands.h"
#include "rhombicPresets.h"
#include "rhombicScanSource.h"
#include "rhombicSidecar.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class ScanOptions
 * \brief The settings of several commands for reading a scan and resampling it onto the lattice. */
struct ScanOptions
{
  std::string scan;
  std::string series;
  std::optional<std::size_t> frame;
  std::size_t level = 0;
  std::string voxelSize;
  std::string raw;
  std::string onIrregular = "resample";
  std::string onGap = "error";
  std::uint64_t maximumMemory = 0;
  std::string temporaryFolder;
  bool acceptsAnalyze = false;
  bool followsLinks = false;
  double density = itk::FCCLattice::DefaultDensity;
  std::vector<double> spacing;
  std::string kernel = "cubic";
  bool isNested = false;
  std::string denoising;
  bool hasNoSidecar = false;

  /** The scan, its series and frame, irregular slices and memory. */
  static const SettingsTable<ScanOptions> &
  SourceTable();

  /** Density, spacing, kernel, nested lattice and denoising. */
  static const SettingsTable<ScanOptions> &
  LatticeTable();

  /** Whether outputs have sidecars. */
  static const SettingsTable<ScanOptions> &
  SidecarTable();

  /** Provenance of the command's outputs. */
  Provenance
  GetProvenance(const CommandSettings & command) const;

  /** The source. Throws Failure(Usage). */
  ScanSource
  GetSource() const;

  /** Denoises the source as the preset asks for, unless \a denoising is given. */
  void
  ApplyPreset(const Preset & preset, ScanSource & source) const;
};

} // namespace rhombic

#endif
