#include "rhombicCompressedFile.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicNIfTIHeader.h"

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::size_t LongestExtensions = std::size_t{ 1 } << 24; // bytes, of all together

/** The first bytes of a file, or all if there are fewer. */
std::string
ReadBeginning(const fs::path & path, std::size_t size)
{
  std::string bytes(size, '\0');
  bytes.resize(ByteStream(path, 0, IsGzip(path)).Read(bytes.data(), size));
  return bytes;
}

/** All bytes before the voxels: the header and its extensions. Empty when there is no room for label tables. */
std::string
ReadUpToVoxels(const fs::path & path, const NIfTIHeader & header)
{
  if (header.kind == NIfTIHeader::Kind::Pair || header.voxelsOffset == 0)
  {
    return ReadBeginning(path, LongestExtensions);
  }
  const bool isInRange = header.voxelsOffset >= static_cast<double>(header.size) &&
                         header.voxelsOffset <= static_cast<double>(LongestExtensions);
  return isInRange ? ReadBeginning(path, static_cast<std::size_t>(header.voxelsOffset)) : "";
}

} // namespace

std::optional<LabelTable>
ReadNIfTILabelTable(const fs::path & path)
{
  const auto header = FindNIfTIHeader(path);
  const std::string bytes = header ? ReadUpToVoxels(path, *header) : "";
  const bool hasExtensions = header && bytes.size() > header->size + 4 && bytes[header->size] != 0;
  if (!hasExtensions)
  {
    return std::nullopt;
  }

  // TotalSegmentator writes the code 0, "unknown", instead of Caret's.
  constexpr std::int32_t unknownCode = 0;
  constexpr std::int32_t caretCode = 30;
  constexpr std::size_t prefixSize = 8; // an extension's size (of all of it) and its code
  std::string_view rest = std::string_view(bytes).substr(header->size + 4);
  while (rest.size() >= prefixSize)
  {
    const auto size = NumberAt<std::int32_t>(rest, 0, header->isSwapped);
    const auto code = NumberAt<std::int32_t>(rest, 4, header->isSwapped);
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
