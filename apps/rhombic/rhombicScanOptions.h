#ifndef rhombicScanOptions_h
#define rhombicScanOptions_h

#include "rhombicScanPipeline.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace rhombic
{

/** \class ScanOptions
 * \brief The options that say where a scan is and how it gets onto the lattice, shared by several commands. */
class ScanOptions
{
public:
  /** The scan and, for DICOM folders, its series. */
  void
  AddSource(CLI::App & parser);

  /** Density, spacing, kernel, or the nested lattice. */
  void
  AddLattice(CLI::App & parser);

  /** How surfaces are extracted from the lattice. */
  void
  AddExtraction(CLI::App & parser);

  /** What was parsed. Throws Failure(Usage). */
  ScanSource
  GetSource() const;

  /** What was parsed. Throws Failure(Usage). */
  itk::FCCIsosurfaceMode
  GetMode() const;

private:
  std::string m_Path;
  std::string m_Series;
  double m_Density = itk::FCCLattice::NyquistDensity;
  std::string m_Spacing;
  std::string m_Kernel = "cubic";
  std::string m_Mode = "lean";
  bool m_Nested = false;
};

} // namespace rhombic

#endif
