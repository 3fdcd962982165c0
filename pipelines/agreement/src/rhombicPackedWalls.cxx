#include "rhombicPackedWalls.h"

#include "rhombicFailure.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace rhombic
{
namespace
{

constexpr std::size_t BlockSize = 1 << 18; // elements

/** The blocks of an array.
 * \param bound the most bytes that a block may take
 * \param encode writes a block: target and its size in bytes, first element, number of elements; returns its bytes */
template <typename TBlocks, typename TArray, typename TEncode>
TBlocks
Pack(const TArray & array, std::size_t bound, TEncode && encode)
{
  TBlocks blocks;
  std::vector<unsigned char> buffer(bound);
  for (std::size_t first = 0; first < array.size(); first += BlockSize)
  {
    const std::size_t count = std::min(BlockSize, array.size() - first);
    const std::size_t length = encode(buffer.data(), buffer.size(), array.data() + first, count);
    blocks.push_back({ count, { buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(length) } });
  }
  return blocks;
}

/** Fills an array from its blocks. \param decode reads a block: target, number of elements, bytes; returns 0 */
template <typename TBlocks, typename TArray, typename TDecode>
void
UnpackBlocks(const TBlocks & blocks, TArray & array, TDecode && decode)
{
  std::size_t total = 0;
  for (const auto & block : blocks)
  {
    total += block.count;
  }
  array.resize(total);
  auto * target = array.data();
  for (const auto & [count, bytes] : blocks)
  {
    if (decode(target, count, bytes) != 0)
    {
      throw Failure(FailureKind::Internal, "Packed walls can't be unpacked.");
    }
    target += count;
  }
}

/** Of elements of a multiple of 4 bytes. */
constexpr auto EncodeElements = [](unsigned char * target, std::size_t size, const auto * elements, std::size_t count) {
  return meshopt_encodeVertexBuffer(target, size, elements, count, sizeof(*elements));
};
constexpr auto DecodeElements = [](auto * target, std::size_t count, const std::vector<unsigned char> & bytes) {
  return meshopt_decodeVertexBuffer(target, count, sizeof(*target), bytes.data(), bytes.size());
};

} // namespace

PackedWalls::PackedWalls(itk::LabelWalls & walls)
{
  const itk::LabelWalls & source = walls;
  using Point = itk::LabelWalls::PointType;
  using Pair = itk::LabelWalls::LabelPairType;
  m_Points =
    Pack<Blocks>(source.GetPoints(), meshopt_encodeVertexBufferBound(BlockSize, sizeof(Point)), EncodeElements);
  m_Labels =
    Pack<Blocks>(source.GetTriangleLabels(), meshopt_encodeVertexBufferBound(BlockSize, sizeof(Pair)), EncodeElements);
  m_Triangles = Pack<Blocks>(source.GetTriangles(),
                             meshopt_encodeIndexSequenceBound(3 * BlockSize, source.GetNumberOfPoints()),
                             [](unsigned char * target, std::size_t size, const auto * triangles, std::size_t count) {
                               return meshopt_encodeIndexSequence(target, size, triangles->data(), 3 * count);
                             });
  walls.Initialize();
}

void
PackedWalls::Unpack(itk::LabelWalls & walls) const
{
  UnpackBlocks(m_Points, walls.GetPoints(), DecodeElements);
  UnpackBlocks(m_Labels, walls.GetTriangleLabels(), DecodeElements);
  UnpackBlocks(
    m_Triangles, walls.GetTriangles(), [](auto * target, std::size_t count, const std::vector<unsigned char> & bytes) {
      return meshopt_decodeIndexSequence(target->data(), 3 * count, bytes.data(), bytes.size());
    });
}

} // namespace rhombic
