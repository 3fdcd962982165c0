#ifndef itkFCCSiteDivision_h
#define itkFCCSiteDivision_h

#include "itkFCCSiteParts.h"
#include "itkFCCSurfaceExtractor.h"

namespace itk
{

/** \class FCCNeighborhood
 * \brief Where the sites of a site's star are, counted as signs are, and which of them exist.
 */
struct FCCNeighborhood
{
  std::array<SizeValueType, 3> places[FCCSiteStar::Sites];
  SizeValueType numbers[FCCSiteStar::Sites]; ///< along x, then y, then z
  unsigned int inBox{ 0 };                   ///< bits of the sites that have signs
  unsigned int inImage{ 0 };                 ///< bits of those in the image

  FCCNeighborhood(const FCCSigns & signs, SizeValueType number);

  /** The bits of some sites, from rows of bits. */
  template <typename TRows>
  unsigned int
  GetBits(const TRows & rows, unsigned int wanted) const
  {
    unsigned int found = 0;
    for (; wanted != 0; wanted &= wanted - 1)
    {
      const auto site = static_cast<unsigned int>(__builtin_ctz(wanted));
      const auto [i, j, k] = places[site];
      found |= unsigned{ FCCBits::Test(rows.GetRow(j, k), i) } << site;
    }
    return found;
  }
};

/** The nearer ends in the star of a site: bit n is set when the end inside is nearer to the crossing on edge n of
 * FCCSiteStar::GetEdges(). Bits of edges that are not cut have no meaning. */
using FCCNearerEndsOfStar = std::uint64_t;
static_assert(FCCSiteStar::Edges <= 64, "all edges of a star fit into one word");

FCCNearerEndsOfStar
FindNearerEndsOfStar(const FCCSigns & signs,
                     const FCCScalarField::ValueReader & readValues,
                     bool insideIsBelow,
                     SizeValueType site);

/** \class FCCSiteDivision
 * \brief Divides one site's crossings into vertices, while the parts of other sites do not change.
 */
class FCCSiteDivision
{
public:
  FCCSiteDivision(const FCCSigns & signs,
                  const FCCSplitRows & split,
                  FCCNearerEndsOfStar nearerEnds,
                  SizeValueType number);

  const FCCSiteParts &
  GetParts() const
  {
    return m_Parts[Center];
  }

  /** Divides the site until none of its vertices breaks a condition of FCCSplitSites. Returns whether it was changed.
   */
  bool
  Divide();

  /** Calls use(number of a site) for sites that have a vertex with an edge of more than two triangles to a vertex of
   * one crossing of this site. When the site has been divided, its own larger vertices have no such edge. */
  template <typename TUse>
  void
  ForEachBrokenNeighbor(const TUse & use) const
  {
    m_Parts[Center].ForEachVertex([this, &use](unsigned int directions) {
      if (IsSingle(directions))
      {
        const auto direction = static_cast<unsigned int>(__builtin_ctz(directions));
        this->CountTriangles(VertexOf(Center, m_Parts[Center].GetVertex(direction)),
                             [&](VertexType end) { use(m_Neighborhood.numbers[end / VerticesOfSite]); });
      }
    });
  }

  /** The most triangles that the tetrahedra with crossings of the site can have: between the plane below and its own,
   * and between its own and the one above. These are the triangles before clustering. */
  std::array<SizeValueType, 2>
  GetMostTriangles() const;

private:
  static constexpr unsigned int Center = FCCSiteStar::Center;

  /** A vertex of the star: its site, and its number in the site's parts, or Whole. */
  using VertexType = std::uint8_t;
  static constexpr unsigned int VerticesOfSite = 16;
  static constexpr unsigned int Whole = 15;
  static_assert(FCCSiteStar::Directions <= Whole && FCCSiteStar::Sites * VerticesOfSite <= 256,
                "a vertex has a number of 8 bits");

  static VertexType
  VertexOf(unsigned int site, unsigned int vertex)
  {
    return static_cast<VertexType>(site * VerticesOfSite + vertex);
  }

  static bool
  IsSingle(unsigned int directions)
  {
    return (directions & (directions - 1)) == 0;
  }

  bool
  IsInside(unsigned int site) const
  {
    return (m_Inside >> site & 1) != 0;
  }
  bool
  IsSplit(unsigned int site) const
  {
    return (m_Split >> site & 1) != 0;
  }

  /** A polygon of the surface with crossings of the site, from the corner where it is cut into triangles on. */
  struct Polygon
  {
    const FCCSiteStar::Tetrahedron * tetrahedron;
    std::uint8_t size;
    VertexType corners[4]; ///< vertices of the site itself are given by directions, whatever its parts
  };

  void
  FindPolygons();

  void
  FindTriangles();

  bool
  StartDividing();

  bool
  Breaks(VertexType vertex) const;

  unsigned int
  FindBroken() const;

  void
  DividePart(unsigned int part);

  /** Counts the triangles of a vertex, and calls use(vertex) for the other ends of its edges with more than two. */
  template <typename TUse>
  unsigned int
  CountTriangles(VertexType vertex, const TUse & use) const
  {
    unsigned int triangles = 0;
    std::uint8_t uses[256] = {};
    for (unsigned int n = 0; n < m_NumberOfTriangles; ++n)
    {
      const auto & triangle = m_Triangles[n];
      if (triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex)
      {
        ++triangles;
        for (const VertexType end : triangle)
        {
          if (end != vertex && ++uses[end] == 3)
          {
            use(end);
          }
        }
      }
    }
    return triangles;
  }

  FCCNeighborhood m_Neighborhood;
  unsigned int m_Inside;
  unsigned int m_Split;
  unsigned int m_Crossings{ 0 }; ///< directions of the crossings that the site is nearer to
  FCCSiteParts m_Parts[FCCSiteStar::Sites];
  std::uint8_t m_NearerSite[FCCSiteStar::Edges]; ///< by edge, if it is cut
  VertexType m_Corners[FCCSiteStar::Edges];      ///< by edge, if it is cut; of the site itself as in Polygon
  unsigned int m_NumberOfPolygons{ 0 };
  Polygon m_Polygons[FCCSiteStar::Tetrahedra];
  unsigned int m_NumberOfTriangles{ 0 };
  std::array<VertexType, 3> m_Triangles[2 * FCCSiteStar::Tetrahedra];
};

} // namespace itk

#endif
