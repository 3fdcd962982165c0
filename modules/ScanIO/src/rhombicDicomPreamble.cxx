#include "rhombicDicomPreamble.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>

namespace rhombic
{
namespace
{

std::uint32_t
LittleEndian(const unsigned char * bytes, int count)
{
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i)
  {
    value = value << 8 | bytes[i];
  }
  return value;
}

/** The length of an element's value from the bytes behind its tag, in the explicit little endian that file meta
 * information always has; nothing when they are not well-formed. */
std::optional<std::uint32_t>
ReadLength(std::ifstream & file)
{
  unsigned char bytes[4];
  if (!file.read(reinterpret_cast<char *>(bytes), sizeof(bytes)))
  {
    return {};
  }
  static const std::set<std::string> shortOnes{ "AE", "AS", "CS", "DA", "DS", "DT", "IS", "LO", "LT", "PN", "SH",
                                                "ST", "TM", "UI", "UL", "US", "SS", "SL", "FL", "FD", "AT" };
  static const std::set<std::string> longOnes{ "OB", "UN", "OW", "OF", "SQ", "UT" };
  const std::string representation(reinterpret_cast<const char *>(bytes), 2);
  if (shortOnes.count(representation) != 0)
  {
    return LittleEndian(bytes + 2, 2);
  }
  if (longOnes.count(representation) == 0 || !file.read(reinterpret_cast<char *>(bytes), sizeof(bytes)))
  {
    return {};
  }
  return LittleEndian(bytes, 4);
}

std::string
TrimPadding(std::string text)
{
  text.erase(text.find_last_not_of(std::string(" \0", 2)) + 1);
  return text;
}

} // namespace

DicomPreamble
ReadDicomPreamble(const std::filesystem::path & path)
{
  constexpr std::uint32_t metaGroup = 2;
  constexpr std::uint32_t transferSyntaxElement = 0x10;
  constexpr std::uint32_t longestValue = 1 << 16;

  DicomPreamble preamble;
  std::ifstream file(path, std::ios::binary);
  char start[132];
  if (!file.read(start, sizeof(start)) || std::memcmp(start + 128, "DICM", 4) != 0)
  {
    return preamble;
  }
  unsigned char tag[4];
  while (file.read(reinterpret_cast<char *>(tag), sizeof(tag)))
  {
    if (LittleEndian(tag, 2) != metaGroup)
    {
      preamble.isDicom = true;
      break;
    }
    const std::uint32_t length = ReadLength(file).value_or(longestValue + 1);
    std::string value(std::min(length, longestValue), '\0');
    if (length > longestValue || !file.read(value.data(), static_cast<std::streamsize>(length)))
    {
      break;
    }
    if (LittleEndian(tag + 2, 2) == transferSyntaxElement)
    {
      preamble.transferSyntax = TrimPadding(value);
    }
  }
  return preamble;
}

} // namespace rhombic
