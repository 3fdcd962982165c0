#ifndef itkFCCLabelCells_h
#define itkFCCLabelCells_h

#include "itkFCCCells.h"

namespace itk
{

/** \class FCCLabelCells
 * \brief The walls between labels in a tetrahedron of FCCCells.
 *
 * An edge between two labels is *cut*. A simplex whose sites have all different labels holds one point of the walls,
 * and all its edges are cut.
 *
 * In a tetrahedron the walls follow from its faces. A face with two labels holds a line between its two cut edges; a
 * face with three labels holds three lines, from its point to its edges. The point of the tetrahedron's largest simplex
 * with different labels (the first of these) is the *apex*, and the walls are the triangles from the apex to the lines
 * in the faces beside the apex: 1 or 2 triangles for two labels, 5 for three, 12 for four. Lines in one face do not
 * cross, and the apex is not in their plane, so that triangles meet only in common edges and points, wherever the
 * points are in their simplices.
 *
 * A *case* is a set of cut edges of a tetrahedron; 15 of the 64 sets exist, one for each partition of four sites. The
 * cases are derived here at compile time.
 */
struct FCCLabelCells
{
  static constexpr unsigned int Cases = 64;
  static constexpr unsigned int MostTriangles = 12;

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

  /** The largest set of different sites in a case, of these the lowest number: where the apex is. 1 if all are equal.
   */
  static constexpr unsigned int
  FindApex(unsigned int pattern)
  {
    unsigned int apex = 1;
    for (unsigned int set = 1; set < 16; ++set)
    {
      apex = FCCCells::SizeOf(set) > FCCCells::SizeOf(apex) && AreDifferent(pattern, set) ? set : apex;
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
      // Being equal is transitive: a face has no single cut edge.
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
      if (FCCCells::SizeOf(apex) > 1 && (apex >> d & 1) != 0)
      {
        AddFace(result, pattern, apex, d);
      }
    }
    return result;
  }

  static constexpr std::array<Case, Cases>
  MakeCases()
  {
    std::array<Case, Cases> cases;
    for (unsigned int pattern = 0; pattern < Cases; ++pattern)
    {
      cases[pattern] = MakeCase(pattern);
    }
    return cases;
  }
};

inline constexpr auto FCCLabelCases = FCCLabelCells::MakeCases();

} // namespace itk

#endif
