#include "rhombicVTPDocument.h"

#include "rhombicWords.h"

#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <memory>
#include <new>

#include <expat.h>

namespace rhombic
{
namespace
{

/** Collects the elements while expat parses. Expat is a C library, so exceptions of its callbacks are kept and thrown
 * again after it has returned. */
class DocumentParser
{
public:
  explicit DocumentParser(const InputFile & file)
    : m_File(file)
    , m_Parser(XML_ParserCreate(nullptr), &XML_ParserFree)
  {
    if (m_Parser == nullptr)
    {
      throw std::bad_alloc();
    }
    XML_SetUserData(m_Parser.get(), this);
    XML_SetElementHandler(m_Parser.get(), &DocumentParser::OnStart, &DocumentParser::OnEnd);
    XML_SetCharacterDataHandler(m_Parser.get(), &DocumentParser::OnText);
    XML_SetStartDoctypeDeclHandler(m_Parser.get(), &DocumentParser::OnDocumentType);
  }

  VTPDocument
  Parse()
  {
    constexpr std::size_t blockSize = std::size_t{ 1 } << 16;
    std::vector<char> block(blockSize);
    for (std::uintmax_t place = 0; place < m_File.GetSize() && m_Document.appendedAt == 0;)
    {
      const auto size = static_cast<std::size_t>(std::min<std::uintmax_t>(blockSize, m_File.GetSize() - place));
      m_File.Read(place, block.data(), size);
      place += size;
      const XML_Status status =
        XML_Parse(m_Parser.get(), block.data(), static_cast<int>(size), place == m_File.GetSize());
      if (m_Exception)
      {
        std::rethrow_exception(m_Exception);
      }
      if (status != XML_STATUS_OK && m_Document.appendedAt == 0)
      {
        m_File.Refuse(std::string("its XML is damaged (") + XML_ErrorString(XML_GetErrorCode(m_Parser.get())) +
                      " in line " + std::to_string(XML_GetCurrentLineNumber(m_Parser.get())) + "); export it again");
      }
    }
    if (m_Document.pieces.empty())
    {
      m_File.Refuse("it holds no PolyData; export it as a surface");
    }
    return std::move(m_Document);
  }

private:
  using Attributes = std::map<std::string, std::string, std::less<>>;

  /** Runs an action and keeps its exception. Does nothing after an exception: expat reports the end of an empty element
   * even after it was stopped. */
  template <typename TAction>
  void
  Guard(const TAction & action)
  {
    if (m_Exception)
    {
      return;
    }
    try
    {
      action();
    }
    catch (...)
    {
      m_Exception = std::current_exception();
      XML_StopParser(m_Parser.get(), XML_FALSE);
    }
  }

  static void
  OnStart(void * self, const char * name, const char ** pairs)
  {
    auto & parser = *static_cast<DocumentParser *>(self);
    parser.Guard([&] {
      Attributes attributes;
      for (; pairs[0] != nullptr; pairs += 2)
      {
        attributes[pairs[0]] = pairs[1];
      }
      parser.Start(name, attributes);
      parser.m_Path.emplace_back(name);
    });
  }

  static void
  OnText(void * self, const char * text, int size)
  {
    auto & parser = *static_cast<DocumentParser *>(self);
    parser.Guard([&] {
      if (parser.m_Array != nullptr)
      {
        parser.m_Array->text.append(text, static_cast<std::size_t>(size));
      }
    });
  }

  static void
  OnEnd(void * self, const char *)
  {
    auto & parser = *static_cast<DocumentParser *>(self);
    parser.Guard([&] {
      parser.m_Array = nullptr;
      parser.m_Path.pop_back();
    });
  }

  static void
  OnDocumentType(void * self, const char *, const char *, const char *, int)
  {
    auto & parser = *static_cast<DocumentParser *>(self);
    parser.Guard([&] { parser.m_File.Refuse("its XML declares a document type, which VTP does not need; remove it"); });
  }

  void
  Start(const std::string & name, const Attributes & attributes)
  {
    if (m_Path.empty() != (name == "VTKFile"))
    {
      m_File.Refuse("it is no file of VTK's XML; check what kind of file it is");
    }
    if (name == "VTKFile")
    {
      this->StartFile(attributes);
    }
    else if (name == "Piece")
    {
      this->StartPiece(attributes);
    }
    else if (name == "PointData" && !m_Document.pieces.empty())
    {
      m_Document.pieces.back().normals = Get(attributes, "Normals");
    }
    else if (name == "DataArray" || name == "Array")
    {
      this->StartArray(attributes);
    }
    else if (name == "AppendedData")
    {
      this->StartAppended(attributes);
    }
  }

  static std::string
  Get(const Attributes & attributes, std::string_view name)
  {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string() : found->second;
  }

  std::uint64_t
  GetCount(const Attributes & attributes, const std::string & name) const
  {
    const std::string text = Get(attributes, name);
    const auto count = text.empty() ? 0 : ParseNumber<std::uint64_t>(text);
    if (!count)
    {
      m_File.RefuseDamaged("its " + name + " is no number");
    }
    return *count;
  }

  void
  StartFile(const Attributes & attributes)
  {
    const std::string compressor = Get(attributes, "compressor");
    if (Get(attributes, "type") != "PolyData")
    {
      m_File.Refuse("it holds no PolyData; export it as a surface");
    }
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    {
      m_File.Refuse("it is compressed by another method than zlib; export it without compression");
    }
    m_Document.isCompressed = !compressor.empty();
    m_Document.isBigEndian = Get(attributes, "byte_order") == "BigEndian";
    m_Document.hasLongSizes = Get(attributes, "header_type") == "UInt64";
  }

  void
  StartPiece(const Attributes & attributes)
  {
    VTPPiece & piece = m_Document.pieces.emplace_back();
    piece.points = this->GetCount(attributes, "NumberOfPoints");
    piece.polygons = this->GetCount(attributes, "NumberOfPolys");
    if (this->GetCount(attributes, "NumberOfStrips") > 0)
    {
      m_File.Refuse("it has triangle strips; export it with triangles");
    }
  }

  void
  StartArray(const Attributes & attributes)
  {
    const std::string section = m_Path.back();
    const bool isField = section == "FieldData";
    if (!isField &&
        (m_Document.pieces.empty() || (section != "Points" && section != "Polys" && section != "PointData")))
    {
      return;
    }
    auto & arrays = isField ? m_Document.fields : m_Document.pieces.back().arrays;
    arrays.push_back({ section,
                       Get(attributes, "Name"),
                       Get(attributes, "type"),
                       Get(attributes, "format"),
                       this->GetCount(attributes, "offset"),
                       {} });
    m_Array = &arrays.back();
  }

  /** Stops the parser: what follows may be no XML. */
  void
  StartAppended(const Attributes & attributes)
  {
    m_Document.isBase64 = Get(attributes, "encoding") == "base64";
    std::uintmax_t place = static_cast<std::uintmax_t>(XML_GetCurrentByteIndex(m_Parser.get())) +
                           static_cast<std::uintmax_t>(XML_GetCurrentByteCount(m_Parser.get()));
    char mark = ' ';
    while (mark == ' ' || mark == '\n' || mark == '\r' || mark == '\t')
    {
      m_File.Read(place++, &mark, 1);
    }
    if (mark != '_')
    {
      m_File.RefuseDamaged("its appended data do not begin with \"_\"");
    }
    this->CheckEnd();
    m_Document.appendedAt = place;
    XML_StopParser(m_Parser.get(), XML_FALSE);
  }

  /** Checks that the file is complete. Reading would not find that out: some arrays are never read. */
  void
  CheckEnd() const
  {
    std::string end(std::min<std::uintmax_t>(m_File.GetSize(), 256), '\0');
    m_File.Read(m_File.GetSize() - end.size(), end.data(), end.size());
    if (end.find("</VTKFile>") == std::string::npos)
    {
      m_File.Refuse("it ends before its arrays do; it may be a part of a file, so copy or export it again");
    }
  }

  const InputFile & m_File;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> m_Parser;
  std::exception_ptr m_Exception;
  VTPDocument m_Document;
  std::vector<std::string> m_Path; ///< names of the open elements
  VTPArray * m_Array = nullptr;    ///< the array whose text is being read
};

} // namespace

VTPDocument
ParseVTPDocument(const InputFile & file)
{
  return DocumentParser(file).Parse();
}

} // namespace rhombic
