#ifndef itkFCCClusterPlane_h
#define itkFCCClusterPlane_h

#include "itkFCCCrossingOwners.h"

namespace itk
{

/** \class FCCNumberedBits
 * \brief Rows of bits that count: the number of a set bit is that of the set bits before it.
 *
 * \ingroup FCCIsosurface
 */
class FCCNumberedBits
{
public:
  using WordType = FCCSigns::WordType;

  FCCNumberedBits(SizeValueType rows, SizeValueType words)
    : m_Stride(words + 1)
    , m_Bits(rows * m_Stride)
    , m_Before(m_Bits.size())
  {}

  /** The words of a row, with a spare one that must stay zero. */
  WordType *
  GetRow(SizeValueType row)
  {
    return m_Bits.data() + row * m_Stride;
  }
  const WordType *
  GetRow(SizeValueType row) const
  {
    return m_Bits.data() + row * m_Stride;
  }
  const std::uint32_t *
  GetBefore(SizeValueType row) const
  {
    return m_Before.data() + row * m_Stride;
  }

  /** Numbers the bits from \a first on; returns the number after the last. */
  std::uint32_t
  Number(std::uint32_t first);

  void
  Clear();

  std::uint32_t
  GetNumber(SizeValueType row, SizeValueType i) const
  {
    const SizeValueType word = row * m_Stride + i / FCCSigns::WordBits;
    const WordType below = m_Bits[word] & ((WordType{ 1 } << (i % FCCSigns::WordBits)) - 1);
    return m_Before[word] + static_cast<std::uint32_t>(__builtin_popcountll(below));
  }

private:
  SizeValueType m_Stride;
  std::vector<WordType> m_Bits;
  std::vector<std::uint32_t> m_Before;
};

/** \class FCCClusterPlane
 * \brief The vertices of one plane: sites that gather the crossings they own, and crossings that stay single.
 *
 * A site that owns crossings is a *cluster*: they all become one vertex. Where that would not leave the surface a
 * manifold the site is *split*, and the crossings it owns are single.
 *
 * Vertices of a plane are numbered clusters first, row by row, then single crossings by the row and type of their edge.
 *
 * Thread safety: each thread uses its own.
 *
 * \ingroup FCCIsosurface
 */
class FCCClusterPlane
{
public:
  using WordType = FCCSigns::WordType;
  static constexpr std::uint8_t Types = FCCCrossingOwners::Types;

  /** The edges at a site: FCCLattice::OwnedEdges, which it stores, and their opposites, which its neighbours do. */
  static constexpr unsigned int Directions = 2 * Types;

  explicit FCCClusterPlane(const FCCSigns & signs);

  /** Finds owners and clusters of plane \a k from its values and the plane below it, which must have been found last;
   * \a below is not looked at for plane 0. With \a split, those sites are split, and vertices are numbered from
   * \a first on; returns the number after the last. */
  std::uint32_t
  Find(SizeValueType k,
       const FCCClusterPlane & below,
       const FCCFieldPlanes & field,
       bool insideIsBelow,
       const FCCSigns * split,
       std::uint32_t first);

  const FCCCrossingOwners &
  GetOwners() const
  {
    return m_Owners;
  }

  /** One row of bits for each row of sites: it is a cluster, not split. */
  const FCCNumberedBits &
  GetClusters() const
  {
    return m_Clusters;
  }

  /** One row of bits for each row and type of edges, the type running fastest: its crossing is single. */
  const FCCNumberedBits &
  GetSingles() const
  {
    return m_Singles;
  }

  /** Bit n of the result: the site owns the crossing of its edge in direction n. */
  unsigned int
  GetOwned(SizeValueType j, SizeValueType i) const;

  /** The words that GetOwned() takes its bits from: one row for each row of sites and direction. */
  const WordType *
  GetOwnedRow(SizeValueType j, unsigned int direction) const
  {
    return m_Owned.data() + (j * Directions + direction) * m_Owners.GetStride();
  }

private:
  void
  FindOwned(SizeValueType j, SizeValueType k, const FCCClusterPlane & below);

  void
  FindSingles(SizeValueType j, SizeValueType k, const FCCSigns & split);

  const FCCSigns * m_Signs;
  FCCCrossingOwners m_Owners;
  std::vector<WordType> m_Owned;
  FCCNumberedBits m_Clusters;
  FCCNumberedBits m_Singles;
};

} // namespace itk

#endif
