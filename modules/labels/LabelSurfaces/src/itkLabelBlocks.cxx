#include "itkLabelBlocks.h"

#include "rhombicForEachBlock.h"
#include "rhombicLabelNumbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace itk
{
namespace
{

using SizeType = LabelBlocks::SizeType;

constexpr SizeValueType BlockLength = 4; // refined voxels

/** What labels some voxels have. */
struct LabelsOfVoxels
{
  std::uint16_t label = 0; ///< one other than 0, if there is any
  bool areSeveral = false; ///< whether there are several others than 0
  bool haveZero = false;

  void
  Add(const LabelsOfVoxels & other)
  {
    areSeveral |= other.areSeveral || (label != 0 && other.label != 0 && label != other.label);
    haveZero |= other.haveZero;
    label = label != 0 ? label : other.label;
  }
};

/** Adds to each block of a grid those within \a reach along each axis. */
template <typename TValue, typename TAdd>
BulkVector<TValue>
Widened(BulkVector<TValue> blocks, const SizeType & size, const SizeType & reach, const TAdd & add)
{
  SizeValueType step = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const BulkVector<TValue> before = blocks;
    constexpr std::size_t together = 16384;
    rhombic::ForEachInBlocks(blocks.size(), together, [&](SizeValueType n) {
      const SizeValueType here = n / step % size[axis];
      const SizeValueType begin = here < reach[axis] ? 0 : here - reach[axis];
      const SizeValueType end = std::min(size[axis], here + reach[axis] + 1);
      for (SizeValueType other = begin; other < end; ++other)
      {
        add(blocks[n], before[n - here * step + other * step]);
      }
    });
    step *= size[axis];
  }
  return blocks;
}

/** The labels of the voxels in each block; at the border of the map, label 0 is among them. */
BulkVector<LabelsOfVoxels>
FindLabelsOfBlocks(const Image<std::uint16_t, 3> & map, const SizeType & edges, const SizeType & size)
{
  const auto & voxels = map.GetLargestPossibleRegion().GetSize();
  BulkVector<LabelsOfVoxels> blocks(size[0] * size[1] * size[2]);
  for (SizeValueType row = 0; row < voxels[1] * voxels[2]; ++row)
  {
    const SizeValueType y = row % voxels[1] / edges[1];
    const SizeValueType z = row / voxels[1] / edges[2];
    LabelsOfVoxels * const ofRow = blocks.data() + (z * size[1] + y) * size[0];
    rhombic::ForEachRun(map.GetBufferPointer() + row * voxels[0],
                        voxels[0],
                        [&](std::uint16_t label, SizeValueType begin, SizeValueType end) {
                          for (SizeValueType x = begin / edges[0]; x <= (end - 1) / edges[0]; ++x)
                          {
                            ofRow[x].Add({ label, false, label == 0 });
                          }
                        });
    const bool isAtBorder = y == 0 || y + 1 == size[1] || z == 0 || z + 1 == size[2];
    for (SizeValueType x = 0; x < size[0]; ++x)
    {
      ofRow[x].haveZero |= isAtBorder || x == 0 || x + 1 == size[0];
    }
  }
  return blocks;
}

} // namespace

LabelBlocks::LabelBlocks(const Image<std::uint16_t, 3> & map, const SizeType & period, double reach)
{
  SizeType blocksOfReach;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    m_Edges[axis] = (BlockLength + period[axis] - 1) / period[axis];
    m_Size[axis] = (map.GetLargestPossibleRegion().GetSize(axis) + m_Edges[axis] - 1) / m_Edges[axis];
    blocksOfReach[axis] =
      static_cast<SizeValueType>(std::ceil(reach / static_cast<double>(m_Edges[axis] * period[axis])));
  }
  const auto addLabels = [](LabelsOfVoxels & labels, const LabelsOfVoxels & others) { labels.Add(others); };
  const auto blocks = FindLabelsOfBlocks(map, m_Edges, m_Size);
  const auto near = Widened(blocks, m_Size, { 1, 1, 1 }, addLabels);
  const auto wide = Widened(blocks, m_Size, blocksOfReach, addLabels);
  m_HaveOneNeighbor.resize(blocks.size());
  BulkVector<std::uint8_t> areJunctions(blocks.size());
  for (SizeValueType n = 0; n < blocks.size(); ++n)
  {
    const bool isAtBorder = near[n].haveZero && near[n].label != 0;
    m_HaveOneNeighbor[n] = isAtBorder && !wide[n].areSeveral ? 1 : 0;
    areJunctions[n] = isAtBorder && wide[n].areSeveral ? 1 : 0;
  }
  m_AreNear =
    Widened(std::move(areJunctions), m_Size, blocksOfReach, [](std::uint8_t & is, std::uint8_t other) { is |= other; });
}

} // namespace itk
