#ifndef itkFCCClusterPlane_h
#define itkFCCClusterPlane_h

#include "itkFCCCrossingOwners.h"
#include "itkFCCSplitSites.h"

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

  FCCNumberedBits(SizeValueType rows, SizeValueType words, std::pmr::memory_resource * scratch)
    : m_Stride(words + 1)
    , m_Bits(rows * m_Stride, scratch)
    , m_Before(m_Bits.size(), scratch)
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

  SizeValueType
  Count() const;

  /** Calls use(row, i) for each set bit, row by row. */
  template <typename TUse>
  void
  ForEach(const TUse & use) const
  {
    for (SizeValueType place = 0; place < m_Bits.size(); ++place)
    {
      for (WordType mask = m_Bits[place]; mask != 0; mask &= mask - 1)
      {
        use(place / m_Stride,
            place % m_Stride * FCCSigns::WordBits + static_cast<SizeValueType>(__builtin_ctzll(mask)));
      }
    }
  }

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
  std::pmr::vector<WordType> m_Bits;
  std::pmr::vector<std::uint32_t> m_Before;
};

/** \class FCCClusterPlane
 * \brief The vertices of one plane, by the sites that own the crossings they are made of.
 *
 * All crossings of a site make one vertex; those of a split site (see FCCSplitSites) make several. Vertices are
 * numbered site by site: first those of the sites that are whole, row by row, then those of the split ones, row by row
 * and by the lowest direction of their crossings.
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
  static constexpr unsigned int Directions = FCCSiteStar::Directions;

  FCCClusterPlane(const FCCSigns & signs, std::pmr::memory_resource * scratch);

  /** Finds owners and vertices of plane \a k from its values and the plane below it, which must have been found last;
   * \a below is not looked at for plane 0. Vertices are numbered from \a first on; returns the number after the last.
   * Without \a splits all sites are whole, and no vertex is numbered. */
  std::uint32_t
  Find(SizeValueType k,
       const FCCClusterPlane & below,
       const FCCFieldPlanes & field,
       bool insideIsBelow,
       const FCCSplitSites * splits,
       std::uint32_t first);

  const FCCCrossingOwners &
  GetOwners() const
  {
    return m_Owners;
  }

  /** One row of bits for each row of sites: it owns crossings and is whole. */
  const FCCNumberedBits &
  GetWholes() const
  {
    return m_Wholes;
  }

  /** A split site. */
  struct Parts
  {
    SizeValueType i;
    SizeValueType j;
    unsigned int owned;  ///< directions of the crossings it owns
    unsigned int lone;   ///< those that are vertices by themselves; the others gather in connected parts
    unsigned int lowest; ///< the lowest direction of each vertex
    std::uint32_t first; ///< number of the first vertex
    std::uint64_t place; ///< four bits a direction: which of the site's vertices its crossing belongs to
  };
  const std::vector<Parts> &
  GetParts() const
  {
    return m_Parts;
  }

  /** The vertex of a split site's crossing in a direction. */
  std::uint32_t
  GetVertex(SizeValueType j, SizeValueType i, unsigned int direction) const
  {
    const Parts & parts = m_Parts[m_Split.GetNumber(j, i)];
    return parts.first + static_cast<std::uint32_t>(parts.place >> (4 * direction) & 15);
  }

  /** Bits of the edges that a row stores: the owner of the crossing is split. */
  const WordType *
  GetSplitRow(SizeValueType j, std::uint8_t type) const
  {
    return m_SplitCrossings.data() + (j * Types + type) * m_Owners.GetStride();
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
  FindSplitCrossings(SizeValueType j, SizeValueType k, const FCCSplitSites & splits);

  std::uint32_t
  NumberParts(SizeValueType k, const FCCSplitSites & splits, std::uint32_t first);

  const FCCSigns * m_Signs;
  FCCCrossingOwners m_Owners;
  std::pmr::vector<WordType> m_Owned;
  std::pmr::vector<WordType> m_SplitCrossings;
  FCCNumberedBits m_Wholes;
  FCCNumberedBits m_Split;
  std::vector<Parts> m_Parts;
};

} // namespace itk

#endif
