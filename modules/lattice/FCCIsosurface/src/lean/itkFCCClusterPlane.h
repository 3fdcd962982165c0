#ifndef itkFCCClusterPlane_h
#define itkFCCClusterPlane_h

#include "itkFCCNearerEnds.h"
#include "itkFCCSiteParts.h"

namespace itk
{

/** \class FCCClusterPlane
 * \brief The vertices of one plane, by the sites that gather their crossings.
 *
 * A site gathers the crossings that it is nearer to: all crossings of a *whole* site make one vertex, the crossings of
 * a *split* site (see FCCSplitSites) make several. Vertices are numbered first by the whole sites, row by row, then by
 * the split sites, row by row, and their parts.
 */
class FCCClusterPlane
{
public:
  using WordType = FCCSigns::WordType;
  static constexpr std::uint8_t Types = FCCNearerEnds::Types;
  static constexpr unsigned int Directions = FCCCells::Directions;

  FCCClusterPlane(const FCCSigns & signs, std::pmr::memory_resource * scratch);

  /** Finds the vertices of plane \a k from its nearer ends and the plane below it, which must have been found last;
   * \a below is not looked at for plane 0. Vertices are numbered from \a first on; returns the number after the last.
   * Without \a splits all sites are whole, and no vertex is numbered. */
  std::uint32_t
  Find(SizeValueType k, const FCCClusterPlane & below, const FCCSplitRows * splits, std::uint32_t first);

  /** To be found before the vertices. */
  FCCNearerEnds &
  GetNearerEnds()
  {
    return m_NearerEnds;
  }
  const FCCNearerEnds &
  GetNearerEnds() const
  {
    return m_NearerEnds;
  }

  /** One row of bits for each row of sites: the site is whole and has crossings. */
  const FCCNumberedBits &
  GetWholeSites() const
  {
    return m_WholeSites;
  }

  struct SplitSite
  {
    std::uint32_t i;
    std::uint32_t j;
    FCCSiteParts parts;
    std::uint32_t firstVertex;
  };
  const std::vector<SplitSite> &
  GetSplitSites() const
  {
    return m_SplitSites;
  }

  /** The split sites of a row. */
  struct SplitRow
  {
    FCCNumberedBits::Row numbers;
    const SplitSite * sites;

    /** The vertex of a site's crossing in a direction. */
    [[gnu::always_inline]] std::uint32_t
    GetVertex(SizeValueType i, unsigned int direction) const
    {
      const SplitSite & site = sites[numbers.GetNumber(i)];
      return site.firstVertex + site.parts.GetVertex(direction);
    }
  };
  SplitRow
  GetSplitRow(SizeValueType j) const
  {
    return { m_Split.GetNumberedRow(j), m_SplitSites.data() };
  }

  /** Bit i: the crossing on the edge of this type that site i stores belongs to a split site. */
  const WordType *
  GetSplitCrossings(SizeValueType j, std::uint8_t type) const
  {
    return m_SplitCrossings.GetRow(j * Types + type);
  }

  /** Calls use(i, directions of the crossings that the site is nearer to) for the whole sites of a row. */
  template <typename TUse>
  void
  ForEachWholeSite(SizeValueType j, const TUse & use) const
  {
    const WordType * const crossings = m_Crossings.GetRow(j * Directions);
    const SizeValueType stride = m_Crossings.GetStride();
    for (SizeValueType word = 0; word < m_Signs->GetNumberOfWords(); ++word)
    {
      FCCBits::ForEach(m_WholeSites.GetRow(j)[word], 0, [&](SizeValueType bit) {
        unsigned int directions = 0;
        for (unsigned int direction = 0; direction < Directions; ++direction)
        {
          directions |= static_cast<unsigned int>(crossings[direction * stride + word] >> bit & 1) << direction;
        }
        use(word * FCCBits::WordBits + bit, directions);
      });
    }
  }

private:
  void
  FindCrossings(SizeValueType j, SizeValueType k, const FCCClusterPlane & below);

  void
  FindSplitCrossings(SizeValueType j, SizeValueType k, const FCCSplitRows & splits);

  std::uint32_t
  NumberSplitSites(SizeValueType k, const FCCSplitRows & splits, std::uint32_t first);

  const FCCSigns * m_Signs;
  FCCNearerEnds m_NearerEnds;
  FCCBitRows m_Crossings; ///< for each row of sites, one row for each direction
  FCCBitRows m_SplitCrossings;
  FCCNumberedBits m_WholeSites;
  FCCNumberedBits m_Split;
  std::vector<SplitSite> m_SplitSites;
};

} // namespace itk

#endif
