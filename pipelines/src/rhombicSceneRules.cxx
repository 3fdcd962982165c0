#include "rhombicSceneRules.h"

#include "rhombicFailure.h"
#include "rhombicLabelColours.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rhombic
{
namespace
{

/** A group of names: their patterns, with blanks between them. */
struct NameGroup
{
  const char * name;
  const char * patterns;
};

constexpr NameGroup Groups[] = {
  { "group:bones",
    "*bone* rib* *costa* *vertebra* sternum* sacrum* skull* *clavicula* *scapula* *humerus* *femur* hip_* "
    "*pelvis* mandib* *tibia* *fibula* *radius* *ulna* patella* carpal* metacarpal* tarsal* metatarsal* "
    "phalanges*" },
  { "group:brain",
    "*brain* *cerebr* *cerebell* *cortex* *thalamus* *caudate* *putamen* *pallidum* *hippocampus* *amygdala* "
    "*ventricle*" },
  { "group:heart", "heart* *atrium* *atrial* *myocardium* heart_ventricle*" },
  { "group:lungs", "lung* *lung *lobe* trachea* bronch*" },
  { "group:muscles", "*muscle* gluteus* iliopsoas* autochthon* quadriceps* thigh* sartorius*" },
  { "group:organs",
    "liver* spleen* pancreas* *kidney* stomach* gallbladder* *adrenal* *bladder* prostate* colon* duodenum* "
    "small_bowel* esophagus* *thyroid* heart* lung* brain*" },
  { "group:vessels", "*aorta* *artery* *vein* *vena* *vessel* *trunk* *carotid* *subclavian* iliac_*" },
};

std::vector<std::string>
NamesOf(const std::vector<SurfaceRequest> & requests, const std::vector<LabelSummary> & labels)
{
  std::vector<std::string> names;
  for (const SurfaceRequest & request : requests)
  {
    names.push_back(request.name);
  }
  for (const LabelSummary & summary : labels)
  {
    names.push_back(summary.label.name);
  }
  return names;
}

/** Throws Failure(Usage) for a pattern that fits none of the names. */
void
RequireFit(const std::string & pattern, const std::vector<std::string> & names)
{
  const bool fits =
    std::any_of(names.begin(), names.end(), [&](const std::string & name) { return FitsPattern(pattern, name); });
  if (!fits)
  {
    throw Failure(FailureKind::Usage,
                  DescribeUnknown("surface or label", pattern, names, "see rhombic info for the names of labels"));
  }
}

bool
FitsAny(const std::vector<std::string> & patterns, const std::string & name)
{
  return std::any_of(
    patterns.begin(), patterns.end(), [&name](const std::string & pattern) { return FitsPattern(pattern, name); });
}

void
ApplyRule(const SceneRule & rule, SurfaceRequest & request)
{
  request.colour = rule.colour.value_or(request.colour);
  request.opacity = rule.opacity.value_or(request.opacity);
}

void
ApplyRule(const SceneRule & rule, Label & label)
{
  for (std::size_t n = 0; rule.colour && n < 3; ++n)
  {
    label.colour[n] = static_cast<std::uint8_t>(std::lround(255.0 * (*rule.colour)[n]));
  }
  label.opacity = rule.opacity.value_or(label.opacity);
}

} // namespace

bool
FitsPattern(const std::string & pattern, const std::string & name)
{
  if (pattern.rfind("group:", 0) != 0)
  {
    return MatchesPattern(pattern, name);
  }
  std::vector<std::string> names;
  for (const auto & [group, patterns] : Groups)
  {
    if (group == LowerCase(pattern))
    {
      const std::vector<std::string_view> words = SplitWords(patterns);
      return std::any_of(
        words.begin(), words.end(), [&name](std::string_view word) { return MatchesPattern(word, name); });
    }
    names.push_back(group);
  }
  throw Failure(FailureKind::Usage, DescribeUnknown("group", pattern, names, "use " + Enumerate(names)));
}

SceneRule
ParseSceneRule(const std::string & text)
{
  const auto equals = text.find('=');
  SceneRule rule;
  rule.isAsked = true;
  rule.pattern = text.substr(0, equals);
  const auto fields = equals == std::string::npos ? std::vector<std::string>{} : Split(text.substr(equals + 1), ",");
  if (rule.pattern.empty() || fields.size() > 3)
  {
    throw Failure(FailureKind::Usage,
                  "'" + text +
                    "' is not name=colour,opacity,look; write, for example, 'liver=#994736,0.5', 'lung*=,0.3' or "
                    "'vessels=,,glossy'.");
  }
  if (!fields.empty() && !fields[0].empty())
  {
    rule.colour = ParseColour(fields[0]);
  }
  if (fields.size() > 1 && !fields[1].empty())
  {
    rule.opacity = ParseOpacity(fields[1]);
    if (!rule.opacity)
    {
      throw Failure(FailureKind::Usage,
                    "'" + fields[1] + "' in '" + text + "' is no opacity; write a number above 0 and at most 1.");
    }
  }
  if (fields.size() > 2)
  {
    rule.isGlossy = fields[2] == "glossy";
    if (!*rule.isGlossy && fields[2] != "matte")
    {
      throw Failure(FailureKind::Usage, "'" + fields[2] + "' in '" + text + "' is no look; write matte or glossy.");
    }
  }
  return rule;
}

std::vector<std::string>
FindUnusedRules(const std::vector<SceneRule> & rules, const std::vector<std::string> & names)
{
  std::vector<std::string> sentences;
  for (const SceneRule & rule : rules)
  {
    const auto fits = [&rule](const std::string & name) { return FitsPattern(rule.pattern, name); };
    if (rule.isAsked && !ToNumber<double>(rule.pattern) && std::none_of(names.begin(), names.end(), fits))
    {
      const std::string nearest = NearestName(rule.pattern, names);
      sentences.push_back("no surface is called " + rule.pattern + ", for which a look was given" +
                          (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
  }
  return sentences;
}

bool
IsGlossy(const std::vector<SceneRule> & rules, const std::string & name)
{
  const auto last = std::find_if(rules.rbegin(), rules.rend(), [&name](const SceneRule & rule) {
    return rule.isGlossy && FitsPattern(rule.pattern, name);
  });
  return last != rules.rend() && *last->isGlossy;
}

void
ApplySceneRules(const SceneRules & rules, std::vector<SurfaceRequest> & requests, LabelMap * map)
{
  std::vector<LabelSummary> none;
  std::vector<LabelSummary> & labels = map != nullptr ? map->labels : none;
  const std::vector<std::string> names = NamesOf(requests, labels);
  for (const auto * const patterns : { &rules.only, &rules.hidden })
  {
    for (const std::string & pattern : *patterns)
    {
      RequireFit(pattern, names);
    }
  }
  if (map != nullptr)
  {
    ColourLabels(*map, rules.colours); // all labels, so that colours do not depend on the shown labels
  }
  const auto isHidden = [&rules](const std::string & name) {
    return (!rules.only.empty() && !FitsAny(rules.only, name)) || FitsAny(rules.hidden, name);
  };
  const auto isHiddenRequest = [&](const SurfaceRequest & request) { return isHidden(request.name); };
  const auto isHiddenLabel = [&](const LabelSummary & summary) { return isHidden(summary.label.name); };
  requests.erase(std::remove_if(requests.begin(), requests.end(), isHiddenRequest), requests.end());
  labels.erase(std::remove_if(labels.begin(), labels.end(), isHiddenLabel), labels.end());
  if (!names.empty() && requests.empty() && labels.empty())
  {
    throw Failure(FailureKind::Usage, "No surface is left to show after --only and --hide; leave one of them out.");
  }
  for (const std::string & pattern : rules.needed)
  {
    RequireFit(pattern, NamesOf(requests, labels));
  }
  for (const SceneRule & rule : rules.rules)
  {
    for (SurfaceRequest & request : requests)
    {
      if (FitsPattern(rule.pattern, request.name))
      {
        ApplyRule(rule, request);
      }
    }
    for (LabelSummary & summary : labels)
    {
      if (FitsPattern(rule.pattern, summary.label.name))
      {
        ApplyRule(rule, summary.label);
      }
    }
  }
}

} // namespace rhombic
