#ifndef itkLatticeCellCases_h
#define itkLatticeCellCases_h

#include "itkFCCCells.h"

#include <array>
#include <cstdint>
#include <limits>

namespace itk
{

/** \file
 * Whole cells of a lattice that are marched: their shape and their triangles. */

/** \class LatticeCell
 * \brief A convex polyhedron with sites as corners, whose faces and edges are found from the corners alone.
 *
 * Corners are steps from the cell's *anchor*, a site, so that one polyhedron describes all cells of its kind. Its edges
 * must be among the lattice's types of edges, the steps along the edges that a site stores.
 */
struct LatticeCell
{
  using SiteType = FCCLattice::SiteType;

  static constexpr unsigned int MaximumCorners = 8;
  static constexpr unsigned int MaximumFaces = 8;
  static constexpr unsigned int MaximumEdges = 12;
  static constexpr unsigned int MaximumFaceCorners = 4;

  /** Corners, counter-clockwise seen from outside the cell. */
  struct Face
  {
    std::uint8_t size = 0;
    std::uint8_t corners[MaximumFaceCorners] = {};
  };

  struct Edge
  {
    std::uint8_t start = 0; ///< the corner that stores the edge
    std::uint8_t end = 0;   ///< the other corner
    std::uint8_t type = 0;  ///< which of the lattice's types it is
  };

  unsigned int numberOfCorners = 0;
  unsigned int numberOfFaces = 0;
  unsigned int numberOfEdges = 0;
  SiteType corners[MaximumCorners] = {};
  Face faces[MaximumFaces] = {};
  Edge edges[MaximumEdges + 1] = {};               ///< behind them the axis
  bool onOneFace[MaximumEdges][MaximumEdges] = {}; ///< whether two edges belong to a common face

  /** FCCStep::Orientation() of four corners. */
  constexpr IndexValueType
  Orientation(unsigned int a, unsigned int b, unsigned int c, unsigned int d) const
  {
    return FCCStep::Orientation(corners[a], corners[b], corners[c], corners[d]);
  }

  /** Bits of the types among the edges. */
  constexpr std::uint8_t
  GetEdgeTypes() const
  {
    unsigned int types = 0;
    for (unsigned int edge = 0; edge < numberOfEdges; ++edge)
    {
      types |= 1u << edges[edge].type;
    }
    return static_cast<std::uint8_t>(types);
  }

  /** Adds the face through three corners if these are the face's first corners, the second and third in any order. */
  constexpr void
  AddFaceThrough(std::uint8_t a, std::uint8_t b, std::uint8_t c)
  {
    std::uint8_t members[MaximumFaceCorners] = { a, b, c };
    unsigned int size = 3;
    bool hasAbove = false;
    bool hasBelow = false;
    for (std::uint8_t d = 0; d < numberOfCorners; ++d)
    {
      const IndexValueType side = d == a || d == b || d == c ? 0 : this->Orientation(a, b, c, d);
      hasAbove = hasAbove || side > 0;
      hasBelow = hasBelow || side < 0;
      if (side == 0 && d != a && d != b && d != c)
      {
        if (d < c)
        {
          return; // another three corners come first
        }
        members[size++] = d;
      }
    }
    if (hasAbove && hasBelow)
    {
      return;
    }

    // From each corner to the corner that leaves all others on the left, seen from outside: the side without corners.
    unsigned int apex = 0; // any corner off the face
    while (this->Orientation(a, b, c, apex) == 0)
    {
      ++apex;
    }
    Face & face = faces[numberOfFaces++];
    std::uint8_t corner = a;
    for (face.size = 0; face.size < size; ++face.size)
    {
      face.corners[face.size] = corner;
      std::uint8_t next = corner;
      for (unsigned int candidate = 0; candidate < size; ++candidate)
      {
        bool hasOthersOnTheLeft = members[candidate] != corner;
        for (unsigned int other = 0; other < size; ++other)
        {
          hasOthersOnTheLeft =
            hasOthersOnTheLeft && this->Orientation(corner, members[candidate], members[other], apex) <= 0;
        }
        next = hasOthersOnTheLeft ? members[candidate] : next;
      }
      corner = next;
    }
  }

  /** The type of a step; the number of types for other steps. */
  template <std::size_t VTypes>
  static constexpr std::uint8_t
  TypeOf(const SiteType & step, const std::array<SiteType, VTypes> & types)
  {
    std::uint8_t type = 0;
    while (type < VTypes && !FCCStep::AreEqual(types[type], step))
    {
      ++type;
    }
    return type;
  }

  template <std::size_t VTypes>
  constexpr void
  AddEdgesOf(const Face & face, const std::array<SiteType, VTypes> & types)
  {
    for (unsigned int n = 0; n < face.size; ++n)
    {
      const std::uint8_t start = face.corners[n];
      const std::uint8_t end = face.corners[(n + 1) % face.size];
      const std::uint8_t type = TypeOf(FCCStep::Subtract(corners[end], corners[start]), types);
      if (type < VTypes) // the edge's other face runs along it the other way, so it is added once
      {
        edges[numberOfEdges++] = { start, end, type };
      }
    }
  }

  constexpr bool
  IsOn(const Edge & edge, const Face & face) const
  {
    bool hasStart = false;
    bool hasEnd = false;
    for (unsigned int n = 0; n < face.size; ++n)
    {
      hasStart = hasStart || face.corners[n] == edge.start;
      hasEnd = hasEnd || face.corners[n] == edge.end;
    }
    return hasStart && hasEnd;
  }

  /** Whether the cell has an *axis*: a line between corners through its inside that is shorter than all others, and an
   * edge of the lattice. */
  constexpr bool
  HasAxis() const
  {
    return edges[numberOfEdges].start != edges[numberOfEdges].end;
  }

  template <std::size_t VTypes>
  constexpr void
  FindAxis(const std::array<SiteType, VTypes> & types)
  {
    Edge & axis = edges[numberOfEdges];
    IndexValueType least = std::numeric_limits<IndexValueType>::max();
    for (std::uint8_t a = 0; a < numberOfCorners; ++a)
    {
      for (auto b = static_cast<std::uint8_t>(a + 1); b < numberOfCorners; ++b)
      {
        bool isOnFace = false;
        for (unsigned int face = 0; face < numberOfFaces; ++face)
        {
          isOnFace = isOnFace || IsOn({ a, b, 0 }, faces[face]);
        }
        const SiteType step = FCCStep::Subtract(corners[b], corners[a]);
        const IndexValueType squared = FCCStep::SquaredLength(step);
        if (isOnFace || squared > least)
        {
          continue;
        }
        const std::uint8_t type = TypeOf(step, types);
        const std::uint8_t opposite = TypeOf(FCCStep::Multiply(-1, step), types);
        axis = type < VTypes ? Edge{ a, b, type } : opposite < VTypes ? Edge{ b, a, opposite } : Edge{};
        axis = squared < least ? axis : Edge{};
        least = squared;
      }
    }
  }

  /** The convex hull of some sites, all of which must be corners of it. \a types are the lattice's types of edges. */
  template <std::size_t VTypes, unsigned int VCorners>
  static constexpr LatticeCell
  FromCorners(const std::array<SiteType, VTypes> & types, const SiteType (&sites)[VCorners])
  {
    static_assert(VCorners <= MaximumCorners);
    LatticeCell cell;
    for (const SiteType & site : sites)
    {
      cell.corners[cell.numberOfCorners++] = site;
    }
    for (std::uint8_t a = 0; a < VCorners; ++a)
    {
      for (auto b = static_cast<std::uint8_t>(a + 1); b < VCorners; ++b)
      {
        for (auto c = static_cast<std::uint8_t>(b + 1); c < VCorners; ++c)
        {
          cell.AddFaceThrough(a, b, c);
        }
      }
    }
    for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
    {
      cell.AddEdgesOf(cell.faces[face], types);
    }
    for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
    {
      for (unsigned int a = 0; a < cell.numberOfEdges; ++a)
      {
        for (unsigned int b = 0; b < cell.numberOfEdges; ++b)
        {
          cell.onOneFace[a][b] = cell.onOneFace[a][b] || (cell.IsOn(cell.edges[a], cell.faces[face]) &&
                                                          cell.IsOn(cell.edges[b], cell.faces[face]));
        }
      }
    }
    cell.FindAxis(types);
    return cell;
  }
};

/** \class LatticeCellCases
 * \brief The triangles of a cell of the lattice, for every pattern of inside and outside, with points on its edges
 * only, and in few cases one on its axis.
 *
 * A *case* is a number with one bit for each corner of the cell; bit c is set when corner c is inside. On each face the
 * surface leaves *segments* between cut edges; segments join to *loops*, and each loop is cut into triangles by
 * *diagonals*, given by the edges on which their corners lie, counter-clockwise seen from outside when the lattice's
 * axes are right-handed.
 *
 * A face with two cut edges has one segment. A quadrilateral whose opposite corners are inside is *ambiguous*: the
 * corners at the ends of its short diagonal are taken as connected, so the segments cut off the other two. Marching
 * the two triangles beside the short diagonal, which can't be cut itself, gives the same. Both cells at a face see the
 * same segments, so the surface has no cracks.
 *
 * If the two ends of the cell's axis are inside alone, or outside alone, the segments form two loops, which a *band*
 * joins, as these sites are connected along the axis. All other loops have a cap each.
 *
 * Why the surface is a manifold for any signs: each cut edge is on one segment of each face around it, so the triangles
 * at its point form one fan, unless two of them share an edge with other triangles, too. Segments differ, as they lie
 * on different faces or on different sides of one. Two edges are common to several cells only if both lie on a
 * common face; so it is enough that no diagonal joins two edges of one face, and a band has none twice. Among the ways
 * to cut a loop into triangles without such a diagonal, that with the least sum of squared lengths of the diagonals is
 * taken, points being at the middle of their edges. A loop for which there is none is cut into triangles about the
 * point on the axis, which lies in no other cell, if the axis is cut. Then no triangle is degenerate, either: three
 * points on the border of a convex cell are collinear only if they lie on one face.
 *
 * The tables are derived here at compile time. The idea that segments on faces, loops and then triangles are found by
 * rule is from J. Bloomenthal, "Polygonization of implicit surfaces", Computer Aided Geometric Design 5 (1988); the
 * cutting of loops is the dynamic programme of G. T. Klincsek, "Minimal triangulations of polygonal domains" (1980).
 *
 * \tparam VCorners corners of the cell
 */
template <unsigned int VCorners>
struct LatticeCellCases
{
  /** A loop passes each of n edges once and has n - 2 triangles, or n about the axis. */
  static constexpr unsigned int MaximumTriangles = LatticeCell::MaximumEdges;

  /** A loop has at least 3 edges; the last place stays empty. */
  static constexpr unsigned int MaximumLoops = LatticeCell::MaximumEdges / 3 + 1;

  struct Case
  {
    std::uint8_t triangles = 0;
    std::uint8_t edges[MaximumTriangles][3] = {}; ///< the edges of each triangle's corners
  };

  /** The segments of one case: the edge that follows an edge in its loop. */
  struct Segments
  {
    std::uint8_t next[LatticeCell::MaximumEdges] = {};
    bool isCut[LatticeCell::MaximumEdges] = {};
  };

  struct Loop
  {
    unsigned int size = 0;
    std::uint8_t edges[LatticeCell::MaximumEdges] = {};
  };

  std::array<Case, 1u << VCorners> cases{};
  bool hasDiagonalOnFace = false; ///< in any of the cases

  static constexpr bool
  IsInside(unsigned int pattern, unsigned int corner)
  {
    return (pattern >> corner & 1) != 0;
  }

  static constexpr std::uint8_t
  EdgeBetween(const LatticeCell & cell, unsigned int a, unsigned int b)
  {
    std::uint8_t edge = 0;
    while (!((cell.edges[edge].start == a && cell.edges[edge].end == b) ||
             (cell.edges[edge].start == b && cell.edges[edge].end == a)))
    {
      ++edge;
    }
    return edge;
  }

  /** On an ambiguous face: whether its inside corners are nearer to each other than its outside corners. */
  static constexpr bool
  AreInsideCornersConnected(const LatticeCell & cell, const LatticeCell::Face & face, unsigned int pattern)
  {
    const unsigned int inside = IsInside(pattern, face.corners[0]) ? 0 : 1;
    const auto squaredDiagonal = [&cell, &face](unsigned int first) {
      return FCCStep::SquaredLength(
        FCCStep::Subtract(cell.corners[face.corners[first + 2]], cell.corners[face.corners[first]]));
    };
    return squaredDiagonal(inside) < squaredDiagonal(1 - inside);
  }

  /** Adds the segments of one face. Along its border the surface is met in turn on the way out and on the way in. A
   * segment with the inside on its left leads from a way in to the next way out, around inside corners, or where they
   * are connected, back to the way out before, around outside corners. */
  static constexpr void
  AddSegments(Segments & segments, const LatticeCell & cell, const LatticeCell::Face & face, unsigned int pattern)
  {
    std::uint8_t crossings[LatticeCell::MaximumFaceCorners] = {};
    bool isWayIn[LatticeCell::MaximumFaceCorners] = {};
    unsigned int size = 0;
    for (unsigned int n = 0; n < face.size; ++n)
    {
      const unsigned int corner = face.corners[n];
      const unsigned int next = face.corners[(n + 1) % face.size];
      if (IsInside(pattern, corner) != IsInside(pattern, next))
      {
        crossings[size] = EdgeBetween(cell, corner, next);
        isWayIn[size] = IsInside(pattern, next);
        ++size;
      }
    }
    const bool isAmbiguous = size == 4;
    const unsigned int toWayOut = isAmbiguous && AreInsideCornersConnected(cell, face, pattern) ? size - 1 : 1;
    for (unsigned int n = 0; n < size; ++n)
    {
      segments.isCut[crossings[n]] = true;
      if (isWayIn[n])
      {
        segments.next[crossings[n]] = crossings[(n + toWayOut) % size];
      }
    }
  }

  /** The cost of a diagonal between edges of one face. */
  static constexpr IndexValueType Prohibitive = 1000000;

  /** Squared length, times four, of a diagonal between the middles of two edges. */
  static constexpr IndexValueType
  DiagonalCost(const LatticeCell & cell, unsigned int a, unsigned int b)
  {
    LatticeCell::SiteType step{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      step[axis] = cell.corners[cell.edges[a].start][axis] + cell.corners[cell.edges[a].end][axis] -
                   cell.corners[cell.edges[b].start][axis] - cell.corners[cell.edges[b].end][axis];
    }
    return cell.onOneFace[a][b] ? Prohibitive : FCCStep::SquaredLength(step);
  }

  static constexpr void
  AddTrianglesAboutAxis(Case & result, const LatticeCell & cell, const Loop & loop)
  {
    for (unsigned int n = 0; n < loop.size; ++n)
    {
      auto & triangle = result.edges[result.triangles++];
      triangle[0] = loop.edges[n];
      triangle[1] = loop.edges[(n + 1) % loop.size];
      triangle[2] = static_cast<std::uint8_t>(cell.numberOfEdges);
    }
  }

  /** Cuts a loop into triangles: finds the best third point between each two points, from short stretches to long.
   * \a mayUseAxis: if the axis is cut and not used yet. */
  constexpr void
  AddTriangles(Case & result, const LatticeCell & cell, const Loop & loop, bool & mayUseAxis)
  {
    // By the ends of a stretch: its cost with its closing diagonal.
    IndexValueType cost[LatticeCell::MaximumEdges][LatticeCell::MaximumEdges] = {};
    std::uint8_t third[LatticeCell::MaximumEdges][LatticeCell::MaximumEdges] = {};
    for (unsigned int length = 2; length < loop.size; ++length)
    {
      for (unsigned int first = 0; first + length < loop.size; ++first)
      {
        const unsigned int last = first + length;
        IndexValueType least = std::numeric_limits<IndexValueType>::max();
        for (unsigned int between = first + 1; between < last; ++between)
        {
          const IndexValueType sum = cost[first][between] + cost[between][last];
          if (sum < least)
          {
            least = sum;
            third[first][last] = static_cast<std::uint8_t>(between);
          }
        }
        const bool isDiagonal = length + 1 < loop.size; // or else the loop's last segment
        cost[first][last] = least + (isDiagonal ? DiagonalCost(cell, loop.edges[first], loop.edges[last]) : 0);
      }
    }

    if (mayUseAxis && cost[0][loop.size - 1] >= Prohibitive)
    {
      AddTrianglesAboutAxis(result, cell, loop);
      mayUseAxis = false;
      return;
    }
    std::uint8_t stretches[LatticeCell::MaximumEdges][2] = { { 0, static_cast<std::uint8_t>(loop.size - 1) } };
    unsigned int waiting = 1;
    while (waiting > 0)
    {
      --waiting;
      const std::uint8_t first = stretches[waiting][0];
      const std::uint8_t last = stretches[waiting][1];
      const std::uint8_t between = third[first][last];
      auto & triangle = result.edges[result.triangles++];
      triangle[0] = loop.edges[first];
      triangle[1] = loop.edges[between];
      triangle[2] = loop.edges[last];
      const bool isClosing = last - first + 1u < loop.size;
      hasDiagonalOnFace = hasDiagonalOnFace || (isClosing && cell.onOneFace[triangle[0]][triangle[2]]);
      if (last - between > 1)
      {
        stretches[waiting][0] = between;
        stretches[waiting++][1] = last;
      }
      if (between - first > 1)
      {
        stretches[waiting][0] = first;
        stretches[waiting++][1] = between;
      }
    }
  }

  /** Joins two loops by a band, cut open along the shortest line between them. */
  constexpr void
  AddBand(Case & result, LatticeCell cell, const Loop & first, const Loop & second)
  {
    unsigned int from = 0;
    unsigned int to = 0;
    for (unsigned int a = 0; a < first.size; ++a)
    {
      for (unsigned int b = 0; b < second.size; ++b)
      {
        if (DiagonalCost(cell, first.edges[a], second.edges[b]) <
            DiagonalCost(cell, first.edges[from], second.edges[to]))
        {
          from = a;
          to = b;
        }
      }
    }
    Loop band;
    for (unsigned int n = 0; n <= first.size; ++n)
    {
      band.edges[band.size++] = first.edges[(from + n) % first.size];
    }
    for (unsigned int n = 0; n <= second.size; ++n)
    {
      band.edges[band.size++] = second.edges[(to + n) % second.size];
    }
    const std::uint8_t a = first.edges[from];
    const std::uint8_t b = second.edges[to];
    cell.onOneFace[a][b] = cell.onOneFace[b][a] = true; // both sides of the cut are there already
    bool mayUseAxis = false;                            // which is not cut
    this->AddTriangles(result, cell, band, mayUseAxis);
  }

  /** Whether the ends of the cell's axis are inside alone, or outside alone. */
  static constexpr bool
  HasBand(const LatticeCell & cell, unsigned int pattern)
  {
    const auto & axis = cell.edges[cell.numberOfEdges];
    const unsigned int ends = 1u << axis.start | 1u << axis.end;
    return cell.HasAxis() && (pattern == ends || (pattern ^ ends) == (1u << VCorners) - 1);
  }

  static constexpr LatticeCellCases
  Of(const LatticeCell & cell)
  {
    LatticeCellCases result;
    for (unsigned int pattern = 0; pattern < result.cases.size(); ++pattern)
    {
      Segments segments;
      for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
      {
        AddSegments(segments, cell, cell.faces[face], pattern);
      }
      Loop loops[MaximumLoops];
      unsigned int size = 0;
      for (unsigned int start = 0; start < cell.numberOfEdges; ++start)
      {
        Loop & loop = loops[size];
        for (auto edge = static_cast<std::uint8_t>(start); segments.isCut[edge]; edge = segments.next[edge])
        {
          segments.isCut[edge] = false; // once around
          loop.edges[loop.size++] = edge;
        }
        size += loop.size > 0 ? 1 : 0;
      }
      if (HasBand(cell, pattern))
      {
        result.AddBand(result.cases[pattern], cell, loops[0], loops[1]);
        continue;
      }
      const auto & axis = cell.edges[cell.numberOfEdges];
      bool mayUseAxis = IsInside(pattern, axis.start) != IsInside(pattern, axis.end);
      for (unsigned int n = 0; n < size; ++n)
      {
        result.AddTriangles(result.cases[pattern], cell, loops[n], mayUseAxis);
      }
    }
    return result;
  }
};

} // namespace itk

#endif
