#include "rhombicLabelTable.h"

#include "rhombicCompressedFile.h"
#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicNIfTIHeader.h"

#include <expat.h>

#include <exception>
#include <map>
#include <memory>
#include <new>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** Collects the Label elements while expat parses. Expat is a C library, so exceptions of its callbacks are kept until
 * it returns. */
class CaretReader
{
public:
  explicit CaretReader(const std::string & source)
    : m_Source(source)
    , m_Parser(XML_ParserCreate(nullptr), &XML_ParserFree)
  {
    if (m_Parser == nullptr)
    {
      throw std::bad_alloc();
    }
    XML_SetUserData(m_Parser.get(), this);
    XML_SetElementHandler(
      m_Parser.get(),
      [](void * self, const char * name, const char ** attributes) {
        Guard(self, [&](CaretReader & reader) { reader.OnStart(name, attributes); });
      },
      [](void * self, const char * name) { Guard(self, [&](CaretReader & reader) { reader.OnEnd(name); }); });
    XML_SetCharacterDataHandler(m_Parser.get(), [](void * self, const char * text, int size) {
      Guard(self, [&](CaretReader & reader) { reader.m_Name.append(text, static_cast<std::size_t>(size)); });
    });
    XML_SetStartDoctypeDeclHandler(m_Parser.get(), [](void * self, const char *, const char *, const char *, int) {
      Guard(self, [](CaretReader & reader) {
        RefuseTable(reader.Place(), "its XML declares a document type, which label tables do not need; remove it");
      });
    });
  }

  LabelTable
  Read(std::string_view xml)
  {
    const XML_Status status = XML_Parse(m_Parser.get(), xml.data(), static_cast<int>(xml.size()), XML_TRUE);
    if (m_Exception)
    {
      std::rethrow_exception(m_Exception);
    }
    if (status != XML_STATUS_OK)
    {
      RefuseTable(this->Place(),
                  std::string("its XML is damaged (") + XML_ErrorString(XML_GetErrorCode(m_Parser.get())) +
                    "); write the labels again");
    }
    return m_Labels.Take();
  }

private:
  TablePlace
  Place() const
  {
    return { m_Source, XML_GetCurrentLineNumber(m_Parser.get()) };
  }

  template <typename TAction>
  static void
  Guard(void * self, const TAction & action)
  {
    auto & reader = *static_cast<CaretReader *>(self);
    try
    {
      action(reader);
    }
    catch (...)
    {
      reader.m_Exception = reader.m_Exception ? reader.m_Exception : std::current_exception();
      XML_StopParser(reader.m_Parser.get(), XML_FALSE);
    }
  }

  void
  OnStart(std::string_view name, const char ** attributes)
  {
    m_IsInTable = m_IsInTable || name == "LabelTable";
    m_IsInLabel = m_IsInTable && name == "Label";
    m_Attributes.clear();
    m_Name.clear();
    for (; m_IsInLabel && attributes[0] != nullptr; attributes += 2)
    {
      m_Attributes[attributes[0]] = attributes[1];
    }
  }

  void
  OnEnd(std::string_view name)
  {
    if (m_IsInLabel)
    {
      this->AddLabel();
    }
    m_IsInLabel = false;
    m_IsInTable = m_IsInTable && name != "LabelTable";
  }

  void
  AddLabel()
  {
    const TablePlace place = this->Place();
    const bool hasColour = m_Attributes.count("Red") + m_Attributes.count("Green") + m_Attributes.count("Blue") > 0;
    Label label = NamedLabel(LabelValue(m_Attributes["Key"], place), m_Name);
    label.colour =
      hasColour ? UnitColour(m_Attributes["Red"], m_Attributes["Green"], m_Attributes["Blue"], place) : label.colour;
    label.opacity = m_Attributes.count("Alpha") > 0 ? RealNumber(m_Attributes["Alpha"], 0, 1, "alpha", place) : 1;
    label.isVisible = label.opacity > 0;
    m_Labels.Add(std::move(label), place);
  }

  const std::string & m_Source;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> m_Parser;
  std::exception_ptr m_Exception;
  LabelCollector m_Labels;
  bool m_IsInTable = false;
  bool m_IsInLabel = false;
  std::map<std::string, std::string> m_Attributes; ///< attributes of the label that is being read
  std::string m_Name;
};

constexpr std::size_t LongestExtensions = std::size_t{ 1 } << 24; // bytes, of all together

/** All bytes before the voxels: the header and its extensions. Empty when there is no room for label tables. */
std::string
ReadUpToVoxels(const fs::path & path, const NIfTIHeader & header)
{
  const bool areInOtherFile = header.kind == NIfTIHeader::Kind::Pair || header.voxelsOffset == 0;
  const bool isInRange = header.voxelsOffset >= static_cast<double>(header.size) &&
                         header.voxelsOffset <= static_cast<double>(LongestExtensions);
  if (!areInOtherFile && !isInRange)
  {
    return "";
  }
  std::string bytes(areInOtherFile ? LongestExtensions : static_cast<std::size_t>(header.voxelsOffset), '\0');
  bytes.resize(ByteStream(path, 0, IsGzip(path)).Read(bytes.data(), bytes.size()));
  return bytes;
}

} // namespace

LabelTable
ParseCaretLabels(std::string_view xml, const std::string & source)
{
  if (xml.size() > LongestLabelTable)
  {
    RefuseTable({ source }, "its XML is longer than 1 MiB, too long for a label table; check that it is one");
  }
  return CaretReader(source).Read(xml);
}

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
