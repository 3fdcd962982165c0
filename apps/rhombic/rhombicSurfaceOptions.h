#ifndef rhombicSurfaceOptions_h
#define rhombicSurfaceOptions_h

#include "rhombicEvents.h"
#include "rhombicPresets.h"
#include "rhombicScanSource.h"

#include <CLI/CLI.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceOptions
 * \brief The options of several commands that select the surfaces of a scan. */
class SurfaceOptions
{
public:
  void
  Add(CLI::App & parser);

  /** The preset; without --preset, one of no surfaces. "auto" reads the source's volume to choose one. Throws Failure.
   */
  Preset
  GetPreset(ScanSource & source, const Events & events) const;

  /** As GetPreset(), but "auto" is one of no surfaces, and nothing is read. */
  Preset
  GetNamedPreset() const;

  /** The parsed selection, with one more surface if given. Without surfaces and label map, the scan itself is taken as
   * the label map. Throws Failure(Usage). */
  SurfaceSelection
  GetSelection(const Preset & preset, const std::optional<SurfaceRequest> & further = std::nullopt) const;

  /** Whether an option names surfaces of a scan or labels. */
  bool
  ChoosesSurfaces() const
  {
    return !m_Preset.empty() || !m_Surfaces.empty() || !m_Labels.empty() || !m_Probabilities.empty() ||
           !m_ChosenLabels.empty();
  }

  /** Which surfaces are shown, and in which colours, by the options; these count more than the rules \a before. Throws
   * Failure(Usage). */
  SceneRules
  GetRules(std::vector<SceneRule> before = {}) const;

  /** Values of options that may name the patient (see DescribeArguments()). */
  std::map<std::string, std::string>
  GetNames() const
  {
    std::map<std::string, std::string> names;
    for (const std::string & path : m_Labels)
    {
      names["LABELS" + (names.empty() ? "" : std::to_string(names.size() + 1))] = path;
    }
    for (const std::string & path : m_Probabilities)
    {
      names["PROBABILITIES" + std::to_string(names.size())] = path;
    }
    return names;
  }

private:
  std::string m_Preset;
  std::vector<std::string> m_Surfaces;
  std::vector<std::string> m_Labels;
  std::vector<std::string> m_Probabilities;
  std::string m_LabelTable;
  bool m_LeavesMaskUnnamed = false;
  std::vector<std::string> m_ChosenLabels;
  std::vector<std::string> m_Only;
  std::vector<std::string> m_Hidden;
  std::vector<std::string> m_Rules;
  std::string m_LabelColours = "anatomy";
  bool m_RemovesTable = false;
  bool m_KeepsTable = false;
  std::string m_Mode = "lean";
};

} // namespace rhombic

#endif
