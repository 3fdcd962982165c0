#ifndef rhombicSurfaceOptions_h
#define rhombicSurfaceOptions_h

#include "rhombicScanSource.h"

#include <CLI/CLI.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceOptions
 * \brief The options that say which surfaces are made of a scan, shared by several commands. */
class SurfaceOptions
{
public:
  void
  Add(CLI::App & parser);

  /** What was parsed, and maybe one more surface. When there are neither surfaces nor a label map, the scan itself is
   * to be the label map. Throws Failure(Usage). */
  SurfaceSelection
  GetSelection(const std::optional<SurfaceRequest> & further = std::nullopt) const;

  /** What in the options may name the patient (see DescribeCommandLine()). */
  std::map<std::string, std::string>
  GetNames() const
  {
    return { { "LABELS", m_Labels } };
  }

private:
  std::string m_Preset;
  std::vector<std::string> m_Surfaces;
  std::string m_Labels;
  std::string m_LabelTable;
  std::vector<std::string> m_ChosenLabels;
  bool m_KeepsTable = false;
  std::string m_Mode = "lean";
};

} // namespace rhombic

#endif
