#include "rhombicFailure.h"
#include "rhombicSurfaceFormats.h"
#include "itkMatrix.h"
#include "itkPointBox.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace rhombic
{
namespace
{

/** Constants of binary glTF (Khronos, "glTF 2.0 Specification", sections 4.4, 5.1 and 5.22). */
namespace glb
{

constexpr std::uint32_t Magic = 0x46546c67;     // "glTF"
constexpr std::uint32_t JsonChunk = 0x4e4f534a; // "JSON"
constexpr std::uint32_t BinChunk = 0x004e4942;  // "BIN"
constexpr std::uint32_t HeaderSize = 12;
constexpr std::uint32_t ChunkHeaderSize = 8;

constexpr int UnsignedByte = 5121;
constexpr int UnsignedShort = 5123;
constexpr int UnsignedInt = 5125;
constexpr int Float = 5126;

constexpr int ArrayBuffer = 34962;
constexpr int ElementArrayBuffer = 34963;

constexpr int Triangles = 4;
constexpr int TriangleStrip = 5;
constexpr int TriangleFan = 6;

/** Matrices, column by column, from LPS or RAS millimetres to glTF's metres with y up and z to the front: the patient
 * stands and faces the viewer. */
constexpr std::array<double, 16> FromLPS{ 0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1 };
constexpr std::array<double, 16> FromRAS{ -0.001, 0, 0, 0, 0, 0, 0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1 };

/** The inverse of FromLPS. */
constexpr std::array<double, 16> ToLPS{ 1000, 0, 0, 0, 0, 0, 1000, 0, 0, -1000, 0, 0, 0, 0, 0, 1 };

} // namespace glb

using OrderedJson = nlohmann::ordered_json;
using PointType = itk::TriangleSurface::PointType;

/** \class GLBWriter
 * \brief Writes positions, normals, colours and indices of each surface, and the JSON that describes them.
 *
 * Positions stay in millimetres, so that nothing is rounded; the root node's matrix converts them to metres. */
class GLBWriter
{
public:
  GLBWriter(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space)
    : m_Surfaces(surfaces)
    , m_Space(space)
  {
    m_Json["asset"] = { { "version", "2.0" }, { "generator", "Rhombic" } };
    m_Json["scene"] = 0;
    m_Json["scenes"] = { { { "nodes", { 0 } } } };
    m_Json["nodes"].push_back({ { "name", "millimetres" },
                                { "matrix", space == SurfaceFileSpace::RAS ? glb::FromRAS : glb::FromLPS },
                                { "extras", { { "SPACE", NameOf(space) }, { "unit", "mm" }, { "scale", 0.001 } } } });
    for (const SceneSurface & item : surfaces)
    {
      this->AddSurface(item);
      if (item.pointColours)
      {
        m_Json["extensionsUsed"] = { "KHR_materials_unlit" };
      }
    }
    m_Json["buffers"].push_back({ { "byteLength", m_BufferSize } });
  }

  void
  Write(OutputFile & file) const
  {
    std::string json = m_Json.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size = glb::HeaderSize + 2 * glb::ChunkHeaderSize + json.size() + m_BufferSize;
    if (size > std::numeric_limits<std::uint32_t>::max())
    {
      throw Failure(FailureKind::Output,
                    "Cannot write " + file.GetTarget().string() + ": " + std::to_string(size) +
                      " bytes are more than the 4 GiB of a GLB file; choose .vtp or a lower density.");
    }
    const auto append = [&file](std::uint64_t number) { file.AppendBinary(static_cast<std::uint32_t>(number)); };
    append(glb::Magic);
    append(2); // version
    append(size);
    append(json.size());
    append(glb::JsonChunk);
    file.Append(json);
    append(m_BufferSize);
    append(glb::BinChunk);
    for (const SceneSurface & item : m_Surfaces)
    {
      this->AppendSurface(item, file);
    }
  }

private:
  void
  AddSurface(const SceneSurface & item)
  {
    const itk::TriangleSurface & surface = *item.surface;
    const std::size_t number = m_Json["nodes"].size() - 1;
    m_Json["nodes"][0]["children"].push_back(number + 1);
    m_Json["nodes"].push_back({ { "name", item.name }, { "mesh", number } });

    OrderedJson primitive{ { "attributes", OrderedJson::object() }, { "material", number } };
    primitive["attributes"]["POSITION"] = this->AddPositions(surface);
    if (surface.HasNormals())
    {
      primitive["attributes"]["NORMAL"] = this->AddVectors(surface.GetNumberOfPoints());
    }
    if (item.pointColours)
    {
      const std::size_t colours = this->AddAccessor(
        glb::UnsignedShort, "VEC4", surface.GetNumberOfPoints(), sizeof(PointColour), glb::ArrayBuffer);
      m_Json["accessors"][colours]["normalized"] = true;
      primitive["attributes"]["COLOR_0"] = colours;
    }
    primitive["indices"] = this->AddAccessor(
      glb::UnsignedInt, "SCALAR", 3 * surface.GetNumberOfTriangles(), sizeof(std::uint32_t), glb::ElementArrayBuffer);
    m_Json["meshes"].push_back({ { "name", item.name }, { "primitives", OrderedJson::array({ primitive }) } });
    m_Json["materials"].push_back(MakeMaterial(item));
  }

  /** Linear, in 16 bits, which dark colours need; and opaque, as the material has the opacity. */
  using PointColour = std::array<std::uint16_t, 4>;

  static PointColour
  ToPointColour(const std::array<std::uint8_t, 3> & bytes)
  {
    constexpr double largest = 65535.0;
    PointColour colour{ 0, 0, 0, 65535 };
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      colour[channel] = static_cast<std::uint16_t>(std::lround(largest * SRGBToLinear(bytes[channel] / 255.0)));
    }
    return colour;
  }

  /** The colours of points multiply that of the material, so that is white then, and seen without lights. */
  static OrderedJson
  MakeMaterial(const SceneSurface & item)
  {
    Colour light{ 1.0, 1.0, 1.0 };
    if (!item.pointColours)
    {
      std::transform(item.colour.begin(), item.colour.end(), light.begin(), SRGBToLinear);
    }
    OrderedJson material{ { "name", item.name },
                          { "pbrMetallicRoughness",
                            { { "baseColorFactor", { light[0], light[1], light[2], item.opacity } },
                              { "metallicFactor", 0 },
                              { "roughnessFactor", 0.6 } } } };
    if (item.opacity < 1)
    {
      material["alphaMode"] = "BLEND";
    }
    if (item.pointColours)
    {
      material["extensions"] = { { "KHR_materials_unlit", OrderedJson::object() } };
    }
    return material;
  }

  std::size_t
  AddPositions(const itk::TriangleSurface & surface)
  {
    const std::size_t accessor = this->AddVectors(surface.GetNumberOfPoints());
    const PointType first = Turned(surface.GetPoints().front(), m_Space);
    itk::PointBox box{ first, first };
    for (const PointType & point : surface.GetPoints())
    {
      box.Add(Turned(point, m_Space));
    }
    m_Json["accessors"][accessor]["min"] = box.lowest;
    m_Json["accessors"][accessor]["max"] = box.highest;
    return accessor;
  }

  std::size_t
  AddVectors(std::uint64_t count)
  {
    return this->AddAccessor(glb::Float, "VEC3", count, sizeof(PointType), glb::ArrayBuffer);
  }

  std::size_t
  AddAccessor(int componentType, const char * type, std::uint64_t count, std::uint64_t elementSize, int target)
  {
    const std::size_t number = m_Json["accessors"].size();
    const std::uint64_t size = count * elementSize;
    m_Json["bufferViews"].push_back(
      { { "buffer", 0 }, { "byteOffset", m_BufferSize }, { "byteLength", size }, { "target", target } });
    m_Json["accessors"].push_back(
      { { "bufferView", number }, { "componentType", componentType }, { "count", count }, { "type", type } });
    m_BufferSize += size;
    return number;
  }

  void
  AppendSurface(const SceneSurface & item, OutputFile & file) const
  {
    const itk::TriangleSurface & surface = *item.surface;
    for (const auto & point : surface.GetPoints())
    {
      file.AppendBinary(Turned(point, m_Space));
    }
    if (surface.HasNormals())
    {
      for (const auto & normal : surface.GetNormals())
      {
        file.AppendBinary(Turned(normal, m_Space));
      }
    }
    if (item.pointColours)
    {
      for (const auto & colour : *item.pointColours)
      {
        file.AppendBinary(ToPointColour(colour));
      }
    }
    for (const auto & triangle : surface.GetTriangles())
    {
      file.AppendBinary(triangle);
    }
  }

  const std::vector<SceneSurface> & m_Surfaces;
  SurfaceFileSpace m_Space;
  OrderedJson m_Json;
  std::uint64_t m_BufferSize = 0;
};

using Json = nlohmann::json;

/** The affine transform x -> linear x + offset. */
struct Transform
{
  itk::Matrix<double, 3, 3> linear;
  itk::Vector<double, 3> offset{ 0.0 };

  /** The transform that applies \a other first, then this transform. */
  Transform
  After(const Transform & other) const
  {
    return { linear * other.linear, linear * other.offset + offset };
  }
};

Transform
FromColumns(const std::array<double, 16> & columns)
{
  Transform transform;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 3; ++column)
    {
      transform.linear(row, column) = columns[4 * column + row];
    }
    transform.offset[row] = columns[12 + row];
  }
  return transform;
}

/** The array of numbers called \a name, if there is one. */
template <std::size_t VCount>
std::optional<std::array<double, VCount>>
NumbersAt(const Json & json, const char * name)
{
  const auto found = json.find(name);
  return found == json.end() ? std::nullopt
                             : std::optional<std::array<double, VCount>>(found->get<std::array<double, VCount>>());
}

Transform
TransformOf(const Json & node)
{
  if (const auto columns = NumbersAt<16>(node, "matrix"))
  {
    return FromColumns(*columns);
  }
  const auto [x, y, z, w] = NumbersAt<4>(node, "rotation").value_or(std::array<double, 4>{ 0, 0, 0, 1 });
  const auto scale = NumbersAt<3>(node, "scale").value_or(std::array<double, 3>{ 1, 1, 1 });
  const auto offset = NumbersAt<3>(node, "translation").value_or(std::array<double, 3>{ 0, 0, 0 });
  const double rotation[3][3]{ { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
                               { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w) },
                               { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y) } };
  Transform transform;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 3; ++column)
    {
      transform.linear(row, column) = rotation[row][column] * scale[column];
    }
    transform.offset[row] = offset[row];
  }
  return transform;
}

double
Determinant(const itk::Matrix<double, 3, 3> & m)
{
  return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
         m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
}

/** The matrix for normals, up to a factor: the cofactors, which exist even if the inverse does not. */
itk::Matrix<double, 3, 3>
NormalMatrix(const itk::Matrix<double, 3, 3> & m)
{
  itk::Matrix<double, 3, 3> cofactors;
  const double sign = Determinant(m) < 0 ? -1 : 1;
  for (unsigned int row = 0; row < 3; ++row)
  {
    const unsigned int r1 = (row + 1) % 3, r2 = (row + 2) % 3;
    for (unsigned int column = 0; column < 3; ++column)
    {
      const unsigned int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
      cofactors(row, column) = sign * (m(r1, c1) * m(r2, c2) - m(r1, c2) * m(r2, c1));
    }
  }
  return cofactors;
}

/** Whether the matrix is exactly orthogonal, so that normals keep their length and need no normalization. */
bool
KeepsLengths(const itk::Matrix<double, 3, 3> & m)
{
  itk::Matrix<double, 3, 3> identity;
  identity.SetIdentity();
  return m * itk::Matrix<double, 3, 3>(m.GetTranspose()) == identity;
}

std::array<float, 3>
ToFloats(const itk::Vector<double, 3> & vector)
{
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2]) };
}

/** The bytes of an accessor in the file. */
struct Accessor
{
  std::uint64_t begin = 0;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  std::uint64_t componentType = 0; ///< 0 if there are no indices: each corner's index is its position
  std::uint64_t componentSize = 0;
};

/** \class GLBReader
 * \brief Reads one surface for each primitive of each node's mesh, in the order of the scene. */
class GLBReader
{
public:
  explicit GLBReader(const InputFile & file)
    : m_File(file)
  {}

  std::vector<SceneSurface>
  Read()
  {
    this->ReadContainer();
    this->CheckExtensions();
    for (const std::uint64_t node : this->RootNodes())
    {
      this->ReadNode(node, FromColumns(glb::ToLPS), 0);
    }
    return std::move(m_Surfaces);
  }

private:
  void
  ReadContainer()
  {
    std::uint32_t header[5];
    m_File.Read(0, header, sizeof(header));
    const auto [magic, version, size, jsonSize, jsonType] = header;
    if (magic != glb::Magic || version != 2 || jsonType != glb::JsonChunk)
    {
      m_File.Refuse("it does not begin like a GLB file of version 2; check what kind of file it is");
    }
    constexpr std::uint64_t longest = std::uint64_t{ 1 } << 26; // a scene of a hundred thousand surfaces
    const std::uint64_t jsonEnd = sizeof(header) + std::uint64_t{ jsonSize };
    if (size > m_File.GetSize() || jsonEnd > size || jsonSize > longest)
    {
      m_File.RefuseDamaged("its parts are longer than the file");
    }
    std::string json(jsonSize, '\0');
    m_File.Read(sizeof(header), json.data(), json.size());
    m_Json = Json::parse(json);

    if (jsonEnd + glb::ChunkHeaderSize <= size)
    {
      std::uint32_t chunk[2];
      m_File.Read(jsonEnd, chunk, sizeof(chunk));
      m_BufferBegin = jsonEnd + sizeof(chunk);
      m_BufferSize = chunk[1] == glb::BinChunk ? chunk[0] : 0;
      if (m_BufferSize > size - m_BufferBegin)
      {
        m_File.RefuseDamaged("its parts are longer than the file");
      }
    }
  }

  /** Refuses required extensions, which may change the meaning of numbers, except those of materials. */
  void
  CheckExtensions() const
  {
    for (const Json & extension : m_Json.value("extensionsRequired", Json::array()))
    {
      const auto & name = extension.get_ref<const std::string &>();
      if (name.rfind("KHR_materials_", 0) != 0 && name != "KHR_texture_transform")
      {
        m_File.Refuse("it requires the extension " + name + ", which is not supported; export it without");
      }
    }
  }

  std::vector<std::uint64_t>
  RootNodes() const
  {
    if (m_Json.contains("scenes"))
    {
      const std::uint64_t scene = this->WholeOr(0, m_Json, "scene");
      std::vector<std::uint64_t> roots;
      for (const Json & node : this->Item("scenes", scene).value("nodes", Json::array()))
      {
        roots.push_back(this->Whole(node));
      }
      return roots;
    }
    std::vector<bool> isChild(m_Json.value("nodes", Json::array()).size());
    for (const Json & node : m_Json.value("nodes", Json::array()))
    {
      for (const Json & child : node.value("children", Json::array()))
      {
        const std::uint64_t number = this->Whole(child);
        if (number < isChild.size())
        {
          isChild[number] = true;
        }
      }
    }
    std::vector<std::uint64_t> roots;
    for (std::size_t n = 0; n < isChild.size(); ++n)
    {
      if (!isChild[n])
      {
        roots.push_back(n);
      }
    }
    return roots;
  }

  void
  ReadNode(std::uint64_t number, const Transform & parent, int depth)
  {
    const Json & node = this->Item("nodes", number);
    m_IsRead.resize(m_Json.at("nodes").size());
    constexpr int deepest = 1000;
    if (m_IsRead[number] || depth > deepest)
    {
      m_File.RefuseDamaged("a node is below two others, or itself");
    }
    m_IsRead[number] = true;
    const Transform transform = parent.After(TransformOf(node));
    if (node.contains("mesh"))
    {
      this->ReadMesh(node, transform);
    }
    for (const Json & child : node.value("children", Json::array()))
    {
      this->ReadNode(this->Whole(child), transform, depth + 1);
    }
  }

  void
  ReadMesh(const Json & node, const Transform & transform)
  {
    const Json & mesh = this->Item("meshes", this->Whole(node, "mesh"));
    const std::string name = node.value("name", mesh.value("name", m_File.GetStem()));
    for (const Json & primitive : mesh.at("primitives"))
    {
      const std::uint64_t mode = this->WholeOr(glb::Triangles, primitive, "mode");
      if (mode == glb::Triangles || mode == glb::TriangleStrip || mode == glb::TriangleFan)
      {
        SceneSurface item = this->ReadLook(primitive);
        item.name = name;
        item.surface = this->ReadPrimitive(primitive, mode, transform);
        m_Surfaces.push_back(std::move(item));
      }
    }
  }

  SceneSurface
  ReadLook(const Json & primitive) const
  {
    SceneSurface item;
    if (primitive.contains("material"))
    {
      const Json & material = this->Item("materials", this->Whole(primitive, "material"));
      const Json surface = material.value("pbrMetallicRoughness", Json::object());
      const auto factor = NumbersAt<4>(surface, "baseColorFactor").value_or(std::array<double, 4>{ 1, 1, 1, 1 });
      std::transform(factor.begin(), factor.begin() + 3, item.colour.begin(), LinearToSRGB);
      item.opacity = material.value("alphaMode", "OPAQUE") == "BLEND" ? ToUnit(factor[3]) : 1.0;
    }
    return item;
  }

  itk::TriangleSurface::Pointer
  ReadPrimitive(const Json & primitive, std::uint64_t mode, const Transform & transform)
  {
    const Json & attributes = primitive.at("attributes");
    const Accessor positions = this->FindVectors(attributes, "POSITION");
    if (positions.count >= std::numeric_limits<std::uint32_t>::max())
    {
      m_File.RefuseDamaged("a mesh has more points than 32-bit indices reach");
    }
    Accessor indices;
    indices.count = positions.count;
    if (primitive.contains("indices"))
    {
      indices = this->FindAccessor(primitive.at("indices"), "SCALAR");
    }
    m_Memory += 24 * positions.count + (mode == glb::Triangles ? 4 : 12) * indices.count;
    m_File.RequireMemoryToRead(m_Memory);

    const auto surface = itk::TriangleSurface::New();
    this->ReadVectors(positions, surface->GetPoints());
    for (auto & point : surface->GetPoints())
    {
      const itk::Vector<double, 3> vector(itk::Vector<float, 3>(point.data()));
      point = ToFloats(transform.linear * vector + transform.offset);
    }
    if (attributes.contains("NORMAL"))
    {
      const Accessor normals = this->FindVectors(attributes, "NORMAL");
      if (normals.count != positions.count)
      {
        m_File.RefuseDamaged("a mesh has another number of normals than of points");
      }
      this->ReadVectors(normals, surface->GetNormals());
      TurnNormals(transform.linear, surface->GetNormals());
    }
    this->ReadTriangles(indices, mode, *surface);
    if (Determinant(transform.linear) < 0) // a reflection: glTF reverses the triangles
    {
      for (auto & triangle : surface->GetTriangles())
      {
        std::swap(triangle[1], triangle[2]);
      }
    }
    return surface;
  }

  static void
  TurnNormals(const itk::Matrix<double, 3, 3> & linear, itk::TriangleSurface::NormalsContainer & normals)
  {
    const auto matrix = NormalMatrix(linear);
    const bool keepsLengths = KeepsLengths(matrix);
    for (auto & normal : normals)
    {
      auto turned = matrix * itk::Vector<double, 3>(itk::Vector<float, 3>(normal.data()));
      const double length = turned.GetNorm();
      if (!keepsLengths && length > 0)
      {
        turned /= length;
      }
      normal = ToFloats(turned);
    }
  }

  /** Finds an attribute of three floats per point. */
  Accessor
  FindVectors(const Json & attributes, const char * name) const
  {
    const Accessor accessor = this->FindAccessor(attributes.at(name), "VEC3");
    if (accessor.componentType != glb::Float)
    {
      m_File.Refuse(std::string("its ") + name + " are not of type float; export it without compression");
    }
    return accessor;
  }

  Accessor
  FindAccessor(const Json & number, std::string_view type) const
  {
    const Json & json = this->Item("accessors", this->Whole(number));
    if (json.contains("sparse") || !json.contains("bufferView"))
    {
      m_File.Refuse("it has sparse accessors, which are not supported; export it without");
    }
    if (json.at("type").get_ref<const std::string &>() != type)
    {
      m_File.RefuseDamaged("an accessor is not of type " + std::string(type));
    }
    const Json & view = this->Item("bufferViews", this->Whole(json, "bufferView"));
    const Json & buffer = this->Item("buffers", this->Whole(view, "buffer"));
    if (this->Whole(view, "buffer") != 0 || buffer.contains("uri"))
    {
      m_File.Refuse("its numbers are in another file; export it as one file");
    }
    Accessor accessor;
    accessor.count = this->Whole(json, "count");
    accessor.componentType = this->Whole(json, "componentType");
    if (accessor.componentType == 0) // which stands for points in their order
    {
      m_File.RefuseDamaged("an accessor has a type of numbers that does not exist");
    }
    accessor.componentSize = accessor.componentType == glb::UnsignedByte    ? 1
                             : accessor.componentType == glb::UnsignedShort ? 2
                                                                            : 4;
    const std::uint64_t elementSize = (type == "VEC3" ? 3 : 1) * accessor.componentSize;
    accessor.stride = this->WholeOr(elementSize, view, "byteStride");

    const std::uint64_t viewBegin = this->WholeOr(0, view, "byteOffset"), viewSize = this->Whole(view, "byteLength");
    const std::uint64_t offset = this->WholeOr(0, json, "byteOffset");
    const bool fits =
      accessor.stride >= elementSize && accessor.stride <= 252 &&
      accessor.count <= std::numeric_limits<std::uint32_t>::max() && viewBegin <= m_BufferSize &&
      viewSize <= m_BufferSize - viewBegin && offset <= viewSize &&
      (accessor.count == 0 || (accessor.count - 1) * accessor.stride + elementSize <= viewSize - offset);
    if (!fits)
    {
      m_File.RefuseDamaged("an accessor reaches beyond its buffer");
    }
    accessor.begin = m_BufferBegin + viewBegin + offset;
    return accessor;
  }

  template <typename TContainer>
  void
  ReadVectors(const Accessor & accessor, TContainer & vectors) const
  {
    vectors.resize(accessor.count);
    if (accessor.stride == sizeof(vectors[0]))
    {
      m_File.Read(accessor.begin, vectors.data(), vectors.size() * sizeof(vectors[0]));
      return;
    }
    InputStream stream(m_File, accessor.begin);
    char between[256];
    for (std::size_t n = 0; n < vectors.size(); ++n)
    {
      stream.Take(vectors[n].data(), sizeof(vectors[n]));
      stream.Take(between, n + 1 < vectors.size() ? accessor.stride - sizeof(vectors[n]) : 0);
    }
  }

  /** Calls \a use(n, index) for each corner in order, with or without indices. */
  template <typename TUse>
  void
  ForEachCorner(const Accessor & indices, std::uint64_t points, const TUse & use) const
  {
    InputStream stream(m_File, indices.begin);
    for (std::uint64_t n = 0; n < indices.count; ++n)
    {
      const std::uint64_t corner = indices.componentSize == 0   ? n
                                   : indices.componentSize == 1 ? stream.Take<std::uint8_t>()
                                   : indices.componentSize == 2 ? stream.Take<std::uint16_t>()
                                                                : stream.Take<std::uint32_t>();
      if (corner >= points)
      {
        m_File.RefuseDamaged("a triangle has a corner at point " + std::to_string(corner) +
                             ", which its mesh does not have");
      }
      use(n, static_cast<std::uint32_t>(corner));
    }
  }

  void
  ReadTriangles(const Accessor & indices, std::uint64_t mode, itk::TriangleSurface & surface) const
  {
    constexpr std::uint64_t wholeTypes[]{ 0, glb::UnsignedByte, glb::UnsignedShort, glb::UnsignedInt };
    if (std::count(std::begin(wholeTypes), std::end(wholeTypes), indices.componentType) == 0 ||
        indices.stride != indices.componentSize)
    {
      m_File.RefuseDamaged("the indices of a mesh are no whole numbers, or not close together");
    }
    auto & triangles = surface.GetTriangles();
    triangles.reserve(mode == glb::Triangles ? indices.count / 3 : indices.count);
    std::array<std::uint32_t, 3> last{};
    this->ForEachCorner(indices, surface.GetNumberOfPoints(), [&](std::uint64_t n, std::uint32_t corner) {
      if (mode == glb::Triangles)
      {
        last[n % 3] = corner;
        if (n % 3 == 2)
        {
          triangles.push_back(last);
        }
        return;
      }
      if (n >= 2)
      {
        const bool isTurned = mode == glb::TriangleStrip && n % 2 == 1;
        triangles.push_back(isTurned ? std::array<std::uint32_t, 3>{ last[1], last[0], corner }
                                     : std::array<std::uint32_t, 3>{ last[0], last[1], corner });
      }
      if (mode == glb::TriangleStrip || n == 0)
      {
        last[0] = n == 0 ? corner : last[1];
      }
      last[1] = corner;
    });
  }

  /** An item of one of the lists of the JSON. */
  const Json &
  Item(const char * list, std::uint64_t number) const
  {
    return m_Json.at(list).at(number);
  }

  std::uint64_t
  Whole(const Json & json) const
  {
    if (!json.is_number_unsigned())
    {
      m_File.RefuseDamaged("its JSON has something else where a whole number must be");
    }
    return json.get<std::uint64_t>();
  }

  std::uint64_t
  Whole(const Json & json, const char * name) const
  {
    return this->Whole(json.at(name));
  }

  std::uint64_t
  WholeOr(std::uint64_t otherwise, const Json & json, const char * name) const
  {
    return json.contains(name) ? this->Whole(json, name) : otherwise;
  }

  const InputFile & m_File;
  Json m_Json;
  std::uint64_t m_BufferBegin = 0; ///< in the file
  std::uint64_t m_BufferSize = 0;
  std::uint64_t m_Memory = 0; ///< bytes of the surfaces so far
  std::vector<bool> m_IsRead; ///< for each node
  std::vector<SceneSurface> m_Surfaces;
};

} // namespace

void
WriteGLB(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  GLBWriter(surfaces, space).Write(file);
}

std::vector<SceneSurface>
ReadGLB(const InputFile & file)
{
  try
  {
    return GLBReader(file).Read();
  }
  catch (const Json::exception & error)
  {
    file.Refuse("its JSON does not follow glTF (" + DescribeError(error) + "); export it again");
  }
}

} // namespace rhombic
