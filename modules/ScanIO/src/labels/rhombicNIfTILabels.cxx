#include "rhombicCompressedFile.h"
#include "rhombicLabelText.h"

#include <algorithm>
#include <cstring>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::size_t LongestExtensions = std::size_t{ 1 } << 24; // bytes, of all together

template <typename TValue>
TValue
NumberAt(std::string_view bytes, std::size_t offset, bool isSwapped)
{
  char value[sizeof(TValue)];
  std::memcpy(value, bytes.data() + offset, sizeof(TValue));
  if (isSwapped)
  {
    std::reverse(value, value + sizeof(TValue));
  }
  TValue result;
  std::memcpy(&result, value, sizeof(TValue));
  return result;
}

/** How a NIfTI header is laid out. */
struct HeaderLayout
{
  std::size_t size = 0; ///< bytes before the extensions' flags; 0 for what is no NIfTI header
  bool isSwapped = false;
};

HeaderLayout
LayoutOf(std::string_view bytes)
{
  for (const std::size_t size : { 348, 540 })
  {
    for (const bool isSwapped : { false, true })
    {
      if (bytes.size() >= size && NumberAt<std::int32_t>(bytes, 0, isSwapped) == static_cast<std::int32_t>(size))
      {
        return { size, isSwapped };
      }
    }
  }
  return {};
}

/** Where the voxels begin in a file of header and voxels; 0 in a header without. */
double
VoxelsOffset(std::string_view bytes, const HeaderLayout & layout)
{
  const bool isFirstVersion = layout.size == 348;
  const bool isPair = bytes.substr(isFirstVersion ? 344 : 4, 2) == "ni";
  return isPair           ? 0
         : isFirstVersion ? static_cast<double>(NumberAt<float>(bytes, 108, layout.isSwapped))
                          : static_cast<double>(NumberAt<std::int64_t>(bytes, 168, layout.isSwapped));
}

/** The first bytes of a file, or all if there are fewer. */
std::string
ReadBeginning(const fs::path & path, std::size_t size)
{
  std::string bytes(size, '\0');
  bytes.resize(UnpackedFile(path).Read(bytes.data(), size));
  return bytes;
}

/** All bytes before the voxels. */
std::string
ReadHeaderAndExtensions(const fs::path & path)
{
  constexpr std::size_t longestHeader = 540;
  const std::string header = ReadBeginning(path, longestHeader);
  const HeaderLayout layout = LayoutOf(header);
  if (layout.size == 0)
  {
    return "";
  }
  const double offset = VoxelsOffset(header, layout);
  const bool isPair = offset == 0;
  if (isPair)
  {
    return ReadBeginning(path, LongestExtensions);
  }
  if (!(offset >= static_cast<double>(layout.size) && offset <= static_cast<double>(LongestExtensions)))
  {
    return ""; // no extensions, or more than label tables need
  }
  return ReadBeginning(path, static_cast<std::size_t>(offset));
}

} // namespace

std::optional<LabelTable>
ReadNIfTILabelTable(const fs::path & path)
{
  const std::string bytes = ReadHeaderAndExtensions(path);
  const HeaderLayout layout = LayoutOf(bytes);
  const bool hasExtensions = layout.size > 0 && bytes.size() > layout.size + 4 && bytes[layout.size] != 0;
  if (!hasExtensions)
  {
    return std::nullopt;
  }

  // TotalSegmentator writes the code 0, "unknown", not that of Caret.
  constexpr std::int32_t unknownCode = 0;
  constexpr std::int32_t caretCode = 30;
  constexpr std::size_t prefixSize = 8; // an extension's size, with itself, and its code
  std::string_view rest = std::string_view(bytes).substr(layout.size + 4);
  while (rest.size() >= prefixSize)
  {
    const auto size = NumberAt<std::int32_t>(rest, 0, layout.isSwapped);
    const auto code = NumberAt<std::int32_t>(rest, 4, layout.isSwapped);
    if (size < static_cast<std::int32_t>(prefixSize) || static_cast<std::size_t>(size) > rest.size())
    {
      RefuseTable({ path.string() },
                  "an extension of its header says that it has " + std::to_string(size) + " bytes, but there are " +
                    std::to_string(rest.size()) + " before the voxels; export it again from its source");
    }
    std::string_view text = rest.substr(prefixSize, static_cast<std::size_t>(size) - prefixSize);
    rest.remove_prefix(static_cast<std::size_t>(size));
    while (!text.empty() && (text.back() == '\0' || text.back() == ' '))
    {
      text.remove_suffix(1);
    }
    const bool isCaret =
      (code == unknownCode || code == caretCode) && text.find("<CaretExtension") != std::string_view::npos;
    if (isCaret)
    {
      LabelTable table = ParseCaretLabels(text, "the label table in " + path.string());
      if (!table.empty())
      {
        return table;
      }
    }
  }
  return std::nullopt;
}

} // namespace rhombic
