#include "rhombicFailure.h"
#include "rhombicFileColours.h"
#include "rhombicFileSpace.h"
#include "rhombicGLBContainer.h"
#include "rhombicSurfaceFormats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace rhombic
{
namespace
{

using OrderedJson = nlohmann::ordered_json;
using PointType = itk::TriangleSurface::PointType;

/** \class GLBWriter
 * \brief Writes positions, normals and indices of each surface, and the JSON that describes them.
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
    for (const SceneSurface & scene : surfaces)
    {
      this->AddSurface(scene);
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
    for (const SceneSurface & scene : m_Surfaces)
    {
      this->AppendSurface(*scene.surface, file);
    }
  }

private:
  void
  AddSurface(const SceneSurface & scene)
  {
    const itk::TriangleSurface & surface = *scene.surface;
    const std::size_t number = m_Json["nodes"].size() - 1;
    m_Json["nodes"][0]["children"].push_back(number + 1);
    m_Json["nodes"].push_back({ { "name", scene.name }, { "mesh", number } });

    OrderedJson primitive{ { "attributes", OrderedJson::object() }, { "material", number } };
    primitive["attributes"]["POSITION"] = this->AddPositions(surface);
    if (surface.HasNormals())
    {
      primitive["attributes"]["NORMAL"] =
        this->AddAccessor(glb::Float, "VEC3", surface.GetNumberOfPoints(), sizeof(PointType), glb::ArrayBuffer);
    }
    primitive["indices"] = this->AddAccessor(
      glb::UnsignedInt, "SCALAR", 3 * surface.GetNumberOfTriangles(), sizeof(std::uint32_t), glb::ElementArrayBuffer);
    m_Json["meshes"].push_back({ { "name", scene.name }, { "primitives", OrderedJson::array({ primitive }) } });
    m_Json["materials"].push_back(MakeMaterial(scene));
  }

  static OrderedJson
  MakeMaterial(const SceneSurface & scene)
  {
    const Colour light = SRGBToLinear(scene.colour);
    OrderedJson material{ { "name", scene.name },
                          { "pbrMetallicRoughness",
                            { { "baseColorFactor", { light[0], light[1], light[2], scene.opacity } },
                              { "metallicFactor", 0 },
                              { "roughnessFactor", 0.6 } } } };
    if (scene.opacity < 1)
    {
      material["alphaMode"] = "BLEND";
    }
    return material;
  }

  std::size_t
  AddPositions(const itk::TriangleSurface & surface)
  {
    const std::size_t accessor =
      this->AddAccessor(glb::Float, "VEC3", surface.GetNumberOfPoints(), sizeof(PointType), glb::ArrayBuffer);
    PointType lowest = Turned(surface.GetPoints().front(), m_Space);
    PointType highest = lowest;
    for (const PointType & point : surface.GetPoints())
    {
      const PointType turned = Turned(point, m_Space);
      for (int axis = 0; axis < 3; ++axis)
      {
        lowest[axis] = std::min(lowest[axis], turned[axis]);
        highest[axis] = std::max(highest[axis], turned[axis]);
      }
    }
    m_Json["accessors"][accessor]["min"] = lowest;
    m_Json["accessors"][accessor]["max"] = highest;
    return accessor;
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
  AppendSurface(const itk::TriangleSurface & surface, OutputFile & file) const
  {
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

} // namespace

void
WriteGLB(const std::vector<SceneSurface> & surfaces, SurfaceFileSpace space, OutputFile & file)
{
  GLBWriter(surfaces, space).Write(file);
}

} // namespace rhombic
