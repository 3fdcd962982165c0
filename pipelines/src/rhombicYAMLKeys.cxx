#include "rhombicYAMLKeys.h"

#include "rhombicWording.h"

#include <algorithm>

namespace rhombic
{

void
RefuseOtherKeys(const YAML::Node & map, const std::vector<std::string> & known)
{
  if (!map.IsMap())
  {
    throw YAMLMistake("is not made of keys and values in line " + std::to_string(map.Mark().line + 1));
  }
  for (const auto & entry : map)
  {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end())
    {
      const std::string nearest = NearestName(key, known);
      throw YAMLMistake("has the unknown key '" + key + "' in line " + std::to_string(entry.first.Mark().line + 1) +
                        (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
    }
  }
}

} // namespace rhombic
