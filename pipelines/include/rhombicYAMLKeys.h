#ifndef rhombicYAMLKeys_h
#define rhombicYAMLKeys_h

#include <yaml-cpp/yaml.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace rhombic
{

/** A mistake in a YAML file, as "has no outputs". The reader of the file makes a sentence of it. */
class YAMLMistake : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Throws YAMLMistake for a node that is no map, and for a key that \a known does not have, as "has the unknown key
 * 'vew' in line 7 (did you mean view?)". */
void
RefuseOtherKeys(const YAML::Node & map, const std::vector<std::string> & known);

} // namespace rhombic

#endif
