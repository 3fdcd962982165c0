#include "rhombicAnatomicalColours.h"
#include "rhombicFailure.h"
#include "rhombicLabelTableFormats.h"

#include <exception>
#include <map>
#include <memory>
#include <new>

#include <expat.h>

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
    XML_SetElementHandler(m_Parser.get(), &CaretReader::OnStart, &CaretReader::OnEnd);
    XML_SetCharacterDataHandler(m_Parser.get(), &CaretReader::OnText);
    XML_SetStartDoctypeDeclHandler(m_Parser.get(), &CaretReader::OnDocumentType);
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
  void
  Guard(const TAction & action)
  {
    try
    {
      action();
    }
    catch (...)
    {
      m_Exception = m_Exception ? m_Exception : std::current_exception();
      XML_StopParser(m_Parser.get(), XML_FALSE);
    }
  }

  static void
  OnStart(void * self, const char * name, const char ** attributes)
  {
    auto & reader = *static_cast<CaretReader *>(self);
    reader.Guard([&] {
      if (std::string_view(name) == "LabelTable")
      {
        reader.m_IsInTable = true;
      }
      reader.m_IsInLabel = reader.m_IsInTable && std::string_view(name) == "Label";
      if (reader.m_IsInLabel)
      {
        reader.m_Attributes.clear();
        reader.m_Name.clear();
        for (; attributes[0] != nullptr; attributes += 2)
        {
          reader.m_Attributes[attributes[0]] = attributes[1];
        }
      }
    });
  }

  static void
  OnText(void * self, const char * text, int size)
  {
    auto & reader = *static_cast<CaretReader *>(self);
    reader.Guard([&] {
      if (reader.m_IsInLabel)
      {
        reader.m_Name.append(text, static_cast<std::size_t>(size));
      }
    });
  }

  static void
  OnEnd(void * self, const char * name)
  {
    auto & reader = *static_cast<CaretReader *>(self);
    reader.Guard([&] {
      if (reader.m_IsInLabel)
      {
        reader.AddLabel();
      }
      reader.m_IsInLabel = false;
      reader.m_IsInTable = reader.m_IsInTable && std::string_view(name) != "LabelTable";
    });
  }

  static void
  OnDocumentType(void * self, const char *, const char *, const char *, int)
  {
    auto & reader = *static_cast<CaretReader *>(self);
    reader.Guard([&] {
      RefuseTable(reader.Place(), "its XML declares a document type, which label tables do not need; remove it");
    });
  }

  void
  AddLabel()
  {
    const TablePlace place = this->Place();
    const bool hasColour = m_Attributes.count("Red") + m_Attributes.count("Green") + m_Attributes.count("Blue") > 0;
    Label label;
    label.value = LabelValue(m_Attributes["Key"], place);
    label.name = SanitizeLabelName(m_Name, label.value);
    label.colour = hasColour ? UnitColour(m_Attributes["Red"], m_Attributes["Green"], m_Attributes["Blue"], place)
                             : AnatomicalColour(label.name, label.value);
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

} // namespace rhombic
