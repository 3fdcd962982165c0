#include "rhombicPresets.h"

#include "rhombicBuiltInPresets.h"
#include "rhombicDenoising.h"
#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

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
RefuseUnknownKeys(const YAML::Node & map, const std::set<std::string> & known, const std::string & source)
{
  if (!map.IsMap())
  {
    FailToParse(source, "is not made of keys and values");
  }
  for (const auto & entry : map)
  {
    if (known.count(entry.first.as<std::string>()) == 0)
    {
      FailToParse(source, "has the unknown key '" + entry.first.as<std::string>() + "'");
    }
  }
}

/** The value of a key that must be one of two words; \a otherwise when the key is missing. */
bool
IsSecondWord(const YAML::Node & value, const char * first, const char * second, const std::string & source)
{
  if (!value || value.as<std::string>() == first)
  {
    return false;
  }
  if (value.as<std::string>() != second)
  {
    FailToParse(source, "has '" + value.as<std::string>() + "' where '" + first + "' or '" + second + "' is expected");
  }
  return true;
}

SurfaceRequest
ParseSurface(const YAML::Node & node, const std::string & source)
{
  RefuseUnknownKeys(node, { "name", "isovalue", "side", "parts", "colour", "opacity" }, source);
  for (const char * key : { "name", "isovalue" })
  {
    if (!node[key])
    {
      FailToParse(source, "has a surface without " + std::string(key));
    }
  }
  SurfaceRequest request;
  request.name = node["name"].as<std::string>();
  if (node["isovalue"].as<std::string>() != "otsu")
  {
    request.isovalue = node["isovalue"].as<double>();
    if (!std::isfinite(*request.isovalue))
    {
      FailToParse(source, "has an isovalue that is not finite");
    }
  }
  request.insideIsBelow = IsSecondWord(node["side"], "above", "below", source);
  const bool isEnclosed = IsSecondWord(node["parts"], "all", "enclosed", source);
  request.parts = isEnclosed ? SurfaceRequest::Parts::Enclosed : SurfaceRequest::Parts::All;
  if (node["colour"])
  {
    request.colour = ParseColour(node["colour"].as<std::string>());
  }
  request.opacity = node["opacity"].as<double>(1.0);
  if (!(request.opacity > 0.0 && request.opacity <= 1.0))
  {
    FailToParse(source, "has an opacity that is not above 0 and at most 1");
  }
  return request;
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
  std::ifstream stream(path);
  if (!stream)
  {
    throw Failure(FailureKind::NotFound, "There is no preset file " + path.string() + "; check the path.");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return ParsePreset(text.str(), path.string());
}

} // namespace

Preset
ParsePreset(const std::string & yaml, const std::string & source)
{
  try
  {
    const YAML::Node root = YAML::Load(yaml);
    RefuseUnknownKeys(root, { "name", "description", "suggested-denoising", "removes", "surfaces" }, source);
    Preset preset;
    preset.name = root["name"].as<std::string>();
    preset.description = root["description"].as<std::string>("");
    preset.denoising = root["suggested-denoising"].as<std::string>("none");
    ParseDenoising(preset.denoising);
    preset.removesTable = IsSecondWord(root["removes"], "nothing", "table", source);
    for (const auto & node : root["surfaces"])
    {
      preset.surfaces.push_back(ParseSurface(node, source));
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
