#ifndef rhombicYAMLKeys_h
#define rhombicYAMLKeys_h

#include "rhombicWording.h"

#include <nlohmann/json.hpp>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <set>
#include <string>
#include <vector>

namespace rhombic
{

/** A mistake in a YAML file, as "has no outputs". The reader of the file makes a sentence of it. */
class YAMLMistake : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** The place of the first character of a text in UTF-8 that YAML 1.2 forbids, or its end: control characters but tabs,
 * line ends and U+0085; U+FFFE and U+FFFF. */
inline std::size_t
FindForbiddenInYAML(const std::string & text)
{
  for (std::size_t n = 0; n < text.size(); ++n)
  {
    const auto byte = static_cast<unsigned char>(text[n]);
    const bool isControl = byte < ' ' ? byte != '\t' && byte != '\n' && byte != '\r' : byte == 0x7F;
    const bool isC1 = byte == 0xC2 && static_cast<unsigned char>(text[n + 1]) < 0xA0 && text[n + 1] != '\x85';
    if (isControl || isC1 || (byte == 0xEF && text[n + 1] == '\xBF' && static_cast<unsigned char>(text[n + 2]) >= 0xBE))
    {
      return n;
    }
  }
  return text.size();
}

/** Takes what a YAML::Parser finds, and does nothing. */
class IgnoredYAMLEvents : public YAML::EventHandler
{
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;

  void
  OnDocumentStart(const Mark &) override
  {}
  void
  OnDocumentEnd() override
  {}
  void
  OnNull(const Mark &, Anchor) override
  {}
  void
  OnAlias(const Mark &, Anchor) override
  {}
  void
  OnScalar(const Mark &, const std::string &, Anchor, const std::string &) override
  {}
  void
  OnSequenceStart(const Mark &, const std::string &, Anchor, Style) override
  {}
  void
  OnSequenceEnd() override
  {}
  void
  OnMapStart(const Mark &, const std::string &, Anchor, Style) override
  {}
  void
  OnMapEnd() override
  {}
};

/** Parses YAML of one document, which is text in UTF-8 without control characters. Throws YAMLMistake for others, and
 * YAML::Exception. yaml-cpp would leave out what is behind the first document. */
inline YAML::Node
LoadYAML(const std::string & text)
{
  try
  {
    nlohmann::json(text).dump();
  }
  catch (const nlohmann::json::exception &)
  {
    throw YAMLMistake("is no text in UTF-8");
  }
  const auto forbidden = text.begin() + static_cast<std::ptrdiff_t>(FindForbiddenInYAML(text));
  if (forbidden != text.end())
  {
    throw YAMLMistake("has a control character in line " +
                      std::to_string(1 + std::count(text.begin(), forbidden, '\n')));
  }
  std::istringstream stream(text); // YAML::LoadAll() would never end for ",a\n%a"
  YAML::Parser parser(stream);
  IgnoredYAMLEvents ignored;
  const bool isEmpty = !parser.HandleNextDocument(ignored);
  if (text.find("\n%") != std::string::npos || (!isEmpty && parser.HandleNextDocument(ignored)))
  {
    throw YAMLMistake("has more than one document");
  }
  return isEmpty ? YAML::Node() : YAML::Load(text);
}

/** Throws YAMLMistake for a node that is no map, for a key that is there twice, and for one that \a known does not
 * have, as "has the unknown key 'vew' in line 7 (did you mean view?)". */
inline void
RefuseOtherKeys(const YAML::Node & map, const std::vector<std::string> & known)
{
  if (!map.IsMap())
  {
    throw YAMLMistake("is not made of keys and values in line " + std::to_string(map.Mark().line + 1));
  }
  std::set<std::string> keys;
  for (const auto & entry : map)
  {
    const auto key = entry.first.as<std::string>();
    if (!keys.insert(key).second)
    {
      throw YAMLMistake("has the key '" + key + "' a second time in line " +
                        std::to_string(entry.first.Mark().line + 1));
    }
    if (std::find(known.begin(), known.end(), key) == known.end())
    {
      const std::string nearest = NearestName(key, known);
      throw YAMLMistake("has the unknown key '" + key + "' in line " + std::to_string(entry.first.Mark().line + 1) +
                        (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
    }
  }
}

} // namespace rhombic

#endif
