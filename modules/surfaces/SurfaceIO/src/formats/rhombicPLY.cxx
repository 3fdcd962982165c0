#include "rhombicSurfaceFormats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace rhombic
{
namespace
{

/** The comment by which ReadPLY() divides the file into surfaces: name, colour, opacity and numbers of points and
 * triangles, as one line of JSON in ASCII. */
std::string
DescribeSurface(const SceneSurface & item)
{
  const nlohmann::json description{ { "name", item.name },
                                    { "colour", ToBytes(item.colour) },
                                    { "opacity", item.opacity },
                                    { "points", item.surface->GetNumberOfPoints() },
                                    { "triangles", item.surface->GetNumberOfTriangles() } };
  return "comment SURFACE " + description.dump(-1, ' ', true) + "\n";
}

std::string
MakeHeader(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, bool haveNormals)
{
  std::string header = std::string("ply\nformat binary_little_endian 1.0\ncomment Rhombic\ncomment SPACE=") +
                       NameOf(space) + "\ncomment UNIT=mm\n";
  itk::SizeValueType points = 0, triangles = 0;
  for (const SceneSurface & item : surfaces)
  {
    header += DescribeSurface(item);
    points += item.surface->GetNumberOfPoints();
    triangles += item.surface->GetNumberOfTriangles();
  }
  header += "element vertex " + std::to_string(points) + "\nproperty float x\nproperty float y\nproperty float z\n";
  header += haveNormals ? "property float nx\nproperty float ny\nproperty float nz\n" : "";
  header += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  return header + "element face " + std::to_string(triangles) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
}

/** Takes the next number of a binary file. */
template <typename TNumber>
double
TakeBinary(InputStream & stream, bool isBigEndian)
{
  std::array<char, sizeof(TNumber)> bytes;
  stream.Take(bytes.data(), bytes.size());
  if (isBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  TNumber number;
  std::memcpy(&number, bytes.data(), bytes.size());
  return static_cast<double>(number);
}

/** A type of numbers. */
struct NumberType
{
  std::string_view name;
  std::string_view nameWithSize; ///< in later files
  std::size_t size;              ///< bytes
  double (*takeBinary)(InputStream & stream, bool isBigEndian);
};

template <typename TNumber>
constexpr NumberType
MakeType(std::string_view name, std::string_view nameWithSize)
{
  return { name, nameWithSize, sizeof(TNumber), TakeBinary<TNumber> };
}

constexpr NumberType NumberTypes[]{
  MakeType<std::int8_t>("char", "int8"),    MakeType<std::uint8_t>("uchar", "uint8"),
  MakeType<std::int16_t>("short", "int16"), MakeType<std::uint16_t>("ushort", "uint16"),
  MakeType<std::int32_t>("int", "int32"),   MakeType<std::uint32_t>("uint", "uint32"),
  MakeType<float>("float", "float32"),      MakeType<double>("double", "float64"),
};

enum class Encoding
{
  Text,
  LittleEndian,
  BigEndian
};

struct Property
{
  std::string name;
  const NumberType * type = nullptr;  ///< one of NumberTypes
  const NumberType * count = nullptr; ///< type of the count, if the property is a list
};

struct Element
{
  std::string name;
  std::uintmax_t count = 0;
  std::vector<Property> properties;
};

/** A surface's name, colour and opacity, and the number of its points and faces in a file. */
struct SurfacePart
{
  SceneSurface look; ///< name, colour and opacity; its surface is null
  std::uintmax_t points = 0;
  std::uintmax_t faces = 0;
};

struct Header
{
  Encoding encoding = Encoding::Text;
  SurfaceFileSpace space = SurfaceFileSpace::LPS;
  std::vector<SurfacePart> parts;
  std::vector<Element> elements;
};

const NumberType *
ParseType(std::string_view word, const InputStream & stream)
{
  for (const NumberType & type : NumberTypes)
  {
    if (word == type.name || word == type.nameWithSize)
    {
      return &type;
    }
  }
  stream.RefuseLine("PLY has no such type of number");
}

Encoding
ParseEncoding(std::string_view word, const InputStream & stream)
{
  if (word == "binary_little_endian")
  {
    return Encoding::LittleEndian;
  }
  if (word != "ascii" && word != "binary_big_endian")
  {
    stream.RefuseLine("PLY has no such format");
  }
  return word == "ascii" ? Encoding::Text : Encoding::BigEndian;
}

Property
ParseProperty(std::string_view words, const InputStream & stream)
{
  Property property;
  std::string_view type = TakeWord(words);
  if (type == "list")
  {
    property.count = ParseType(TakeWord(words), stream);
    type = TakeWord(words);
  }
  property.type = ParseType(type, stream);
  property.name = TakeWord(words);
  return property;
}

Element
ParseElement(std::string_view words, const InputStream & stream)
{
  Element element;
  element.name = TakeWord(words);
  const auto count = ParseNumber<std::uint64_t>(TakeWord(words));
  if (!count)
  {
    stream.RefuseLine("an element needs a name and a count");
  }
  element.count = *count;
  return element;
}

/** Parses WritePLY()'s description of a surface; nothing if the comment is another program's. */
std::optional<SurfacePart>
ParseDescription(std::string_view text)
{
  const auto json = nlohmann::json::parse(text, nullptr, false);
  try
  {
    const auto colour = json.at("colour").get<std::array<double, 3>>();
    SurfacePart part;
    part.look.name = json.at("name").get<std::string>();
    for (std::size_t n = 0; n < colour.size(); ++n)
    {
      part.look.colour[n] = ToUnit(colour[n] / 255);
    }
    part.look.opacity = ToUnit(json.at("opacity").get<double>());
    // As doubles, because nlohmann's conversion of numbers beyond integers' range is not defined.
    const auto points = json.at("points").get<double>(), faces = json.at("triangles").get<double>();
    if (!(points >= 0 && points <= UINT32_MAX && faces >= 0 && faces <= UINT32_MAX))
    {
      return std::nullopt;
    }
    part.points = static_cast<std::uint64_t>(points);
    part.faces = static_cast<std::uint64_t>(faces);
    return part;
  }
  catch (const nlohmann::json::exception &)
  {
    return std::nullopt;
  }
}

void
ParseComment(std::string_view comment, Header & header)
{
  if (SaysRAS(comment))
  {
    header.space = SurfaceFileSpace::RAS;
  }
  else if (TakeWord(comment) == "SURFACE")
  {
    if (auto part = ParseDescription(comment))
    {
      header.parts.push_back(std::move(*part));
    }
  }
}

Header
ParseHeader(InputStream & stream)
{
  Header header;
  std::string_view line;
  if (!stream.TakeLine(line) || Trim(line) != "ply")
  {
    stream.RefuseLine("a PLY file begins with \"ply\"; check what kind of file it is");
  }
  bool hasEncoding = false;
  while (stream.TakeLine(line))
  {
    const std::string_view keyword = TakeWord(line);
    if (keyword == "end_header" && hasEncoding)
    {
      return header;
    }
    if (keyword == "format")
    {
      header.encoding = ParseEncoding(TakeWord(line), stream);
      hasEncoding = true;
    }
    else if (keyword == "comment")
    {
      ParseComment(line, header);
    }
    else if (keyword == "element")
    {
      header.elements.push_back(ParseElement(line, stream));
    }
    else if (keyword == "property" && !header.elements.empty())
    {
      header.elements.back().properties.push_back(ParseProperty(line, stream));
    }
    else if (keyword != "obj_info")
    {
      stream.RefuseLine("this is not how the header of a PLY file goes on; the file is damaged, so export it again");
    }
  }
  stream.RefuseLine("the header has no end; the file is damaged, so export it again");
}

/** \class Values
 * \brief Reads the numbers of the elements in order, in any encoding. */
class Values
{
public:
  Values(InputStream & stream, Encoding encoding)
    : m_Stream(stream)
    , m_Encoding(encoding)
  {}

  /** Goes to the next line of a text file that is not empty: each element has its own line. */
  void
  BeginElement()
  {
    m_Line = {};
    while (m_Encoding == Encoding::Text && Trim(m_Line).empty())
    {
      if (!m_Stream.TakeLine(m_Line))
      {
        m_Stream.RefuseLine("the file ends early; copy or export it again");
      }
    }
  }

  /** Refuses the rest of a text file's line, as its numbers may be those of other properties. */
  void
  EndElement()
  {
    if (!Trim(m_Line).empty())
    {
      m_Stream.RefuseLine("a line has more numbers than its element has properties; export the file again");
    }
  }

  double
  Take(const NumberType & type)
  {
    return m_Encoding == Encoding::Text ? this->TakeText()
                                        : type.takeBinary(m_Stream, m_Encoding == Encoding::BigEndian);
  }

  /** Takes a count or index; throws Failure(Unreadable) for any other number. */
  std::uint64_t
  TakeWhole(const NumberType & type)
  {
    const double value = this->Take(type);
    if (!(value >= 0 && value <= UINT32_MAX && value == std::floor(value)))
    {
      const std::string why = "an index or count is no whole number; the file is damaged, so export it again";
      m_Encoding == Encoding::Text ? m_Stream.RefuseLine(why) : m_Stream.GetFile().Refuse(why);
    }
    return static_cast<std::uint64_t>(value);
  }

private:
  double
  TakeText()
  {
    const auto value = ParseNumber<double>(TakeWord(m_Line));
    if (!value)
    {
      m_Stream.RefuseLine("a number is missing or none; the file is damaged, so export it again");
    }
    return *value;
  }

  InputStream & m_Stream;
  Encoding m_Encoding;
  std::string_view m_Line;
};

/** The properties of a vertex that are read. */
constexpr std::array<std::string_view, 10> SlotNames{
  "x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha"
};
constexpr std::size_t FirstNormal = 3;
constexpr std::size_t FirstColour = 6;
constexpr std::size_t Alpha = 9;
using Slots = std::array<double, SlotNames.size()>;

std::size_t
SlotOf(const Property & property)
{
  return property.count != nullptr
           ? SlotNames.size()
           : static_cast<std::size_t>(std::find(SlotNames.begin(), SlotNames.end(), property.name) - SlotNames.begin());
}

bool
HasSlots(const Element & vertex, std::size_t first, std::size_t count)
{
  std::array<bool, SlotNames.size() + 1> has{};
  for (const Property & property : vertex.properties)
  {
    has[SlotOf(property)] = true;
  }
  return std::all_of(has.begin() + first, has.begin() + first + count, [](bool hasSlot) { return hasSlot; });
}

bool
IsIndexList(const Property & property)
{
  return property.count != nullptr && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/** A lower bound for the bytes of an element. */
std::uintmax_t
SmallestSize(const Element & element, Encoding encoding)
{
  std::uintmax_t size = 0;
  for (const Property & property : element.properties)
  {
    size += encoding == Encoding::Text ? 2 : (property.count != nullptr ? property.count : property.type)->size;
  }
  return size;
}

const Element &
FindElement(const Header & header, std::string_view name, const InputFile & file)
{
  const auto isNamed = [name](const Element & element) { return element.name == name; };
  if (std::count_if(header.elements.begin(), header.elements.end(), isNamed) != 1)
  {
    file.Refuse("a surface needs one list of elements called \"" + std::string(name) + "\"; export it as a mesh");
  }
  return *std::find_if(header.elements.begin(), header.elements.end(), isNamed);
}

void
CheckElements(const Header & header, const InputFile & file, std::uintmax_t rest)
{
  for (const Element & element : header.elements)
  {
    const std::uintmax_t size = SmallestSize(element, header.encoding);
    // The end of the last line of a text file may be missing.
    if (element.count > 0 && (size == 0 || element.count > (rest + 1) / size))
    {
      file.Refuse("its header promises more elements than the file holds; it may be a part of one, so copy it again");
    }
  }
}

void
SkipProperty(const Property & property, Values & values)
{
  const std::uint64_t count = property.count != nullptr ? values.TakeWhole(*property.count) : 1;
  for (std::uint64_t n = 0; n < count; ++n)
  {
    values.Take(*property.type);
  }
}

/** Whether the parts add up to all points and faces; written so that nothing overflows. */
bool
AddUp(const std::vector<SurfacePart> & parts, std::uintmax_t points, std::uintmax_t faces)
{
  for (const SurfacePart & part : parts)
  {
    if (part.points > points || part.faces > faces)
    {
      return false;
    }
    points -= part.points;
    faces -= part.faces;
  }
  return points == 0 && faces == 0;
}

/** \class SurfaceAssembler
 * \brief Distributes the points and faces of a file to its surfaces, which follow each other in the file. */
class SurfaceAssembler
{
public:
  /** \a points and \a faces are the totals of the file, which the caller has compared with the file's size; a point
   * takes 24 bytes, a face 12. If \a parts do not add up to these totals, another program has changed the file, and
   * everything becomes one surface named after the file. Throws Failure(Memory), Failure(Unreadable). */
  SurfaceAssembler(const InputFile & file,
                   std::vector<SurfacePart> parts,
                   std::uintmax_t points,
                   std::uintmax_t faces,
                   bool haveNormals)
    : m_File(file)
    , m_IsDivided(!parts.empty() && AddUp(parts, points, faces))
  {
    if (points >= std::numeric_limits<std::uint32_t>::max())
    {
      file.Refuse("it has more points than 32-bit indices reach; divide it");
    }
    file.RequireMemoryToRead(24 * points + 12 * faces);
    if (!m_IsDivided)
    {
      parts.assign(1, SurfacePart{});
      parts[0].look.name = file.GetStem();
      parts[0].points = points;
      parts[0].faces = faces;
    }
    std::uintmax_t firstPoint = 0;
    for (SurfacePart & part : parts)
    {
      auto surface = itk::TriangleSurface::New();
      surface->GetPoints().reserve(part.points);
      surface->GetNormals().reserve(haveNormals ? part.points : 0);
      surface->GetTriangles().reserve(part.faces);
      firstPoint += part.points;
      m_Surfaces.push_back({ std::move(part), surface, firstPoint - part.points });
    }
  }

  void
  AddPoint(const itk::TriangleSurface::PointType & point)
  {
    while (m_Surfaces[m_PointSurface].surface->GetPoints().size() == m_Surfaces[m_PointSurface].part.points)
    {
      ++m_PointSurface;
    }
    m_Surfaces[m_PointSurface].surface->GetPoints().push_back(point);
  }

  void
  AddNormal(const itk::TriangleSurface::NormalType & normal)
  {
    while (m_Surfaces[m_NormalSurface].surface->GetNormals().size() == m_Surfaces[m_NormalSurface].part.points)
    {
      ++m_NormalSurface;
    }
    m_Surfaces[m_NormalSurface].surface->GetNormals().push_back(normal);
  }

  /** Adds a face by its points' indices in the file; more than three corners make a fan. Throws Failure(Unreadable) for
   * fewer, and for a point that does not belong to the face's surface. */
  void
  AddFace(const std::vector<std::uint64_t> & corners)
  {
    while (m_Faces == m_Surfaces[m_FaceSurface].part.faces)
    {
      ++m_FaceSurface;
      m_Faces = 0;
    }
    ++m_Faces;
    const Assembled & assembled = m_Surfaces[m_FaceSurface];
    if (corners.size() < 3)
    {
      m_File.Refuse("a face has fewer than three corners; export triangles");
    }
    for (const std::uint64_t corner : corners)
    {
      if (corner < assembled.firstPoint || corner - assembled.firstPoint >= assembled.part.points)
      {
        m_File.RefuseDamaged("a face has a corner at point " + std::to_string(corner) +
                             ", which its surface does not have");
      }
    }
    const auto local = [&](std::size_t n) { return static_cast<std::uint32_t>(corners[n] - assembled.firstPoint); };
    for (std::size_t n = 2; n < corners.size(); ++n)
    {
      assembled.surface->GetTriangles().push_back({ local(0), local(n - 1), local(n) });
    }
  }

  /** Sets colour and opacity, if the file has a single surface without a description. */
  void
  SetLook(const Colour & colour, double opacity)
  {
    if (!m_IsDivided)
    {
      m_Surfaces[0].part.look.colour = colour;
      m_Surfaces[0].part.look.opacity = opacity;
    }
  }

  std::vector<SceneSurface>
  Take(SurfaceFileSpace space)
  {
    std::vector<SceneSurface> surfaces;
    for (Assembled & assembled : m_Surfaces)
    {
      TurnFrom(space, *assembled.surface);
      surfaces.push_back(std::move(assembled.part.look));
      surfaces.back().surface = assembled.surface;
    }
    return surfaces;
  }

private:
  struct Assembled
  {
    SurfacePart part;
    itk::TriangleSurface::Pointer surface;
    std::uintmax_t firstPoint = 0;
  };

  const InputFile & m_File;
  std::vector<Assembled> m_Surfaces;
  bool m_IsDivided;
  std::size_t m_PointSurface = 0;  ///< index of the surface that gets the next point
  std::size_t m_NormalSurface = 0; ///< index of the surface that gets the next normal
  std::size_t m_FaceSurface = 0;   ///< index of the surface that gets the next face
  std::uintmax_t m_Faces = 0;      ///< number of faces this surface has
};

/** The colour and opacity of all points, if they are the same. */
class CommonLook
{
public:
  void
  Add(const Slots & slots)
  {
    m_IsCommon =
      !m_First || (m_IsCommon && std::equal(slots.begin() + FirstColour, slots.end(), m_First->begin() + FirstColour));
    m_First = m_First ? m_First : std::optional<Slots>(slots);
  }

  void
  Set(SurfaceAssembler & assembler, const Element & vertex) const
  {
    if (m_First && m_IsCommon && HasSlots(vertex, FirstColour, 3))
    {
      const auto colour =
        std::find_if(vertex.properties.begin(), vertex.properties.end(), [](const Property & property) {
          return property.name == SlotNames[FirstColour];
        });
      const double largest = colour->type->name == "uchar" ? 255 : 1;
      const auto unit = [&](std::size_t slot) { return ToUnit((*m_First)[slot] / largest); };
      assembler.SetLook({ unit(FirstColour), unit(FirstColour + 1), unit(FirstColour + 2) },
                        HasSlots(vertex, Alpha, 1) ? unit(Alpha) : 1.0);
    }
  }

private:
  std::optional<Slots> m_First;
  bool m_IsCommon = false;
};

void
ReadVertices(const Element & vertex, Values & values, SurfaceAssembler & assembler)
{
  const bool hasNormals = HasSlots(vertex, FirstNormal, 3);
  CommonLook look;
  for (std::uintmax_t n = 0; n < vertex.count; ++n)
  {
    values.BeginElement();
    Slots slots{};
    for (const Property & property : vertex.properties)
    {
      if (const std::size_t slot = SlotOf(property); slot < slots.size())
      {
        slots[slot] = values.Take(*property.type);
      }
      else
      {
        SkipProperty(property, values);
      }
    }
    values.EndElement();
    const auto triple = [&slots](std::size_t first) {
      return itk::TriangleSurface::PointType{ static_cast<float>(slots[first]),
                                              static_cast<float>(slots[first + 1]),
                                              static_cast<float>(slots[first + 2]) };
    };
    assembler.AddPoint(triple(0));
    if (hasNormals)
    {
      assembler.AddNormal(triple(FirstNormal));
    }
    look.Add(slots);
  }
  look.Set(assembler, vertex);
}

/** Reads elements that are no vertices. \a assembler gets the lists of indices; null: all properties are skipped. */
void
ReadElements(const Element & element, Values & values, SurfaceAssembler * assembler)
{
  std::vector<std::uint64_t> corners;
  for (std::uintmax_t n = 0; n < element.count; ++n)
  {
    values.BeginElement();
    for (const Property & property : element.properties)
    {
      if (assembler == nullptr || !IsIndexList(property))
      {
        SkipProperty(property, values);
        continue;
      }
      corners.clear();
      for (std::uint64_t rest = values.TakeWhole(*property.count); rest > 0; --rest)
      {
        corners.push_back(values.TakeWhole(*property.type));
      }
      assembler->AddFace(corners);
    }
    values.EndElement();
  }
}

} // namespace

void
WritePLY(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  const bool haveNormals =
    std::all_of(surfaces.begin(), surfaces.end(), [](const SceneSurface & item) { return item.surface->HasNormals(); });
  file.Append(MakeHeader(surfaces, space, haveNormals));
  for (const SceneSurface & item : surfaces)
  {
    const auto & points = item.surface->GetPoints();
    const std::uint8_t opacity = ToByte(item.opacity);
    const auto common = ToBytes(item.colour);
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      file.AppendBinary(Turned(points[n], space));
      if (haveNormals)
      {
        file.AppendBinary(Turned(item.surface->GetNormals()[n], space));
      }
      const auto & [red, green, blue] = item.pointColours ? (*item.pointColours)[n] : common;
      file.AppendBinary(std::array<std::uint8_t, 4>{ red, green, blue, opacity });
    }
  }
  std::uint32_t firstPoint = 0;
  for (const SceneSurface & item : surfaces)
  {
    for (const auto & [a, b, c] : item.surface->GetTriangles())
    {
      file.AppendBinary(std::uint8_t{ 3 });
      file.AppendBinary(itk::TriangleSurface::TriangleType{ firstPoint + a, firstPoint + b, firstPoint + c });
    }
    firstPoint += static_cast<std::uint32_t>(item.surface->GetNumberOfPoints());
  }
}

std::vector<SceneSurface>
ReadPLY(const InputFile & file)
{
  InputStream stream(file);
  const Header header = ParseHeader(stream);
  const Element & vertex = FindElement(header, "vertex", file);
  const Element & face = FindElement(header, "face", file);
  if (!HasSlots(vertex, 0, 3) || std::count_if(face.properties.begin(), face.properties.end(), IsIndexList) != 1)
  {
    file.Refuse("its points have no x, y and z, or its faces no vertex_indices; export it as a mesh");
  }
  CheckElements(header, file, stream.GetRest());

  SurfaceAssembler assembler(file, header.parts, vertex.count, face.count, HasSlots(vertex, FirstNormal, 3));
  Values values(stream, header.encoding);
  for (const Element & element : header.elements)
  {
    &element == &vertex ? ReadVertices(element, values, assembler)
                        : ReadElements(element, values, &element == &face ? &assembler : nullptr);
  }
  return assembler.Take(header.space);
}

} // namespace rhombic
