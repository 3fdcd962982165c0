#ifndef rhombicPresets_h
#define rhombicPresets_h

#include "rhombicSurfaceRequest.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Presets: surfaces for kinds of scans. Thread safety: presets are values, and any number of threads may call these
 * functions at once. */

/** A named list of surfaces for a kind of scan. */
struct Preset
{
  std::string name;
  std::string description;
  std::string denoising = "none"; ///< for noisy scans, as ParseDenoising() takes it: shown, not applied
  bool removesTable = false;      ///< it is for CTs in HU, from which the scanner's table is removed
  std::vector<SurfaceRequest> surfaces;
};

/** The presets of pipelines/presets/, which are built in, by name. */
const std::vector<Preset> &
GetPresets();

/** The built-in preset of that name, or the one in the YAML file of that path. Throws Failure: Usage for an unknown
 * name, suggesting the nearest; NotFound and Unreadable for files. */
Preset
FindPreset(const std::string & nameOrPath);

/** A preset from YAML text; \a source names it in messages. Throws Failure(Unreadable). */
Preset
ParsePreset(const std::string & yaml, const std::string & source);

} // namespace rhombic

#endif
