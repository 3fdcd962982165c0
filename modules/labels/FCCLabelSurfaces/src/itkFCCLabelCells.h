#ifndef itkFCCLabelCells_h
#define itkFCCLabelCells_h

#include "itkFCCMarchingCases.h"

namespace itk
{

/** \class FCCLabelCells
 * \brief The edges, faces and tetrahedra of the six-tetrahedra decomposition, and the walls in a tetrahedron.
 *
 * A *simplex* is an edge, a face or a tetrahedron. It is stored by its lowest site (by z, then y, then x) as one of 25
 * types: 7 edges, 12 faces, 6 tetrahedra. A simplex whose sites have all different labels holds one point of the walls,
 * and all its edges are *cut*.
 *
 * In a tetrahedron the walls follow from its faces. A face with two labels holds a line between its two cut edges; one
 * with three holds three lines, from its point to its edges. The point of the tetrahedron's largest simplex with
 * different labels (the first one) is the *apex*, and the walls are the triangles from the apex to the lines in the
 * faces beside it: 1 or 2 triangles for two labels, 5 for three, 12 for four. Lines in one face do not cross, and the
 * apex is not in their plane, so that triangles meet only in common edges and points, wherever the points are in their
 * simplices.
 *
 * A *case* is a set of cut edges of a tetrahedron; 15 of the 64 sets exist, one for each partition of four sites. All
 * tables are derived here at compile time from the tetrahedra of FCCMarchingCases.
 */
struct FCCLabelCells
{
  using SiteType = FCCLattice::SiteType;

  static constexpr unsigned int Edges = FCCLattice::OwnedEdges.size();
  static constexpr unsigned int Faces = 12;
  static constexpr unsigned int Tetrahedra = 6;
  static constexpr unsigned int FirstFace = Edges;
  static constexpr unsigned int FirstTetrahedron = Edges + Faces;
  static constexpr unsigned int Types = Edges + Faces + Tetrahedra;
  static constexpr unsigned int Cases = 64;
  static constexpr unsigned int MostTriangles = 12;

  /** A simplex within another: where its lowest site is, and its type. */
  struct Part
  {
    std::uint8_t site = 0; ///< of the other
    std::uint8_t type = 0;
  };

  /** A simplex: the steps from its lowest site to all its sites, ascending; the first is 0. Its parts are found by the
   * set of their sites, bit n for the n-th. */
  struct Simplex
  {
    std::uint8_t size = 0;
    SiteType steps[4] = {};
    Part parts[16] = {};
    bool isPositive = false; ///< orientation of a tetrahedron's sites
  };

  /** A triangle of the walls in a tetrahedron whose orientation is positive: three sets of sites, and two sites with
   * the labels that it parts. Counter-clockwise seen from the first. */
  struct Triangle
  {
    std::uint8_t corners[3] = {};
    std::uint8_t sides[2] = {};
  };

  struct Case
  {
    bool exists = false;
    std::uint8_t size = 0;
    Triangle triangles[MostTriangles] = {};
  };

  /** The number of the edge between two sites of a tetrahedron: 01, 02, 03, 12, 13, 23. */
  static constexpr unsigned int
  EdgeBetween(unsigned int a, unsigned int b)
  {
    const unsigned int low = a < b ? a : b;
    const unsigned int high = a < b ? b : a;
    return low == 0 ? high - 1 : low + high;
  }

  /** Whether all sites of a set have different labels in a case. */
  static constexpr bool
  AreDifferent(unsigned int pattern, unsigned int set)
  {
    for (unsigned int a = 0; a < 4; ++a)
    {
      for (unsigned int b = a + 1; b < 4; ++b)
      {
        if ((set >> a & 1) != 0 && (set >> b & 1) != 0 && (pattern >> EdgeBetween(a, b) & 1) == 0)
        {
          return false;
        }
      }
    }
    return true;
  }

  static constexpr unsigned int
  SizeOf(unsigned int set)
  {
    return (set & 1) + (set >> 1 & 1) + (set >> 2 & 1) + (set >> 3 & 1);
  }

  /** The largest set of different sites in a case, of these the lowest number: where the apex is. 1 if all are equal.
   */
  static constexpr unsigned int
  FindApex(unsigned int pattern)
  {
    unsigned int apex = 1;
    for (unsigned int set = 1; set < 16; ++set)
    {
      apex = SizeOf(set) > SizeOf(apex) && AreDifferent(pattern, set) ? set : apex;
    }
    return apex;
  }

  /** Adds the triangle between the apex and the line from the cut edge ab to \a other, in the face of a, b and c. Seen
   * from a in a positive tetrahedron a, b, c, d, the apex is on d's side of the face. */
  static constexpr void
  AddTriangle(Case & result,
              unsigned int apex,
              unsigned int a,
              unsigned int b,
              unsigned int c,
              unsigned int d,
              unsigned int other)
  {
    const unsigned int order[4] = { a, b, c, d };
    unsigned int inversions = 0;
    for (unsigned int m = 0; m < 4; ++m)
    {
      for (unsigned int n = m + 1; n < 4; ++n)
      {
        inversions += order[m] > order[n] ? 1 : 0;
      }
    }
    const auto edge = static_cast<std::uint8_t>(1u << a | 1u << b);
    const auto end = static_cast<std::uint8_t>(other);
    const bool isEven = inversions % 2 == 0;
    Triangle & triangle = result.triangles[result.size++];
    triangle.corners[0] = static_cast<std::uint8_t>(apex);
    triangle.corners[1] = isEven ? end : edge;
    triangle.corners[2] = isEven ? edge : end;
    triangle.sides[0] = static_cast<std::uint8_t>(a);
    triangle.sides[1] = static_cast<std::uint8_t>(b);
  }

  /** Adds the triangles between the apex and the lines in the face opposite to site \a d. */
  static constexpr void
  AddFace(Case & result, unsigned int pattern, unsigned int apex, unsigned int d)
  {
    const unsigned int face = 15u & ~(1u << d);
    for (unsigned int c = 0; c < 4; ++c)
    {
      if (c == d)
      {
        continue;
      }
      unsigned int a = 0;
      while (a == c || a == d)
      {
        ++a;
      }
      const unsigned int b = 6 - a - c - d;
      const bool isCut = AreDifferent(pattern, 1u << a | 1u << b);
      if (AreDifferent(pattern, face))
      {
        AddTriangle(result, apex, a, b, c, d, face);
      }
      else if (!isCut && AreDifferent(pattern, 1u << a | 1u << c))
      {
        // c alone: the line from edge ca to edge cb, c being the side it is seen from.
        AddTriangle(result, apex, c, a, b, d, 1u << b | 1u << c);
      }
    }
  }

  static constexpr Case
  MakeCase(unsigned int pattern)
  {
    Case result;
    result.exists = true;
    for (unsigned int d = 0; d < 4; ++d)
    {
      // Being equal is transitive: of the three edges of a face not just one is cut.
      unsigned int cut = 0;
      for (unsigned int a = 0; a < 4; ++a)
      {
        for (unsigned int b = a + 1; b < 4; ++b)
        {
          cut += a != d && b != d ? pattern >> EdgeBetween(a, b) & 1 : 0;
        }
      }
      result.exists = result.exists && cut != 1;
    }
    const unsigned int apex = FindApex(pattern);
    for (unsigned int d = 0; result.exists && d < 4; ++d)
    {
      // The apex is in the face if the face has all its sites.
      if (SizeOf(apex) > 1 && (apex >> d & 1) != 0)
      {
        AddFace(result, pattern, apex, d);
      }
    }
    return result;
  }

  struct Tables
  {
    Simplex simplices[Types] = {}; ///< edges, faces, tetrahedra
    Case cases[Cases] = {};
  };

  /** The simplex of some of another's sites. */
  static constexpr Simplex
  SimplexOf(const Simplex & whole, unsigned int set)
  {
    Simplex simplex;
    SiteType lowest{};
    for (unsigned int n = 0; n < whole.size; ++n)
    {
      if ((set >> n & 1) != 0)
      {
        lowest = simplex.size == 0 ? whole.steps[n] : lowest;
        simplex.steps[simplex.size++] = FCCStep::Subtract(whole.steps[n], lowest);
      }
    }
    return simplex;
  }

  /** The n-th tetrahedron: two kinds of steps of a column have three each. */
  static constexpr Simplex
  TetrahedronOf(unsigned int n)
  {
    constexpr unsigned int kinds = FCCMarchingCases::Kinds;
    Simplex ordered;
    for (const unsigned int site : FCCMarchingCases::TetrahedronSites[n / kinds])
    {
      unsigned int place = ordered.size++;
      ordered.steps[place] = FCCMarchingCases::SiteOf(n % kinds, site);
      for (; place > 0 && FCCStep::IsLower(ordered.steps[place], ordered.steps[place - 1]); --place)
      {
        const SiteType lower = ordered.steps[place];
        ordered.steps[place] = ordered.steps[place - 1];
        ordered.steps[place - 1] = lower;
      }
    }
    Simplex tetrahedron = SimplexOf(ordered, 15);
    const auto & steps = tetrahedron.steps;
    tetrahedron.isPositive = FCCStep::Orientation(steps[0], steps[1], steps[2], steps[3]) > 0;
    return tetrahedron;
  }

  static constexpr bool
  AreEqual(const Simplex & a, const Simplex & b)
  {
    bool equal = a.size == b.size;
    for (unsigned int n = 0; n < 4; ++n)
    {
      equal = equal && FCCStep::AreEqual(a.steps[n], b.steps[n]);
    }
    return equal;
  }

  /** The type of a simplex, or Types if it has none yet. */
  static constexpr unsigned int
  FindType(const Tables & tables, const Simplex & simplex)
  {
    unsigned int type = 0;
    while (type < Types && !AreEqual(tables.simplices[type], simplex))
    {
      ++type;
    }
    return type;
  }

  /** Finds the types of a simplex's parts of some size, itself included. */
  static constexpr void
  FindParts(const Tables & tables, Simplex & simplex, unsigned int size)
  {
    for (unsigned int set = 1; set < 1u << simplex.size; ++set)
    {
      if (SizeOf(set) == size)
      {
        const unsigned int lowest = (set & 1) != 0 ? 0 : (set & 2) != 0 ? 1 : 2;
        simplex.parts[set] = { static_cast<std::uint8_t>(lowest),
                               static_cast<std::uint8_t>(FindType(tables, SimplexOf(simplex, set))) };
      }
    }
  }

  static constexpr Tables
  MakeTables()
  {
    Tables tables;
    for (unsigned int pattern = 0; pattern < Cases; ++pattern)
    {
      tables.cases[pattern] = MakeCase(pattern);
    }
    unsigned int types = 0;
    for (const SiteType & step : FCCLattice::OwnedEdges)
    {
      tables.simplices[types].size = 2;
      tables.simplices[types++].steps[1] = step;
    }
    for (unsigned int size = 3; size <= 4; ++size)
    {
      for (unsigned int n = 0; n < Tetrahedra; ++n)
      {
        const Simplex tetrahedron = TetrahedronOf(n);
        for (unsigned int set = 1; set < 16; ++set)
        {
          Simplex simplex = size == 4 ? tetrahedron : SimplexOf(tetrahedron, set);
          if (SizeOf(set) == size && FindType(tables, simplex) == Types)
          {
            tables.simplices[types++] = simplex;
          }
        }
      }
    }
    for (Simplex & simplex : tables.simplices)
    {
      for (unsigned int size = 2; size <= simplex.size; ++size)
      {
        FindParts(tables, simplex, size);
      }
    }
    return tables;
  }
};

inline constexpr FCCLabelCells::Tables FCCLabelTables = FCCLabelCells::MakeTables();

} // namespace itk

#endif
