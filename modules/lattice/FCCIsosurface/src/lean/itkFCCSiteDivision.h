#ifndef itkFCCSiteDivision_h
#define itkFCCSiteDivision_h

#include "itkFCCNearerEnds.h"
#include "itkFCCSiteParts.h"

#include <cstring>

namespace itk
{

/** \class FCCStarReader
 * \brief Reads the stars of a row's sites: which sites are inside, and which crossings are nearer to the sites that
 * store their edges.
 */
class FCCStarReader
{
public:
  /** For the row (\a j, \a k). Planes of nearer ends are given below, at and above \a k. */
  FCCStarReader(const FCCSigns & signs,
                const std::array<const FCCNearerEnds *, 3> & nearerEnds,
                SizeValueType j,
                SizeValueType k);

  /** The star of a site. */
  struct Star
  {
    std::uint16_t inside; ///< bits of its sites
    std::uint64_t starts; ///< bits of FCCSiteStar::edges: the edge's first end is nearer; only for cut edges
  };

  Star
  Read(SizeValueType i) const;

private:
  /** A row of bits, and how far from a site's index its bit is. */
  struct Bits
  {
    const FCCSigns::WordType * row;
    SizeValueType shift;
  };

  /** Bits outside the box are 0. */
  bool
  Test(const Bits & bits, SizeValueType i) const
  {
    const SizeValueType place = i + bits.shift; // below 0 wraps around
    return place < m_Width && FCCBits::Test(bits.row, place);
  }

  SizeValueType m_Width;
  Bits m_Inside[FCCSiteStar::Sites];
  Bits m_Starts[FCCSiteStar::Edges];
};

/** \class FCCSiteDivision
 * \brief Divides one site's crossings into vertices, while the parts of other sites do not change.
 */
class FCCSiteDivision
{
public:
  FCCSiteDivision(const FCCSigns & signs,
                  const FCCSplitRows & split,
                  const FCCStarReader::Star & star,
                  const std::array<SizeValueType, 3> & place);

  const FCCSiteParts &
  GetParts() const
  {
    return m_Parts[Center];
  }

  /** Divides the site until none of its vertices breaks a condition of FCCSplitSites. Returns whether it was changed.
   */
  bool
  Divide();

  /** Calls use(place of a site) for sites that have a vertex with an edge of more than two triangles to a vertex of
   * one crossing of this site. When the site has been divided, its own larger vertices have no such edge. */
  template <typename TUse>
  void
  ForEachBrokenNeighbor(const TUse & use) const
  {
    const unsigned int single = this->GetVertices() & ~this->GetGatheredVertices();
    if (single != 0)
    {
      this->CountTriangles(single, [&](unsigned int, VertexType end) { use(m_Places[end / VerticesOfSite]); });
    }
  }

  /** The most triangles that the tetrahedra with crossings of the site can have: between the plane below and its own,
   * and between its own and the plane above. These are the triangles before clustering. */
  std::array<SizeValueType, 2>
  GetMostTriangles() const;

private:
  static constexpr unsigned int Center = FCCSiteStar::Center;

  /** A vertex of the star: its site, and its number in the site's parts, or Whole. */
  using VertexType = std::uint8_t;
  static constexpr unsigned int VerticesOfSite = 16;
  static constexpr unsigned int Whole = 15;
  static_assert(FCCCells::Directions <= Whole && FCCSiteStar::Sites * VerticesOfSite <= 256,
                "a vertex has a number of 8 bits");

  static constexpr VertexType
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
  IsSplit(unsigned int site) const
  {
    return (m_Split >> site & 1) != 0;
  }

  /** A polygon of the surface with crossings of the site, from the corner where it is cut into triangles on. */
  struct Polygon
  {
    bool isBelow;
    std::uint8_t size;
    VertexType corners[4]; ///< vertices of the site itself are given by directions, whatever its parts
  };

  void
  FindPolygons(const FCCStarReader::Star & star);

  unsigned int
  FindBrokenVertices(unsigned int wanted) const;

  void
  StartDividing();

  void
  SetParts(const FCCSiteParts & parts);

  unsigned int
  FindBroken() const;

  unsigned int
  FindHelpful(unsigned int part) const;

  void
  DividePart(unsigned int part);

  /** The vertex of a polygon's corner, with the parts that the site has now. */
  VertexType
  VertexAt(VertexType corner) const
  {
    return corner < VertexOf(Center, 0) ? corner : m_Centers[corner % VerticesOfSite];
  }

  /** Calls use(three corners, their vertices) for the triangles of the polygons: all that have vertices of the site. */
  template <typename TUse>
  void
  ForEachTriangle(const TUse & use) const
  {
    for (unsigned int p = 0; p < m_NumberOfPolygons; ++p)
    {
      const Polygon & polygon = m_Polygons[p];
      VertexType corners[3] = { polygon.corners[0], 0, polygon.corners[1] };
      VertexType vertices[3] = { this->VertexAt(corners[0]), 0, this->VertexAt(corners[2]) };
      for (unsigned int n = 2; n < polygon.size; ++n)
      {
        corners[1] = corners[2];
        vertices[1] = vertices[2];
        corners[2] = polygon.corners[n];
        vertices[2] = this->VertexAt(corners[2]);
        if (vertices[0] != vertices[1] && vertices[1] != vertices[2] && vertices[2] != vertices[0])
        {
          use(corners, vertices);
        }
      }
    }
  }

  /** The numbers of the site's vertices, as bits. */
  unsigned int
  GetVertices() const
  {
    return (1U << m_NumberOfVertices) - 1;
  }

  /** The numbers of the site's vertices that gather crossings, as bits. */
  unsigned int
  GetGatheredVertices() const;

  /** Counts the triangles of some vertices of the site, and calls use(number of a vertex, other end) for their edges
   * with more than two. */
  template <typename TUse>
  std::array<std::uint8_t, VerticesOfSite>
  CountTriangles(unsigned int wanted, const TUse & use) const
  {
    std::array<std::uint8_t, VerticesOfSite> triangles{};
    std::uint8_t uses[VerticesOfSite][256];
    std::memset(uses, 0, m_NumberOfVertices * sizeof uses[0]);
    this->ForEachTriangle([&](const VertexType(&)[3], const VertexType(&vertices)[3]) {
      for (unsigned int n = 0; n < 3; ++n)
      {
        const unsigned int vertex = vertices[n] % VerticesOfSite;
        if (vertices[n] < VertexOf(Center, 0) || (wanted >> vertex & 1) == 0)
        {
          continue;
        }
        ++triangles[vertex];
        for (const VertexType end : { vertices[(n + 1) % 3], vertices[(n + 2) % 3] })
        {
          if (++uses[vertex][end] == 3)
          {
            use(vertex, end);
          }
        }
      }
    });
    return triangles;
  }

  std::array<SizeValueType, 3> m_Places[FCCSiteStar::Sites];
  unsigned int m_Split{ 0 };
  unsigned int m_Crossings{ 0 }; ///< directions of the crossings that the site is nearer to
  FCCSiteParts m_Parts[FCCSiteStar::Sites];
  unsigned int m_NumberOfVertices{ 1 };
  VertexType m_Centers[VerticesOfSite]; ///< the site's vertices, by direction; a whole site has vertex 0
  unsigned int m_NumberOfPolygons{ 0 };
  Polygon m_Polygons[FCCSiteStar::Tetrahedra];
};

} // namespace itk

#endif
