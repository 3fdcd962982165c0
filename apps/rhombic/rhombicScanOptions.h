#ifndef rhombicScanOptions_h
#define rhombicScanOptions_h

#include "rhombicCommands.h"
#include "rhombicPresets.h"
#include "rhombicScanSource.h"
#include "rhombicSidecar.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class ScanOptions
 * \brief The options of several commands for reading a scan and resampling it onto the lattice. */
class ScanOptions
{
public:
  /** Adds the scan, and options for its series, frame, irregular slices and memory. */
  void
  AddSource(CLI::App & parser);

  /** Adds density, spacing, kernel, nested lattice and denoising. */
  void
  AddLattice(CLI::App & parser);

  /** Adds the option to leave out sidecars. */
  void
  AddSidecar(CLI::App & parser);

  /** Provenance of the command's outputs.
   * \param names further arguments that may name the patient (see DescribeArguments()) */
  Provenance
  GetProvenance(const CommandContext & context, std::map<std::string, std::string> names = {}) const;

  /** The parsed source, to be read with the program's decoder. Throws Failure(Usage). */
  ScanSource
  GetSource(const CommandContext & context) const;

  /** Denoises the source as the preset asks for, unless --denoise is given. */
  void
  ApplyPreset(const Preset & preset, ScanSource & source) const;

private:
  std::string m_Path;
  std::string m_Series;
  std::string m_OnIrregular = "resample";
  std::string m_OnGap = "error";
  std::uint64_t m_MaximumMemory = 0;
  std::optional<std::size_t> m_Frame;
  bool m_AcceptsAnalyze = false;
  bool m_FollowsLinks = false;
  bool m_HasNoSidecar = false;
  double m_Density = itk::FCCLattice::DefaultDensity;
  std::vector<double> m_Spacing;
  std::string m_Kernel = "cubic";
  std::string m_Denoising;
  bool m_Nested = false;
};

} // namespace rhombic

#endif
