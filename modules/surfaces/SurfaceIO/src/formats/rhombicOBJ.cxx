#include "rhombicSurfaceFormats.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace rhombic
{
namespace
{

/** The names of groups and materials: one word each, all different. */
std::vector<std::string>
MakeIdentifiers(const std::vector<SceneSurface> & surfaces)
{
  std::vector<std::string> identifiers;
  std::set<std::string> used;
  for (const SceneSurface & item : surfaces)
  {
    std::string base = item.name.empty() ? "surface" : item.name;
    std::replace_if(
      base.begin(), base.end(), [](char letter) { return letter == ' ' || letter == '#' || letter == '\\'; }, '_');
    std::string identifier = base;
    for (int number = 2; !used.insert(identifier).second; ++number)
    {
      identifier = base + "_" + std::to_string(number);
    }
    identifiers.push_back(identifier);
  }
  return identifiers;
}

/** The name of an object, without a backslash at the end, which would join the next line. */
std::string
ObjectName(const SceneSurface & item)
{
  std::string name(Trim(item.name));
  if (!name.empty() && name.back() == '\\')
  {
    name.back() = '_';
  }
  return name.empty() ? "surface" : name;
}

/** Appends the shortest text that is read as the same number, in any locale. */
template <typename TNumber>
void
AppendNumber(TNumber number, std::string & text)
{
  char digits[64];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
}

template <typename TNumbers>
void
AppendLine(const char * keyword, const TNumbers & numbers, OutputFile & file)
{
  std::string line(keyword);
  for (const auto number : numbers)
  {
    AppendNumber(number, line += ' ');
  }
  file.Append(line += '\n');
}

/** "f 1 2 3", or "f 1//1 2//2 3//3" with normals, which have indices of their own. */
void
AppendFace(const itk::TriangleSurface::TriangleType & triangle,
           std::uint64_t firstPoint,
           std::optional<std::uint64_t> firstNormal,
           OutputFile & file)
{
  std::string line("f");
  for (const std::uint32_t corner : triangle)
  {
    AppendNumber(firstPoint + corner, line += ' ');
    if (firstNormal)
    {
      AppendNumber(*firstNormal + corner, line += "//");
    }
  }
  file.Append(line += '\n');
}

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t Several = None - 1;
constexpr const char * NoTriple = "three numbers are needed here; the file is damaged, so export it again";

/** Surfaces of which only colour and opacity are set, by the names of materials. */
using Materials = std::map<std::string, SceneSurface, std::less<>>;

double
ParseUnit(std::string_view word)
{
  return ToUnit(ParseNumber<double>(word).value_or(0));
}

/** Reads a file of materials. If there is none, surfaces keep their default colours. */
void
ReadMaterials(const std::filesystem::path & path, Materials & materials)
{
  constexpr std::uintmax_t longest = std::uintmax_t{ 1 } << 24;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || std::filesystem::file_size(path, error) > longest || error)
  {
    return;
  }
  const InputFile file(path);
  InputStream stream(file);
  SceneSurface * material = nullptr;
  std::string_view line;
  while (stream.TakeLine(line))
  {
    const std::string_view keyword = TakeWord(line);
    if (keyword == "newmtl")
    {
      material = &materials[std::string(Trim(line))];
    }
    else if (material != nullptr && keyword == "Kd")
    {
      for (double & part : material->colour)
      {
        part = ParseUnit(TakeWord(line));
      }
    }
    else if (material != nullptr && (keyword == "d" || keyword == "Tr"))
    {
      const double value = ParseUnit(TakeWord(line));
      material->opacity = keyword == "d" ? value : 1 - value;
    }
  }
}

/** \class OBJReader
 * \brief Reads an OBJ file. Faces of the same object, group and material become one surface; surfaces are in the order
 * of their first faces. */
class OBJReader
{
public:
  explicit OBJReader(const InputFile & file)
    : m_File(file)
    , m_Stream(file)
  {}

  std::vector<SceneSurface>
  Read()
  {
    // Each corner takes at least two bytes in the file and 12 bytes of memory; points take more bytes in the file.
    m_File.RequireMemoryToRead(6 * m_File.GetSize());
    std::string_view line;
    while (this->TakeLine(line))
    {
      this->ReadLine(line);
    }
    std::vector<SceneSurface> surfaces;
    std::vector<std::uint32_t> indices(m_Points.size(), None);
    for (Part & part : m_Parts)
    {
      surfaces.push_back(this->MakeSurface(part, indices));
    }
    return surfaces;
  }

private:
  struct Part
  {
    std::string name;
    std::string material;
    itk::TriangleSurface::TrianglesContainer triangles; ///< indices of the file's points
  };

  struct Corner
  {
    std::uint32_t point;
    std::uint32_t normal; ///< or None
  };

  /** Gets the next line, with the lines that backslashes join to it. */
  bool
  TakeLine(std::string_view & line)
  {
    if (!m_Stream.TakeLine(line))
    {
      return false;
    }
    if (line.empty() || line.back() != '\\')
    {
      return true;
    }
    constexpr std::size_t longest = std::size_t{ 1 } << 24;
    m_JoinedLine.clear();
    while (!line.empty() && line.back() == '\\')
    {
      m_JoinedLine.append(line.substr(0, line.size() - 1)) += ' ';
      line = {};
      if (m_JoinedLine.size() > longest || !m_Stream.TakeLine(line))
      {
        m_Stream.RefuseLine("the line that is to be joined to this one is missing; copy or export the file again");
      }
    }
    m_JoinedLine.append(line);
    line = m_JoinedLine;
    return true;
  }

  void
  ReadLine(std::string_view line)
  {
    const std::string_view whole = line;
    const std::string_view keyword = TakeWord(line);
    if (keyword == "v")
    {
      m_Points.push_back(ParseTriple(line, m_Stream, NoTriple));
      m_NormalOfPoint.push_back(None);
      if (m_Points.size() >= Several)
      {
        m_Stream.RefuseLine("there are more points than 32-bit indices reach; divide the file");
      }
    }
    else if (keyword == "vn")
    {
      m_Normals.push_back(ParseTriple(line, m_Stream, NoTriple));
    }
    else if (keyword == "f")
    {
      this->ReadFace(line);
    }
    else if (keyword == "o" || keyword == "g" || keyword == "usemtl")
    {
      m_Key[keyword == "o" ? 0 : keyword == "g" ? 1 : 2] = Trim(line);
      m_Part = nullptr;
    }
    else if (keyword == "mtllib")
    {
      this->ReadLibrary(Trim(line));
    }
    else if (!keyword.empty() && keyword[0] == '#')
    {
      m_Space = SaysRAS(whole) ? SurfaceFileSpace::RAS : m_Space;
    }
    else if (!keyword.empty() && !IsIgnored(keyword))
    {
      m_Stream.RefuseLine("OBJ has no such line; check what kind of file it is");
    }
  }

  static bool
  IsIgnored(std::string_view keyword)
  {
    constexpr std::string_view ignored[]{
      "vt",    "vp",       "p",        "l",          "s",         "lod",    "mg",
      "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "maplib", "usemap"
    };
    return std::find(std::begin(ignored), std::end(ignored), keyword) != std::end(ignored);
  }

  /** Reads materials, but only from the file's own folder or below it. */
  void
  ReadLibrary(const std::filesystem::path & library)
  {
    if (library.is_relative() && std::find(library.begin(), library.end(), "..") == library.end())
    {
      ReadMaterials(m_File.GetPath().parent_path() / library, m_Materials);
    }
  }

  /** Converts an index of the file, which counts from 1, or backwards from -1 at the last point or normal so far. */
  std::uint32_t
  ParseIndex(std::string_view word, std::size_t count) const
  {
    const std::int64_t index = ParseNumber<std::int64_t>(word).value_or(0);
    const auto size = static_cast<std::int64_t>(count);
    if (index == 0 || index > size || index < -size)
    {
      m_Stream.RefuseLine("a corner's index is no number of a point or normal above it; the file is damaged, so "
                          "export it again");
    }
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : size + index);
  }

  /** "1", "1/2", "1//3" or "1/2/3": point, texture, normal. */
  Corner
  ParseCorner(std::string_view word) const
  {
    const std::size_t first = std::min(word.find('/'), word.size());
    const std::size_t second = std::min(word.find('/', first + 1), word.size());
    Corner corner{ this->ParseIndex(word.substr(0, first), m_Points.size()), None };
    if (second < word.size())
    {
      corner.normal = this->ParseIndex(word.substr(second + 1), m_Normals.size());
    }
    return corner;
  }

  void
  ReadFace(std::string_view line)
  {
    m_Corners.clear();
    for (std::string_view word = TakeWord(line); !word.empty() && word[0] != '#'; word = TakeWord(line))
    {
      m_Corners.push_back(this->ParseCorner(word));
      this->NoteNormal(m_Corners.back());
    }
    if (m_Corners.size() < 3)
    {
      m_Stream.RefuseLine("a face has fewer than three corners; export triangles");
    }
    auto & triangles = this->CurrentPart().triangles;
    for (std::size_t n = 2; n < m_Corners.size(); ++n)
    {
      triangles.push_back({ m_Corners[0].point, m_Corners[n - 1].point, m_Corners[n].point });
    }
  }

  void
  NoteNormal(const Corner & corner)
  {
    std::uint32_t & normal = m_NormalOfPoint[corner.point];
    if (normal == None)
    {
      normal = corner.normal == None ? Several : corner.normal;
    }
    else if (normal != Several && normal != corner.normal &&
             (corner.normal == None || m_Normals[normal] != m_Normals[corner.normal]))
    {
      normal = Several;
    }
  }

  Part &
  CurrentPart()
  {
    if (m_Part == nullptr)
    {
      const auto [found, isNew] = m_PartOfKey.try_emplace(m_Key, m_Parts.size());
      if (isNew)
      {
        const auto named =
          std::find_if(m_Key.begin(), m_Key.end(), [](const std::string & name) { return !name.empty(); });
        m_Parts.push_back({ named == m_Key.end() ? m_File.GetStem() : *named, m_Key[2], {} });
      }
      m_Part = &m_Parts[found->second];
    }
    return *m_Part;
  }

  /** Makes a surface of the part's triangles. \a indices is working memory: None for each point of the file, before and
   * after the call. */
  SceneSurface
  MakeSurface(Part & part, std::vector<std::uint32_t> & indices) const
  {
    const auto surface = itk::TriangleSurface::New();
    surface->GetTriangles().swap(part.triangles);
    std::vector<std::uint32_t> used;
    for (const auto & triangle : surface->GetTriangles())
    {
      for (const std::uint32_t point : triangle)
      {
        if (indices[point] == None)
        {
          indices[point] = 0;
          used.push_back(point);
        }
      }
    }
    std::sort(used.begin(), used.end());
    const bool hasNormals =
      std::all_of(used.begin(), used.end(), [this](std::uint32_t point) { return m_NormalOfPoint[point] < Several; });
    for (std::size_t n = 0; n < used.size(); ++n)
    {
      indices[used[n]] = static_cast<std::uint32_t>(n);
      surface->GetPoints().push_back(m_Points[used[n]]);
      if (hasNormals)
      {
        surface->GetNormals().push_back(m_Normals[m_NormalOfPoint[used[n]]]);
      }
    }
    for (auto & triangle : surface->GetTriangles())
    {
      for (std::uint32_t & point : triangle)
      {
        point = indices[point];
      }
    }
    for (const std::uint32_t point : used)
    {
      indices[point] = None;
    }
    TurnFrom(m_Space, *surface);
    const auto found = m_Materials.find(part.material);
    SceneSurface item = found == m_Materials.end() ? SceneSurface() : found->second;
    item.name = part.name;
    item.surface = surface;
    return item;
  }

  const InputFile & m_File;
  InputStream m_Stream;
  std::string m_JoinedLine;
  SurfaceFileSpace m_Space = SurfaceFileSpace::LPS;
  itk::TriangleSurface::PointsContainer m_Points;
  itk::TriangleSurface::NormalsContainer m_Normals;
  std::vector<std::uint32_t> m_NormalOfPoint; ///< index; None before the first face, Several if faces disagree
  std::vector<Corner> m_Corners;              ///< corners of the face that is being read
  std::array<std::string, 3> m_Key;           ///< object, group, material
  std::map<std::array<std::string, 3>, std::size_t> m_PartOfKey;
  std::vector<Part> m_Parts;
  Part * m_Part = nullptr; ///< part of the next face; null when it must be looked up
  Materials m_Materials;
};

} // namespace

void
WriteOBJ(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  const std::vector<std::string> identifiers = MakeIdentifiers(surfaces);
  const std::string materials = file.GetTarget().filename().replace_extension(".mtl").string();
  file.Append(std::string("# Rhombic\n# SPACE=") + NameOf(space) + "\n# UNIT=mm\nmtllib " + materials + "\n");
  std::uint64_t firstPoint = 1;
  std::uint64_t firstNormal = 1;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const itk::TriangleSurface & surface = *surfaces[n].surface;
    file.Append("o " + ObjectName(surfaces[n]) + "\ng " + identifiers[n] + "\nusemtl " + identifiers[n] + "\n");
    for (const auto & point : surface.GetPoints())
    {
      AppendLine("v", Turned(point, space), file);
    }
    const bool hasNormals = surface.HasNormals();
    if (hasNormals)
    {
      for (const auto & normal : surface.GetNormals())
      {
        AppendLine("vn", Turned(normal, space), file);
      }
    }
    for (const auto & triangle : surface.GetTriangles())
    {
      AppendFace(triangle, firstPoint, hasNormals ? std::optional<std::uint64_t>(firstNormal) : std::nullopt, file);
    }
    firstPoint += surface.GetNumberOfPoints();
    firstNormal += hasNormals ? surface.GetNumberOfPoints() : 0;
  }
}

void
WriteMTL(const std::vector<SceneSurface> & surfaces, OutputFile & file)
{
  const std::vector<std::string> identifiers = MakeIdentifiers(surfaces);
  file.Append("# Rhombic: colours as sRGB encodes them\n");
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const std::array<double, 1> opacity{ surfaces[n].opacity };
    file.Append("newmtl " + identifiers[n] + "\n");
    AppendLine("Kd", surfaces[n].colour, file);
    AppendLine("d", opacity, file);
    file.Append("illum 1\n");
  }
}

std::vector<SceneSurface>
ReadOBJ(const InputFile & file)
{
  return OBJReader(file).Read();
}

} // namespace rhombic
