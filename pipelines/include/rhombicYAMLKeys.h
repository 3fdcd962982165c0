#ifndef rhombicYAMLKeys_h
#define rhombicYAMLKeys_h

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace rhombic
{

/** What is wrong with the keys of a node, as "has the unknown key 'vew' in line 7 (did you mean view?)". Empty when it
 * is a map and has no other keys than those of \a known. */
std::string
DescribeKeys(const YAML::Node & map, const std::vector<std::string> & known);

} // namespace rhombic

#endif
