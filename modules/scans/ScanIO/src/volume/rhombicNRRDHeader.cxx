#include "rhombicNRRDHeader.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::size_t LargestHeader = std::size_t(1) << 24;

/** Reads the next line without its end, and adds its bytes to the header's size. False at the end of the file. */
bool
ReadLine(std::istream & file, const fs::path & path, NRRDHeader & header, std::string & line)
{
  line.clear();
  char letter = 0;
  while (file.get(letter))
  {
    if (++header.size > LargestHeader)
    {
      RefuseVolume(path, "its header has no end within 16 MiB; check where it came from");
    }
    if (letter == '\n')
    {
      if (!line.empty() && line.back() == '\r')
      {
        line.pop_back();
      }
      return true;
    }
    line.push_back(letter);
  }
  return !line.empty();
}

/** Undoes "\n" and "\\". */
std::string
Unescaped(const std::string & text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isEscape = text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\');
    result.push_back(!isEscape ? text[i] : text[++i] == 'n' ? '\n' : '\\');
  }
  return result;
}

std::string
Find(const std::map<std::string, std::string> & texts, const std::string & name)
{
  const auto found = texts.find(name);
  return found == texts.end() ? "" : found->second;
}

} // namespace

std::string
NRRDHeader::Get(const std::string & field) const
{
  return Find(fields, field);
}

std::string
NRRDHeader::GetValue(const std::string & key) const
{
  return Find(keyValues, key);
}

NRRDHeader
ReadNRRDHeader(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  NRRDHeader header;
  std::string magic(8, '\0');
  file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (!file || magic.compare(0, 7, "NRRD000") != 0 || magic[7] < '1' || magic[7] > '6')
  {
    RefuseVolume(path, "its content is not NRRD, as its name says; check where it came from");
  }
  header.size = magic.size();
  std::string line;
  ReadLine(file, path, header, line);

  while (ReadLine(file, path, header, line) && !line.empty())
  {
    const std::size_t colon = line.find(':');
    if (line.front() == '#' || colon == std::string::npos)
    {
      continue;
    }
    if (line.compare(colon, 2, ":=") == 0)
    {
      header.keyValues[Unescaped(line.substr(0, colon))] = Unescaped(line.substr(colon + 2));
      continue;
    }
    std::string name = LowerCase(line.substr(0, colon));
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    if (!header.fields.emplace(name, Trim(line.substr(colon + 1))).second)
    {
      RefuseVolume(path, "its header has the field '" + name + "' twice; export it again from its source");
    }
    if (name == "datafile" && header.Get(name).compare(0, 4, "LIST") == 0)
    {
      break; // names of files follow
    }
  }
  return header;
}

std::map<std::string, std::string>
ReadNRRDKeyValues(const fs::path & path)
{
  return ReadNRRDHeader(path).keyValues;
}

std::string
CanonicalNRRDType(const std::string & name)
{
  static const std::vector<std::vector<std::string>> types{
    { "int8", "int8_t", "signed char" },
    { "uint8", "uint8_t", "uchar", "unsigned char" },
    { "int16", "int16_t", "short", "short int", "signed short", "signed short int" },
    { "uint16", "uint16_t", "ushort", "unsigned short", "unsigned short int" },
    { "int32", "int32_t", "int", "signed int" },
    { "uint32", "uint32_t", "uint", "unsigned int" },
    { "int64", "int64_t", "longlong", "long long", "long long int", "signed long long", "signed long long int" },
    { "uint64", "uint64_t", "ulonglong", "unsigned long long", "unsigned long long int" },
    { "float" },
    { "double" },
  };
  const std::string lowerCase = LowerCase(name);
  for (const auto & names : types)
  {
    if (std::find(names.begin(), names.end(), lowerCase) != names.end())
    {
      return names.front();
    }
  }
  return {};
}

} // namespace rhombic
