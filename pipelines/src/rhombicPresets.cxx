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

[[noreturn]] void
FailToParse(const std::string & source, const std::string & why)
{
  throw Failure(FailureKind::Unreadable,
                "The preset " + source + " " + why + "; compare it with those in pipelines/presets.");
}

void
RefuseUnknownKeys(const YAML::Node & map, const std::vector<std::string> & known, const std::string & source)
{
  const std::string mistake = DescribeKeys(map, known);
  if (!mistake.empty())
  {
    FailToParse(source, mistake);
  }
}

/** The position of a key's value in a list of words; 0 when the key is missing. */
std::size_t
FindWord(const YAML::Node & value, const std::vector<std::string> & words, const std::string & source)
{
  const auto found = value ? std::find(words.begin(), words.end(), value.as<std::string>()) : words.begin();
  if (found == words.end())
  {
    std::vector<std::string> quoted;
    std::transform(words.begin(), words.end(), std::back_inserter(quoted), [](const std::string & word) {
      return "'" + word + "'";
    });
    FailToParse(source, "has '" + value.as<std::string>() + "' where " + Enumerate(quoted) + " is expected");
  }
  return static_cast<std::size_t>(found - words.begin());
}

double
ReadOpacity(const YAML::Node & node, const std::string & source)
{
  const auto opacity = ParseOpacity(node.as<std::string>());
  if (!opacity)
  {
    FailToParse(source, "has an opacity that is not above 0 and at most 1");
  }
  return *opacity;
}

bool
ReadGloss(const YAML::Node & node, const std::string & source)
{
  const auto gloss = ParseGloss(node.as<std::string>());
  if (!gloss)
  {
    FailToParse(source, "has '" + node.as<std::string>() + "' where 'matte' or 'glossy' is expected");
  }
  return *gloss;
}

SurfaceRequest
ParseSurface(const YAML::Node & node, const std::string & source)
{
  RefuseUnknownKeys(
    node,
    { "name", "isovalue", "side", "parts", "colour", "opacity", "min-volume", "largest", "fill", "smooth", "look" },
    source);
  for (const char * key : { "name", "isovalue" })
  {
    if (!node[key])
    {
      FailToParse(source, "has a surface without " + std::string(key));
    }
  }
  SurfaceRequest request;
  request.name = node["name"].as<std::string>();
  if (!ParseThreshold(node["isovalue"].as<std::string>(), request) || request.insideIsBelow)
  {
    FailToParse(source, "has an isovalue that is neither a finite number nor otsu, otsu-low, otsu-lowest or otsu-high");
  }
  request.insideIsBelow = FindWord(node["side"], { "above", "below" }, source) == 1;
  using Parts = SurfaceRequest::Parts;
  constexpr std::array<Parts, 3> parts{ Parts::All, Parts::Enclosed, Parts::Outermost };
  request.parts = parts[FindWord(node["parts"], { "all", "enclosed", "outermost" }, source)];
  if (node["colour"])
  {
    request.colour = ParseColour(node["colour"].as<std::string>());
  }
  request.opacity = node["opacity"] ? ReadOpacity(node["opacity"], source) : 1.0;
  request.finish.minimumVolume = node["min-volume"].as<double>(0.0);
  request.finish.keepsLargestPart = node["largest"].as<bool>(false);
  request.finish.fillsCavities = node["fill"].as<bool>(false);
  request.finish.smoothing = node["smooth"].as<double>(0.0);
  CheckSurfaceFinish(request.finish);
  return request;
}

SceneRule
ParseRule(const YAML::Node & node, const std::string & source)
{
  RefuseUnknownKeys(node, { "match", "colour", "opacity", "look" }, source);
  if (!node["match"])
  {
    FailToParse(source, "has a rule without match");
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
    rule.opacity = ReadOpacity(node["opacity"], source);
  }
  if (node["look"])
  {
    rule.isGlossy = ReadGloss(node["look"], source);
  }
  return rule;
}

bool
IsYamlPath(const std::string & text)
{
  const auto extension = fs::path(text).extension();
  return extension == ".yaml" || extension == ".yml";
}

Preset
ReadPreset(const fs::path & path)
{
  return ParsePreset(ReadTextFile(path, "preset file"), path.string());
}

} // namespace

Preset
ParsePreset(const std::string & yaml, const std::string & source)
{
  try
  {
    const YAML::Node root = YAML::Load(yaml);
    RefuseUnknownKeys(root, { "name", "description", "denoise", "removes", "surfaces", "rules" }, source);
    Preset preset;
    preset.name = root["name"].as<std::string>();
    preset.description = root["description"].as<std::string>("");
    preset.denoising = ParseDenoising(root["denoise"].as<std::string>("none"));
    preset.removesTable = FindWord(root["removes"], { "nothing", "table" }, source) == 1;
    for (const auto & node : root["surfaces"])
    {
      preset.surfaces.push_back(ParseSurface(node, source));
      if (node["look"])
      {
        preset.rules.push_back({ preset.surfaces.back().name, {}, {}, ReadGloss(node["look"], source) });
      }
    }
    for (const auto & node : root["rules"])
    {
      preset.rules.push_back(ParseRule(node, source));
    }
    if (preset.surfaces.empty())
    {
      FailToParse(source, "has no surfaces");
    }
    return preset;
  }
  catch (const Failure & failure)
  {
    if (failure.GetKind() == FailureKind::Unreadable)
    {
      throw;
    }
    FailToParse(source, "has a mistake: " + DescribeError(failure));
  }
  catch (const YAML::Exception & error)
  {
    FailToParse(source, "is not valid (line " + std::to_string(error.mark.line + 1) + ": " + error.msg + ")");
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
  if (IsYamlPath(nameOrPath))
  {
    return ReadPreset(nameOrPath);
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
