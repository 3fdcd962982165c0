#ifndef rhombicScanOptions_h
#define rhombicScanOptions_h

#include "rhombicCommands.h"
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
 * \brief The options that say where a scan is and how it gets onto the lattice, shared by several commands. */
class ScanOptions
{
public:
  /** The scan, which of its parts to read, and what to accept. */
  void
  AddSource(CLI::App & parser);

  /** Density, spacing, kernel, or the nested lattice; noise. */
  void
  AddLattice(CLI::App & parser);

  /** Whether reports are written beside outputs. */
  void
  AddSidecar(CLI::App & parser);

  /** For the outputs of a command on the source. \param names what else than the source may name the patient, by what
   * takes its place (see DescribeCommandLine()) */
  Provenance
  GetProvenance(const CommandContext & context, std::map<std::string, std::string> names = {}) const;

  /** What was parsed, to be read with the program's decoder. Throws Failure(Usage). */
  ScanSource
  GetSource(const CommandContext & context) const;

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
  double m_Density = itk::FCCLattice::NyquistDensity;
  std::vector<double> m_Spacing;
  std::string m_Kernel = "cubic";
  std::string m_Denoising = "none";
  bool m_Nested = false;
};

} // namespace rhombic

#endif
