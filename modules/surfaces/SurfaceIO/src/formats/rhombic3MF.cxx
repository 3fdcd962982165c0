#include "rhombicFailure.h"
#include "rhombicSurfaceFormats.h"
#include "rhombicWording.h"
#include "rhombicZip.h"
#include "itkMatrix.h"

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <optional>

#include <expat.h>

namespace rhombic
{
namespace
{

// 3MF Consortium, "3D Manufacturing Format Core Specification", 1.3: an OPC package, which is a ZIP archive, whose
// relationships name a model.
constexpr const char * ModelName = "3D/3dmodel.model";
constexpr const char * ModelRelation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr const char * CoreNamespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr const char * RelationsNamespace = "http://schemas.openxmlformats.org/package/2006/relationships";
constexpr const char * ContentTypes =
  "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
  "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
  "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
  "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";

/** A name between quotes in XML. The two code points that XML lacks are replaced. */
std::string
Quoted(const std::string & name)
{
  std::string text;
  for (std::size_t n = 0; n < name.size(); ++n)
  {
    const std::string_view three = std::string_view(name).substr(n, 3);
    if (three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF")
    {
      text += "\xEF\xBF\xBD";
      n += 2;
      continue;
    }
    switch (name[n])
    {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += name[n];
    }
  }
  return '"' + text + '"';
}

/** "#RRGGBBAA"; nothing is wholly transparent. */
std::string
DisplayColour(const SceneSurface & item)
{
  constexpr std::string_view digits = "0123456789ABCDEF";
  const auto [red, green, blue] = ToBytes(item.colour);
  std::string text = "#";
  for (const std::uint8_t byte : { red, green, blue, std::max(ToByte(item.opacity), std::uint8_t{ 1 }) })
  {
    (text += digits[byte / 16]) += digits[byte % 16];
  }
  return text;
}

/** Appends ` name="number"`: the shortest text that is read as the same number, in any locale. */
template <typename TNumber>
void
AppendAttribute(const char * name, TNumber number, std::string & text)
{
  char digits[32];
  ((text += name) += "=\"").append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr) += '"';
}

void
AppendMesh(const SceneSurface & item, SurfaceFileSpace space, const std::filesystem::path & target, ZipWriter & zip)
{
  zip.Append("<mesh>\n<vertices>\n");
  std::string line;
  for (const auto & point : item.surface->GetPoints())
  {
    const auto [x, y, z] = Turned(point, space);
    line = "<vertex";
    AppendAttribute(" x", x, line);
    AppendAttribute(" y", y, line);
    AppendAttribute(" z", z, line);
    zip.Append(line += "/>\n");
  }
  zip.Append("</vertices>\n<triangles>\n");
  for (const auto & [a, b, c] : item.surface->GetTriangles())
  {
    if (a == b || b == c || c == a)
    {
      throw Failure(FailureKind::Output,
                    "Cannot write " + target.string() + ": a triangle of the surface " + item.name +
                      " has one point at two corners, which 3MF forbids; choose .vtp or .glb.");
    }
    line = "<triangle";
    AppendAttribute(" v1", a, line);
    AppendAttribute(" v2", b, line);
    AppendAttribute(" v3", c, line);
    zip.Append(line += "/>\n");
  }
  zip.Append("</triangles>\n</mesh>\n");
}

/** \class ParserMemory
 * \brief The memory of one parser. It ends what makes a parser slow or large: very long names and values, which expat
 * scans again with each block, elements in elements without end, and ever new names. */
class ParserMemory
{
public:
  static constexpr std::size_t Most = std::size_t{ 1 } << 22; // the parser of a usual file takes 100 kB

  /** The functions by which expat takes memory in this thread, from a new count on. */
  static const XML_Memory_Handling_Suite *
  Begin()
  {
    static const XML_Memory_Handling_Suite suite{ [](std::size_t size) { return Resize(nullptr, size); },
                                                  Resize,
                                                  [](void * block) { Resize(block, 0); } };
    s_Taken = 0;
    return &suite;
  }

private:
  static constexpr std::size_t Header = alignof(std::max_align_t); // holds the size of the block

  /** As std::realloc, but a size of 0 always frees. */
  static void *
  Resize(void * block, std::size_t size)
  {
    auto * const old = block != nullptr ? static_cast<char *>(block) - Header : nullptr;
    std::size_t oldSize = 0;
    if (old != nullptr)
    {
      std::memcpy(&oldSize, old, sizeof(oldSize));
    }
    if (size == 0)
    {
      s_Taken -= oldSize;
      std::free(old);
      return nullptr;
    }
    const bool isTooMuch = size > Most || s_Taken - oldSize > Most - size;
    auto * const made = isTooMuch ? nullptr : static_cast<char *>(std::realloc(old, Header + size));
    if (made == nullptr)
    {
      return nullptr;
    }
    s_Taken += size - oldSize;
    std::memcpy(made, &size, sizeof(size));
    return made + Header;
  }

  static thread_local std::size_t s_Taken;
};

thread_local std::size_t ParserMemory::s_Taken = 0;

using Attributes = const XML_Char **;

/** The attribute's text; empty if there is none. */
std::string_view
AttributeOf(Attributes attributes, std::string_view name)
{
  for (; *attributes != nullptr; attributes += 2)
  {
    if (name == attributes[0])
    {
      return attributes[1];
    }
  }
  return {};
}

/** \class XMLPart
 * \brief Parses a part of the archive, element by element, by expat. Elements of 3MF's core and of relationships have
 * their names without a prefix, whatever prefix the part gives to the namespace; others have names that nothing is
 * called. Parts with a document type are refused, so nothing expands. Parts whose parser would need much memory are
 * refused, too. */
class XMLPart
{
public:
  virtual ~XMLPart() = default;

  void
  Parse(const InputFile & file, const ZipReader & zip, const ZipPart & part)
  {
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(
      XML_ParserCreate_MM(nullptr, ParserMemory::Begin(), Separator), XML_ParserFree);
    m_Parser = parser.get();
    XML_SetUserData(m_Parser, this);
    XML_SetElementHandler(m_Parser, &XMLPart::OnBegin, &XMLPart::OnEnd);
    XML_SetCharacterDataHandler(m_Parser, &XMLPart::OnText);
    XML_SetStartDoctypeDeclHandler(m_Parser, &XMLPart::OnDocumentType);
    XML_SetStartNamespaceDeclHandler(m_Parser, &XMLPart::OnNamespace);
    const auto parse = [&](std::string_view bytes, bool isLast) {
      const auto status = XML_Parse(m_Parser, bytes.data(), static_cast<int>(bytes.size()), isLast ? 1 : 0);
      if (m_Failure)
      {
        std::rethrow_exception(m_Failure);
      }
      if (status != XML_STATUS_OK && XML_GetErrorCode(m_Parser) == XML_ERROR_NO_MEMORY)
      {
        file.RefuseDamaged("its part " + part.name + " has names or values that are too long, or too many names");
      }
      if (status != XML_STATUS_OK)
      {
        file.RefuseDamaged("its part " + part.name + " is no XML from line " +
                           std::to_string(XML_GetCurrentLineNumber(m_Parser)) + " on (" +
                           XML_ErrorString(XML_GetErrorCode(m_Parser)) + ")");
      }
    };
    zip.Unpack(part, [&parse](std::string_view bytes) { parse(bytes, false); });
    parse({}, true);
  }

protected:
  /** The namespace that a prefix stands for; empty for an unknown prefix. */
  std::string
  NamespaceOf(std::string_view prefix) const
  {
    const auto found = m_Namespaces.find(prefix);
    return found != m_Namespaces.end() ? found->second : "";
  }

  virtual void
  BeginElement(std::string_view name, Attributes attributes) = 0;
  virtual void
  EndElement(std::string_view)
  {}
  virtual void
  AddText(std::string_view)
  {}

private:
  /** Failures cross expat, which is C, as a stop of the parser. */
  template <typename TAction>
  static void
  Guarded(void * self, const TAction & action)
  {
    auto & part = *static_cast<XMLPart *>(self);
    if (part.m_Failure)
    {
      return;
    }
    try
    {
      action(part);
    }
    catch (...)
    {
      part.m_Failure = std::current_exception();
      XML_StopParser(part.m_Parser, XML_FALSE);
    }
  }

  /** An element's name without its namespace, if that is known or there is none; else with it. */
  static std::string_view
  OwnName(std::string_view name)
  {
    const std::size_t separator = name.rfind(*Separator);
    const std::string_view space = name.substr(0, separator);
    const bool isOwn = separator == name.npos || space == CoreNamespace || space == RelationsNamespace;
    return isOwn ? name.substr(separator + 1) : name;
  }

  static void
  OnBegin(void * self, const XML_Char * name, const XML_Char ** attributes)
  {
    Guarded(self, [&](XMLPart & part) { part.BeginElement(OwnName(name), attributes); });
  }
  static void
  OnEnd(void * self, const XML_Char * name)
  {
    Guarded(self, [&](XMLPart & part) { part.EndElement(OwnName(name)); });
  }
  static void
  OnNamespace(void * self, const XML_Char * prefix, const XML_Char * name)
  {
    Guarded(self, [&](XMLPart & part) {
      if (part.m_Namespaces.size() < MostNamespaces)
      {
        part.m_Namespaces.emplace(prefix != nullptr ? prefix : "", name != nullptr ? name : "");
      }
    });
  }
  static void
  OnText(void * self, const XML_Char * text, int size)
  {
    Guarded(self, [&](XMLPart & part) { part.AddText({ text, static_cast<std::size_t>(size) }); });
  }
  static void
  OnDocumentType(void * self, const XML_Char *, const XML_Char *, const XML_Char *, int)
  {
    XML_StopParser(static_cast<XMLPart *>(self)->m_Parser, XML_FALSE);
  }

  static constexpr const XML_Char * Separator = " "; // between namespace and name
  static constexpr std::size_t MostNamespaces = 1000;

  XML_Parser m_Parser = nullptr;
  std::map<std::string, std::string, std::less<>> m_Namespaces; ///< by prefix
  std::exception_ptr m_Failure;
};

/** \class Relationships
 * \brief Finds the part with the model. */
class Relationships : public XMLPart
{
public:
  std::string model; ///< without a slash at the beginning; empty if there is none

protected:
  void
  BeginElement(std::string_view name, Attributes attributes) override
  {
    if (name == "Relationship" && AttributeOf(attributes, "Type") == ModelRelation)
    {
      model = AttributeOf(attributes, "Target");
      model.erase(0, model.find_first_not_of('/'));
    }
  }
};

/** The affine transform x -> linear x + offset. */
struct Placement
{
  itk::Matrix<double, 3, 3> linear;
  itk::Vector<double, 3> offset{ 0.0 };

  /** The placement that applies \a other first, then this one. */
  Placement
  After(const Placement & other) const
  {
    return { linear * other.linear, linear * other.offset + offset };
  }
};

/** \class ModelPart
 * \brief Collects the objects of a model; Surfaces() then has one surface for each mesh that is built. */
class ModelPart : public XMLPart
{
public:
  explicit ModelPart(const InputFile & file)
    : m_File(file)
  {}

  std::vector<SceneSurface>
  TakeSurfaces()
  {
    const double turn = m_Space == SurfaceFileSpace::RAS ? -1 : 1;
    for (const Instance & item : m_Items)
    {
      this->AddInstance(item, Scaled({ turn * m_Unit, turn * m_Unit, m_Unit }), 0);
    }
    return std::move(m_Surfaces);
  }

protected:
  void
  BeginElement(std::string_view name, Attributes attributes) override
  {
    if (name == "vertex" && m_Object != nullptr)
    {
      this->AddVertex(attributes);
    }
    else if (name == "triangle" && m_Object != nullptr)
    {
      this->AddTriangle(attributes);
    }
    else if (name == "object")
    {
      this->BeginObject(attributes);
    }
    else if (name == "component" && m_Object != nullptr)
    {
      m_Object->components.push_back(this->InstanceOf(attributes));
    }
    else if (name == "item")
    {
      m_Items.push_back(this->InstanceOf(attributes));
    }
    else if (name == "basematerials")
    {
      m_Group = AttributeOf(attributes, "id");
    }
    else if (name == "base")
    {
      m_Materials[m_Group].push_back(LookOf(AttributeOf(attributes, "displaycolor")));
    }
    else if (name == "model")
    {
      this->BeginModel(attributes);
    }
    const bool isOfMesh = name == "vertex" || name == "triangle";
    if (!isOfMesh && ++m_OtherElements > MostOtherElements)
    {
      m_File.RefuseDamaged("it has more than " + std::to_string(MostOtherElements) + " elements beside its meshes");
    }
    m_IsMetadata = name == "metadata";
  }

  void
  EndElement(std::string_view name) override
  {
    if (name == "object")
    {
      m_Object = nullptr;
    }
    m_IsMetadata = false;
    m_Text.clear();
  }

  void
  AddText(std::string_view text) override
  {
    if (m_IsMetadata && m_Text.size() < 1000)
    {
      m_Space = SaysRAS(m_Text.append(text)) ? SurfaceFileSpace::RAS : m_Space;
    }
  }

private:
  /** An object at a place, in the build or in another object. */
  struct Instance
  {
    std::string object; ///< its id
    Placement placement;
  };

  struct Object
  {
    SceneSurface item; ///< without its surface
    itk::TriangleSurface::Pointer surface = itk::TriangleSurface::New();
    std::vector<Instance> components;
  };

  static Placement
  Scaled(const std::array<double, 3> & factors)
  {
    Placement placement;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      placement.linear(axis, axis) = factors[axis];
    }
    return placement;
  }

  void
  BeginModel(Attributes attributes)
  {
    static const std::map<std::string_view, double> units{ { "micron", 0.001 },  { "millimeter", 1 }, { "", 1 },
                                                           { "centimeter", 10 }, { "inch", 25.4 },    { "foot", 304.8 },
                                                           { "meter", 1000 } };
    const auto found = units.find(AttributeOf(attributes, "unit"));
    if (found == units.end())
    {
      m_File.RefuseDamaged("its unit of length is none of 3MF");
    }
    m_Unit = found->second;
    for (const std::string_view prefix : SplitWords(AttributeOf(attributes, "requiredextensions")))
    {
      const std::string extension = this->NamespaceOf(prefix);
      if (extension != CoreNamespace &&
          extension.find("/material/") == extension.npos) // materials change the look alone
      {
        m_File.Refuse("it requires the extension " + (extension.empty() ? std::string(prefix) : extension) +
                      ", which is not supported; export it without");
      }
    }
    m_HasModel = true;
  }

  void
  BeginObject(Attributes attributes)
  {
    if (!m_HasModel)
    {
      m_File.RefuseDamaged("it has an object outside of a model");
    }
    Object & object = m_Objects[std::string(AttributeOf(attributes, "id"))];
    if (object.surface->GetNumberOfPoints() > 0 || !object.components.empty())
    {
      m_File.RefuseDamaged("two of its objects have the same number");
    }
    const auto group = m_Materials.find(AttributeOf(attributes, "pid"));
    const auto index = ParseNumber<std::size_t>(AttributeOf(attributes, "pindex"));
    if (group != m_Materials.end() && index && *index < group->second.size())
    {
      object.item = group->second[*index];
    }
    object.item.name = AttributeOf(attributes, "name");
    object.item.name = object.item.name.empty() ? m_File.GetStem() : object.item.name;
    m_Object = &object;
  }

  void
  AddVertex(Attributes attributes)
  {
    constexpr std::string_view names[]{ "x", "y", "z" };
    itk::TriangleSurface::PointType point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto number = ParseNumber<float>(AttributeOf(attributes, names[axis]));
      if (!number || !std::isfinite(*number))
      {
        m_File.RefuseDamaged("a vertex has no three numbers");
      }
      point[axis] = *number;
    }
    m_Object->surface->GetPoints().push_back(point);
  }

  void
  AddTriangle(Attributes attributes)
  {
    constexpr std::string_view names[]{ "v1", "v2", "v3" };
    itk::TriangleSurface::TriangleType triangle;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const std::string_view word = AttributeOf(attributes, names[corner]);
      const auto point = ParseNumber<std::uint32_t>(word);
      if (!point || *point >= m_Object->surface->GetNumberOfPoints())
      {
        m_File.RefuseDamaged("a triangle has a corner at point '" + std::string(word.substr(0, 20)) +
                             "', which its mesh does not have");
      }
      triangle[corner] = *point;
    }
    m_Object->surface->GetTriangles().push_back(triangle);
  }

  /** Of a component or item. Its transform has twelve numbers: the images of three axes, and the offset. */
  Instance
  InstanceOf(Attributes attributes) const
  {
    Instance instance{ std::string(AttributeOf(attributes, "objectid")), Scaled({ 1, 1, 1 }) };
    const std::vector<std::string_view> words = SplitWords(AttributeOf(attributes, "transform"));
    for (std::size_t n = 0; n < words.size(); ++n)
    {
      const auto number = ParseNumber<double>(words[n]);
      if (words.size() != 12 || !number || !std::isfinite(*number))
      {
        m_File.RefuseDamaged("a transform has no twelve numbers");
      }
      const auto row = static_cast<unsigned int>(n / 3);
      const auto axis = static_cast<unsigned int>(n % 3);
      (row < 3 ? instance.placement.linear(axis, row) : instance.placement.offset[axis]) = *number;
    }
    return instance;
  }

  void
  AddInstance(const Instance & instance, const Placement & around, int depth)
  {
    constexpr int deepest = 1000;
    constexpr std::size_t most = 100000;
    const auto found = m_Objects.find(instance.object);
    if (found == m_Objects.end())
    {
      m_File.RefuseDamaged("it builds an object that it does not have");
    }
    if (depth > deepest || ++m_Instances > most)
    {
      m_File.RefuseDamaged("its objects are put together of too many others");
    }
    const Object & object = found->second;
    const Placement placement = around.After(instance.placement);
    if (object.surface->GetNumberOfTriangles() > 0)
    {
      SceneSurface item = object.item;
      item.surface = this->Placed(*object.surface, placement);
      m_Surfaces.push_back(std::move(item));
    }
    for (const Instance & component : object.components)
    {
      this->AddInstance(component, placement, depth + 1);
    }
  }

  /** The surface itself, if the placement leaves it where it is. */
  itk::TriangleSurface::ConstPointer
  Placed(const itk::TriangleSurface & surface, const Placement & placement)
  {
    if (placement.linear == Scaled({ 1, 1, 1 }).linear && placement.offset == Placement().offset)
    {
      return &surface;
    }
    m_Memory += 12 * (surface.GetNumberOfPoints() + surface.GetNumberOfTriangles());
    m_File.RequireMemoryToRead(m_Memory);
    const auto placed = itk::TriangleSurface::New();
    for (const auto & point : surface.GetPoints())
    {
      const auto p = placement.linear * itk::Vector<double, 3>(itk::Vector<float, 3>(point.data())) + placement.offset;
      placed->GetPoints().push_back({ static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]) });
    }
    const bool isMirrored = vnl_determinant(placement.linear.GetVnlMatrix().as_matrix()) < 0;
    for (const auto & [a, b, c] : surface.GetTriangles())
    {
      placed->GetTriangles().push_back({ a, isMirrored ? c : b, isMirrored ? b : c });
    }
    return placed.GetPointer();
  }

  static SceneSurface
  LookOf(std::string_view colour)
  {
    SceneSurface look;
    std::uint32_t bytes = 0;
    const bool isHex =
      colour.size() >= 7 && colour[0] == '#' &&
      std::from_chars(colour.data() + 1, colour.data() + colour.size(), bytes, 16).ptr == colour.data() + colour.size();
    if (isHex && (colour.size() == 7 || colour.size() == 9))
    {
      bytes = colour.size() == 7 ? bytes << 8 | 0xff : bytes;
      look.colour = { (bytes >> 24) / 255.0, (bytes >> 16 & 0xff) / 255.0, (bytes >> 8 & 0xff) / 255.0 };
      look.opacity = (bytes & 0xff) / 255.0;
    }
    return look;
  }

  const InputFile & m_File;
  bool m_HasModel = false;
  double m_Unit = 1; ///< mm
  SurfaceFileSpace m_Space = SurfaceFileSpace::LPS;
  bool m_IsMetadata = false;
  std::string m_Text;
  std::string m_Group; ///< id of the materials that are being read
  std::map<std::string, std::vector<SceneSurface>, std::less<>> m_Materials;
  std::map<std::string, Object, std::less<>> m_Objects;
  Object * m_Object = nullptr; ///< the one that is being read
  std::vector<Instance> m_Items;
  static constexpr std::size_t MostOtherElements = 100000;
  std::size_t m_OtherElements = 0; ///< beside points and triangles
  std::size_t m_Instances = 0;
  std::uint64_t m_Memory = 0; ///< bytes of placed surfaces so far
  std::vector<SceneSurface> m_Surfaces;
};

} // namespace

void
Write3MF(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  ZipWriter zip(file);
  zip.Begin("[Content_Types].xml");
  zip.Append(ContentTypes);
  zip.Begin("_rels/.rels");
  zip.Append(std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"") + RelationsNamespace +
             "\"><Relationship Target=\"/" + ModelName + "\" Id=\"rel0\" Type=\"" + ModelRelation +
             "\"/></Relationships>\n");
  zip.Begin(ModelName);
  zip.Append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"" +
             std::string(CoreNamespace) +
             "\">\n"
             "<metadata name=\"Application\">Rhombic</metadata>\n<metadata name=\"Description\">SPACE=" +
             std::string(NameOf(space)) + " UNIT=mm</metadata>\n<resources>\n<basematerials id=\"1\">\n");
  for (const SceneSurface & item : surfaces)
  {
    zip.Append("<base name=" + Quoted(item.name) + " displaycolor=\"" + DisplayColour(item) + "\"/>\n");
  }
  zip.Append("</basematerials>\n");
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    zip.Append("<object id=\"" + std::to_string(n + 2) + "\" type=\"model\" name=" + Quoted(surfaces[n].name) +
               " pid=\"1\" pindex=\"" + std::to_string(n) + "\">\n");
    AppendMesh(surfaces[n], space, file.GetTarget(), zip);
    zip.Append("</object>\n");
  }
  zip.Append("</resources>\n<build>\n");
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    zip.Append("<item objectid=\"" + std::to_string(n + 2) + "\"/>\n");
  }
  zip.Append("</build>\n</model>\n");
  zip.Close();
}

std::vector<SceneSurface>
Read3MF(const InputFile & file)
{
  const ZipReader zip(file);
  const ZipPart * part = zip.Find("_rels/.rels");
  if (part != nullptr)
  {
    Relationships relationships;
    relationships.Parse(file, zip, *part);
    part = zip.Find(relationships.model);
  }
  if (part == nullptr)
  {
    file.Refuse("it is a ZIP archive without a model; check what kind of file it is");
  }
  file.RequireMemoryToRead(part->size); // a vertex or triangle takes 23 letters or more, and 12 bytes in memory
  ModelPart model(file);
  model.Parse(file, zip, *part);
  return model.TakeSurfaces();
}

} // namespace rhombic
