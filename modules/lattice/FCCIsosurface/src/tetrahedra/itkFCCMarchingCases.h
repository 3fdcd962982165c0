#ifndef itkFCCMarchingCases_h
#define itkFCCMarchingCases_h

#include "itkFCCCells.h"

#include <cstdint>

namespace itk
{

/** \class FCCTetrahedronPolygon
 * \brief The surface in one tetrahedron of sites: a triangle, a quadrilateral, or nothing.
 *
 * Its corners are the crossings on the edges between sites inside and outside, counter-clockwise seen from outside when
 * the lattice's axes are right-handed.
 */
struct FCCTetrahedronPolygon
{
  /** The sites of the tetrahedron, 0 to 3, at the ends of a crossing's edge. */
  struct Crossing
  {
    std::uint8_t inside = 0;
    std::uint8_t outside = 0;
  };

  std::uint8_t size = 0;
  Crossing crossings[4] = {};
  std::uint8_t decider = 0; ///< index of the crossing between the lowest site inside and the lowest site outside

  /** The polygon with its first corner where a mesh with moved crossings cuts a quadrilateral into two triangles: from
   * the decider to the opposite corner when the decider's nearer end is inside, else along the other diagonal. All that
   * cut quadrilaterals at moved crossings use this rule. */
  constexpr unsigned int
  FindFirstCorner(bool isDeciderNearerToInside) const
  {
    return size == 4 ? (decider + (isDeciderNearerToInside ? 0u : 1u)) % 2 : 0;
  }

  /** \param pattern bit s: site s is inside */
  static constexpr FCCTetrahedronPolygon
  Of(const FCCLattice::SiteType (&sites)[4], unsigned int pattern)
  {
    std::uint8_t ordered[4] = {}; // the sites inside first
    unsigned int inside = 0;
    for (unsigned int pass = 0, place = 0; pass < 2; ++pass)
    {
      for (std::uint8_t site = 0; site < 4; ++site)
      {
        const bool isInside = (pattern >> site & 1) != 0;
        if (isInside == (pass == 0))
        {
          ordered[place++] = site;
          inside += isInside ? 1 : 0;
        }
      }
    }
    // With this order positive, the corners below run counter-clockwise around the way from inside to outside.
    if (FCCStep::Orientation(sites[ordered[0]], sites[ordered[1]], sites[ordered[2]], sites[ordered[3]]) < 0)
    {
      const unsigned int first = inside == 1 ? 2 : 0; // two on the same side of the surface
      const std::uint8_t swapped = ordered[first];
      ordered[first] = ordered[first + 1];
      ordered[first + 1] = swapped;
    }
    const std::uint8_t a = ordered[0];
    const std::uint8_t b = ordered[1];
    const std::uint8_t c = ordered[2];
    const std::uint8_t d = ordered[3];
    switch (inside)
    {
      case 1:
        return WithDecider({ 3, { { a, b }, { a, c }, { a, d } } }, sites);
      case 2:
        return WithDecider({ 4, { { a, c }, { a, d }, { b, d }, { b, c } } }, sites);
      case 3:
        return WithDecider({ 3, { { a, d }, { b, d }, { c, d } } }, sites);
      default:
        return {};
    }
  }

private:
  static constexpr FCCTetrahedronPolygon
  WithDecider(FCCTetrahedronPolygon polygon, const FCCLattice::SiteType (&sites)[4])
  {
    for (std::uint8_t n = 1; n < polygon.size; ++n)
    {
      const Crossing & lowest = polygon.crossings[polygon.decider];
      const Crossing & crossing = polygon.crossings[n];
      if (!FCCStep::IsLower(sites[lowest.inside], sites[crossing.inside]) &&
          !FCCStep::IsLower(sites[lowest.outside], sites[crossing.outside]))
      {
        polygon.decider = n;
      }
    }
    return polygon;
  }
};

/** \class FCCMarchingCases
 * \brief The triangles of one step of the column march, for every pattern of inside and outside.
 *
 * A *column* is the square prism between the rows A (j, k), B (j+1, k), C (j, k+1) and D (j+1, k+1). Rows A and D have
 * one parity, B and C the other, so along x the column's sites come in alternating *pairs* AD, BC, AD, BC ... one
 * lattice unit apart. Every tetrahedron of the six-tetrahedra decomposition that touches the prism lies in it, and
 * spans two or three consecutive pairs. A *step* is the tetrahedra that start at one pair; with the pair's rows called
 * first and second:
 *
 *   sites  0, 1  first and second row of this pair
 *          2, 3  first and second row of the next pair, of the other kind
 *          4, 5  first and second row of the pair after that, of this kind again
 *   tetrahedra  {0 1 2 3}  the regular tetrahedron between this pair and the next
 *               {0 4 2 3}  the quarter of an octahedron about its diagonal 0-4
 *               {1 5 2 3}  the quarter of another octahedron about its diagonal 1-5
 *
 * There are two *kinds* of step: kind 0 starts at a pair AD, kind 1 at a pair BC. A *case* is a number of six bits; bit
 * s is set when site s is inside. Triangles are given by the edges of the tetrahedra on which their corners lie, and
 * are counter-clockwise seen from outside when the lattice's axes are right-handed.
 *
 * The tables are derived here at compile time, from the sites' coordinates alone.
 */
struct FCCMarchingCases
{
  static constexpr unsigned int Kinds = 2;
  static constexpr unsigned int Sites = 6;
  static constexpr unsigned int Cases = 64;
  static constexpr unsigned int Edges = 12;
  static constexpr unsigned int Tetrahedra = 3;

  /** Rows of the column: bit 0 is one step in y, bit 1 one step in z. */
  enum Row : std::uint8_t
  {
    A = 0,
    B = 1,
    C = 2,
    D = 3
  };

  /** The rows of a pair, first and second, for the kind of step that starts at it. */
  static constexpr Row PairRows[Kinds][2] = { { A, D }, { B, C } };

  static constexpr std::uint8_t TetrahedronSites[Tetrahedra][4] = { { 0, 1, 2, 3 }, { 0, 4, 2, 3 }, { 1, 5, 2, 3 } };

  /** The two sites of each edge. Edges between sites 4 and 5, or among later sites, belong to later steps. */
  static constexpr std::uint8_t EdgeSites[Edges][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 },
                                                        { 0, 4 }, { 1, 5 }, { 2, 4 }, { 3, 4 }, { 2, 5 }, { 3, 5 } };

  struct Case
  {
    std::uint8_t triangles = 0;        ///< number for all three tetrahedra
    std::uint8_t regularTriangles = 0; ///< number for the regular tetrahedron, which come first
    std::uint8_t edges[6][3] = {};     ///< the edges of each triangle's corners
  };

  /** Where an edge is stored: by one of EdgeSites, in a row and as a type of FCCLattice::OwnedEdges. */
  struct StoredEdge
  {
    std::uint8_t start = 0; ///< which of EdgeSites stores it
    Row row = A;
    std::uint8_t type = 0;
    std::uint8_t pair = 0; ///< 0: this pair, 1: the next pair, 2: the pair after
  };

  /** Row of a site of a step. */
  static constexpr Row
  RowOf(unsigned int kind, unsigned int site)
  {
    const unsigned int pair = site / 2;
    return PairRows[pair == 1 ? 1 - kind : kind][site % 2];
  }

  /** Lattice coordinates of a site of a step, from the first pair's x and row A. */
  static constexpr FCCLattice::SiteType
  SiteOf(unsigned int kind, unsigned int site)
  {
    const Row row = RowOf(kind, site);
    return { static_cast<IndexValueType>(site / 2), row & 1, row >> 1 };
  }

  static constexpr StoredEdge
  FindStoredEdge(unsigned int kind, unsigned int edge)
  {
    for (std::uint8_t start = 0; start < 2; ++start)
    {
      const unsigned int site = EdgeSites[edge][start];
      const auto step = FCCStep::Subtract(SiteOf(kind, EdgeSites[edge][1 - start]), SiteOf(kind, site));
      const unsigned int type = FCCCells::DirectionOf(step);
      if (type < FCCCells::Edges)
      {
        return { start, RowOf(kind, site), static_cast<std::uint8_t>(type), static_cast<std::uint8_t>(site / 2) };
      }
    }
    return {};
  }

  static constexpr std::uint8_t
  EdgeBetween(unsigned int a, unsigned int b)
  {
    std::uint8_t edge = 0;
    while (
      !((EdgeSites[edge][0] == a && EdgeSites[edge][1] == b) || (EdgeSites[edge][0] == b && EdgeSites[edge][1] == a)))
    {
      ++edge;
    }
    return edge;
  }

  /** Which of EdgeSites a site is. */
  static constexpr unsigned int
  EndOf(unsigned int edge, unsigned int site)
  {
    return EdgeSites[edge][0] == site ? 0 : 1;
  }

  /** Six times the signed volume of the tetrahedron of four sites. */
  static constexpr IndexValueType
  Orientation(unsigned int kind, unsigned int a, unsigned int b, unsigned int c, unsigned int d)
  {
    return FCCStep::Orientation(SiteOf(kind, a), SiteOf(kind, b), SiteOf(kind, c), SiteOf(kind, d));
  }

  /** The polygon in a tetrahedron. \param pattern bit n: the n-th of its TetrahedronSites is inside */
  static constexpr FCCTetrahedronPolygon
  PolygonOf(unsigned int kind, unsigned int tetrahedron, unsigned int pattern)
  {
    const auto & sites = TetrahedronSites[tetrahedron];
    return FCCTetrahedronPolygon::Of(
      { SiteOf(kind, sites[0]), SiteOf(kind, sites[1]), SiteOf(kind, sites[2]), SiteOf(kind, sites[3]) }, pattern);
  }

  /** The edge of a tetrahedron's crossing. */
  static constexpr std::uint8_t
  EdgeOf(unsigned int tetrahedron, const FCCTetrahedronPolygon::Crossing & crossing)
  {
    const auto & sites = TetrahedronSites[tetrahedron];
    return EdgeBetween(sites[crossing.inside], sites[crossing.outside]);
  }

  /** Adds the triangles of one tetrahedron, which are a fan about the polygon's first corner. */
  static constexpr void
  AddTetrahedron(Case & result, unsigned int kind, unsigned int pattern, unsigned int tetrahedron)
  {
    unsigned int inside = 0;
    for (unsigned int n = 0; n < 4; ++n)
    {
      inside |= (pattern >> TetrahedronSites[tetrahedron][n] & 1) << n;
    }
    const FCCTetrahedronPolygon polygon = PolygonOf(kind, tetrahedron, inside);
    for (unsigned int n = 2; n < polygon.size; ++n)
    {
      auto & triangle = result.edges[result.triangles++];
      triangle[0] = EdgeOf(tetrahedron, polygon.crossings[0]);
      triangle[1] = EdgeOf(tetrahedron, polygon.crossings[n - 1]);
      triangle[2] = EdgeOf(tetrahedron, polygon.crossings[n]);
    }
  }

  static constexpr Case
  MakeCase(unsigned int kind, unsigned int pattern)
  {
    Case result;
    for (unsigned int tetrahedron = 0; tetrahedron < Tetrahedra; ++tetrahedron)
    {
      AddTetrahedron(result, kind, pattern, tetrahedron);
      if (tetrahedron == 0)
      {
        result.regularTriangles = result.triangles;
      }
    }
    return result;
  }

  struct Tables
  {
    Case cases[Kinds][Cases] = {};
    StoredEdge storedEdges[Kinds][Edges] = {};
  };

  static constexpr Tables
  MakeTables()
  {
    Tables tables;
    for (unsigned int kind = 0; kind < Kinds; ++kind)
    {
      for (unsigned int pattern = 0; pattern < Cases; ++pattern)
      {
        tables.cases[kind][pattern] = MakeCase(kind, pattern);
      }
      for (unsigned int edge = 0; edge < Edges; ++edge)
      {
        tables.storedEdges[kind][edge] = FindStoredEdge(kind, edge);
      }
    }
    return tables;
  }
};

inline constexpr FCCMarchingCases::Tables FCCMarchingTables = FCCMarchingCases::MakeTables();

} // namespace itk

#endif
