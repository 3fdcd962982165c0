#include "rhombicPLYWriter.h"

#include "itkByteSwapper.h"

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace rhombic
{
namespace
{

/** Collects small records and writes them in large blocks. */
class BlockWriter
{
public:
  explicit BlockWriter(const std::filesystem::path & path)
    : m_File(path, std::ios::binary | std::ios::trunc)
  {
    m_Block.reserve(BlockSize);
  }

  ~BlockWriter()
  {
    this->Flush();
  }

  BlockWriter(const BlockWriter &) = delete;
  BlockWriter &
  operator=(const BlockWriter &) = delete;

  void
  Append(const void * data, std::size_t size)
  {
    if (m_Block.size() + size > BlockSize)
    {
      this->Flush();
    }
    const auto * const bytes = static_cast<const char *>(data);
    m_Block.insert(m_Block.end(), bytes, bytes + size);
  }

private:
  static constexpr std::size_t BlockSize = 1 << 20;

  void
  Flush()
  {
    m_File.write(m_Block.data(), static_cast<std::streamsize>(m_Block.size()));
    m_Block.clear();
  }

  std::ofstream m_File;
  std::vector<char> m_Block;
};

std::string
MakeHeader(const itk::TriangleSurface & surface)
{
  const bool bigEndian = itk::ByteSwapper<std::uint16_t>::SystemIsBigEndian();
  return std::string("ply\nformat ") + (bigEndian ? "binary_big_endian" : "binary_little_endian") +
         " 1.0\ncomment Rhombic\ncomment SPACE=LPS\nelement vertex " + std::to_string(surface.GetNumberOfPoints()) +
         "\nproperty float x\nproperty float y\nproperty float z\n" +
         (surface.HasNormals() ? "property float nx\nproperty float ny\nproperty float nz\n" : "") + "element face " +
         std::to_string(surface.GetNumberOfTriangles()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

} // namespace

std::uintmax_t
WritePLY(const itk::TriangleSurface & surface, const std::filesystem::path & path)
{
  const std::string header = MakeHeader(surface);
  const bool hasNormals = surface.HasNormals();
  BlockWriter writer(path);
  writer.Append(header.data(), header.size());
  for (std::size_t i = 0; i < surface.GetNumberOfPoints(); ++i)
  {
    writer.Append(surface.GetPoints()[i].data(), sizeof(itk::TriangleSurface::PointType));
    if (hasNormals)
    {
      writer.Append(surface.GetNormals()[i].data(), sizeof(itk::TriangleSurface::NormalType));
    }
  }
  constexpr std::size_t indicesSize = sizeof(itk::TriangleSurface::TriangleType);
  for (const auto & triangle : surface.GetTriangles())
  {
    char record[1 + indicesSize] = { 3 };
    std::memcpy(record + 1, triangle.data(), indicesSize);
    writer.Append(record, sizeof(record));
  }
  const std::uintmax_t pointSize = sizeof(itk::TriangleSurface::PointType) * (hasNormals ? 2 : 1);
  return header.size() + pointSize * surface.GetNumberOfPoints() + (1 + indicesSize) * surface.GetNumberOfTriangles();
}

} // namespace rhombic
