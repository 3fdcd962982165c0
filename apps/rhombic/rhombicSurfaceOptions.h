#ifndef rhombicSurfaceOptions_h
#define rhombicSurfaceOptions_h

#include "rhombicColourBy.h"
#include "rhombicEvents.h"
#include "rhombicPresets.h"
#include "rhombicScanSource.h"
#include "rhombicSettings.h"
#include "rhombicSurfaceFinish.h"

#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceOptions
 * \brief The settings of several commands that select the surfaces of a scan. */
struct SurfaceOptions
{
  std::string preset;
  std::vector<std::string> surfaces;
  std::vector<std::string> labels;
  std::vector<std::string> probabilities;
  std::string labelTable;
  bool leavesMaskUnnamed = false;
  std::vector<std::string> chosenLabels;
  std::vector<std::string> only;
  std::vector<std::string> hidden;
  std::vector<std::string> looks;
  std::string labelColours = "anatomy";
  bool removesTable = false;
  bool keepsTable = false;
  std::string mode = "lean";
  bool takesAuto = false; ///< no setting: of commands that choose a preset as "auto" does where no surface is named

  static const SettingsTable<SurfaceOptions> &
  Table();

  /** The preset; without --preset, one of no surfaces. "auto", and the lack of any choice if takesAuto, reads the
   * source to choose one: \a volume is what it holds, and the source's presetChoice tells why. Throws Failure. */
  Preset
  GetPreset(ScanSource & source, std::optional<SourceVolume> & volume, const Events & events) const;

  /** As GetPreset(), but "auto" is one of no surfaces, and nothing is read. */
  Preset
  GetNamedPreset() const;

  /** The parsed selection, with one more surface if given. Without surfaces and label map, the scan itself is taken as
   * the label map. Throws Failure(Usage). */
  SurfaceSelection
  GetSelection(const Preset & chosen, const std::optional<SurfaceRequest> & further = std::nullopt) const;

  /** Whether a setting names surfaces of a scan or labels. */
  bool
  ChoosesSurfaces() const
  {
    return !preset.empty() || !surfaces.empty() || !labels.empty() || !probabilities.empty() || !chosenLabels.empty();
  }

  /** Which surfaces are shown, and in which colours, by the settings; these count more than the rules \a before. Throws
   * Failure(Usage). */
  SceneRules
  GetRules(std::vector<SceneRule> before = {}) const;
};

/** The settings of several commands for parts and smoothness of surfaces; CheckSurfaceFinish() judges their values. */
const SettingsTable<SurfaceFinish> &
FinishTable();

/** The help text of --colour-by. */
const char *
GetColourByHelp();

/** What --colour-by names; nothing for an empty text. Throws Failure(Usage). */
std::optional<ColourBy>
GetColourBy(const std::string & text);

} // namespace rhombic

#endif
