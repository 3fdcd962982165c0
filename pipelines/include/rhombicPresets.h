#ifndef rhombicPresets_h
#define rhombicPresets_h

#include "rhombicDenoising.h"
#include "rhombicSceneRules.h"
#include "rhombicSurfaceRequest.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** A named list of surfaces for a kind of scan, and how they are made and drawn. */
struct Preset
{
  std::string name;
  std::string description;
  Denoising denoising;       ///< of the scan or the lattice, before surfaces are made
  bool removesTable = false; ///< for CTs in HU: removes the scanner's table
  std::vector<SurfaceRequest> surfaces;
  std::vector<SceneRule> rules; ///< looks of the surfaces, and of labels that are shown with them
};

/** The built-in presets, from pipelines/presets/. */
const std::vector<Preset> &
GetPresets();

/** The built-in preset of a name, or the preset in a YAML file. Throws Failure: Usage for an unknown
 * name, suggesting the nearest; NotFound and Unreadable for files. */
Preset
FindPreset(const std::string & nameOrPath);

/** Reads a preset from YAML text. Throws Failure(Unreadable), whose message names \a source. */
Preset
ParsePreset(const std::string & yaml, const std::string & source);

} // namespace rhombic

#endif
