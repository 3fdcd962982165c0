#ifndef itkVoxelBand_h
#define itkVoxelBand_h

#include "itkBulkAllocator.h"
#include "itkIntTypes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>

namespace itk
{

/** \class VoxelBand
 * \brief A set of voxels, such as those near a border, in tiles along x.
 *
 * A row, of number y + z height, has at most 64 tiles of a multiple of 16 voxels each, one bit for each tile. Eight
 * bytes a row. Different rows can be marked at once. */
class VoxelBand
{
public:
  using SizeType = std::array<SizeValueType, 3>;

  explicit VoxelBand(const SizeType & size)
    : m_Size(size)
    , m_TileLength(16 * ((size[0] + 16 * 64 - 1) / (16 * 64)))
    , m_Rows(size[1] * size[2], 0)
  {}

  SizeValueType
  GetTileLength() const
  {
    return m_TileLength;
  }

  /** Adds the tile of a voxel. */
  void
  Mark(SizeValueType row, SizeValueType x)
  {
    m_Rows[row] |= std::uint64_t{ 1 } << (x / m_TileLength);
  }

  bool
  HasRow(SizeValueType row) const
  {
    return m_Rows[row] != 0;
  }

  /** From the first voxel of a row to behind the last. */
  std::array<SizeValueType, 2>
  FindRange(SizeValueType row) const
  {
    std::array<SizeValueType, 2> range{ m_Size[0], 0 };
    this->ForEachRun(row, [&range](SizeValueType begin, SizeValueType end) {
      range = { std::min(range[0], begin), end };
    });
    return range;
  }

  /** Calls use(begin, end) for the runs of voxels of a row, ascending. */
  template <typename TUse>
  void
  ForEachRun(SizeValueType row, const TUse & use) const
  {
    const SizeValueType tiles = (m_Size[0] + m_TileLength - 1) / m_TileLength;
    for (SizeValueType tile = 0; tile < tiles; ++tile)
    {
      const SizeValueType first = tile;
      while (tile < tiles && (m_Rows[row] >> tile & 1) != 0)
      {
        ++tile;
      }
      if (tile > first)
      {
        use(first * m_TileLength, std::min(tile * m_TileLength, m_Size[0]));
      }
    }
  }

  /** The voxels within some distance of this band along each axis, and along x the rest of their tiles. */
  VoxelBand
  Widened(const SizeType & reach) const
  {
    VoxelBand wide(*this);
    for (SizeValueType n = 0; n < reach[0]; n += m_TileLength)
    {
      for (std::uint64_t & tiles : wide.m_Rows)
      {
        tiles |= tiles << 1 | tiles >> 1;
      }
    }
    wide.Widen(1, m_Size[1], reach[1]);
    wide.Widen(m_Size[1], m_Size[2], reach[2]);
    return wide;
  }

  /** The voxels of this band in the rows that pass a test. */
  template <typename TTest>
  VoxelBand
  Selected(const TTest & test) const
  {
    VoxelBand selected(*this);
    for (SizeValueType row = 0; row < m_Rows.size(); ++row)
    {
      selected.m_Rows[row] = test(row) ? m_Rows[row] : 0;
    }
    return selected;
  }

  /** The voxels of this band and of another one of the same size. */
  VoxelBand
  Common(const VoxelBand & other) const
  {
    VoxelBand common(*this);
    std::transform(m_Rows.begin(), m_Rows.end(), other.m_Rows.begin(), common.m_Rows.begin(), std::bit_and<>());
    return common;
  }

  /** The voxels of this band in the tiles that pass a test(row, begin, end). */
  template <typename TTest>
  VoxelBand
  SelectedTiles(const TTest & test) const
  {
    VoxelBand selected(m_Size);
    for (SizeValueType row = 0; row < m_Rows.size(); ++row)
    {
      this->ForEachRun(row, [&](SizeValueType begin, SizeValueType end) {
        for (SizeValueType x = begin; x < end; x += m_TileLength)
        {
          if (test(row, x, std::min(x + m_TileLength, end)))
          {
            selected.Mark(row, x);
          }
        }
      });
    }
    return selected;
  }

private:
  /** Widens along y or z: \a length rows, \a step numbers apart. */
  void
  Widen(SizeValueType step, SizeValueType length, SizeValueType reach)
  {
    reach = std::min(reach, length - 1);
    for (SizeValueType reached = 0; reached < reach;)
    {
      // Without a gap, also beside the ends of the image: each row is reached over rows between it and its origin.
      const SizeValueType further = std::min(reached + 1, reach - reached);
      const BulkVector<std::uint64_t> rows = m_Rows;
      for (SizeValueType first = 0; first < rows.size(); first += length * step)
      {
        for (SizeValueType row = first; row + further * step < first + length * step; ++row)
        {
          m_Rows[row] |= rows[row + further * step];
          m_Rows[row + further * step] |= rows[row];
        }
      }
      reached += further;
    }
  }

  SizeType m_Size;
  SizeValueType m_TileLength;
  BulkVector<std::uint64_t> m_Rows;
};

} // namespace itk

#endif
