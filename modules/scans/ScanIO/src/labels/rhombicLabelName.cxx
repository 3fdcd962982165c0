#include "rhombicLabelTable.h"

namespace rhombic
{
namespace
{

constexpr std::size_t LongestName = 100; // bytes
constexpr char32_t NotACharacter = 0xFFFFFFFF;

struct Character
{
  char32_t code = NotACharacter;
  std::size_t size = 1; ///< bytes
};

/** The UTF-8 character at the beginning of a text; NotACharacter of one byte where there is none. */
Character
FirstCharacter(std::string_view text)
{
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80)
  {
    return { byte(0), 1 };
  }
  const std::size_t size = byte(0) >= 0xC2 && byte(0) < 0xE0   ? 2
                           : byte(0) >= 0xE0 && byte(0) < 0xF0 ? 3
                           : byte(0) >= 0xF0 && byte(0) < 0xF5 ? 4
                                                               : 0;
  if (size == 0 || text.size() < size)
  {
    return {};
  }
  char32_t code = byte(0) & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i)
  {
    if ((byte(i) & 0xC0) != 0x80)
    {
      return {};
    }
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr char32_t smallest[5] = { 0, 0, 0x80, 0x800, 0x10000 };
  const bool isSurrogate = code >= 0xD800 && code < 0xE000;
  return code < smallest[size] || code > 0x10FFFF || isSurrogate ? Character{} : Character{ code, size };
}

bool
IsSpace(char32_t code)
{
  return code == ' ' || (code >= '\t' && code <= '\r') || code == 0xA0 || code == 0x2028 || code == 0x2029;
}

/** Control characters, byte order marks, and marks that change the direction of writing. */
bool
IsHidden(char32_t code)
{
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x61C || (code >= 0x200B && code <= 0x200F) ||
         (code >= 0x202A && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

bool
IsSafeInFileNames(char letter)
{
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
         letter == '.' || letter == '_' || letter == '-';
}

} // namespace

std::string
SanitizeLabelName(std::string_view name, std::int32_t value)
{
  std::string clean;
  while (!name.empty())
  {
    const Character character = FirstCharacter(name);
    std::string next(name.substr(0, character.size));
    name.remove_prefix(character.size);
    if (character.code == NotACharacter)
    {
      next = "?";
    }
    else if (IsSpace(character.code))
    {
      next = clean.empty() || clean.back() == ' ' ? "" : " ";
    }
    else if (IsHidden(character.code))
    {
      next.clear();
    }
    if (clean.size() + next.size() > LongestName)
    {
      break;
    }
    clean += next;
  }
  if (!clean.empty() && clean.back() == ' ')
  {
    clean.pop_back();
  }
  return clean.empty() ? "label " + std::to_string(value) : clean;
}

Label
NamedLabel(std::int32_t value, std::string_view name)
{
  Label label;
  label.value = value;
  label.name = SanitizeLabelName(name, value);
  label.colour = AnatomicalColour(label.name, value);
  return label;
}

std::string
FileStemOf(std::string_view name)
{
  std::string stem;
  while (!name.empty() && stem.size() < LongestName)
  {
    const char letter = name.front();
    name.remove_prefix(FirstCharacter(name).size);
    const char safe = IsSafeInFileNames(letter) ? letter : '_';
    const bool isRepeated = safe == '_' && !stem.empty() && stem.back() == '_';
    const bool isBadFirst = stem.empty() && (safe == '.' || safe == '-' || letter != safe);
    if (!isRepeated && !isBadFirst)
    {
      stem += safe;
    }
  }
  while (!stem.empty() && (stem.back() == '.' || stem.back() == '_'))
  {
    stem.pop_back();
  }
  return stem.empty() ? "label" : stem;
}

} // namespace rhombic
