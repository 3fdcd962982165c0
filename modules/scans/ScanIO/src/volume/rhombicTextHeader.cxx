#include "rhombicTextHeader.h"

#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include <algorithm>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::uintmax_t LargestCount = std::numeric_limits<std::int32_t>::max();

template <typename TNumber>
std::optional<std::vector<TNumber>>
Parse(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return letter == ',' || letter == '(' || letter == ')'; }, ' ');
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

} // namespace

std::optional<std::vector<double>>
NumbersOf(const std::string & text)
{
  return Parse<double>(text);
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
  if (!dimension || dimension->size() != 1 || !sizes || sizes->size() != dimension->front() ||
      std::count(sizes->begin(), sizes->end(), 0) > 0)
  {
    RefuseVolume(path, "its header contradicts itself about its dimensions; export it again from its source");
  }
  if (sizes->size() < 3)
  {
    RefuseVolume(path, "it is a flat picture of " + Count(sizes->size(), "dimension") + ", not a volume");
  }
  if (sizes->size() > 4)
  {
    RefuseVolume(path, "it has " + std::to_string(sizes->size()) + " dimensions; extract one volume first");
  }
  return *sizes;
}

fs::path
DetachedFile(const fs::path & header, const std::string & name)
{
  if (name.compare(0, 4, "LIST") == 0 || name.find('%') != std::string::npos)
  {
    RefuseVolume(header, "its voxels are spread over several files, which is not supported; write it as one file");
  }
  const fs::path relative(name);
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
  {
    RefuseVolume(header,
                 "its header leads to a file outside of its folder, " + name + "; put the two files into one folder");
  }
  const fs::path path = header.parent_path() / relative;
  std::error_code error;
  if (!fs::is_regular_file(path, error))
  {
    RefuseVolume(header,
                 "its voxels should be in " + path.string() + ", which is missing; put the two files into one folder");
  }
  return path;
}

} // namespace rhombic
