#include "rhombicTextHeader.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <fstream>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uintmax_t LargestCount = std::numeric_limits<std::int32_t>::max();

template <typename TNumber>
std::optional<std::vector<TNumber>>
Parse(std::string_view text)
{
  std::vector<TNumber> numbers;
  for (const std::string_view word : SplitWords(text))
  {
    const auto number = ToNumber<TNumber>(word.substr(word.front() == '+' ? 1 : 0));
    if (!number)
    {
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

constexpr std::size_t LargestHeader = std::size_t(1) << 24;

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

} // namespace

std::string
TextHeader::Get(const std::vector<std::string> & names) const
{
  for (const std::string & name : names)
  {
    if (const auto found = fields.find(name); found != fields.end())
    {
      return found->second;
    }
  }
  return "";
}

std::string
TextHeader::GetValue(const std::string & key) const
{
  const auto found = keyValues.find(key);
  return found == keyValues.end() ? "" : found->second;
}

bool
HeaderLines::Read(std::string & line)
{
  line.clear();
  for (char letter = 0; m_File.get(letter);)
  {
    if (++m_Size > m_Longest)
    {
      return false;
    }
    if (letter == '\n')
    {
      line.resize(line.size() - (!line.empty() && line.back() == '\r' ? 1 : 0));
      return true;
    }
    line.push_back(letter);
  }
  return !line.empty();
}

std::optional<std::vector<double>>
NumbersOf(const std::string & text)
{
  const bool isInParentheses = text.size() > 1 && text.front() == '(' && text.back() == ')';
  std::string words = isInParentheses ? text.substr(1, text.size() - 2) : text;
  std::replace(words.begin(), words.end(), ',', ' ');
  return Parse<double>(words);
}

std::optional<std::vector<std::uintmax_t>>
CountsOf(const std::string & text)
{
  const auto counts = Parse<std::uintmax_t>(text);
  const bool fit =
    counts && std::all_of(counts->begin(), counts->end(), [](auto count) { return count <= LargestCount; });
  return fit ? counts : std::nullopt;
}

std::optional<double>
SkipOf(const std::string & text, bool isDeflated)
{
  constexpr double largest = 1e15;
  const auto numbers = NumbersOf(text);
  const double skip = numbers && numbers->size() == 1 ? numbers->front() : 0;
  const bool isValid = numbers && numbers->size() <= 1 && skip >= -1 && skip <= largest && !(skip < 0 && isDeflated);
  return isValid ? std::make_optional(skip) : std::nullopt;
}

std::vector<std::uintmax_t>
AxisSizes(const std::string & dimensionText, const std::string & sizesText, const fs::path & path)
{
  const auto dimension = CountsOf(dimensionText);
  const auto sizes = CountsOf(sizesText);
  RefuseVolumeIf(!dimension || dimension->size() != 1 || !sizes || sizes->size() != dimension->front() ||
                   std::count(sizes->begin(), sizes->end(), 0) > 0,
                 path,
                 "its header contradicts itself about its dimensions; export it again from its source");
  RefuseOtherIf(
    sizes->size() < 3, path, "it is a flat picture of " + Count(sizes->size(), "dimension") + ", not a volume");
  RefuseOtherIf(
    sizes->size() > 4, path, "it has " + std::to_string(sizes->size()) + " dimensions; extract one volume first");
  return *sizes;
}

fs::path
DetachedFile(const fs::path & header, const std::string & name)
{
  RefuseOtherIf(name.compare(0, 4, "LIST") == 0 || name.find('%') != std::string::npos,
                header,
                "its voxels are spread over several files, which is not supported; write it as one file");
  const fs::path relative(name);
  RefuseVolumeIf(relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end(),
                 header,
                 "its header leads to a file outside of its folder, " + name + "; put the two files into one folder");
  const fs::path path = header.parent_path() / relative;
  std::error_code error;
  RefuseVolumeIf(!fs::is_regular_file(path, error),
                 header,
                 "its voxels should be in " + path.string() + ", which is missing; put the two files into one folder");
  return path;
}

NRRDHeader
ReadNRRDHeader(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  std::string magic(8, '\0');
  file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  RefuseVolumeIf(!file || magic.compare(0, 7, "NRRD000") != 0 || magic[7] < '1' || magic[7] > '6',
                 path,
                 "its content is not NRRD, as its name says; check where it came from");
  NRRDHeader header;
  HeaderLines lines(file, LargestHeader - magic.size());
  std::string line;
  lines.Read(line);
  while (lines.Read(line) && !line.empty())
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
    const std::string_view value = Trim(std::string_view(line).substr(colon + 1));
    RefuseVolumeIf(line.compare(colon, 2, ": ") != 0 || (value.empty() && name != "content"),
                   path,
                   "its header's field '" + name +
                     "' has no value after a colon and a blank; export it again from its "
                     "source");
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    RefuseVolumeIf(!header.fields.emplace(name, value).second,
                   path,
                   "its header has the field '" + name + "' twice; export it again from its source");
    if (name == "datafile" && header.Get(name).compare(0, 4, "LIST") == 0)
    {
      break; // names of files follow
    }
  }
  header.size = magic.size() + lines.GetSize();
  RefuseVolumeIf(header.size > LargestHeader, path, "its header has no end within 16 MiB; check where it came from");
  return header;
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
