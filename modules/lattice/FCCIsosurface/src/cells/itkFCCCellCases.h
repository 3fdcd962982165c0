#ifndef itkFCCCellCases_h
#define itkFCCCellCases_h

#include "itkFCCCells.h"

#include <array>
#include <cstdint>
#include <limits>

namespace itk
{

/** \file
 * The whole cells that the modes of FCCIsosurfaceFilter march: their shape, their triangles, and last their kinds. */

/** \class FCCCell
 * \brief A convex polyhedron with sites as corners, whose faces and edges are found from the corners alone.
 *
 * Corners are steps from the cell's *anchor*, a site, so that one polyhedron describes all cells of its kind. Its edges
 * must be of the types of FCCLattice::OwnedEdges.
 */
struct FCCCell
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
    std::uint8_t type = 0;  ///< which of FCCLattice::OwnedEdges it is
  };

  unsigned int numberOfCorners = 0;
  unsigned int numberOfFaces = 0;
  unsigned int numberOfEdges = 0;
  SiteType corners[MaximumCorners] = {};
  Face faces[MaximumFaces] = {};
  Edge edges[MaximumEdges] = {};
  bool onOneFace[MaximumEdges][MaximumEdges] = {}; ///< whether two edges belong to a common face

  /** FCCStep::Orientation() of four corners. */
  constexpr IndexValueType
  Orientation(unsigned int a, unsigned int b, unsigned int c, unsigned int d) const
  {
    return FCCStep::Orientation(corners[a], corners[b], corners[c], corners[d]);
  }

  /** Bits of the types of FCCLattice::OwnedEdges among the edges. */
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

  constexpr void
  AddEdgesOf(const Face & face)
  {
    for (unsigned int n = 0; n < face.size; ++n)
    {
      const std::uint8_t start = face.corners[n];
      const std::uint8_t end = face.corners[(n + 1) % face.size];
      const unsigned int type = FCCCells::DirectionOf(FCCStep::Subtract(corners[end], corners[start]));
      if (type < FCCCells::Edges) // the edge's other face runs along it the other way, so it is added once
      {
        edges[numberOfEdges++] = { start, end, static_cast<std::uint8_t>(type) };
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

  /** The convex hull of some sites, all of which must be corners of it. */
  template <unsigned int VCorners>
  static constexpr FCCCell
  FromCorners(const SiteType (&sites)[VCorners])
  {
    static_assert(VCorners <= MaximumCorners);
    FCCCell cell;
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
      cell.AddEdgesOf(cell.faces[face]);
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
    return cell;
  }
};

/** \class FCCCellCases
 * \brief The triangles of a cell of the lattice, for every pattern of inside and outside, with no point but those on
 * its edges.
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
 * Why the surface is a manifold for any signs: each cut edge is on one segment of each face around it, so the triangles
 * at its point form one fan, unless two of them share an edge with other triangles, too. Segments differ, as they lie
 * on different faces or on different sides of one. Two edges are common to several cells only if both lie on a
 * common face; so it is enough that no diagonal joins two edges of one face. Among the ways to cut a loop into
 * triangles without such a diagonal, that with the least sum of squared lengths of the diagonals is taken, points being
 * at the middle of their edges. Then no triangle is degenerate, either: three points on the border of a convex cell are
 * collinear only if they lie on one face.
 *
 * The tables are derived here at compile time. The idea that segments on faces, loops and then triangles are found by
 * rule is from J. Bloomenthal, "Polygonization of implicit surfaces", Computer Aided Geometric Design 5 (1988); the
 * cutting of loops is the dynamic programme of G. T. Klincsek, "Minimal triangulations of polygonal domains" (1980).
 *
 * \tparam VCorners corners of the cell
 */
template <unsigned int VCorners>
struct FCCCellCases
{
  /** A loop passes each of n edges once and has n - 2 triangles. */
  static constexpr unsigned int MaximumTriangles = FCCCell::MaximumEdges - 2;

  struct Case
  {
    std::uint8_t triangles = 0;
    std::uint8_t edges[MaximumTriangles][3] = {}; ///< the edges of each triangle's corners
  };

  /** The segments of one case: the edge that follows an edge in its loop. */
  struct Segments
  {
    std::uint8_t next[FCCCell::MaximumEdges] = {};
    bool isCut[FCCCell::MaximumEdges] = {};
  };

  struct Loop
  {
    unsigned int size = 0;
    std::uint8_t edges[FCCCell::MaximumEdges] = {};
  };

  std::array<Case, 1u << VCorners> cases{};
  bool hasDiagonalOnFace = false; ///< in any of the cases

  static constexpr bool
  IsInside(unsigned int pattern, unsigned int corner)
  {
    return (pattern >> corner & 1) != 0;
  }

  static constexpr std::uint8_t
  EdgeBetween(const FCCCell & cell, unsigned int a, unsigned int b)
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
  AreInsideCornersConnected(const FCCCell & cell, const FCCCell::Face & face, unsigned int pattern)
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
  AddSegments(Segments & segments, const FCCCell & cell, const FCCCell::Face & face, unsigned int pattern)
  {
    std::uint8_t crossings[FCCCell::MaximumFaceCorners] = {};
    bool isWayIn[FCCCell::MaximumFaceCorners] = {};
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

  /** Squared length, times four, of a diagonal between the middles of two edges. */
  static constexpr IndexValueType
  DiagonalCost(const FCCCell & cell, unsigned int a, unsigned int b)
  {
    constexpr IndexValueType prohibitive = 1000000; // cost of a diagonal between equal edges
    FCCCell::SiteType step{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      step[axis] = cell.corners[cell.edges[a].start][axis] + cell.corners[cell.edges[a].end][axis] -
                   cell.corners[cell.edges[b].start][axis] - cell.corners[cell.edges[b].end][axis];
    }
    return cell.onOneFace[a][b] ? prohibitive : FCCStep::SquaredLength(step);
  }

  /** Cuts a loop into triangles: finds the best third point between each two points, from short stretches to long. */
  constexpr void
  AddTriangles(Case & result, const FCCCell & cell, const Loop & loop)
  {
    // By the ends of a stretch: its cost with its closing diagonal.
    IndexValueType cost[FCCCell::MaximumEdges][FCCCell::MaximumEdges] = {};
    std::uint8_t third[FCCCell::MaximumEdges][FCCCell::MaximumEdges] = {};
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

    std::uint8_t stretches[FCCCell::MaximumEdges][2] = { { 0, static_cast<std::uint8_t>(loop.size - 1) } };
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

  static constexpr FCCCellCases
  Of(const FCCCell & cell)
  {
    FCCCellCases result;
    for (unsigned int pattern = 0; pattern < result.cases.size(); ++pattern)
    {
      Segments segments;
      for (unsigned int face = 0; face < cell.numberOfFaces; ++face)
      {
        AddSegments(segments, cell, cell.faces[face], pattern);
      }
      for (unsigned int start = 0; start < cell.numberOfEdges; ++start)
      {
        Loop loop;
        for (auto edge = static_cast<std::uint8_t>(start); segments.isCut[edge]; edge = segments.next[edge])
        {
          segments.isCut[edge] = false; // once around
          loop.edges[loop.size++] = edge;
        }
        if (loop.size > 0)
        {
          result.AddTriangles(result.cases[pattern], cell, loop);
        }
      }
    }
    return result;
  }
};

/** Mode `octahedra` marches the Delaunay cells of the lattice: an octahedron around each odd point, and a regular
 * tetrahedron in each unit cube. Each site is the anchor of one octahedron, that of the odd point after it in its row,
 * and of two tetrahedra, those of the unit cubes after and before it in x, which lie after it in y and z. All faces are
 * triangles, so the surface between the cells is unique. Within an octahedron, two opposite corners that are inside
 * alone, or outside alone, have a cap each. */
struct FCCOctahedron
{
  static constexpr FCCCell::SiteType Corners[6] = { { 0, 0, 0 }, { 2, 0, 0 },  { 1, -1, 0 },
                                                    { 1, 1, 0 }, { 1, 0, -1 }, { 1, 0, 1 } };
  static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
  static constexpr FCCCellCases<6> Cases = FCCCellCases<6>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

struct FCCTetrahedronAfter
{
  static constexpr FCCCell Cell = FCCCell::FromCorners(FCCCells::Simplices[FCCCells::FirstTetrahedron].steps);
  static constexpr FCCCellCases<4> Cases = FCCCellCases<4>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

struct FCCTetrahedronBefore
{
  static constexpr FCCCell Cell = FCCCell::FromCorners(FCCCells::Simplices[FCCCells::FirstTetrahedron + 1].steps);
  static constexpr FCCCellCases<4> Cases = FCCCellCases<4>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

/** The primitive parallelepipeds of the lattice, rhombohedra with the edges (0, 1, 1), (1, 0, 1) and (1, 1, 0): mode
 * `parallelepipeds`.
 *
 * Each is an octahedron and the two regular tetrahedra on its faces that look along (1, 1, 1) and against it, and each
 * site is the anchor of the parallelepiped whose octahedron is that of the odd point after the site in its row. Only
 * three edges a site carry points. It is the scheme that fits the triangle counts of Y. Sahillioglu, "A marching
 * algorithm for isosurface extraction from face-centered cubic lattices", Turk J Elec Eng & Comp Sci 25 (2017). Sites
 * that are connected across a face's short diagonal are nearest neighbours. */
struct FCCParallelepiped
{
  static constexpr FCCCell::SiteType Corners[8] = { { 0, 0, 0 },  { 2, 0, 0 }, { 1, -1, 0 },  { 1, 1, 0 },
                                                    { 1, 0, -1 }, { 1, 0, 1 }, { 0, -1, -1 }, { 2, 1, 1 } };
  static constexpr FCCCell Cell = FCCCell::FromCorners(Corners);
  static constexpr FCCCellCases<8> Cases = FCCCellCases<8>::Of(Cell);
  static_assert(!Cases.hasDiagonalOnFace);
};

} // namespace itk

#endif
