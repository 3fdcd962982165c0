#ifndef itkFCCSiteStar_h
#define itkFCCSiteStar_h

#include "itkFCCCutEdges.h"
#include "itkFCCTetrahedronPolygon.h"

#include <array>
#include <bitset>

namespace itk
{

/** \class FCCSiteStar
 * \brief The edges and tetrahedra at a site, which are the same for all sites, and what sets of crossings look like.
 *
 * *Directions* 0 to 6 are the steps of FCCLattice::OwnedEdges, along edges that the site stores; 7 to 13 are their
 * opposites, along edges that its neighbours store. A set of directions is bits. The crossings of two edges of the site
 * are *adjacent* when the edges' far ends are neighbours: then a side of the surface's polygons joins them.
 *
 * The *sites* of the star are the neighbours, numbered by their direction, and the center.
 */
class FCCSiteStar
{
public:
  using SiteType = FCCLattice::SiteType;

  static constexpr unsigned int StoredDirections = FCCStoredEdges::NumberOfTypes;
  static constexpr unsigned int Directions = 2 * StoredDirections;
  static constexpr unsigned int NoDirection = Directions;
  static constexpr unsigned int Center = Directions;
  static constexpr unsigned int Sites = Directions + 1;
  static constexpr unsigned int Edges = Directions + 36; ///< edges at the center, and edges between neighbours
  static constexpr unsigned int Tetrahedra = 24;

  static constexpr SiteType
  StepOf(unsigned int direction)
  {
    const auto & step = FCCLattice::OwnedEdges[direction % StoredDirections];
    const IndexValueType sign = direction < StoredDirections ? 1 : -1;
    return { sign * step[0], sign * step[1], sign * step[2] };
  }

  /** The step from the center to a site. */
  static constexpr SiteType
  StepTo(unsigned int site)
  {
    return site == Center ? SiteType{ 0, 0, 0 } : StepOf(site);
  }

  /** NoDirection for a step that is none. */
  static constexpr unsigned int
  DirectionOf(const SiteType & step)
  {
    unsigned int direction = 0;
    while (direction < Directions && !FCCStep::AreEqual(StepOf(direction), step))
    {
      ++direction;
    }
    return direction;
  }

  static constexpr unsigned int
  OppositeOf(unsigned int direction)
  {
    return (direction + StoredDirections) % Directions;
  }

  /** An edge between two sites. */
  struct Edge
  {
    std::uint8_t ends[2];       ///< the site that stores it first
    std::uint8_t directions[2]; ///< from either end to the other
  };

  struct Tetrahedron
  {
    std::uint8_t sites[4];              ///< the center first
    unsigned int far;                   ///< the directions of the others
    FCCTetrahedronPolygon polygons[16]; ///< by the sites inside
    bool isBelow;                       ///< whether it lies below the plane of the center
    std::uint8_t edges[16][4];          ///< the indices in GetEdges() of the edges of the polygons' crossings
  };

  static const FCCSiteStar &
  Get();

  const std::array<Edge, Edges> &
  GetEdges() const
  {
    return m_Edges;
  }
  const std::array<Tetrahedron, Tetrahedra> &
  GetTetrahedra() const
  {
    return m_Tetrahedra;
  }

  /** The edges that are cut when some sites are inside, both as bits. */
  std::uint64_t
  GetCutEdges(unsigned int inside) const
  {
    std::uint64_t cut = 0;
    for (; inside != 0; inside &= inside - 1)
    {
      cut ^= m_EdgesAt[static_cast<unsigned int>(__builtin_ctz(inside))];
    }
    return cut;
  }

  /** Whether the crossings of a set of directions form a disk with the sides and triangles between them: they are
   * connected, and points - sides + triangles = 1. */
  bool
  IsDisk(unsigned int set) const
  {
    return m_IsDisk[set];
  }

  /** The directions of a set that are connected with one of them by adjacent crossings. */
  unsigned int
  PartOf(unsigned int set, unsigned int direction) const;

private:
  FCCSiteStar();

  void
  FindEdges();

  void
  FindTetrahedra();

  void
  FindDisks();

  std::array<Edge, Edges> m_Edges;
  std::array<std::array<std::uint8_t, Sites>, Sites> m_EdgeBetween{};
  std::array<std::uint64_t, Sites> m_EdgesAt{}; ///< bits of the edges at a site
  std::array<Tetrahedron, Tetrahedra> m_Tetrahedra;
  std::array<unsigned int, Directions> m_Adjacent{};
  std::bitset<1U << Directions> m_IsDisk;
};

} // namespace itk

#endif
