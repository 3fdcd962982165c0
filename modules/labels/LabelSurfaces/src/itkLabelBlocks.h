#ifndef itkLabelBlocks_h
#define itkLabelBlocks_h

#include "itkBulkAllocator.h"
#include "itkImage.h"

#include <array>
#include <cstdint>

namespace itk
{

/** \class LabelBlocks
 * \brief Blocks of a label map's voxels, and where the border of label 0 has only *one neighbour* or is at a *junction*
 * of several labels.
 *
 * Where it has one neighbour, the depth below it is that label's with the other sign. Elsewhere than at a border of
 * label 0 its field is that far from a border. Beyond the map is label 0. Blocks are about four refined voxels long
 * along each axis. */
class LabelBlocks
{
public:
  using SizeType = std::array<SizeValueType, 3>;

  /** \param period parts into which voxels are divided along each axis
   * \param reach how far labels have an effect on fields, in parts of voxels */
  LabelBlocks(const Image<std::uint16_t, 3> & map, const SizeType & period, double reach);

  /** The edges of a block, in voxels. */
  const SizeType &
  GetEdges() const
  {
    return m_Edges;
  }

  /** The number of blocks along each axis. */
  const SizeType &
  GetSize() const
  {
    return m_Size;
  }

  /** Whether a block is at a border of label 0 that has one neighbour. */
  bool
  HasOneNeighbor(SizeValueType x, SizeValueType y, SizeValueType z) const
  {
    return m_HaveOneNeighbor[this->NumberOf(x, y, z)] != 0;
  }

  /** Whether a block is at a junction or within reach of such a block, on which the field there depends. */
  bool
  IsNearJunction(SizeValueType x, SizeValueType y, SizeValueType z) const
  {
    return m_AreNear[this->NumberOf(x, y, z)] != 0;
  }

private:
  SizeValueType
  NumberOf(SizeValueType x, SizeValueType y, SizeValueType z) const
  {
    return (z * m_Size[1] + y) * m_Size[0] + x;
  }

  SizeType m_Edges;
  SizeType m_Size;
  BulkVector<std::uint8_t> m_HaveOneNeighbor;
  BulkVector<std::uint8_t> m_AreNear; ///< junctions
};

} // namespace itk

#endif
