#ifndef itkFCCMarchingCases_h
#define itkFCCMarchingCases_h

#include "itkFCCLattice.h"

#include <cstdint>

namespace itk
{

/** \class FCCMarchingCases
 * \brief The triangles of one step of the column march, for every pattern of inside and outside.
 *
 * A *column* is the square prism between the rows A (j, k), B (j+1, k), C (j, k+1) and D (j+1, k+1). Rows A and D have
 * one parity, B and C the other, so along x the column's sites come in alternating *pairs* AD, BC, AD, BC ... one
 * lattice unit apart. Every tetrahedron of the six-tetrahedra decomposition that touches the prism lies in it, and
 * spans two or three consecutive pairs. A *step* is what starts at one pair; with the pair's rows called first and
 * second:
 *
 *   sites  0, 1  first and second row of this pair
 *          2, 3  first and second row of the next pair, of the other kind
 *          4, 5  first and second row of the pair after that, of this kind again
 *   tetrahedra  {0 1 2 3}  the regular one between this pair and the next
 *               {0 4 2 3}  the quarter of an octahedron about its diagonal 0-4
 *               {1 5 2 3}  the quarter of another octahedron about its diagonal 1-5
 *
 * There are two *kinds* of step: kind 0 starts at a pair AD, kind 1 at a pair BC. A *case* is a number of six bits; bit
 * s is set when site s is inside. Triangles are given by the edges of the tetrahedra on which their corners lie, and
 * are counter-clockwise seen from outside when the lattice's axes are right-handed.
 *
 * The tables are derived here at compile time, from the sites' coordinates alone.
 *
 * \ingroup FCCIsosurface
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

  /** The two sites of each edge. Edges between sites 4 and 5, or among later ones, belong to later steps. */
  static constexpr std::uint8_t EdgeSites[Edges][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 },
                                                        { 0, 4 }, { 1, 5 }, { 2, 4 }, { 3, 4 }, { 2, 5 }, { 3, 5 } };

  struct Case
  {
    std::uint8_t triangles = 0;        ///< of all three tetrahedra
    std::uint8_t regularTriangles = 0; ///< of the regular tetrahedron, which come first
    std::uint8_t edges[6][3] = {};     ///< the edges of each triangle's corners
  };

  /** Where an edge is stored: its owner's row, which of FCCLattice::OwnedEdges it is, and the pair of its owner. */
  struct EdgeOwner
  {
    Row row = A;
    std::uint8_t type = 0;
    std::uint8_t pair = 0; ///< 0: this pair, 1: the next, 2: the one after
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

  static constexpr EdgeOwner
  OwnerOf(unsigned int kind, unsigned int edge)
  {
    for (unsigned int end = 0; end < 2; ++end)
    {
      const unsigned int owner = EdgeSites[edge][end];
      const unsigned int other = EdgeSites[edge][1 - end];
      for (std::uint8_t type = 0; type < FCCLattice::OwnedEdges.size(); ++type)
      {
        bool matches = true;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          matches =
            matches && SiteOf(kind, other)[axis] - SiteOf(kind, owner)[axis] == FCCLattice::OwnedEdges[type][axis];
        }
        if (matches)
        {
          return { RowOf(kind, owner), type, static_cast<std::uint8_t>(owner / 2) };
        }
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

  /** Six times the signed volume of the tetrahedron of four sites. */
  static constexpr IndexValueType
  Orientation(unsigned int kind, unsigned int a, unsigned int b, unsigned int c, unsigned int d)
  {
    IndexValueType v[3][3] = {};
    const unsigned int ends[3] = { b, c, d };
    for (unsigned int row = 0; row < 3; ++row)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        v[row][axis] = SiteOf(kind, ends[row])[axis] - SiteOf(kind, a)[axis];
      }
    }
    return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) - v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  }

  static constexpr void
  AddTriangle(Case & result, std::uint8_t a, std::uint8_t b, std::uint8_t c)
  {
    result.edges[result.triangles][0] = a;
    result.edges[result.triangles][1] = b;
    result.edges[result.triangles][2] = c;
    ++result.triangles;
  }

  /** Adds the triangles of one tetrahedron. Its sites are put in order, those inside first; then the surface leaves
   * through a triangle, or through a quadrilateral that is cut in two. */
  static constexpr void
  AddTetrahedron(Case & result, unsigned int kind, unsigned int pattern, const std::uint8_t (&sites)[4])
  {
    unsigned int ordered[4] = {};
    unsigned int inside = 0;
    for (unsigned int pass = 0, place = 0; pass < 2; ++pass)
    {
      for (const std::uint8_t site : sites)
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
    if (Orientation(kind, ordered[0], ordered[1], ordered[2], ordered[3]) < 0)
    {
      const unsigned int first = inside == 1 ? 2 : 0; // two on the same side of the surface
      const unsigned int swapped = ordered[first];
      ordered[first] = ordered[first + 1];
      ordered[first + 1] = swapped;
    }
    const unsigned int a = ordered[0];
    const unsigned int b = ordered[1];
    const unsigned int c = ordered[2];
    const unsigned int d = ordered[3];
    switch (inside)
    {
      case 1:
        AddTriangle(result, EdgeBetween(a, b), EdgeBetween(a, c), EdgeBetween(a, d));
        break;
      case 2:
        AddTriangle(result, EdgeBetween(a, c), EdgeBetween(a, d), EdgeBetween(b, d));
        AddTriangle(result, EdgeBetween(a, c), EdgeBetween(b, d), EdgeBetween(b, c));
        break;
      case 3:
        AddTriangle(result, EdgeBetween(a, d), EdgeBetween(b, d), EdgeBetween(c, d));
        break;
      default:
        break;
    }
  }

  static constexpr Case
  MakeCase(unsigned int kind, unsigned int pattern)
  {
    Case result;
    for (unsigned int tetrahedron = 0; tetrahedron < Tetrahedra; ++tetrahedron)
    {
      AddTetrahedron(result, kind, pattern, TetrahedronSites[tetrahedron]);
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
    EdgeOwner owners[Kinds][Edges] = {};
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
        tables.owners[kind][edge] = OwnerOf(kind, edge);
      }
    }
    return tables;
  }
};

inline constexpr FCCMarchingCases::Tables FCCMarchingTables = FCCMarchingCases::MakeTables();

} // namespace itk

#endif
