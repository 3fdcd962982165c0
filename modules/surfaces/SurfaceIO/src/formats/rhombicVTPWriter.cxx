#include "rhombicSurfaceFormats.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <limits>

namespace rhombic
{
namespace
{

/** An array among the appended data. */
struct AppendedArray
{
  std::uint64_t size = 0; ///< bytes
  std::function<void(OutputFile & file)> append;
};

/** \class VTPWriter
 * \brief Writes one piece with all surfaces, with the arrays as raw appended data. If all are of labels, and their
 * points have no values, they are joined.
 *
 * Format: VTK File Formats, "XML File Formats", docs.vtk.org. VTK's own writer would need a merged copy of the
 * surfaces, and reports success on a full disk. */
class VTPWriter
{
public:
  VTPWriter(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space)
    : m_Surfaces(surfaces)
    , m_Space(space)
  {
    m_HaveValues = std::all_of(
      surfaces.begin(), surfaces.end(), [](const SceneSurface & item) { return item.pointValues != nullptr; });
    const bool areLabels =
      std::all_of(surfaces.begin(), surfaces.end(), [](const SceneSurface & item) { return item.label != 0; });
    if (areLabels && !m_HaveValues) // on a wall, each of two surfaces has values of its own
    {
      m_Joined = JoinSurfaces(surfaces);
      m_Meshes.push_back(m_Joined.surface);
    }
    else
    {
      std::transform(surfaces.begin(), surfaces.end(), std::back_inserter(m_Meshes), [](const SceneSurface & item) {
        return item.surface;
      });
    }
    for (const auto & mesh : m_Meshes)
    {
      m_Points += mesh->GetNumberOfPoints();
      m_Triangles += mesh->GetNumberOfTriangles();
      m_HaveNormals = m_HaveNormals && mesh->HasNormals();
    }
  }

  void
  Write(OutputFile & file)
  {
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
    this->AddFields(xml);
    xml += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(m_Points) +
           "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
           std::to_string(m_Triangles) + "\">\n";
    this->AddPoints(xml);
    const bool isSmall = 3 * m_Triangles <= std::numeric_limits<std::int32_t>::max();
    isSmall ? this->AddPolys<std::int32_t>("Int32", xml) : this->AddPolys<std::int64_t>("Int64", xml);
    this->AddCellData(xml);
    xml += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    file.Append(xml);
    for (const AppendedArray & array : m_Arrays)
    {
      file.AppendBinary(array.size);
      array.append(file);
    }
    file.Append("\n</AppendedData>\n</VTKFile>\n");
  }

private:
  /** Adds an array's element to the XML; \a append writes its \a size bytes later. */
  void
  Add(std::string & xml, const std::string & element, std::uint64_t size, std::function<void(OutputFile & file)> append)
  {
    xml += element + " format=\"appended\" offset=\"" + std::to_string(m_Offset) + "\"/>\n";
    m_Offset += sizeof(std::uint64_t) + size;
    m_Arrays.push_back({ size, std::move(append) });
  }

  void
  AddStrings(std::string & xml, const std::string & name, const std::vector<std::string> & strings)
  {
    std::string bytes;
    for (const std::string & string : strings)
    {
      bytes.append(string) += '\0';
    }
    this->Add(xml,
              "<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(strings.size()) + "\"",
              bytes.size(),
              [bytes](OutputFile & file) { file.Append(bytes); });
  }

  /** Adds an array with a tuple for each surface. */
  template <typename TGetTuple>
  void
  AddTuples(std::string & xml, const std::string & name, const std::string & type, const TGetTuple & getTuple)
  {
    using TupleType = decltype(getTuple(m_Surfaces.front()));
    const std::size_t components = std::tuple_size_v<TupleType>;
    this->Add(xml,
              "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                std::to_string(components) + "\" NumberOfTuples=\"" + std::to_string(m_Surfaces.size()) + "\"",
              sizeof(TupleType) * m_Surfaces.size(),
              [this, getTuple](OutputFile & file) {
                for (const SceneSurface & item : m_Surfaces)
                {
                  file.AppendBinary(getTuple(item));
                }
              });
  }

  void
  AddFields(std::string & xml)
  {
    std::vector<std::string> names;
    for (const SceneSurface & item : m_Surfaces)
    {
      names.push_back(item.name);
    }
    this->AddStrings(xml, "SPACE", { NameOf(m_Space) });
    this->AddStrings(xml, "UNIT", { "mm" });
    this->AddStrings(xml, "SurfaceNames", names);
    this->AddTuples(xml, "SurfaceColours", "UInt8", [](const SceneSurface & item) { return ToBytes(item.colour); });
    this->AddTuples(xml, "SurfaceOpacities", "Float64", [](const SceneSurface & item) {
      return std::array<double, 1>{ item.opacity };
    });
    if (m_Joined.surface)
    {
      this->AddTuples(xml, "SurfaceLabels", "Int32", [](const SceneSurface & item) {
        return std::array<std::int32_t, 1>{ item.label };
      });
      return;
    }
    this->AddTuples(xml, "SurfaceSizes", "UInt64", [](const SceneSurface & item) {
      return std::array<std::uint64_t, 2>{ item.surface->GetNumberOfPoints(), item.surface->GetNumberOfTriangles() };
    });
  }

  void
  AddPoints(std::string & xml)
  {
    if (m_HaveNormals || m_HaveValues)
    {
      const std::string name = m_HaveValues ? ArrayName(m_Surfaces.front().pointValues->name) : "";
      xml += std::string("<PointData") + (m_HaveNormals ? " Normals=\"Normals\"" : "") +
             (m_HaveValues ? " Scalars=\"" + name + "\"" : "") + ">\n";
      if (m_HaveNormals)
      {
        this->AddVectors(
          xml, "Normals", [](const itk::TriangleSurface & mesh) -> auto & { return mesh.GetNormals(); });
      }
      if (m_HaveValues)
      {
        this->AddValues(xml, name);
      }
      xml += "</PointData>\n";
    }
    xml += "<Points>\n";
    this->AddVectors(
      xml, "Points", [](const itk::TriangleSurface & mesh) -> auto & { return mesh.GetPoints(); });
    xml += "</Points>\n";
  }

  /** A name without letters that XML needs. */
  static std::string
  ArrayName(std::string name)
  {
    std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
    return name;
  }

  void
  AddValues(std::string & xml, const std::string & name)
  {
    this->Add(
      xml, "<DataArray type=\"Float32\" Name=\"" + name + "\"", sizeof(float) * m_Points, [this](OutputFile & file) {
        for (const SceneSurface & item : m_Surfaces)
        {
          for (const float value : item.pointValues->values)
          {
            file.AppendBinary(value);
          }
        }
      });
  }

  template <typename TGetVectors>
  void
  AddVectors(std::string & xml, const std::string & name, const TGetVectors & getVectors)
  {
    this->Add(xml,
              "<DataArray type=\"Float32\" Name=\"" + name + "\" NumberOfComponents=\"3\"",
              sizeof(itk::TriangleSurface::PointType) * m_Points,
              [this, getVectors](OutputFile & file) {
                for (const auto & mesh : m_Meshes)
                {
                  for (const auto & vector : getVectors(*mesh))
                  {
                    file.AppendBinary(Turned(vector, m_Space));
                  }
                }
              });
  }

  template <typename TIndex>
  void
  AddPolys(const std::string & type, std::string & xml)
  {
    const std::string element = "<DataArray type=\"" + type + "\" Name=";
    xml += "<Polys>\n";
    this->Add(xml, element + "\"connectivity\"", 3 * sizeof(TIndex) * m_Triangles, [this](OutputFile & file) {
      TIndex first = 0;
      for (const auto & mesh : m_Meshes)
      {
        for (const auto & [a, b, c] : mesh->GetTriangles())
        {
          file.AppendBinary(std::array<TIndex, 3>{
            static_cast<TIndex>(first + a), static_cast<TIndex>(first + b), static_cast<TIndex>(first + c) });
        }
        first += static_cast<TIndex>(mesh->GetNumberOfPoints());
      }
    });
    this->Add(xml, element + "\"offsets\"", sizeof(TIndex) * m_Triangles, [this](OutputFile & file) {
      for (std::uint64_t n = 1; n <= m_Triangles; ++n)
      {
        file.AppendBinary(static_cast<TIndex>(3 * n));
      }
    });
    xml += "</Polys>\n";
  }

  /** Adds an array with a value for each triangle, got from the two surfaces at it, which are counted from 1. */
  template <typename TGetValue>
  void
  AddCellValues(std::string & xml, const std::string & element, const TGetValue & getValue)
  {
    using Sides = std::array<std::uint32_t, 2>;
    this->Add(xml, element, sizeof(getValue(Sides())) * m_Triangles, [this, getValue](OutputFile & file) {
      for (const Sides & sides : m_Joined.sides)
      {
        file.AppendBinary(getValue(sides));
      }
      for (std::uint32_t surface = 1; !m_Joined.surface && surface <= m_Surfaces.size(); ++surface)
      {
        const auto value = getValue(Sides{ surface, 0 });
        for (itk::SizeValueType n = 0; n < m_Surfaces[surface - 1].surface->GetNumberOfTriangles(); ++n)
        {
          file.AppendBinary(value);
        }
      }
    });
  }

  void
  AddCellData(std::string & xml)
  {
    xml += "<CellData Scalars=\"Colours\">\n";
    this->AddCellValues(
      xml, "<DataArray type=\"UInt8\" Name=\"Colours\" NumberOfComponents=\"4\"", [this](const auto & sides) {
        const SceneSurface & item = m_Surfaces[sides[0] - 1];
        const auto colour = ToBytes(item.colour);
        return std::array<std::uint8_t, 4>{ colour[0], colour[1], colour[2], ToByte(item.opacity) };
      });
    if (m_Joined.surface)
    {
      this->AddCellValues(
        xml, "<DataArray type=\"Int32\" Name=\"BoundaryLabels\" NumberOfComponents=\"2\"", [this](const auto & sides) {
          return std::array<std::int32_t, 2>{ m_Surfaces[sides[0] - 1].label,
                                              sides[1] == 0 ? 0 : m_Surfaces[sides[1] - 1].label };
        });
    }
    else
    {
      this->AddCellValues(
        xml, "<DataArray type=\"UInt32\" Name=\"SurfaceNumbers\"", [](const auto & sides) { return sides[0] - 1; });
    }
    xml += "</CellData>\n";
  }

  const std::vector<SceneSurface> & m_Surfaces;
  JoinedSurfaces m_Joined; ///< null if a surface is of no label, or points have values
  std::vector<itk::TriangleSurface::ConstPointer> m_Meshes;
  SurfaceFileSpace m_Space;
  std::uint64_t m_Points = 0;
  std::uint64_t m_Triangles = 0;
  bool m_HaveNormals = true;
  bool m_HaveValues = false;
  std::uint64_t m_Offset = 0; ///< begin of the next array, from the start of the appended data
  std::vector<AppendedArray> m_Arrays;
};

} // namespace

void
WriteVTP(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  VTPWriter(surfaces, space).Write(file);
}

} // namespace rhombic
