#ifndef itkFCCCell_h
#define itkFCCCell_h

#include "itkFCCCells.h"

#include <cstdint>

namespace itk
{

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

} // namespace itk

#endif
