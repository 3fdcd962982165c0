#ifndef rhombicSceneRules_h
#define rhombicSceneRules_h

#include "rhombicLabelColours.h"
#include "rhombicSurfaceRequest.h"

#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Which surfaces are shown, and in which colours, by patterns of their names.
 *
 * A pattern is a name with `*` for any characters and `?` for any character, in upper or lower case, or the name of a
 * group: group:bones, group:vessels, group:lungs, group:heart, group:brain, group:muscles or group:organs, as
 * TotalSegmentator and FreeSurfer name them.
 */

/** Colour, opacity and look of the surfaces whose names fit a pattern. */
struct SceneRule
{
  std::string pattern;
  std::optional<Colour> colour;
  std::optional<double> opacity; ///< above 0, at most 1
  std::optional<bool> isGlossy;  ///< see SceneSurface
  bool isAsked = false;          ///< by a user, not by a preset
};

/** Which surfaces are shown, and in which colours. */
struct SceneRules
{
  std::vector<std::string> only;   ///< patterns of those that are shown; empty: all
  std::vector<std::string> hidden; ///< patterns of those that are not shown
  std::vector<SceneRule> rules;    ///< later ones count more
  std::vector<std::string> needed; ///< patterns that each must fit a surface that is shown
  LabelColours colours = LabelColours::Anatomy;
};

/** Whether a name fits a pattern. Throws Failure(Usage) for an unknown group. */
bool
FitsPattern(const std::string & pattern, const std::string & name);

/** Looks written as pattern[=[colour][,[opacity][,matte or glossy]]]: "liver", "liver=#994736,0.5", "lung*=,0.3",
 * "vessels=,,glossy". Throws Failure(Usage). */
SceneRule
ParseSceneRule(const std::string & text);

/** Sentences about rules that a user asked for by a pattern of names and that fit none, with the nearest name. */
std::vector<std::string>
FindUnusedRules(const std::vector<SceneRule> & rules, const std::vector<std::string> & names);

/** Whether the last rule with a look for this name makes it glossy. */
bool
IsGlossy(const std::vector<SceneRule> & rules, const std::string & name);

/** Leaves those isosurfaces and labels that the rules show, and sets the colours and opacities of these. Labels that
 * touch get different colours, unless a rule or the table sets them.
 *
 * \param labels may be null
 *
 * Throws Failure(Usage) for a pattern of \a only, \a hidden or \a needed that fits nothing, suggesting the nearest
 * name, and when nothing is left. */
void
ApplySceneRules(const SceneRules & rules, std::vector<SurfaceRequest> & requests, LabelMap * labels);

} // namespace rhombic

#endif
