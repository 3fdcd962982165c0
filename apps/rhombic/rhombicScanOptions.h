#ifndef rhombicScanOptions_h
#define rhombicScanOptions_h

#include "rhombicCommands.h"
#include "rhombicScanPipeline.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>

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

  /** How surfaces are extracted from the lattice. */
  void
  AddExtraction(CLI::App & parser);

  /** Whether the scanner's table is removed. */
  void
  AddTable(CLI::App & parser);

  /** Whether reports are written beside outputs. */
  void
  AddSidecar(CLI::App & parser);

  /** For the outputs of a command on the source. */
  Provenance
  GetProvenance(const CommandContext & context) const;

  /** What was parsed, to be read with the program's decoder. Throws Failure(Usage). */
  ScanSource
  GetSource(const CommandContext & context) const;

  /** What was parsed. Throws Failure(Usage). */
  itk::FCCIsosurfaceMode
  GetMode() const;

  /** What was parsed; a preset may say that the scan is a CT. */
  TableRule
  GetTable(bool isRemovedByPreset) const;

private:
  std::string m_Path;
  std::string m_Series;
  std::string m_OnIrregular = "resample";
  std::string m_OnGap = "error";
  std::string m_MaximumMemory;
  std::optional<std::size_t> m_Frame;
  bool m_AcceptsAnalyze = false;
  bool m_FollowsLinks = false;
  bool m_HasNoSidecar = false;
  bool m_KeepsTable = false;
  double m_Density = itk::FCCLattice::NyquistDensity;
  std::string m_Spacing;
  std::string m_Kernel = "cubic";
  std::string m_Denoising = "none";
  std::string m_Mode = "lean";
  bool m_Nested = false;
};

} // namespace rhombic

#endif
