#include "rhombicPresets.h"

#include "rhombicBuiltInPresets.h"
#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicScanToLattice.h"
#include "rhombicWording.h"
#include "rhombicYAMLKeys.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The position of a key's value in a list of words; 0 when the key is missing. */
std::size_t
FindWord(const YAML::Node & value, const std::vector<std::string> & words)
{
  const auto found = value ? std::find(words.begin(), words.end(), value.as<std::string>()) : words.begin();
  if (found == words.end())
  {
    std::vector<std::string> quoted;
    std::transform(words.begin(), words.end(), std::back_inserter(quoted), [](const std::string & word) {
      return "'" + word + "'";
    });
    throw YAMLMistake("has '" + value.as<std::string>() + "' where " + Enumerate(quoted) + " is expected");
  }
  return static_cast<std::size_t>(found - words.begin());
}

double
ReadOpacity(const YAML::Node & node)
{
  const auto opacity = ParseOpacity(node.as<std::string>());
  if (!opacity)
  {
    throw YAMLMistake("has an opacity that is not above 0 and at most 1");
  }
  return *opacity;
}

/** Volumes in millilitres, not by YAML::Node::as<double>(), which reads numbers as the host's locale writes them. */
double
ReadVolume(const YAML::Node & node)
{
  const auto volume = ToNumber<double>(node.as<std::string>());
  if (!volume)
  {
    throw YAMLMistake("has '" + node.as<std::string>() + "' where a volume in millilitres is expected");
  }
  return *volume;
}

/** Whether a look is glossy. */
bool
ReadGloss(const YAML::Node & node)
{
  return FindWord(node, { "matte", "glossy" }) == 1;
}

SurfaceRequest
ParseSurface(const YAML::Node & node)
{
  RefuseOtherKeys(
    node,
    { "name", "isovalue", "side", "parts", "colour", "opacity", "min-volume", "largest", "fill", "smooth", "look" });
  for (const char * key : { "name", "isovalue" })
  {
    if (!node[key] || node[key].Scalar().empty()) // as by '', or a tag without a value
    {
      throw YAMLMistake("has a surface without " + std::string(key));
    }
  }
  SurfaceRequest request;
  request.name = node["name"].as<std::string>();
  if (!ParseThreshold(node["isovalue"].as<std::string>(), request) || request.insideIsBelow)
  {
    throw YAMLMistake("has an isovalue that is neither a finite number nor otsu, otsu-low, otsu-lowest or otsu-high");
  }
  request.insideIsBelow = FindWord(node["side"], { "above", "below" }) == 1;
  using Parts = SurfaceRequest::Parts;
  constexpr std::array<Parts, 3> parts{ Parts::All, Parts::Enclosed, Parts::Outermost };
  request.parts = parts[FindWord(node["parts"], { "all", "enclosed", "outermost" })];
  if (node["colour"])
  {
    request.colour = ParseColour(node["colour"].as<std::string>());
  }
  request.hasOwnOpacity = node["opacity"].IsDefined();
  request.opacity = request.hasOwnOpacity ? ReadOpacity(node["opacity"]) : 1.0;
  request.finish.minimumVolume = node["min-volume"] ? ReadVolume(node["min-volume"]) : 0.0;
  request.finish.keepsLargestPart = node["largest"] && node["largest"].as<bool>();
  request.finish.fillsCavities = node["fill"] && node["fill"].as<bool>();
  request.finish.smoothing = ParseSmoothingLimit(node["smooth"].as<std::string>("0"));
  CheckSurfaceFinish(request.finish);
  return request;
}

SceneRule
ParseRule(const YAML::Node & node)
{
  RefuseOtherKeys(node, { "match", "colour", "opacity", "look" });
  if (!node["match"])
  {
    throw YAMLMistake("has a rule without match");
  }
  SceneRule rule;
  rule.pattern = node["match"].as<std::string>();
  FitsPattern(rule.pattern, ""); // throws for an unknown group
  if (node["colour"])
  {
    rule.colour = ParseColour(node["colour"].as<std::string>());
  }
  if (node["opacity"])
  {
    rule.opacity = ReadOpacity(node["opacity"]);
  }
  if (node["look"])
  {
    rule.isGlossy = ReadGloss(node["look"]);
  }
  return rule;
}

} // namespace

Preset
ParsePreset(const std::string & yaml, const std::string & source)
{
  const auto failure = [&source](const std::string & why) {
    return Failure(FailureKind::Unreadable,
                   "The preset " + source + " " + why + "; compare it with those in pipelines/presets.");
  };
  try
  {
    const YAML::Node root = LoadYAML(yaml);
    RefuseOtherKeys(root, { "name", "description", "denoise", "removes", "surfaces", "rules" });
    Preset preset;
    preset.name = root["name"].as<std::string>();
    preset.description = root["description"].as<std::string>("");
    preset.denoising = ParseDenoising(root["denoise"].as<std::string>("none"));
    preset.removesTable = FindWord(root["removes"], { "nothing", "table" }) == 1;
    for (const auto & node : root["surfaces"])
    {
      preset.surfaces.push_back(ParseSurface(node));
      if (node["look"])
      {
        preset.rules.push_back({ preset.surfaces.back().name, {}, {}, ReadGloss(node["look"]) });
      }
    }
    for (const auto & node : root["rules"])
    {
      preset.rules.push_back(ParseRule(node));
    }
    if (preset.surfaces.empty())
    {
      throw YAMLMistake("has no surfaces");
    }
    return preset;
  }
  catch (const YAMLMistake & mistake)
  {
    throw failure(mistake.what());
  }
  catch (const Failure & mistake)
  {
    throw failure("has a mistake: " + DescribeError(mistake));
  }
  catch (const YAML::Exception & error)
  {
    throw failure("is not valid (line " + std::to_string(error.mark.line + 1) + ": " + error.msg + ")");
  }
}

const std::vector<Preset> &
GetPresets()
{
  static const std::vector<Preset> presets = [] {
    std::vector<Preset> parsed;
    for (const BuiltInPreset & builtIn : BuiltInPresets)
    {
      parsed.push_back(ParsePreset(builtIn.yaml, builtIn.name));
    }
    return parsed;
  }();
  return presets;
}

Preset
FindPreset(const std::string & nameOrPath)
{
  const fs::path extension = fs::path(nameOrPath).extension();
  if (extension == ".yaml" || extension == ".yml")
  {
    return ParsePreset(ReadTextFile(nameOrPath, "preset file"), nameOrPath);
  }
  std::vector<std::string> names;
  for (const Preset & preset : GetPresets())
  {
    if (preset.name == nameOrPath)
    {
      return preset;
    }
    names.push_back(preset.name);
  }
  throw Failure(FailureKind::Usage,
                DescribeUnknown("preset", nameOrPath, names, "see rhombic render --list-presets for all of them"));
}

} // namespace rhombic
