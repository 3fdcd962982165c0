#ifndef itkFCCSiteStar_h
#define itkFCCSiteStar_h

#include "itkFCCMarchingCases.h"

namespace itk
{

/** \class FCCSiteStar
 * \brief The edges and tetrahedra around a site, which are the same for all sites, and the surface in the tetrahedra.
 *
 * The *sites* of the star are the neighbours, numbered by their directions (see FCCCells), and the *center*. Sets of
 * sites and of edges are bits.
 */
struct FCCSiteStar
{
  static constexpr unsigned int Center = FCCCells::Directions;
  static constexpr unsigned int Sites = FCCCells::Directions + 1;
  static constexpr unsigned int Edges = FCCCells::Directions + 36; ///< at the center, and of its link
  static constexpr unsigned int Tetrahedra = 24;

  /** The step from the center to a site. */
  static constexpr FCCLattice::SiteType
  StepTo(unsigned int site)
  {
    return site == Center ? FCCLattice::SiteType{ 0, 0, 0 } : FCCCells::StepOf(site);
  }

  /** An edge between two sites. */
  struct Edge
  {
    std::uint8_t ends[2] = {};       ///< the site that stores it first
    std::uint8_t directions[2] = {}; ///< from either end to the other
  };

  struct Tetrahedron
  {
    std::uint8_t sites[4] = {};              ///< the center first
    unsigned int far = 0;                    ///< the other sites, as bits
    FCCTetrahedronPolygon polygons[16] = {}; ///< by the sites inside
    bool isBelow = false;                    ///< whether it lies below the plane of the center
    std::uint8_t edges[16][4] = {};          ///< the edges of the polygons' crossings
  };

  /** The surface in the star of a certain site. */
  struct Pattern
  {
    std::uint16_t inside; ///< the sites inside
    std::uint64_t starts; ///< the edges with a crossing that is nearer to their first end; of cut edges only
  };

  Edge edges[Edges] = {};
  std::uint64_t edgesAt[Sites] = {}; ///< the edges at each site
  Tetrahedron tetrahedra[Tetrahedra] = {};

  /** The edges that are cut when some sites are inside. */
  std::uint64_t
  GetCutEdges(unsigned int inside) const
  {
    std::uint64_t cut = 0;
    for (; inside != 0; inside &= inside - 1)
    {
      cut ^= edgesAt[static_cast<unsigned int>(__builtin_ctz(inside))];
    }
    return cut;
  }

  static constexpr FCCSiteStar
  Make()
  {
    FCCSiteStar star;
    star.FindEdges();
    unsigned int count = 0;
    for (unsigned int type = FCCCells::FirstTetrahedron; type < FCCCells::Types; ++type)
    {
      for (unsigned int center = 0; center < 4; ++center)
      {
        star.FindTetrahedron(FCCCells::Simplices[type], center, star.tetrahedra[count++]);
      }
    }
    return star;
  }

private:
  constexpr void
  FindEdges()
  {
    unsigned int count = 0;
    for (std::uint8_t a = 0; a < Sites; ++a)
    {
      for (std::uint8_t b = 0; b < Sites; ++b)
      {
        const auto direction =
          static_cast<std::uint8_t>(FCCCells::DirectionOf(FCCStep::Subtract(StepTo(b), StepTo(a))));
        if (direction < FCCCells::Edges) // a stores it
        {
          edgesAt[a] |= std::uint64_t{ 1 } << count;
          edgesAt[b] |= std::uint64_t{ 1 } << count;
          edges[count++] = { { a, b }, { direction, static_cast<std::uint8_t>(FCCCells::OppositeOf(direction)) } };
        }
      }
    }
  }

  /** The tetrahedron of a type with one of its sites at the center. */
  constexpr void
  FindTetrahedron(const FCCCells::Simplex & type, unsigned int center, Tetrahedron & tetrahedron) const
  {
    tetrahedron.sites[0] = Center;
    for (unsigned int n = 0, size = 1; n < 4; ++n)
    {
      const auto step = FCCStep::Subtract(type.steps[n], type.steps[center]);
      if (n != center)
      {
        tetrahedron.sites[size++] = static_cast<std::uint8_t>(FCCCells::DirectionOf(step));
        tetrahedron.far |= 1u << FCCCells::DirectionOf(step);
      }
      tetrahedron.isBelow = tetrahedron.isBelow || step[2] < 0;
    }
    const auto & sites = tetrahedron.sites;
    for (unsigned int pattern = 0; pattern < 16; ++pattern)
    {
      FCCTetrahedronPolygon & polygon = tetrahedron.polygons[pattern];
      polygon =
        FCCTetrahedronPolygon::Of({ StepTo(sites[0]), StepTo(sites[1]), StepTo(sites[2]), StepTo(sites[3]) }, pattern);
      for (unsigned int n = 0; n < polygon.size; ++n)
      {
        const std::uint64_t joining =
          edgesAt[sites[polygon.crossings[n].inside]] & edgesAt[sites[polygon.crossings[n].outside]];
        tetrahedron.edges[pattern][n] = static_cast<std::uint8_t>(__builtin_ctzll(joining));
      }
    }
  }
};

inline constexpr FCCSiteStar FCCStarOfSite = FCCSiteStar::Make();

} // namespace itk

#endif
