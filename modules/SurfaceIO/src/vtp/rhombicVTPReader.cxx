#include "rhombicFileColours.h"
#include "rhombicSurfaceAssembler.h"
#include "rhombicSurfaceFormats.h"
#include "rhombicVTPNumbers.h"

#include <algorithm>

namespace rhombic
{
namespace
{

/** \class VTPReader
 * \brief Reads all pieces as one and divides them into surfaces by the field data that WriteVTP() writes. */
class VTPReader
{
public:
  explicit VTPReader(const InputFile & file)
    : m_File(file)
    , m_Document(ParseVTPDocument(file))
  {}

  std::vector<SceneSurface>
  Read()
  {
    std::uint64_t points = 0, polygons = 0;
    bool haveNormals = true;
    for (const VTPPiece & piece : m_Document.pieces)
    {
      this->CheckPiece(piece);
      points += piece.points;
      polygons += piece.polygons;
      haveNormals = haveNormals && FindNormals(piece) != nullptr;
    }
    SurfaceAssembler assembler(m_File, this->ReadParts(), points, polygons, haveNormals);
    std::uint64_t firstPoint = 0;
    for (const VTPPiece & piece : m_Document.pieces)
    {
      this->ReadPoints(piece, haveNormals, assembler);
      this->ReadPolygons(piece, firstPoint, assembler);
      firstPoint += piece.points;
    }
    return assembler.Take(this->ReadString("SPACE") == "RAS" ? SurfaceFileSpace::RAS : SurfaceFileSpace::LPS);
  }

private:
  static const VTPArray *
  Find(const std::vector<VTPArray> & arrays, std::string_view section, std::string_view name)
  {
    const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const VTPArray & array) {
      return array.section == section && (name.empty() || array.name == name);
    });
    return found == arrays.end() ? nullptr : &*found;
  }

  static const VTPArray *
  FindNormals(const VTPPiece & piece)
  {
    return piece.normals.empty() ? nullptr : Find(piece.arrays, "PointData", piece.normals);
  }

  VTPNumbers
  Open(const std::vector<VTPArray> & arrays,
       const std::string & section,
       std::string_view name,
       std::uint64_t count) const
  {
    const VTPArray * const array = Find(arrays, section, name);
    if (array == nullptr)
    {
      m_File.RefuseDamaged("its " + section + " are missing");
    }
    VTPNumbers numbers(m_File, m_Document, *array);
    if (numbers.GetRest() < count)
    {
      m_File.RefuseDamaged("its array " + array->name + " is shorter than it must be");
    }
    return numbers;
  }

  /** Checks, before memory is allocated, that the lengths of the arrays agree with the counts of the piece. */
  void
  CheckPiece(const VTPPiece & piece) const
  {
    constexpr std::uint64_t most = UINT32_MAX; // keeps the sums and products of counts from overflowing
    if (piece.points > most || piece.polygons > most || m_Document.pieces.size() > most)
    {
      m_File.Refuse("it has more points or polygons than 32-bit indices reach; divide it");
    }
    if (piece.points > 0)
    {
      this->Open(piece.arrays, "Points", "", 3 * piece.points);
    }
    if (piece.polygons > 0)
    {
      this->Open(piece.arrays, "Polys", "offsets", piece.polygons);
    }
  }

  void
  ReadPoints(const VTPPiece & piece, bool haveNormals, SurfaceAssembler & assembler) const
  {
    const auto readVectors = [&](VTPNumbers numbers, auto add) {
      for (std::uint64_t n = 0; n < piece.points; ++n)
      {
        const auto x = static_cast<float>(numbers.Take());
        const auto y = static_cast<float>(numbers.Take());
        add(std::array<float, 3>{ x, y, static_cast<float>(numbers.Take()) });
      }
    };
    if (piece.points > 0)
    {
      readVectors(this->Open(piece.arrays, "Points", "", 3 * piece.points),
                  [&](const auto & point) { assembler.AddPoint(point); });
    }
    if (piece.points > 0 && haveNormals)
    {
      readVectors(this->Open(piece.arrays, "PointData", piece.normals, 3 * piece.points),
                  [&](const auto & normal) { assembler.AddNormal(normal); });
    }
  }

  /** Reads polygons: each offset is the end of a polygon's corners. */
  void
  ReadPolygons(const VTPPiece & piece, std::uint64_t firstPoint, SurfaceAssembler & assembler) const
  {
    if (piece.polygons == 0)
    {
      return;
    }
    VTPNumbers offsets = this->Open(piece.arrays, "Polys", "offsets", piece.polygons);
    VTPNumbers connectivity = this->Open(piece.arrays, "Polys", "connectivity", 3 * piece.polygons);
    std::vector<std::uint64_t> corners;
    std::uint64_t begin = 0;
    for (std::uint64_t n = 0; n < piece.polygons; ++n)
    {
      const std::uint64_t end = offsets.TakeWhole();
      if (end < begin || end - begin > connectivity.GetRest())
      {
        m_File.Refuse("the offsets of its polygons are damaged; export it again");
      }
      corners.clear();
      for (; begin < end; ++begin)
      {
        corners.push_back(firstPoint + connectivity.TakeWhole());
      }
      assembler.AddFace(corners);
    }
  }

  std::string
  ReadString(const std::string & name) const
  {
    const auto strings = this->ReadStrings(name);
    return strings.empty() ? std::string() : strings.front();
  }

  std::vector<std::string>
  ReadStrings(const std::string & name) const
  {
    std::vector<std::string> strings;
    if (const VTPArray * const array = Find(m_Document.fields, "FieldData", name))
    {
      VTPNumbers letters(m_File, m_Document, *array);
      std::string string;
      while (letters.HasMore())
      {
        const auto letter = static_cast<char>(letters.TakeWhole());
        if (letter == '\0')
        {
          strings.push_back(string);
          string.clear();
        }
        else
        {
          string += letter;
        }
      }
    }
    return strings;
  }

  std::vector<SurfacePart>
  ReadParts() const
  {
    const std::vector<std::string> names = this->ReadStrings("SurfaceNames");
    for (const char * const name : { "SurfaceColours", "SurfaceOpacities", "SurfaceSizes" })
    {
      if (Find(m_Document.fields, "FieldData", name) == nullptr)
      {
        return {};
      }
    }
    VTPNumbers colours = this->Open(m_Document.fields, "FieldData", "SurfaceColours", 3 * names.size());
    VTPNumbers opacities = this->Open(m_Document.fields, "FieldData", "SurfaceOpacities", names.size());
    VTPNumbers sizes = this->Open(m_Document.fields, "FieldData", "SurfaceSizes", 2 * names.size());
    std::vector<SurfacePart> parts(names.size());
    for (std::size_t n = 0; n < names.size(); ++n)
    {
      parts[n].look.name = names[n];
      for (double & part : parts[n].look.colour)
      {
        part = ToUnit(colours.Take() / 255);
      }
      parts[n].look.opacity = ToUnit(opacities.Take());
      parts[n].points = sizes.TakeWhole();
      parts[n].faces = sizes.TakeWhole();
    }
    return parts;
  }

  const InputFile & m_File;
  const VTPDocument m_Document;
};

} // namespace

std::vector<SceneSurface>
ReadVTP(const InputFile & file)
{
  return VTPReader(file).Read();
}

} // namespace rhombic
